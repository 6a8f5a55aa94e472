//! `nav2_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces_main/nav2_msgs`
//! instead.

pub use super::nav2_msgs::*;

crate::message! {
    /// Drives straight backwards.
    "nav2_msgs/action/BackUp_Goal" "RIHS01_07be8f5f294103a66436fbd9072f6595359431e03221039da9a8e56c2d88d8d8"
    BackUpGoal {
        /// Distance to drive along x; m.
        target: crate::geometry_msgs::Point,
        /// Speed; m/s.
        speed: f32,
        /// Maximum duration; 0 is none.
        time_allowance: crate::builtin_interfaces::Duration,
        /// Drives on whatever the costmap says.
        disable_collision_checks: bool = false,
    }
}

crate::message! {
    /// `nav2_msgs/action/BackUp_Result`.
    "nav2_msgs/action/BackUp_Result" "RIHS01_5e66d3db3244f382ecb7be337d2f28135ad7a0e66429948520a2315d97fb3acd"
    BackUpResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 710;
    /// TIMEOUT
    TIMEOUT: u16 = 711;
    /// TF_ERROR
    TF_ERROR: u16 = 712;
    /// INVALID_INPUT
    INVALID_INPUT: u16 = 713;
    /// COLLISION_AHEAD
    COLLISION_AHEAD: u16 = 714;
}

crate::message! {
    /// `nav2_msgs/action/BackUp_Feedback`.
    "nav2_msgs/action/BackUp_Feedback" "RIHS01_859f0344e74b313985d5c7338fc9462fcce637f25ea97500355b39201dc5c8a1"
    BackUpFeedback {
        /// Distance so far; m.
        distance_traveled: f32,
    }
}

crate::message! {
    /// `nav2_msgs/action/BackUp_SendGoal_Request`.
    "nav2_msgs/action/BackUp_SendGoal_Request" "RIHS01_6bded75f3afe3371737f4491bc41f4c1e6bcaed515d35e82e26a9b489391dd8d"
    BackUpSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: BackUpGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/BackUp_SendGoal_Response`.
    "nav2_msgs/action/BackUp_SendGoal_Response" "RIHS01_58e85a6a7981154343c55ff9f8a14a053fd341a9284335e88b09d68432ebb4a8"
    BackUpSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/BackUp_GetResult_Request`.
    "nav2_msgs/action/BackUp_GetResult_Request" "RIHS01_5cf59ee0de44c995e55039f86486cc019edf979cba1f665b341c01e9573bf640"
    BackUpGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/BackUp_GetResult_Response`.
    "nav2_msgs/action/BackUp_GetResult_Response" "RIHS01_0eab01e9a15f4db33961494d72b571012ded2a7e0bd28dacee6e2277646b0b35"
    BackUpGetResultResponse {
        /// status
        status: i8,
        /// result
        result: BackUpResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/BackUp_FeedbackMessage`.
    "nav2_msgs/action/BackUp_FeedbackMessage" "RIHS01_f279f363e5f9f485dfca4704643e12354bb5bb092dc27b0ae3dca718cff715f7"
    BackUpFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: BackUpFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/BackUp_SendGoal`.
    "nav2_msgs/action/BackUp_SendGoal" "RIHS01_00de8fde2e0080b4307e349b2c7ceb327dc5c914779c80ccd2949419e690b892"
    BackUpSendGoal, BackUpSendGoalRequest, BackUpSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/BackUp_GetResult`.
    "nav2_msgs/action/BackUp_GetResult" "RIHS01_3522c919bdbbffa283f13484f610981688138de7308e88de94a57c47c466d342"
    BackUpGetResult, BackUpGetResultRequest, BackUpGetResultResponse
}

crate::action! {
    /// Drives straight backwards.
    "nav2_msgs/action/BackUp" "RIHS01_cc8889ed926f2e6956d1a3d0459e8e610289ed689efdcf8bcff3e4a349cea741"
    BackUp, BackUpGoal, BackUpResult, BackUpFeedback,
    BackUpSendGoal, BackUpGetResult, BackUpFeedbackMessage
}

crate::message! {
    /// Plans a route in a graph and follows the progress of the robot on it.
    "nav2_msgs/action/ComputeAndTrackRoute_Goal" "RIHS01_3a3b9643500c26d1cf79baaf47e62e1e05ba2be0c19da2cefe1169f814cf8d99"
    ComputeAndTrackRouteGoal {
        /// start_id
        start_id: u16,
        /// start
        start: crate::geometry_msgs::PoseStamped,
        /// goal_id
        goal_id: u16,
        /// goal
        goal: crate::geometry_msgs::PoseStamped,
        /// Plans from `start` instead of the pose of the robot.
        use_start: bool,
        /// Uses `start` and `goal` instead of the ids of nodes.
        use_poses: bool,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_Result`.
    "nav2_msgs/action/ComputeAndTrackRoute_Result" "RIHS01_b6db1fb01e6d3a44b948f12148247e933ef307ccf2f1794889c93572e0f77705"
    ComputeAndTrackRouteResult {
        /// Duration of the action.
        execution_duration: crate::builtin_interfaces::Duration,
        /// 0 without an error, else one of the values above.
        error_code: u16 = 0,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 400;
    /// TF_ERROR
    TF_ERROR: u16 = 401;
    /// NO_VALID_GRAPH
    NO_VALID_GRAPH: u16 = 402;
    /// INDETERMINANT_NODES_ON_GRAPH
    INDETERMINANT_NODES_ON_GRAPH: u16 = 403;
    /// TIMEOUT
    TIMEOUT: u16 = 404;
    /// NO_VALID_ROUTE
    NO_VALID_ROUTE: u16 = 405;
    /// OPERATION_FAILED
    OPERATION_FAILED: u16 = 406;
    /// INVALID_EDGE_SCORER_USE
    INVALID_EDGE_SCORER_USE: u16 = 407;
}

crate::message! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_Feedback`.
    "nav2_msgs/action/ComputeAndTrackRoute_Feedback" "RIHS01_82ff092bb13b32d069b63702458df0d58f8f447068f0fd04c899ee64fc1cfc19"
    ComputeAndTrackRouteFeedback {
        /// last_node_id
        last_node_id: u16,
        /// next_node_id
        next_node_id: u16,
        /// current_edge_id
        current_edge_id: u16,
        /// route
        route: Route,
        /// path
        path: crate::nav_msgs::Path,
        /// operations_triggered
        operations_triggered: Vec<std::string::String>,
        /// True if the route is a new one.
        rerouted: bool,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_SendGoal_Request`.
    "nav2_msgs/action/ComputeAndTrackRoute_SendGoal_Request" "RIHS01_ae237b33571d122cf216470b57d31d40f02ec0de9b9f5578c22a037f5e025d50"
    ComputeAndTrackRouteSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: ComputeAndTrackRouteGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_SendGoal_Response`.
    "nav2_msgs/action/ComputeAndTrackRoute_SendGoal_Response" "RIHS01_c63524bd0382b4020ca809be4a07f0d75fdd0add3f5743048d497dcf60c99787"
    ComputeAndTrackRouteSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_GetResult_Request`.
    "nav2_msgs/action/ComputeAndTrackRoute_GetResult_Request" "RIHS01_39870b638b1726768bc35cb12daf9af044bbe0a1c56c712edfba7eb20ff78fb5"
    ComputeAndTrackRouteGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_GetResult_Response`.
    "nav2_msgs/action/ComputeAndTrackRoute_GetResult_Response" "RIHS01_006bb770198979e2beea3f25d63cc1a931090b38efd9db9642d487e3a40d81b4"
    ComputeAndTrackRouteGetResultResponse {
        /// status
        status: i8,
        /// result
        result: ComputeAndTrackRouteResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_FeedbackMessage`.
    "nav2_msgs/action/ComputeAndTrackRoute_FeedbackMessage" "RIHS01_b3fb06cc9ea9a2855e2a74b02752235e6a609a5539a74dea28ae0cc5abd8e0af"
    ComputeAndTrackRouteFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: ComputeAndTrackRouteFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_SendGoal`.
    "nav2_msgs/action/ComputeAndTrackRoute_SendGoal" "RIHS01_af46f107a68d679c6cb9a8414b6c09ba949d94543fb0b45c2b42f51b1286ef2e"
    ComputeAndTrackRouteSendGoal, ComputeAndTrackRouteSendGoalRequest, ComputeAndTrackRouteSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/ComputeAndTrackRoute_GetResult`.
    "nav2_msgs/action/ComputeAndTrackRoute_GetResult" "RIHS01_1a57ea4152008bf2688a017c7b4ff809370c46ec22f6696a55ddbfe40ae59714"
    ComputeAndTrackRouteGetResult, ComputeAndTrackRouteGetResultRequest, ComputeAndTrackRouteGetResultResponse
}

crate::action! {
    /// Plans a route in a graph and follows the progress of the robot on it.
    "nav2_msgs/action/ComputeAndTrackRoute" "RIHS01_d3970a8643572b8f1398cfb6b4c48dae7db967fb7b809a2b0c2e5b6deed77a2a"
    ComputeAndTrackRoute, ComputeAndTrackRouteGoal, ComputeAndTrackRouteResult, ComputeAndTrackRouteFeedback,
    ComputeAndTrackRouteSendGoal, ComputeAndTrackRouteGetResult, ComputeAndTrackRouteFeedbackMessage
}

crate::message! {
    /// Plans a path through several poses.
    "nav2_msgs/action/ComputePathThroughPoses_Goal" "RIHS01_a71ea25248d84e4c3badd7b343904581d935d238282fda677e26d102f73a7b8e"
    ComputePathThroughPosesGoal {
        /// goals
        goals: crate::nav_msgs::Goals,
        /// start
        start: crate::geometry_msgs::PoseStamped,
        /// Name of the planner; may be empty if there is only one.
        planner_id: std::string::String,
        /// Plans from `start` instead of the pose of the robot.
        use_start: bool,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathThroughPoses_Result`.
    "nav2_msgs/action/ComputePathThroughPoses_Result" "RIHS01_c195dd18048b2b04d46fca3b56e13bf2cdfdbf36190cbee8264c86d28f6c63d0"
    ComputePathThroughPosesResult {
        /// path
        path: crate::nav_msgs::Path,
        /// Index of the last goal that the path reaches, or ALL_GOALS.
        last_reached_index: i16 = -1,
        /// Time that the planner needed.
        planning_time: crate::builtin_interfaces::Duration,
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// ALL_GOALS
    ALL_GOALS: i16 = -1;
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 300;
    /// INVALID_PLANNER
    INVALID_PLANNER: u16 = 301;
    /// TF_ERROR
    TF_ERROR: u16 = 302;
    /// START_OUTSIDE_MAP
    START_OUTSIDE_MAP: u16 = 303;
    /// GOAL_OUTSIDE_MAP
    GOAL_OUTSIDE_MAP: u16 = 304;
    /// START_OCCUPIED
    START_OCCUPIED: u16 = 305;
    /// GOAL_OCCUPIED
    GOAL_OCCUPIED: u16 = 306;
    /// TIMEOUT
    TIMEOUT: u16 = 307;
    /// NO_VALID_PATH
    NO_VALID_PATH: u16 = 308;
    /// NO_VIAPOINTS_GIVEN
    NO_VIAPOINTS_GIVEN: u16 = 309;
}

crate::message! {
    /// `nav2_msgs/action/ComputePathThroughPoses_Feedback`.
    "nav2_msgs/action/ComputePathThroughPoses_Feedback" "RIHS01_ee7ba8f81f423e6137f20fcb93da27e9bb7166b7b3c07fedd2bce0ef23b5ff38"
    ComputePathThroughPosesFeedback {
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathThroughPoses_SendGoal_Request`.
    "nav2_msgs/action/ComputePathThroughPoses_SendGoal_Request" "RIHS01_088daa50448696cbe6d0afb5c2feb1926546b059bf6dc2cd38d9e580fdf29498"
    ComputePathThroughPosesSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: ComputePathThroughPosesGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathThroughPoses_SendGoal_Response`.
    "nav2_msgs/action/ComputePathThroughPoses_SendGoal_Response" "RIHS01_c13064c3215ec29e84c0eda2f52e242423a7b92d713a9aa685746a2c598061ea"
    ComputePathThroughPosesSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathThroughPoses_GetResult_Request`.
    "nav2_msgs/action/ComputePathThroughPoses_GetResult_Request" "RIHS01_b44d1f4a9e53c39840aa68d6539c0bd06b63f63c4a60bd554d2edf86aec4de9a"
    ComputePathThroughPosesGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathThroughPoses_GetResult_Response`.
    "nav2_msgs/action/ComputePathThroughPoses_GetResult_Response" "RIHS01_a2919fb48b952aaf997305fa1f419134243ec3a4e738821c1db57f4c632d4e47"
    ComputePathThroughPosesGetResultResponse {
        /// status
        status: i8,
        /// result
        result: ComputePathThroughPosesResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathThroughPoses_FeedbackMessage`.
    "nav2_msgs/action/ComputePathThroughPoses_FeedbackMessage" "RIHS01_b04e85195fb2c41edab60868657632fa95d11e9ae69792ca2a1df9de4fbc5521"
    ComputePathThroughPosesFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: ComputePathThroughPosesFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/ComputePathThroughPoses_SendGoal`.
    "nav2_msgs/action/ComputePathThroughPoses_SendGoal" "RIHS01_3f2cf643185466c2bb1b22002d55d2607c4312ac3d23d6206ee430ba5a35ecec"
    ComputePathThroughPosesSendGoal, ComputePathThroughPosesSendGoalRequest, ComputePathThroughPosesSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/ComputePathThroughPoses_GetResult`.
    "nav2_msgs/action/ComputePathThroughPoses_GetResult" "RIHS01_653d53798ee477a667585e34ed797daf86cd1fdc7e202c3fc3b23975085dbcbc"
    ComputePathThroughPosesGetResult, ComputePathThroughPosesGetResultRequest, ComputePathThroughPosesGetResultResponse
}

crate::action! {
    /// Plans a path through several poses.
    "nav2_msgs/action/ComputePathThroughPoses" "RIHS01_40193b04e498d60c45f5a69b95f17bda2223de3bd4dde8269d35ce70fd34b978"
    ComputePathThroughPoses, ComputePathThroughPosesGoal, ComputePathThroughPosesResult, ComputePathThroughPosesFeedback,
    ComputePathThroughPosesSendGoal, ComputePathThroughPosesGetResult, ComputePathThroughPosesFeedbackMessage
}

crate::message! {
    /// Plans a path to a pose.
    "nav2_msgs/action/ComputePathToPose_Goal" "RIHS01_92468520eaa91151d04752835ca6cccaa1b49d939f49be74e7df6b33207f4061"
    ComputePathToPoseGoal {
        /// goal
        goal: crate::geometry_msgs::PoseStamped,
        /// start
        start: crate::geometry_msgs::PoseStamped,
        /// Poses to pass on the way.
        viapoints: Vec<crate::geometry_msgs::PoseStamped>,
        /// Name of the planner; may be empty if there is only one.
        planner_id: std::string::String,
        /// Plans from `start` instead of the pose of the robot.
        use_start: bool,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathToPose_Result`.
    "nav2_msgs/action/ComputePathToPose_Result" "RIHS01_7178b0d4da2f4d4243f3b95db1051384e4fdd2226a14518f04547b13cdfa0253"
    ComputePathToPoseResult {
        /// path
        path: crate::nav_msgs::Path,
        /// Time that the planner needed.
        planning_time: crate::builtin_interfaces::Duration,
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 200;
    /// INVALID_PLANNER
    INVALID_PLANNER: u16 = 201;
    /// TF_ERROR
    TF_ERROR: u16 = 202;
    /// START_OUTSIDE_MAP
    START_OUTSIDE_MAP: u16 = 203;
    /// GOAL_OUTSIDE_MAP
    GOAL_OUTSIDE_MAP: u16 = 204;
    /// START_OCCUPIED
    START_OCCUPIED: u16 = 205;
    /// GOAL_OCCUPIED
    GOAL_OCCUPIED: u16 = 206;
    /// TIMEOUT
    TIMEOUT: u16 = 207;
    /// NO_VALID_PATH
    NO_VALID_PATH: u16 = 208;
}

crate::message! {
    /// `nav2_msgs/action/ComputePathToPose_Feedback`.
    "nav2_msgs/action/ComputePathToPose_Feedback" "RIHS01_65f211af92621424a97b9f54224f75c04e748d9b998115a39f6f03a684e01f1b"
    ComputePathToPoseFeedback {
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathToPose_SendGoal_Request`.
    "nav2_msgs/action/ComputePathToPose_SendGoal_Request" "RIHS01_7a1b2094d8729d7da24b2c4ce3a65824cab13096844239509a8e87ae1867ca42"
    ComputePathToPoseSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: ComputePathToPoseGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathToPose_SendGoal_Response`.
    "nav2_msgs/action/ComputePathToPose_SendGoal_Response" "RIHS01_5bf8211084a19dc1b677915e75d6752a72c1e0cf0b2beede2f49c578b7865e35"
    ComputePathToPoseSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathToPose_GetResult_Request`.
    "nav2_msgs/action/ComputePathToPose_GetResult_Request" "RIHS01_4b6daec66100272fa48786b26682982c6de4166bd2b1a061e47ccd9a6bd7bbb1"
    ComputePathToPoseGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathToPose_GetResult_Response`.
    "nav2_msgs/action/ComputePathToPose_GetResult_Response" "RIHS01_f278e880ee5e06bc9498152d76991cc90096b0265f1b1e1234baf23f395ce1d5"
    ComputePathToPoseGetResultResponse {
        /// status
        status: i8,
        /// result
        result: ComputePathToPoseResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputePathToPose_FeedbackMessage`.
    "nav2_msgs/action/ComputePathToPose_FeedbackMessage" "RIHS01_a086c8f040554ab5883b433bded128a1d1a732d21ca57596b7fdbe7ad2d0b64a"
    ComputePathToPoseFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: ComputePathToPoseFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/ComputePathToPose_SendGoal`.
    "nav2_msgs/action/ComputePathToPose_SendGoal" "RIHS01_17a0fab5ba4877bf9571c14fde753d26465c5a61d9dd74f027292dfdf2d309ea"
    ComputePathToPoseSendGoal, ComputePathToPoseSendGoalRequest, ComputePathToPoseSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/ComputePathToPose_GetResult`.
    "nav2_msgs/action/ComputePathToPose_GetResult" "RIHS01_386ab12c2f62a441596ef1140b3beca654a957eaac87e769c10de01b0e28208f"
    ComputePathToPoseGetResult, ComputePathToPoseGetResultRequest, ComputePathToPoseGetResultResponse
}

crate::action! {
    /// Plans a path to a pose.
    "nav2_msgs/action/ComputePathToPose" "RIHS01_27550d8f0473ae91babf72f120bc58c49afbd95c7bcb7795bf4d08d6cc7e89dd"
    ComputePathToPose, ComputePathToPoseGoal, ComputePathToPoseResult, ComputePathToPoseFeedback,
    ComputePathToPoseSendGoal, ComputePathToPoseGetResult, ComputePathToPoseFeedbackMessage
}

crate::message! {
    /// Plans a route in a graph.
    "nav2_msgs/action/ComputeRoute_Goal" "RIHS01_d6eaf4c8821eb057f9164b33e52f76c3aee9d35186cb07c769c75caec6f3ab1e"
    ComputeRouteGoal {
        /// start_id
        start_id: u16,
        /// start
        start: crate::geometry_msgs::PoseStamped,
        /// goal_id
        goal_id: u16,
        /// goal
        goal: crate::geometry_msgs::PoseStamped,
        /// Plans from `start` instead of the pose of the robot.
        use_start: bool,
        /// Uses `start` and `goal` instead of the ids of nodes.
        use_poses: bool,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeRoute_Result`.
    "nav2_msgs/action/ComputeRoute_Result" "RIHS01_ccb528edc79f5fab501edf8b4305dfdc963b612b166573043a6cc533a61899fe"
    ComputeRouteResult {
        /// Time that the planner needed.
        planning_time: crate::builtin_interfaces::Duration,
        /// path
        path: crate::nav_msgs::Path,
        /// route
        route: Route,
        /// 0 without an error, else one of the values above.
        error_code: u16 = 0,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 400;
    /// TF_ERROR
    TF_ERROR: u16 = 401;
    /// NO_VALID_GRAPH
    NO_VALID_GRAPH: u16 = 402;
    /// INDETERMINANT_NODES_ON_GRAPH
    INDETERMINANT_NODES_ON_GRAPH: u16 = 403;
    /// TIMEOUT
    TIMEOUT: u16 = 404;
    /// NO_VALID_ROUTE
    NO_VALID_ROUTE: u16 = 405;
    /// INVALID_EDGE_SCORER_USE
    INVALID_EDGE_SCORER_USE: u16 = 407;
}

crate::message! {
    /// `nav2_msgs/action/ComputeRoute_Feedback`.
    "nav2_msgs/action/ComputeRoute_Feedback" "RIHS01_50f6b82e5e22c58e08e90cab482ea0cb79b6439b409735419d9afbfbff4e54b1"
    ComputeRouteFeedback {
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeRoute_SendGoal_Request`.
    "nav2_msgs/action/ComputeRoute_SendGoal_Request" "RIHS01_a29ad1a9596cbfe381bb0dfa3ce46eb774e1192b226386c0ef68777885637459"
    ComputeRouteSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: ComputeRouteGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeRoute_SendGoal_Response`.
    "nav2_msgs/action/ComputeRoute_SendGoal_Response" "RIHS01_9b1da5f651ad7c1cd0dde516aed521007932317db932ae6dbf17a71f162c6d90"
    ComputeRouteSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeRoute_GetResult_Request`.
    "nav2_msgs/action/ComputeRoute_GetResult_Request" "RIHS01_fac9bb7b507efad8280da4274ec2f9a3a00abe6baa6c253133191d37d5746228"
    ComputeRouteGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeRoute_GetResult_Response`.
    "nav2_msgs/action/ComputeRoute_GetResult_Response" "RIHS01_7f5a7030b456b8b412c8d1015734116e8392aef7b9fb734165f94df1018e37c2"
    ComputeRouteGetResultResponse {
        /// status
        status: i8,
        /// result
        result: ComputeRouteResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/ComputeRoute_FeedbackMessage`.
    "nav2_msgs/action/ComputeRoute_FeedbackMessage" "RIHS01_41e8e0f760c38e072fc7e76a83c1920e61d25a6d514547daf6b9bad9ea7f6685"
    ComputeRouteFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: ComputeRouteFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/ComputeRoute_SendGoal`.
    "nav2_msgs/action/ComputeRoute_SendGoal" "RIHS01_e66ba750cd0d399e486f21e30d41ecc50a4cac2afc62a9027ff975f9ba6a20a9"
    ComputeRouteSendGoal, ComputeRouteSendGoalRequest, ComputeRouteSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/ComputeRoute_GetResult`.
    "nav2_msgs/action/ComputeRoute_GetResult" "RIHS01_8a07c63d65186c624b6592c6099b68d626bc6be4e17eed06f07ae2182ce72b62"
    ComputeRouteGetResult, ComputeRouteGetResultRequest, ComputeRouteGetResultResponse
}

crate::action! {
    /// Plans a route in a graph.
    "nav2_msgs/action/ComputeRoute" "RIHS01_303bfda47f20ae2cb27788d5e8fd0a692f51da499397a3b323ba7f015f8fdedc"
    ComputeRoute, ComputeRouteGoal, ComputeRouteResult, ComputeRouteFeedback,
    ComputeRouteSendGoal, ComputeRouteGetResult, ComputeRouteFeedbackMessage
}

crate::message! {
    /// Drives straight ahead.
    "nav2_msgs/action/DriveOnHeading_Goal" "RIHS01_6e3f96280e3a224f12a117254e06335a929bf2d6f4a0e0939afaa93e7daa1380"
    DriveOnHeadingGoal {
        /// Distance to drive along x; m.
        target: crate::geometry_msgs::Point,
        /// Speed; m/s.
        speed: f32,
        /// Maximum duration; 0 is none.
        time_allowance: crate::builtin_interfaces::Duration,
        /// Drives on whatever the costmap says.
        disable_collision_checks: bool = false,
    }
}

crate::message! {
    /// `nav2_msgs/action/DriveOnHeading_Result`.
    "nav2_msgs/action/DriveOnHeading_Result" "RIHS01_e851c607f572e4d4f9526c827488d62445e851895635e0a54446a4f2f8e4a0e6"
    DriveOnHeadingResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 720;
    /// TIMEOUT
    TIMEOUT: u16 = 721;
    /// TF_ERROR
    TF_ERROR: u16 = 722;
    /// COLLISION_AHEAD
    COLLISION_AHEAD: u16 = 723;
    /// INVALID_INPUT
    INVALID_INPUT: u16 = 724;
}

crate::message! {
    /// `nav2_msgs/action/DriveOnHeading_Feedback`.
    "nav2_msgs/action/DriveOnHeading_Feedback" "RIHS01_cd9fb3ed3edb66ca2dd74f9b8e078ad84dc2906f70bcaa216a9ce29248fbf0f1"
    DriveOnHeadingFeedback {
        /// Distance so far; m.
        distance_traveled: f32,
    }
}

crate::message! {
    /// `nav2_msgs/action/DriveOnHeading_SendGoal_Request`.
    "nav2_msgs/action/DriveOnHeading_SendGoal_Request" "RIHS01_20142f4355cda52fc89403b6071daea5e92e25eaae0f179b9ebd19b16815f341"
    DriveOnHeadingSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: DriveOnHeadingGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/DriveOnHeading_SendGoal_Response`.
    "nav2_msgs/action/DriveOnHeading_SendGoal_Response" "RIHS01_ee3c927eabbf7999c58641b07713646e5dc08367bba2204c68782dfdee911f14"
    DriveOnHeadingSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/DriveOnHeading_GetResult_Request`.
    "nav2_msgs/action/DriveOnHeading_GetResult_Request" "RIHS01_d72e6f9e21c458a0125d90bf326afd417c8685a8a34601a8cf94484642dc6b04"
    DriveOnHeadingGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/DriveOnHeading_GetResult_Response`.
    "nav2_msgs/action/DriveOnHeading_GetResult_Response" "RIHS01_ef9e908872e8ebccaa5c4bdf1677363fe0b7ab132259bf5f289884dde07838b9"
    DriveOnHeadingGetResultResponse {
        /// status
        status: i8,
        /// result
        result: DriveOnHeadingResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/DriveOnHeading_FeedbackMessage`.
    "nav2_msgs/action/DriveOnHeading_FeedbackMessage" "RIHS01_5f0d0cc07e53aa1a6fefdc62c7c273ae914c7f4f730648bc5b1885b098e26958"
    DriveOnHeadingFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: DriveOnHeadingFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/DriveOnHeading_SendGoal`.
    "nav2_msgs/action/DriveOnHeading_SendGoal" "RIHS01_882a3a456acbb4bb4353675a146659396107d26e5c26544fef2e4e4539876976"
    DriveOnHeadingSendGoal, DriveOnHeadingSendGoalRequest, DriveOnHeadingSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/DriveOnHeading_GetResult`.
    "nav2_msgs/action/DriveOnHeading_GetResult" "RIHS01_85cef782f5814a11f0dc3deb6cceda7a4df777e116e48c13b89b27b96fac89c8"
    DriveOnHeadingGetResult, DriveOnHeadingGetResultRequest, DriveOnHeadingGetResultResponse
}

crate::action! {
    /// Drives straight ahead.
    "nav2_msgs/action/DriveOnHeading" "RIHS01_14e7a7c5a558249d00ffe1e1ad64c06f4ac85f3527f04811dba9cf0cb0cc38a8"
    DriveOnHeading, DriveOnHeadingGoal, DriveOnHeadingResult, DriveOnHeadingFeedback,
    DriveOnHeadingSendGoal, DriveOnHeadingGetResult, DriveOnHeadingFeedbackMessage
}

crate::message! {
    /// Drives to poses on the globe one after the other.
    "nav2_msgs/action/FollowGPSWaypoints_Goal" "RIHS01_52cbca06efeecf54c38547c2a14f03ad000173a2f222f5e1259a49a79f8cfb51"
    FollowGPSWaypointsGoal {
        /// Number of repetitions.
        number_of_loops: u32,
        /// Index of the first pose.
        goal_index: u32 = 0,
        /// gps_poses
        gps_poses: Vec<crate::geographic_msgs::GeoPose>,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowGPSWaypoints_Result`.
    "nav2_msgs/action/FollowGPSWaypoints_Result" "RIHS01_ca285389976432cb26e956eeaec35f24b7418b62f143a9eb80510b0a3b7b205c"
    FollowGPSWaypointsResult {
        /// Poses that were not reached.
        missed_waypoints: Vec<WaypointStatus>,
        /// 0 without an error, else one of the values above.
        error_code: i16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// UNKNOWN
    UNKNOWN: u16 = 600;
    /// TASK_EXECUTOR_FAILED
    TASK_EXECUTOR_FAILED: u16 = 601;
    /// NO_WAYPOINTS_GIVEN
    NO_WAYPOINTS_GIVEN: u16 = 602;
    /// STOP_ON_MISSED_WAYPOINT
    STOP_ON_MISSED_WAYPOINT: u16 = 603;
}

crate::message! {
    /// `nav2_msgs/action/FollowGPSWaypoints_Feedback`.
    "nav2_msgs/action/FollowGPSWaypoints_Feedback" "RIHS01_75cb72a8be8a5ae238c58a5cb90ad265f20ef013b06e2993d0b60e513d913869"
    FollowGPSWaypointsFeedback {
        /// Index of the current pose.
        current_waypoint: u32,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowGPSWaypoints_SendGoal_Request`.
    "nav2_msgs/action/FollowGPSWaypoints_SendGoal_Request" "RIHS01_e1962be411bbb3d139dc6dec7e769854bc5e0e8f75fc9c82d31c29994e21ed96"
    FollowGPSWaypointsSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: FollowGPSWaypointsGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowGPSWaypoints_SendGoal_Response`.
    "nav2_msgs/action/FollowGPSWaypoints_SendGoal_Response" "RIHS01_e9e75beae7b34495a924b7fa909f1b88833c9adff9eff3f0fcbf923ce4856107"
    FollowGPSWaypointsSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowGPSWaypoints_GetResult_Request`.
    "nav2_msgs/action/FollowGPSWaypoints_GetResult_Request" "RIHS01_bd42588a720448510909cf17a4dab7619ff773f9d10b2f694a93e5e319793f28"
    FollowGPSWaypointsGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowGPSWaypoints_GetResult_Response`.
    "nav2_msgs/action/FollowGPSWaypoints_GetResult_Response" "RIHS01_299f54cb44edd637bdda87dbd173c407b4f56599b7b4a7af1b8b8b8f01518224"
    FollowGPSWaypointsGetResultResponse {
        /// status
        status: i8,
        /// result
        result: FollowGPSWaypointsResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowGPSWaypoints_FeedbackMessage`.
    "nav2_msgs/action/FollowGPSWaypoints_FeedbackMessage" "RIHS01_455b2b8a7ab82141f52af896a2f493ea01c43e0f68ff64bae2360e75ada7de2e"
    FollowGPSWaypointsFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: FollowGPSWaypointsFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/FollowGPSWaypoints_SendGoal`.
    "nav2_msgs/action/FollowGPSWaypoints_SendGoal" "RIHS01_9b09aba9dd2612487fd37b5976e0735a54041b4873c9aa1e14508f981c39cfb5"
    FollowGPSWaypointsSendGoal, FollowGPSWaypointsSendGoalRequest, FollowGPSWaypointsSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/FollowGPSWaypoints_GetResult`.
    "nav2_msgs/action/FollowGPSWaypoints_GetResult" "RIHS01_25d7eaaefcdbf5648ccc4a2208d21c6e924e4363a23cdb74153e715634309ef0"
    FollowGPSWaypointsGetResult, FollowGPSWaypointsGetResultRequest, FollowGPSWaypointsGetResultResponse
}

crate::action! {
    /// Drives to poses on the globe one after the other.
    "nav2_msgs/action/FollowGPSWaypoints" "RIHS01_6d6b84ed07e5e547a5133ceacef39aa512c3ce73b1ca80fa4c8252f6bfb09377"
    FollowGPSWaypoints, FollowGPSWaypointsGoal, FollowGPSWaypointsResult, FollowGPSWaypointsFeedback,
    FollowGPSWaypointsSendGoal, FollowGPSWaypointsGetResult, FollowGPSWaypointsFeedbackMessage
}

crate::message! {
    /// Drives along a path.
    "nav2_msgs/action/FollowPath_Goal" "RIHS01_d78b925f5a50ee2ce415c9b1339b92dd99bd7a25374c68edd7b8a4216675b160"
    FollowPathGoal {
        /// path
        path: crate::nav_msgs::Path,
        /// Name of the controller; may be empty if there is only one.
        controller_id: std::string::String,
        /// Name of the goal checker; may be empty if there is only one.
        goal_checker_id: std::string::String,
        /// Name of the progress checker; may be empty if there is only one.
        progress_checker_id: std::string::String,
        /// Name of the path handler; may be empty if there is only one.
        path_handler_id: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_Result`.
    "nav2_msgs/action/FollowPath_Result" "RIHS01_432bc8fc1c0de59f8181d00bf8dcc7d58e76cebcfd2de471361e62f468ad4428"
    FollowPathResult {
        /// result
        result: crate::std_msgs::Empty,
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 100;
    /// INVALID_CONTROLLER
    INVALID_CONTROLLER: u16 = 101;
    /// TF_ERROR
    TF_ERROR: u16 = 102;
    /// INVALID_PATH
    INVALID_PATH: u16 = 103;
    /// PATIENCE_EXCEEDED
    PATIENCE_EXCEEDED: u16 = 104;
    /// FAILED_TO_MAKE_PROGRESS
    FAILED_TO_MAKE_PROGRESS: u16 = 105;
    /// NO_VALID_CONTROL
    NO_VALID_CONTROL: u16 = 106;
    /// CONTROLLER_TIMED_OUT
    CONTROLLER_TIMED_OUT: u16 = 107;
    /// TIMEOUT
    TIMEOUT: u16 = 108;
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_Feedback`.
    "nav2_msgs/action/FollowPath_Feedback" "RIHS01_36e30cb03ea307e167f5fe9ee83780cbbe9cf5392b1e96304e22842d7f829790"
    FollowPathFeedback {
        /// tracking_feedback
        tracking_feedback: TrackingFeedback,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_SendGoal_Request`.
    "nav2_msgs/action/FollowPath_SendGoal_Request" "RIHS01_a1927f178a1d55026dfbf7dc13d1b8abce6d0d98a113963aab4de4548993198b"
    FollowPathSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: FollowPathGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_SendGoal_Response`.
    "nav2_msgs/action/FollowPath_SendGoal_Response" "RIHS01_2c1d1ec5fc39c057ac9caca056b351a82fad6e395e92d0e5fa6c780de91a26bd"
    FollowPathSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_GetResult_Request`.
    "nav2_msgs/action/FollowPath_GetResult_Request" "RIHS01_36e9a26a637063ba2692fde90de56d1eb7f9ba374908e14e3aec90c7466e1c30"
    FollowPathGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_GetResult_Response`.
    "nav2_msgs/action/FollowPath_GetResult_Response" "RIHS01_b5ec36b035c915310afffc3cb4941ce7c8ba34221c00ebfd8db911af5e381bde"
    FollowPathGetResultResponse {
        /// status
        status: i8,
        /// result
        result: FollowPathResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_FeedbackMessage`.
    "nav2_msgs/action/FollowPath_FeedbackMessage" "RIHS01_98d6d4ee571bfacbae2578e2adabd22fee50ea15b44cda31b65c3390964cd013"
    FollowPathFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: FollowPathFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/FollowPath_SendGoal`.
    "nav2_msgs/action/FollowPath_SendGoal" "RIHS01_0c091793c90a67349df3445771d5d30005daea785137bd6e6bf5d96ea53fb721"
    FollowPathSendGoal, FollowPathSendGoalRequest, FollowPathSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/FollowPath_GetResult`.
    "nav2_msgs/action/FollowPath_GetResult" "RIHS01_8ab4c588c878f0e997316ec559f172bb56fc210b484c2f6b280d391d3bd6890f"
    FollowPathGetResult, FollowPathGetResultRequest, FollowPathGetResultResponse
}

crate::action! {
    /// Drives along a path.
    "nav2_msgs/action/FollowPath" "RIHS01_7cd53751af929820972f91d44e162fcd3e1d3929bbab089d9f7016ec896b22af"
    FollowPath, FollowPathGoal, FollowPathResult, FollowPathFeedback,
    FollowPathSendGoal, FollowPathGetResult, FollowPathFeedbackMessage
}

crate::message! {
    /// Drives to poses one after the other, with a task at each.
    "nav2_msgs/action/FollowWaypoints_Goal" "RIHS01_ff501ac35193ef65c68aa766e1296b45ae003df94c85a9675679a09738317bd4"
    FollowWaypointsGoal {
        /// Number of repetitions.
        number_of_loops: u32,
        /// Index of the first pose.
        goal_index: u32 = 0,
        /// poses
        poses: Vec<crate::geometry_msgs::PoseStamped>,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowWaypoints_Result`.
    "nav2_msgs/action/FollowWaypoints_Result" "RIHS01_58f76203b5766c271beec3de33b1218ac1c3d46ada01ae755b4987cfb5754fe4"
    FollowWaypointsResult {
        /// Poses that were not reached.
        missed_waypoints: Vec<WaypointStatus>,
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// UNKNOWN
    UNKNOWN: u16 = 600;
    /// TASK_EXECUTOR_FAILED
    TASK_EXECUTOR_FAILED: u16 = 601;
    /// NO_VALID_WAYPOINTS
    NO_VALID_WAYPOINTS: u16 = 602;
    /// STOP_ON_MISSED_WAYPOINT
    STOP_ON_MISSED_WAYPOINT: u16 = 603;
}

crate::message! {
    /// `nav2_msgs/action/FollowWaypoints_Feedback`.
    "nav2_msgs/action/FollowWaypoints_Feedback" "RIHS01_4e41856e123034fefdbad24b78bccfb1be3d2c6adfa01fdd5c4027ab67337836"
    FollowWaypointsFeedback {
        /// Index of the current pose.
        current_waypoint: u32,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowWaypoints_SendGoal_Request`.
    "nav2_msgs/action/FollowWaypoints_SendGoal_Request" "RIHS01_9fa0988dacd6ca16e16c3d6f854a19aa413ba354d9ff55f8d93395ab2f525c23"
    FollowWaypointsSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: FollowWaypointsGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowWaypoints_SendGoal_Response`.
    "nav2_msgs/action/FollowWaypoints_SendGoal_Response" "RIHS01_4d8837e9c4373289cf2a57738b7b55b98dc15b8ecedaac331932b1173c4c2b1f"
    FollowWaypointsSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowWaypoints_GetResult_Request`.
    "nav2_msgs/action/FollowWaypoints_GetResult_Request" "RIHS01_2d19684031b7073b05099befc49a6c78c1bbc30900a6bcd0a4071406fa8bbf45"
    FollowWaypointsGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowWaypoints_GetResult_Response`.
    "nav2_msgs/action/FollowWaypoints_GetResult_Response" "RIHS01_f9d3d51214c0957ef5c6689a3af7dc90711a2de9b9c622cfb4b60a048c0058fd"
    FollowWaypointsGetResultResponse {
        /// status
        status: i8,
        /// result
        result: FollowWaypointsResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowWaypoints_FeedbackMessage`.
    "nav2_msgs/action/FollowWaypoints_FeedbackMessage" "RIHS01_467071c0ede294cafe6be7251e6e85716a6e19b8ed46db18952ac0c05597abcf"
    FollowWaypointsFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: FollowWaypointsFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/FollowWaypoints_SendGoal`.
    "nav2_msgs/action/FollowWaypoints_SendGoal" "RIHS01_20cdb80c508af436914a6da2e812289d93c6b06b4cc0670ce6530c94797bb356"
    FollowWaypointsSendGoal, FollowWaypointsSendGoalRequest, FollowWaypointsSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/FollowWaypoints_GetResult`.
    "nav2_msgs/action/FollowWaypoints_GetResult" "RIHS01_7bc8b2d136804efa78de434256aa5274b0bd8af0fa8b8abee04c6617a4293fb7"
    FollowWaypointsGetResult, FollowWaypointsGetResultRequest, FollowWaypointsGetResultResponse
}

crate::action! {
    /// Drives to poses one after the other, with a task at each.
    "nav2_msgs/action/FollowWaypoints" "RIHS01_667c9e9d426ede27da21dd3cdd3a34e4fc5cc6405b35bc9d5c0b084479920f54"
    FollowWaypoints, FollowWaypointsGoal, FollowWaypointsResult, FollowWaypointsFeedback,
    FollowWaypointsSendGoal, FollowWaypointsGetResult, FollowWaypointsFeedbackMessage
}

crate::message! {
    /// Drives through several poses.
    "nav2_msgs/action/NavigateThroughPoses_Goal" "RIHS01_e87a54ff1b11928570b7fc730f819a4a2f02df9fd48f163cc598e772fd8903f9"
    NavigateThroughPosesGoal {
        /// poses
        poses: crate::nav_msgs::Goals,
        /// File or id of the tree; the default tree if empty.
        behavior_tree: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_Result`.
    "nav2_msgs/action/NavigateThroughPoses_Result" "RIHS01_c1cba96c1a8dff972fb892764582e004f88e1bf68e12ccddd3b9ebc820c308e3"
    NavigateThroughPosesResult {
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
        /// States of all poses.
        waypoint_statuses: Vec<WaypointStatus>,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 9100;
    /// FAILED_TO_LOAD_BEHAVIOR_TREE
    FAILED_TO_LOAD_BEHAVIOR_TREE: u16 = 9101;
    /// TF_ERROR
    TF_ERROR: u16 = 9102;
    /// TIMEOUT
    TIMEOUT: u16 = 9103;
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_Feedback`.
    "nav2_msgs/action/NavigateThroughPoses_Feedback" "RIHS01_671664f58c2b1835245726e374cd979139acf9b10059a3370650047ef261121d"
    NavigateThroughPosesFeedback {
        /// current_pose
        current_pose: crate::geometry_msgs::PoseStamped,
        /// Time since the start.
        navigation_time: crate::builtin_interfaces::Duration,
        /// Estimated time to the goal.
        estimated_time_remaining: crate::builtin_interfaces::Duration,
        /// Number of recoveries so far.
        number_of_recoveries: i16,
        /// Length of the path that remains; m.
        distance_remaining: f32,
        /// Distance from the path, positive on its left; m.
        position_tracking_error: f32,
        /// Angle between robot and path; rad.
        heading_tracking_error: f32,
        /// Number of poses not yet passed.
        number_of_poses_remaining: i16,
        /// States of all poses.
        waypoint_statuses: Vec<WaypointStatus>,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_SendGoal_Request`.
    "nav2_msgs/action/NavigateThroughPoses_SendGoal_Request" "RIHS01_304d6970a9b1d812b76b1b7a0ec0cfb1256a4ceaf18e70660da9174041f3f0e4"
    NavigateThroughPosesSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: NavigateThroughPosesGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_SendGoal_Response`.
    "nav2_msgs/action/NavigateThroughPoses_SendGoal_Response" "RIHS01_abd99696630c2a5a7f0ac05b3223a0debf4307e42bdba425c6304fa1e223d6f0"
    NavigateThroughPosesSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_GetResult_Request`.
    "nav2_msgs/action/NavigateThroughPoses_GetResult_Request" "RIHS01_e228678211f043e10c8b6fce48a6c34825bdf4b61c635f7d3797f01bfd10c488"
    NavigateThroughPosesGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_GetResult_Response`.
    "nav2_msgs/action/NavigateThroughPoses_GetResult_Response" "RIHS01_e5b5fad5469de54c04ce6beb492eb123f0951d1e0d58201f763395908914f810"
    NavigateThroughPosesGetResultResponse {
        /// status
        status: i8,
        /// result
        result: NavigateThroughPosesResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_FeedbackMessage`.
    "nav2_msgs/action/NavigateThroughPoses_FeedbackMessage" "RIHS01_635c41c7319151a8e0e39beaff75ba35b1a7d6c9cb2d85e348d309693ecf87d6"
    NavigateThroughPosesFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: NavigateThroughPosesFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/NavigateThroughPoses_SendGoal`.
    "nav2_msgs/action/NavigateThroughPoses_SendGoal" "RIHS01_0fb14135a40c3900a9a184f95b2ed6966a0ffd298739cc9de7903ebc6dc06a25"
    NavigateThroughPosesSendGoal, NavigateThroughPosesSendGoalRequest, NavigateThroughPosesSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/NavigateThroughPoses_GetResult`.
    "nav2_msgs/action/NavigateThroughPoses_GetResult" "RIHS01_6a44a9426cc399cf0cc59f607e0115ea0288978a82c5a4209d8616169e31dd91"
    NavigateThroughPosesGetResult, NavigateThroughPosesGetResultRequest, NavigateThroughPosesGetResultResponse
}

crate::action! {
    /// Drives through several poses.
    "nav2_msgs/action/NavigateThroughPoses" "RIHS01_75f845da775541d77058e31bc666aff3119100e557a4d9c561b93f06df638bbf"
    NavigateThroughPoses, NavigateThroughPosesGoal, NavigateThroughPosesResult, NavigateThroughPosesFeedback,
    NavigateThroughPosesSendGoal, NavigateThroughPosesGetResult, NavigateThroughPosesFeedbackMessage
}

crate::message! {
    /// Drives to a pose.
    "nav2_msgs/action/NavigateToPose_Goal" "RIHS01_22a9dffbd6733011220460bd52edbc7843c8fc86282d40bc7ad3ca176a9dec10"
    NavigateToPoseGoal {
        /// pose
        pose: crate::geometry_msgs::PoseStamped,
        /// File or id of the tree; the default tree if empty.
        behavior_tree: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateToPose_Result`.
    "nav2_msgs/action/NavigateToPose_Result" "RIHS01_ddbff7fc6d1e51d774d5defdb8398a57cb23fa8709355002d676408bb4860b85"
    NavigateToPoseResult {
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 9000;
    /// FAILED_TO_LOAD_BEHAVIOR_TREE
    FAILED_TO_LOAD_BEHAVIOR_TREE: u16 = 9001;
    /// TF_ERROR
    TF_ERROR: u16 = 9002;
    /// TIMEOUT
    TIMEOUT: u16 = 9003;
}

crate::message! {
    /// `nav2_msgs/action/NavigateToPose_Feedback`.
    "nav2_msgs/action/NavigateToPose_Feedback" "RIHS01_f37016a810a4d5541cadeb74dfc5892b1cf197e84dea241276c1de178d90420b"
    NavigateToPoseFeedback {
        /// current_pose
        current_pose: crate::geometry_msgs::PoseStamped,
        /// Time since the start.
        navigation_time: crate::builtin_interfaces::Duration,
        /// Estimated time to the goal.
        estimated_time_remaining: crate::builtin_interfaces::Duration,
        /// Number of recoveries so far.
        number_of_recoveries: i16,
        /// Length of the path that remains; m.
        distance_remaining: f32,
        /// Distance from the path, positive on its left; m.
        position_tracking_error: f32,
        /// Angle between robot and path; rad.
        heading_tracking_error: f32,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateToPose_SendGoal_Request`.
    "nav2_msgs/action/NavigateToPose_SendGoal_Request" "RIHS01_e9381f2acfe9fa8c4838a277d0cde28a93c483564827b9f13496b9c2092e4f09"
    NavigateToPoseSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: NavigateToPoseGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateToPose_SendGoal_Response`.
    "nav2_msgs/action/NavigateToPose_SendGoal_Response" "RIHS01_99f97fcbb07daf024df4b8c3f02f19ce7fa3183fcedfb76b8772a61a371a55fa"
    NavigateToPoseSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateToPose_GetResult_Request`.
    "nav2_msgs/action/NavigateToPose_GetResult_Request" "RIHS01_106d3457cf0db4c4a8d3373bab3ff6aa8ba8ad99ae6392ce9784830a7d04ac93"
    NavigateToPoseGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateToPose_GetResult_Response`.
    "nav2_msgs/action/NavigateToPose_GetResult_Response" "RIHS01_c59f178c377de5318919c00bdbf7884cb3b185acfdffceba6c9f161e0aa3cc81"
    NavigateToPoseGetResultResponse {
        /// status
        status: i8,
        /// result
        result: NavigateToPoseResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateToPose_FeedbackMessage`.
    "nav2_msgs/action/NavigateToPose_FeedbackMessage" "RIHS01_2c1b4ec1a0e3a53c9aa326aabe717670eeef0ff3d4c3351ff940613b2011728a"
    NavigateToPoseFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: NavigateToPoseFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/NavigateToPose_SendGoal`.
    "nav2_msgs/action/NavigateToPose_SendGoal" "RIHS01_a4fcb3bee1bf32e21a0e541a943b221aa0826996e2c98f079b47022b256f48b5"
    NavigateToPoseSendGoal, NavigateToPoseSendGoalRequest, NavigateToPoseSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/NavigateToPose_GetResult`.
    "nav2_msgs/action/NavigateToPose_GetResult" "RIHS01_c407920357d566771e8882b4ef4d1f1a84ee922d609920ccd57faa6d6e391dc5"
    NavigateToPoseGetResult, NavigateToPoseGetResultRequest, NavigateToPoseGetResultResponse
}

crate::action! {
    /// Drives to a pose.
    "nav2_msgs/action/NavigateToPose" "RIHS01_8249f00686c6ae22c7854aea17fec2e47bc5fe2390e3513973eb7feb890bbd23"
    NavigateToPose, NavigateToPoseGoal, NavigateToPoseResult, NavigateToPoseFeedback,
    NavigateToPoseSendGoal, NavigateToPoseGetResult, NavigateToPoseFeedbackMessage
}

crate::message! {
    /// Turns in place.
    "nav2_msgs/action/Spin_Goal" "RIHS01_f6e33f6a4d5d9c4e34cfa68f31818cd096d4251c162738ea5c01a9a8854779fc"
    SpinGoal {
        /// Angle to turn; rad, anticlockwise.
        target_yaw: f32,
        /// Maximum duration; 0 is none.
        time_allowance: crate::builtin_interfaces::Duration,
        /// Drives on whatever the costmap says.
        disable_collision_checks: bool = false,
    }
}

crate::message! {
    /// `nav2_msgs/action/Spin_Result`.
    "nav2_msgs/action/Spin_Result" "RIHS01_7e028af50815284a59ab43101abfd16f349963c4f0a832c33f497bfcab114a6b"
    SpinResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// UNKNOWN
    UNKNOWN: u16 = 700;
    /// TIMEOUT
    TIMEOUT: u16 = 701;
    /// TF_ERROR
    TF_ERROR: u16 = 702;
    /// COLLISION_AHEAD
    COLLISION_AHEAD: u16 = 703;
}

crate::message! {
    /// `nav2_msgs/action/Spin_Feedback`.
    "nav2_msgs/action/Spin_Feedback" "RIHS01_3973d0eb96c7340ba3a815ca1a623225178a882b603e0c59451ef5a5f55fee02"
    SpinFeedback {
        /// Angle turned so far; rad.
        angular_distance_traveled: f32,
    }
}

crate::message! {
    /// `nav2_msgs/action/Spin_SendGoal_Request`.
    "nav2_msgs/action/Spin_SendGoal_Request" "RIHS01_4edb60053144f38024ad61403e1e02f1eb7362d03646b18284ee4493134ca8b6"
    SpinSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: SpinGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/Spin_SendGoal_Response`.
    "nav2_msgs/action/Spin_SendGoal_Response" "RIHS01_437152e9292a37e023b93be76e80eddd232dec1559019a17cb37c6eff186e99a"
    SpinSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/Spin_GetResult_Request`.
    "nav2_msgs/action/Spin_GetResult_Request" "RIHS01_38ad335938aff37fe49919e8ad376b12ad3aac2ccc505b9e40025097c6ee1e47"
    SpinGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/Spin_GetResult_Response`.
    "nav2_msgs/action/Spin_GetResult_Response" "RIHS01_5f68b672144ed58bedd7690a840a58caf387f689f27f8e7b091641fd45cf4cef"
    SpinGetResultResponse {
        /// status
        status: i8,
        /// result
        result: SpinResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/Spin_FeedbackMessage`.
    "nav2_msgs/action/Spin_FeedbackMessage" "RIHS01_65172773a4a518f36640b41d18d588319e665e7ba04a29237e7f92ba275e8388"
    SpinFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: SpinFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/Spin_SendGoal`.
    "nav2_msgs/action/Spin_SendGoal" "RIHS01_63ad359dc095261afa24687d27726c47541752ba406dc5515aca94c83c4a51b8"
    SpinSendGoal, SpinSendGoalRequest, SpinSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/Spin_GetResult`.
    "nav2_msgs/action/Spin_GetResult" "RIHS01_7f67d68c99609b11fce83d1912c5f69b3c2e78629da43f6c74f4e02b00b49653"
    SpinGetResult, SpinGetResultRequest, SpinGetResultResponse
}

crate::action! {
    /// Turns in place.
    "nav2_msgs/action/Spin" "RIHS01_8463b23d8454c92f735dbc77a62138d4e8570570939e39eab993dd63d8442925"
    Spin, SpinGoal, SpinResult, SpinFeedback,
    SpinSendGoal, SpinGetResult, SpinFeedbackMessage
}

crate::message! {
    /// Clears a square about a pose.
    "nav2_msgs/srv/ClearCostmapAroundPose_Request" "RIHS01_8f1608d4367d30fad666f594e02740b32b2cb41175b732a4d948c5498cfc7fa7"
    ClearCostmapAroundPoseRequest {
        /// Its middle.
        pose: crate::geometry_msgs::PoseStamped,
        /// Side of the square; m.
        reset_distance: f64,
        /// Of these layers; of all that may be cleared if there is none.
        plugins: Vec<std::string::String>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapAroundPose_Response`.
    "nav2_msgs/srv/ClearCostmapAroundPose_Response" "RIHS01_93297a0135cf02c6e53b44572bedd560a326af74beb0e8756ef579deb433ff4b"
    ClearCostmapAroundPoseResponse {
        /// Whether it was done; if a name does not fit, nothing is.
        success: bool,
    }
}

crate::service! {
    /// Clears a square about a pose.
    "nav2_msgs/srv/ClearCostmapAroundPose" "RIHS01_3b092cbcc5d25708adc0db6f29bc9e5f6cb76c47a774ee097bf05a87f649fa37"
    ClearCostmapAroundPose, ClearCostmapAroundPoseRequest, ClearCostmapAroundPoseResponse
}

crate::message! {
    /// Clears a square about the robot.
    "nav2_msgs/srv/ClearCostmapAroundRobot_Request" "RIHS01_55e6b76115fd11b6fb8b12bac59e3b2293520461481f8ecdb55b7b3e7bfe18f0"
    ClearCostmapAroundRobotRequest {
        /// Side of the square; m.
        reset_distance: f32,
        /// Of these layers; of all that may be cleared if there is none.
        plugins: Vec<std::string::String>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapAroundRobot_Response`.
    "nav2_msgs/srv/ClearCostmapAroundRobot_Response" "RIHS01_81dca16a2b326650a3c70bc6a86b2d5ae4977a03472b0fae6e64b2f9b13d2c14"
    ClearCostmapAroundRobotResponse {
        /// Whether it was done; if a name does not fit, nothing is.
        success: bool,
    }
}

crate::service! {
    /// Clears a square about the robot.
    "nav2_msgs/srv/ClearCostmapAroundRobot" "RIHS01_44d2b7c7521a1d317d1008344d470413a604cb0f1d162cba80480490b5ce26a4"
    ClearCostmapAroundRobot, ClearCostmapAroundRobotRequest, ClearCostmapAroundRobotResponse
}

crate::message! {
    /// Clears all but a square about the robot.
    "nav2_msgs/srv/ClearCostmapExceptRegion_Request" "RIHS01_c2425e47f27b066291649a2a713f24eb58b970b6285181f1321700906513e0e1"
    ClearCostmapExceptRegionRequest {
        /// Side of the square; m.
        reset_distance: f32,
        /// Of these layers; of all that may be cleared if there is none.
        plugins: Vec<std::string::String>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapExceptRegion_Response`.
    "nav2_msgs/srv/ClearCostmapExceptRegion_Response" "RIHS01_7897989c8ec51534295d76ec315fe51cf7b8f07d1e743003b2c0e83ffd130601"
    ClearCostmapExceptRegionResponse {
        /// Whether it was done; if a name does not fit, nothing is.
        success: bool,
    }
}

crate::service! {
    /// Clears all but a square about the robot.
    "nav2_msgs/srv/ClearCostmapExceptRegion" "RIHS01_07ca78b82d39cf741a39c1f5dd1a679f415ccd4ec2ba054751e48a0d633adae8"
    ClearCostmapExceptRegion, ClearCostmapExceptRegionRequest, ClearCostmapExceptRegionResponse
}

crate::message! {
    /// Clears a costmap.
    "nav2_msgs/srv/ClearEntireCostmap_Request" "RIHS01_61cc07fa7635a8afa816672385117f7fe44e0a0dae93fc0204949eb82d6c67ce"
    ClearEntireCostmapRequest {
        /// Only these layers; everything if there is none.
        plugins: Vec<std::string::String>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearEntireCostmap_Response`.
    "nav2_msgs/srv/ClearEntireCostmap_Response" "RIHS01_abb68db9ff372188bf455ede0066044afb9f1827364e9f8e8ca6496253e84b55"
    ClearEntireCostmapResponse {
        /// Whether it was done; if a name does not fit, nothing is.
        success: bool,
    }
}

crate::service! {
    /// Clears a costmap.
    "nav2_msgs/srv/ClearEntireCostmap" "RIHS01_f6d3228ce896488e63003f99de655e742af27bcab2e75694f4eb8ca1604ccb3d"
    ClearEntireCostmap, ClearEntireCostmapRequest, ClearEntireCostmapResponse
}

crate::message! {
    /// Test if a path is free of obstacles.
    "nav2_msgs/srv/IsPathValid_Request" "RIHS01_b3f3b2f615b36aa25e1de624a83c765b2e37dbc37f0382e49b6179be179f0e51"
    IsPathValidRequest {
        /// path
        path: crate::nav_msgs::Path,
        /// Cost from which on a pose is invalid.
        max_cost: u8 = 254,
        /// Poses in unknown cells are invalid.
        consider_unknown_as_obstacle: bool = false,
        /// Layer to test; the whole costmap if empty.
        layer_name: std::string::String = "".into(),
        /// Footprint to use instead of that of the robot.
        footprint: std::string::String = "".into(),
        /// Ends the test at the first invalid pose.
        stop_at_first_collision: bool = true,
        /// Length of the path to test; m; all if negative.
        max_lookahead_distance: f64 = -1.0,
    }
}

crate::message! {
    /// `nav2_msgs/srv/IsPathValid_Response`.
    "nav2_msgs/srv/IsPathValid_Response" "RIHS01_44b06a098c8aec5b346ff47d665148c8b43639c0b737630cadfb7a4adc9d6fb4"
    IsPathValidResponse {
        /// success
        success: bool,
        /// True if no pose is in collision.
        is_valid: bool,
        /// Indices of the poses in collision.
        invalid_pose_indices: Vec<i32>,
    }
}

crate::service! {
    /// Test if a path is free of obstacles.
    "nav2_msgs/srv/IsPathValid" "RIHS01_0ac807042778de2617d7929c1d18ca07331367df975b3a4161073f17d21a5418"
    IsPathValid, IsPathValidRequest, IsPathValidResponse
}
