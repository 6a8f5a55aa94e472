//! `move_base_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/move_base_msgs`
//! instead.

crate::message! {
    /// All messages of the action, by which ROS 1 names its type.
    "move_base_msgs/msg/MoveBaseAction" "RIHS01_99caf89cb9c295f4c2e9c9e15667590ae345153a3cc56497147dba5914ca7853"
    MoveBaseAction {
        /// action_goal
        action_goal: MoveBaseActionGoal,
        /// action_result
        action_result: MoveBaseActionResult,
        /// action_feedback
        action_feedback: MoveBaseActionFeedback,
    }
}

crate::message! {
    /// Feedback as a server of ROS 1 publishes it.
    "move_base_msgs/msg/MoveBaseActionFeedback" "RIHS01_0cf9d40e3e735377a34078c2f27836753bef67dde932ee30f42e665edea16c8a"
    MoveBaseActionFeedback {
        /// header
        header: crate::std_msgs::Header,
        /// status
        status: crate::actionlib_msgs::GoalStatus,
        /// feedback
        feedback: MoveBaseFeedback,
    }
}

crate::message! {
    /// Goal as a client of ROS 1 publishes it.
    "move_base_msgs/msg/MoveBaseActionGoal" "RIHS01_2d005193b75ff3b9b629646a14daf98c54c97cf82c3097cbdde4f47db7308104"
    MoveBaseActionGoal {
        /// header
        header: crate::std_msgs::Header,
        /// goal_id
        goal_id: crate::actionlib_msgs::GoalID,
        /// goal
        goal: MoveBaseGoal,
    }
}

crate::message! {
    /// Result as a server of ROS 1 publishes it.
    "move_base_msgs/msg/MoveBaseActionResult" "RIHS01_6fd77b564df962dc94b4fc9c15eeb1a25097808ea688ab48da35b12b0c0aa704"
    MoveBaseActionResult {
        /// header
        header: crate::std_msgs::Header,
        /// status
        status: crate::actionlib_msgs::GoalStatus,
        /// result
        result: MoveBaseResult,
    }
}

crate::message! {
    /// Feedback of the node move_base of ROS 1.
    "move_base_msgs/msg/MoveBaseFeedback" "RIHS01_512b94513ca1b545b94db991599e44cd367f4d536bd7ddbb69b0e12671c9b8e2"
    MoveBaseFeedback {
        /// Pose of the robot.
        base_position: crate::geometry_msgs::PoseStamped,
    }
}

crate::message! {
    /// Goal of the node move_base of ROS 1.
    "move_base_msgs/msg/MoveBaseGoal" "RIHS01_509311338ecb99d269ef2f388b9445f0545c2805bba5b38210d610ecee3e791f"
    MoveBaseGoal {
        /// target_pose
        target_pose: crate::geometry_msgs::PoseStamped,
    }
}

crate::message! {
    /// Empty result of the node move_base of ROS 1.
    "move_base_msgs/msg/MoveBaseResult" "RIHS01_eff30da5bc2b4e90bcf0e1e52b8ccc8f0768bb212208cbe329a959a25397d626"
    MoveBaseResult {
    }
}

crate::message! {
    /// Recovery of the node move_base of ROS 1.
    "move_base_msgs/msg/RecoveryStatus" "RIHS01_f785d652684298ad52f4f130a437011b3d0a9b7b494562b7d8b7cc54afadfeae"
    RecoveryStatus {
        /// Pose of the robot.
        pose_stamped: crate::geometry_msgs::PoseStamped,
        /// current_recovery_number
        current_recovery_number: u16,
        /// total_number_of_recoveries
        total_number_of_recoveries: u16,
        /// recovery_behavior_name
        recovery_behavior_name: std::string::String,
    }
}
