//! `actionlib_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/actionlib_msgs`
//! instead.

crate::message! {
    /// Name of a goal of an action of ROS 1.
    "actionlib_msgs/msg/GoalID" "RIHS01_140ea4a1bad4781edc32030c7983ab3a62c675f861c61c9b2200ae5e5398be24"
    GoalID {
        /// Time of the request.
        stamp: crate::builtin_interfaces::Time,
        /// id
        id: std::string::String,
    }
}

crate::message! {
    /// State of a goal of an action of ROS 1.
    "actionlib_msgs/msg/GoalStatus" "RIHS01_c90c64230954d90ee079cbdd22a14bca3650b3d403f5cc3faf0eee992c6ae9ff"
    GoalStatus {
        /// goal_id
        goal_id: GoalID,
        /// One of the values below.
        status: u8,
        /// Reason, in words.
        text: std::string::String,
    }
    /// PENDING
    PENDING: u8 = 0;
    /// ACTIVE
    ACTIVE: u8 = 1;
    /// PREEMPTED
    PREEMPTED: u8 = 2;
    /// SUCCEEDED
    SUCCEEDED: u8 = 3;
    /// ABORTED
    ABORTED: u8 = 4;
    /// REJECTED
    REJECTED: u8 = 5;
    /// PREEMPTING
    PREEMPTING: u8 = 6;
    /// RECALLING
    RECALLING: u8 = 7;
    /// RECALLED
    RECALLED: u8 = 8;
    /// LOST
    LOST: u8 = 9;
}

crate::message! {
    /// States of all goals of an action of ROS 1.
    "actionlib_msgs/msg/GoalStatusArray" "RIHS01_f3230208e8daec53eb7b8da6df1c1d1d4eb095f3082be922661c29a1f855a1bc"
    GoalStatusArray {
        /// header
        header: crate::std_msgs::Header,
        /// status_list
        status_list: Vec<GoalStatus>,
    }
}
