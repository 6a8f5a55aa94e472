//! `control_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces_main/control_msgs`
//! instead.

pub use super::control_msgs::*;

crate::message! {
    /// Moves joints along a trajectory.
    "control_msgs/action/FollowJointTrajectory_Goal" "RIHS01_8a9060704b269608f5a340934cc26e66869dd14bdac29e2e7fd9ec8b9882d205"
    FollowJointTrajectoryGoal {
        /// trajectory
        trajectory: crate::trajectory_msgs::JointTrajectory,
        /// multi_dof_trajectory
        multi_dof_trajectory: crate::trajectory_msgs::MultiDOFJointTrajectory,
        /// path_tolerance
        path_tolerance: Vec<JointTolerance>,
        /// component_path_tolerance
        component_path_tolerance: Vec<JointComponentTolerance>,
        /// goal_tolerance
        goal_tolerance: Vec<JointTolerance>,
        /// component_goal_tolerance
        component_goal_tolerance: Vec<JointComponentTolerance>,
        /// goal_time_tolerance
        goal_time_tolerance: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `control_msgs/action/FollowJointTrajectory_Result`.
    "control_msgs/action/FollowJointTrajectory_Result" "RIHS01_8002e99ed2c14c6faa522f2a93c26d744c5982f254f9e98ff9c6f19789bdb220"
    FollowJointTrajectoryResult {
        /// 0 without an error, else one of the values above.
        error_code: i32,
        /// error_string
        error_string: std::string::String,
    }
    /// GOAL_TOLERANCE_VIOLATED
    GOAL_TOLERANCE_VIOLATED: i32 = -5;
    /// PATH_TOLERANCE_VIOLATED
    PATH_TOLERANCE_VIOLATED: i32 = -4;
    /// OLD_HEADER_TIMESTAMP
    OLD_HEADER_TIMESTAMP: i32 = -3;
    /// INVALID_JOINTS
    INVALID_JOINTS: i32 = -2;
    /// INVALID_GOAL
    INVALID_GOAL: i32 = -1;
    /// SUCCESSFUL
    SUCCESSFUL: i32 = 0;
}

crate::message! {
    /// `control_msgs/action/FollowJointTrajectory_Feedback`.
    "control_msgs/action/FollowJointTrajectory_Feedback" "RIHS01_0bb018d181bdc6384dd75365480967bd1d6eaee4ef3dd597c64cd0b8bdc10867"
    FollowJointTrajectoryFeedback {
        /// header
        header: crate::std_msgs::Header,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// desired
        desired: crate::trajectory_msgs::JointTrajectoryPoint,
        /// actual
        actual: crate::trajectory_msgs::JointTrajectoryPoint,
        /// error
        error: crate::trajectory_msgs::JointTrajectoryPoint,
        /// index
        index: i32,
        /// multi_dof_joint_names
        multi_dof_joint_names: Vec<std::string::String>,
        /// multi_dof_desired
        multi_dof_desired: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_actual
        multi_dof_actual: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_error
        multi_dof_error: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_index
        multi_dof_index: i32,
    }
}

crate::message! {
    /// `control_msgs/action/FollowJointTrajectory_SendGoal_Request`.
    "control_msgs/action/FollowJointTrajectory_SendGoal_Request" "RIHS01_179c93691f1f6d1d115881ff88c3917b7cc6eac2ba4bf56766cc7c4389e19ef1"
    FollowJointTrajectorySendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: FollowJointTrajectoryGoal,
    }
}

crate::message! {
    /// `control_msgs/action/FollowJointTrajectory_SendGoal_Response`.
    "control_msgs/action/FollowJointTrajectory_SendGoal_Response" "RIHS01_e6a48ba740ae254500129a877f0b071be8663a115da1a539b74599cc97921fbf"
    FollowJointTrajectorySendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `control_msgs/action/FollowJointTrajectory_GetResult_Request`.
    "control_msgs/action/FollowJointTrajectory_GetResult_Request" "RIHS01_ecf7ea8463d3beec7084bca75216d0b01b87b6e1e4e09679bb26093041efcbe9"
    FollowJointTrajectoryGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `control_msgs/action/FollowJointTrajectory_GetResult_Response`.
    "control_msgs/action/FollowJointTrajectory_GetResult_Response" "RIHS01_08eefbaa146ce02ba45898d5e99160afd6c4c54a30d159aee0f2ca6035b1580f"
    FollowJointTrajectoryGetResultResponse {
        /// status
        status: i8,
        /// result
        result: FollowJointTrajectoryResult,
    }
}

crate::message! {
    /// `control_msgs/action/FollowJointTrajectory_FeedbackMessage`.
    "control_msgs/action/FollowJointTrajectory_FeedbackMessage" "RIHS01_95618cc73912d99b9acaa17d2da5e832cb0bfdeede7534fa8ec600feca2a6c4b"
    FollowJointTrajectoryFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: FollowJointTrajectoryFeedback,
    }
}

crate::service! {
    /// `control_msgs/action/FollowJointTrajectory_SendGoal`.
    "control_msgs/action/FollowJointTrajectory_SendGoal" "RIHS01_b13789dddc325a7a962825c45e28c77d37237ec129dd0c34dc5994562938c57f"
    FollowJointTrajectorySendGoal, FollowJointTrajectorySendGoalRequest, FollowJointTrajectorySendGoalResponse
}

crate::service! {
    /// `control_msgs/action/FollowJointTrajectory_GetResult`.
    "control_msgs/action/FollowJointTrajectory_GetResult" "RIHS01_e3ceb38e3e1867c8dc0f46014df26e90eb93422f27e9e97f936e07f94be4bc8b"
    FollowJointTrajectoryGetResult, FollowJointTrajectoryGetResultRequest, FollowJointTrajectoryGetResultResponse
}

crate::action! {
    /// Moves joints along a trajectory.
    "control_msgs/action/FollowJointTrajectory" "RIHS01_ff29901b2693f5deb847e96084a1c2cdb26e70b7c847be21859b70a55fb29cf0"
    FollowJointTrajectory, FollowJointTrajectoryGoal, FollowJointTrajectoryResult, FollowJointTrajectoryFeedback,
    FollowJointTrajectorySendGoal, FollowJointTrajectoryGetResult, FollowJointTrajectoryFeedbackMessage
}

crate::message! {
    /// State of a PID controller.
    "control_msgs/msg/PidState" "RIHS01_02d464a78563dce5014a2b8f9e3d3bd5344f537891c4b9f089d71feadd7f6e4b"
    PidState {
        /// header
        header: crate::std_msgs::Header,
        /// timestep
        timestep: crate::builtin_interfaces::Duration,
        /// error
        error: f64,
        /// error_dot
        error_dot: f64,
        /// i_term
        i_term: f64,
        /// p_gain
        p_gain: f64,
        /// i_gain
        i_gain: f64,
        /// d_gain
        d_gain: f64,
        /// output
        output: f64,
    }
}
