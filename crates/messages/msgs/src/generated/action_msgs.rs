//! `action_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/action_msgs`
//! instead.

crate::message! {
    /// Names one goal of an action.
    "action_msgs/msg/GoalInfo" "RIHS01_6398fe763154554353930716b225947f93b672f0fb2e49fdd01bb7a7e37933e9"
    GoalInfo {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// How far a goal is.
    "action_msgs/msg/GoalStatus" "RIHS01_32f4cfd717735d17657e1178f24431c1ce996c878c515230f6c5b3476819dbb9"
    GoalStatus {
        /// goal_info
        goal_info: GoalInfo,
        /// status
        status: i8,
    }
    /// STATUS_UNKNOWN
    STATUS_UNKNOWN: i8 = 0;
    /// STATUS_ACCEPTED
    STATUS_ACCEPTED: i8 = 1;
    /// STATUS_EXECUTING
    STATUS_EXECUTING: i8 = 2;
    /// STATUS_CANCELING
    STATUS_CANCELING: i8 = 3;
    /// STATUS_SUCCEEDED
    STATUS_SUCCEEDED: i8 = 4;
    /// STATUS_CANCELED
    STATUS_CANCELED: i8 = 5;
    /// STATUS_ABORTED
    STATUS_ABORTED: i8 = 6;
}

crate::message! {
    /// How far all goals of an action server are.
    "action_msgs/msg/GoalStatusArray" "RIHS01_6c1684b00f177d37438febe6e709fc4e2b0d4248dca4854946f9ed8b30cda83e"
    GoalStatusArray {
        /// status_list
        status_list: Vec<GoalStatus>,
    }
}

crate::message! {
    /// Asks to stop goals: an id of zeros means all, a time of zero any time.
    "action_msgs/srv/CancelGoal_Request" "RIHS01_3d3c84653c1f96918086887e1dcb236faec88b81a5b14fd4cf4840065bcdf8af"
    CancelGoalRequest {
        /// goal_info
        goal_info: GoalInfo,
    }
}

crate::message! {
    /// `action_msgs/srv/CancelGoal_Response`.
    "action_msgs/srv/CancelGoal_Response" "RIHS01_35e682cf3f510e83c70a82a4aac888496dedee56773bf9d8e5e0aa81f9e1c960"
    CancelGoalResponse {
        /// return_code
        return_code: i8,
        /// goals_canceling
        goals_canceling: Vec<GoalInfo>,
    }
    /// ERROR_NONE
    ERROR_NONE: i8 = 0;
    /// ERROR_REJECTED
    ERROR_REJECTED: i8 = 1;
    /// ERROR_UNKNOWN_GOAL_ID
    ERROR_UNKNOWN_GOAL_ID: i8 = 2;
    /// ERROR_GOAL_TERMINATED
    ERROR_GOAL_TERMINATED: i8 = 3;
}

crate::service! {
    /// Asks to stop goals: an id of zeros means all, a time of zero any time.
    "action_msgs/srv/CancelGoal" "RIHS01_573d8b0a534451d7bc2ac8c5ffde8ac14b8593b7001175d0cd6516dcbeb8689a"
    CancelGoal, CancelGoalRequest, CancelGoalResponse
}
