//! `nav2_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/nav2_msgs`
//! instead.

crate::message! {
    /// Lets a user drive and stops before obstacles.
    "nav2_msgs/action/AssistedTeleop_Goal" "RIHS01_7f15de2bf641884ed35558980c06bfb299fa509c3ee0f4f0a87c8a03ad4980f5"
    AssistedTeleopGoal {
        /// Maximum duration; 0 is none.
        time_allowance: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `nav2_msgs/action/AssistedTeleop_Result`.
    "nav2_msgs/action/AssistedTeleop_Result" "RIHS01_94dc3582c30005fa65d2b5558c5046b2b5da199c07025af0fab2ddd3da46757c"
    AssistedTeleopResult {
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
    UNKNOWN: u16 = 730;
    /// TIMEOUT
    TIMEOUT: u16 = 731;
    /// TF_ERROR
    TF_ERROR: u16 = 732;
}

crate::message! {
    /// `nav2_msgs/action/AssistedTeleop_Feedback`.
    "nav2_msgs/action/AssistedTeleop_Feedback" "RIHS01_f206973552e669e0573255ea6bcbddf8b356dcbeaf4ab21f6f76afd5859de989"
    AssistedTeleopFeedback {
        /// Time since the start.
        current_teleop_duration: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `nav2_msgs/action/AssistedTeleop_SendGoal_Request`.
    "nav2_msgs/action/AssistedTeleop_SendGoal_Request" "RIHS01_0b5af506173445f4eb1578dfe0de46996bfeacb0c89abdaa5d80f5bfd3658cd7"
    AssistedTeleopSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: AssistedTeleopGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/AssistedTeleop_SendGoal_Response`.
    "nav2_msgs/action/AssistedTeleop_SendGoal_Response" "RIHS01_7781e634117dedcc929ea1334a5654abec734078fe85c309aa50b4eb43e2064a"
    AssistedTeleopSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/AssistedTeleop_GetResult_Request`.
    "nav2_msgs/action/AssistedTeleop_GetResult_Request" "RIHS01_6c95017eb93b7d15ea1ec6f5575f1488e2b4c7ced30cab8267052043540e9499"
    AssistedTeleopGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/AssistedTeleop_GetResult_Response`.
    "nav2_msgs/action/AssistedTeleop_GetResult_Response" "RIHS01_3435b909465181861e06624d40a4e2504fdc051e4c2c2710e71a1abded40b7b0"
    AssistedTeleopGetResultResponse {
        /// status
        status: i8,
        /// result
        result: AssistedTeleopResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/AssistedTeleop_FeedbackMessage`.
    "nav2_msgs/action/AssistedTeleop_FeedbackMessage" "RIHS01_440e6eff945d974df81e3aa2c7ee115aaa930deb218d8a04b853e8bf2d9c2df5"
    AssistedTeleopFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: AssistedTeleopFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/AssistedTeleop_SendGoal`.
    "nav2_msgs/action/AssistedTeleop_SendGoal" "RIHS01_b33119db4a7f19115ae145b7ca3a92e6c3e7767c3106da893da36639170a6b94"
    AssistedTeleopSendGoal, AssistedTeleopSendGoalRequest, AssistedTeleopSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/AssistedTeleop_GetResult`.
    "nav2_msgs/action/AssistedTeleop_GetResult" "RIHS01_dd682e460cf893ec1c2cd93caf1805b40b0c08c0cb462daa6c30865e157bb1b0"
    AssistedTeleopGetResult, AssistedTeleopGetResultRequest, AssistedTeleopGetResultResponse
}

crate::action! {
    /// Lets a user drive and stops before obstacles.
    "nav2_msgs/action/AssistedTeleop" "RIHS01_0db8dcd93f8f6072c806b47c8e09f6065e47261d9658db291c359b2a9854f8f4"
    AssistedTeleop, AssistedTeleopGoal, AssistedTeleopResult, AssistedTeleopFeedback,
    AssistedTeleopSendGoal, AssistedTeleopGetResult, AssistedTeleopFeedbackMessage
}

crate::message! {
    /// Drives straight backwards.
    "nav2_msgs/action/BackUp_Goal" "RIHS01_55f0d0f5affeabe369b9ff934c2c0bfb9816faca93953a5bced119c038c42783"
    BackUpGoal {
        /// Distance to drive along x; m.
        target: crate::geometry_msgs::Point,
        /// Speed; m/s.
        speed: f32,
        /// Maximum duration; 0 is none.
        time_allowance: crate::builtin_interfaces::Duration,
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
    "nav2_msgs/action/BackUp_SendGoal_Request" "RIHS01_79bcd42f3243d0a219e47130f84ff7d5a3a4c9f34700f893beb8a23eae6f68fe"
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
    "nav2_msgs/action/BackUp_SendGoal" "RIHS01_e37785b6e28415aa2b434da90fb8dd9f2595e05f2b354be6e463b7aff2934720"
    BackUpSendGoal, BackUpSendGoalRequest, BackUpSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/BackUp_GetResult`.
    "nav2_msgs/action/BackUp_GetResult" "RIHS01_3522c919bdbbffa283f13484f610981688138de7308e88de94a57c47c466d342"
    BackUpGetResult, BackUpGetResultRequest, BackUpGetResultResponse
}

crate::action! {
    /// Drives straight backwards.
    "nav2_msgs/action/BackUp" "RIHS01_28d3ef6f5c43fdb860f960f4be61825e80d3c6fd54a12af77005eb477ad60d50"
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
    "nav2_msgs/action/ComputeAndTrackRoute_Result" "RIHS01_e4c7715931fca885ff92c57bcf813f8d0a8a69e18eeedb561623d3d51b9e2e37"
    ComputeAndTrackRouteResult {
        /// Duration of the action.
        execution_duration: crate::builtin_interfaces::Duration,
        /// 0 without an error, else one of the values above.
        error_code: u16 = 0,
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
    "nav2_msgs/action/ComputeAndTrackRoute_GetResult_Response" "RIHS01_9066b31678d4d6ab9e264f6ad343003ed74b72bfa9bd606c6b4180da71baac3f"
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
    "nav2_msgs/action/ComputeAndTrackRoute_GetResult" "RIHS01_8ae7176ade04d0e2948b47059c9595522201125c87f221f6577b56cec9f0e36f"
    ComputeAndTrackRouteGetResult, ComputeAndTrackRouteGetResultRequest, ComputeAndTrackRouteGetResultResponse
}

crate::action! {
    /// Plans a route in a graph and follows the progress of the robot on it.
    "nav2_msgs/action/ComputeAndTrackRoute" "RIHS01_eb358f9e4b7f7db475c3340bebf11c650f0641a8577da6eb3f9faa0a20805857"
    ComputeAndTrackRoute, ComputeAndTrackRouteGoal, ComputeAndTrackRouteResult, ComputeAndTrackRouteFeedback,
    ComputeAndTrackRouteSendGoal, ComputeAndTrackRouteGetResult, ComputeAndTrackRouteFeedbackMessage
}

crate::message! {
    /// Plans a path through several poses.
    "nav2_msgs/action/ComputePathThroughPoses_Goal" "RIHS01_ef05acd91e1bfc92608d564d649d666d8bd7ff84fdea0b5a006a1172320d2bae"
    ComputePathThroughPosesGoal {
        /// goals
        goals: Vec<crate::geometry_msgs::PoseStamped>,
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
    "nav2_msgs/action/ComputePathThroughPoses_Result" "RIHS01_9b1b12c2ed2f27b2a8e4a657b944180b3ce4cdb6798f4d0eefd9a5b739f233a6"
    ComputePathThroughPosesResult {
        /// path
        path: crate::nav_msgs::Path,
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
    "nav2_msgs/action/ComputePathThroughPoses_SendGoal_Request" "RIHS01_dbdd127d3da1f01300f279d2484bf5a88d77cba10fceca88710bb0377efd1dc3"
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
    "nav2_msgs/action/ComputePathThroughPoses_GetResult_Response" "RIHS01_70d89be6b071711328338621fab174401490b8f0e347d359866a3aec8c33a327"
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
    "nav2_msgs/action/ComputePathThroughPoses_SendGoal" "RIHS01_6aac5f4ea44b023b4c4685ee022298a76e8a1671f27ab488adf2ac4efecfca9d"
    ComputePathThroughPosesSendGoal, ComputePathThroughPosesSendGoalRequest, ComputePathThroughPosesSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/ComputePathThroughPoses_GetResult`.
    "nav2_msgs/action/ComputePathThroughPoses_GetResult" "RIHS01_86b86db67d57ff222084ff1ac42e5357fdf8597973b36000e15e01ad43a9fdf7"
    ComputePathThroughPosesGetResult, ComputePathThroughPosesGetResultRequest, ComputePathThroughPosesGetResultResponse
}

crate::action! {
    /// Plans a path through several poses.
    "nav2_msgs/action/ComputePathThroughPoses" "RIHS01_bb3cde2342f7eadfe65ed4dff5253edc37e44ae14a3fcee77272d7fef552440c"
    ComputePathThroughPoses, ComputePathThroughPosesGoal, ComputePathThroughPosesResult, ComputePathThroughPosesFeedback,
    ComputePathThroughPosesSendGoal, ComputePathThroughPosesGetResult, ComputePathThroughPosesFeedbackMessage
}

crate::message! {
    /// Plans a path to a pose.
    "nav2_msgs/action/ComputePathToPose_Goal" "RIHS01_9b2a136db06950716ad4a46b9d01bb628703cad155650c0b8233fb6a2f2783fa"
    ComputePathToPoseGoal {
        /// goal
        goal: crate::geometry_msgs::PoseStamped,
        /// start
        start: crate::geometry_msgs::PoseStamped,
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
    "nav2_msgs/action/ComputePathToPose_SendGoal_Request" "RIHS01_7febfe253154b28fa86ff7badebe59ddfb79829c86485903efd19884a73e178e"
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
    "nav2_msgs/action/ComputePathToPose_SendGoal" "RIHS01_e800806a220935f225495784663dfdd78b509335309a5127ed1112f6ce6b9dbc"
    ComputePathToPoseSendGoal, ComputePathToPoseSendGoalRequest, ComputePathToPoseSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/ComputePathToPose_GetResult`.
    "nav2_msgs/action/ComputePathToPose_GetResult" "RIHS01_386ab12c2f62a441596ef1140b3beca654a957eaac87e769c10de01b0e28208f"
    ComputePathToPoseGetResult, ComputePathToPoseGetResultRequest, ComputePathToPoseGetResultResponse
}

crate::action! {
    /// Plans a path to a pose.
    "nav2_msgs/action/ComputePathToPose" "RIHS01_b11d50c914791956069419b8f4ad441e3c66fcfbd9461f8e87110b77dc6febe9"
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
    "nav2_msgs/action/ComputeRoute_Result" "RIHS01_ddc1a556ad76449e6ce6f18d503170afde747c5c0bb085d7724124a7b47237b6"
    ComputeRouteResult {
        /// Time that the planner needed.
        planning_time: crate::builtin_interfaces::Duration,
        /// path
        path: crate::nav_msgs::Path,
        /// route
        route: Route,
        /// 0 without an error, else one of the values above.
        error_code: u16 = 0,
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
    "nav2_msgs/action/ComputeRoute_GetResult_Response" "RIHS01_bbe1d52c6ce64e7f7600e9d49ec163d2b93c5f1b0d8b49ba04e0e0bdda15f262"
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
    "nav2_msgs/action/ComputeRoute_GetResult" "RIHS01_c5d88f3f3bed36738c147f78cf7e45cbd3880283f7faa83c04f441d846d28842"
    ComputeRouteGetResult, ComputeRouteGetResultRequest, ComputeRouteGetResultResponse
}

crate::action! {
    /// Plans a route in a graph.
    "nav2_msgs/action/ComputeRoute" "RIHS01_a9b4edd14db3c113801ee8bad9b15fdc25aff0655f587fac6d8a672d6cf9af60"
    ComputeRoute, ComputeRouteGoal, ComputeRouteResult, ComputeRouteFeedback,
    ComputeRouteSendGoal, ComputeRouteGetResult, ComputeRouteFeedbackMessage
}

crate::message! {
    /// Drives a robot into a dock.
    "nav2_msgs/action/DockRobot_Goal" "RIHS01_771fae864909c42683a444d493e806a2e709af4678a21091e64edbe16e3223bc"
    DockRobotGoal {
        /// Looks the dock up by its id instead of using `dock_pose`.
        use_dock_id: bool = true,
        /// dock_id
        dock_id: std::string::String,
        /// dock_pose
        dock_pose: crate::geometry_msgs::PoseStamped,
        /// dock_type
        dock_type: std::string::String,
        /// Maximum time to the staging pose; s.
        max_staging_time: f32 = 1000.0,
        /// navigate_to_staging_pose
        navigate_to_staging_pose: bool = true,
    }
}

crate::message! {
    /// `nav2_msgs/action/DockRobot_Result`.
    "nav2_msgs/action/DockRobot_Result" "RIHS01_09208d89bb7477854fc834f4ceced1e963890614c5e0821121b2a97ddb7be5eb"
    DockRobotResult {
        /// success
        success: bool = true,
        /// 0 without an error, else one of the values above.
        error_code: u16 = 0,
        /// Number of repetitions so far.
        num_retries: u16 = 0,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// DOCK_NOT_IN_DB
    DOCK_NOT_IN_DB: u16 = 901;
    /// DOCK_NOT_VALID
    DOCK_NOT_VALID: u16 = 902;
    /// FAILED_TO_STAGE
    FAILED_TO_STAGE: u16 = 903;
    /// FAILED_TO_DETECT_DOCK
    FAILED_TO_DETECT_DOCK: u16 = 904;
    /// FAILED_TO_CONTROL
    FAILED_TO_CONTROL: u16 = 905;
    /// FAILED_TO_CHARGE
    FAILED_TO_CHARGE: u16 = 906;
    /// TIMEOUT
    TIMEOUT: u16 = 907;
    /// UNKNOWN
    UNKNOWN: u16 = 999;
}

crate::message! {
    /// `nav2_msgs/action/DockRobot_Feedback`.
    "nav2_msgs/action/DockRobot_Feedback" "RIHS01_b23f877ad7013aae4ad83a1330e83a62a1397594839126331a843a8852dcc8e8"
    DockRobotFeedback {
        /// state
        state: u16,
        /// docking_time
        docking_time: crate::builtin_interfaces::Duration,
        /// Number of repetitions so far.
        num_retries: u16 = 0,
    }
    /// NONE
    NONE: u16 = 0;
    /// NAV_TO_STAGING_POSE
    NAV_TO_STAGING_POSE: u16 = 1;
    /// INITIAL_PERCEPTION
    INITIAL_PERCEPTION: u16 = 2;
    /// CONTROLLING
    CONTROLLING: u16 = 3;
    /// WAIT_FOR_CHARGE
    WAIT_FOR_CHARGE: u16 = 4;
    /// RETRY
    RETRY: u16 = 5;
}

crate::message! {
    /// `nav2_msgs/action/DockRobot_SendGoal_Request`.
    "nav2_msgs/action/DockRobot_SendGoal_Request" "RIHS01_309c70d1d0c40a21fe70cb766b444d0e627fbaa631ab47befb74d26ac82ce762"
    DockRobotSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: DockRobotGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/DockRobot_SendGoal_Response`.
    "nav2_msgs/action/DockRobot_SendGoal_Response" "RIHS01_0509c711affb605eac18ce08cc59092af9a6c01a6dcb9d5ccafb1b9fd38db1f3"
    DockRobotSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/DockRobot_GetResult_Request`.
    "nav2_msgs/action/DockRobot_GetResult_Request" "RIHS01_5039076d7f1f90aeeb9c2a09c2252ff0f66ed4d668cb405dde9591f05e25d885"
    DockRobotGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/DockRobot_GetResult_Response`.
    "nav2_msgs/action/DockRobot_GetResult_Response" "RIHS01_07583af3f8c2ae650710bb28176bc535b80fff055922398d3aba8e41659f881f"
    DockRobotGetResultResponse {
        /// status
        status: i8,
        /// result
        result: DockRobotResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/DockRobot_FeedbackMessage`.
    "nav2_msgs/action/DockRobot_FeedbackMessage" "RIHS01_16db0109537f6d74013ed7e6fa51f21c6dcc0a0355cef3be4db4401e971bbe81"
    DockRobotFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: DockRobotFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/DockRobot_SendGoal`.
    "nav2_msgs/action/DockRobot_SendGoal" "RIHS01_9e60155a1fb741109942c5c7dc21ae0e0db771eaf55d0cfc768bae57a95f3454"
    DockRobotSendGoal, DockRobotSendGoalRequest, DockRobotSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/DockRobot_GetResult`.
    "nav2_msgs/action/DockRobot_GetResult" "RIHS01_3e83e8a6eefb3ebe244cd0384418f43d22ffb1f3263fd7b978af8164591c50b3"
    DockRobotGetResult, DockRobotGetResultRequest, DockRobotGetResultResponse
}

crate::action! {
    /// Drives a robot into a dock.
    "nav2_msgs/action/DockRobot" "RIHS01_d4398769495d327a0cba210e3cf1055ac742ec8a3eccc683f88b1c730b1d6405"
    DockRobot, DockRobotGoal, DockRobotResult, DockRobotFeedback,
    DockRobotSendGoal, DockRobotGetResult, DockRobotFeedbackMessage
}

crate::message! {
    /// Drives straight ahead.
    "nav2_msgs/action/DriveOnHeading_Goal" "RIHS01_c7e0460e8c21ad1ee58a45becec6ba6f242ad1f63e71c1c735fa66d734b64744"
    DriveOnHeadingGoal {
        /// Distance to drive along x; m.
        target: crate::geometry_msgs::Point,
        /// Speed; m/s.
        speed: f32,
        /// Maximum duration; 0 is none.
        time_allowance: crate::builtin_interfaces::Duration,
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
    "nav2_msgs/action/DriveOnHeading_SendGoal_Request" "RIHS01_02a091c65adfe1e6a67915b73379f59876c62fcaddd59c9d5324abc6757f9af7"
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
    "nav2_msgs/action/DriveOnHeading_SendGoal" "RIHS01_3fcdf73cd305fd67065324d54bf31afb8f77715a03b73ad88476acce7eb58196"
    DriveOnHeadingSendGoal, DriveOnHeadingSendGoalRequest, DriveOnHeadingSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/DriveOnHeading_GetResult`.
    "nav2_msgs/action/DriveOnHeading_GetResult" "RIHS01_85cef782f5814a11f0dc3deb6cceda7a4df777e116e48c13b89b27b96fac89c8"
    DriveOnHeadingGetResult, DriveOnHeadingGetResultRequest, DriveOnHeadingGetResultResponse
}

crate::action! {
    /// Drives straight ahead.
    "nav2_msgs/action/DriveOnHeading" "RIHS01_9eca8a3505f973b994ac18f4aaf76c0c4563cc7cde1ce7384be2f70e53479c11"
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
    "nav2_msgs/action/FollowGPSWaypoints_Result" "RIHS01_3acb9f8a7e3ea2d2c27b2d684611b582b1dfaedb6919efec4d98822838651696"
    FollowGPSWaypointsResult {
        /// Poses that were not reached.
        missed_waypoints: Vec<MissedWaypoint>,
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
    "nav2_msgs/action/FollowGPSWaypoints_GetResult_Response" "RIHS01_581fcf1b6e9b4b00836ad2ded9120514116f2e7216a48cdd9861a4b59d43999f"
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
    "nav2_msgs/action/FollowGPSWaypoints_GetResult" "RIHS01_6ac4faa6cf1c4602c739f396e9da071e16ed2fefc979ad5f32084b0b0c379cd4"
    FollowGPSWaypointsGetResult, FollowGPSWaypointsGetResultRequest, FollowGPSWaypointsGetResultResponse
}

crate::action! {
    /// Drives to poses on the globe one after the other.
    "nav2_msgs/action/FollowGPSWaypoints" "RIHS01_deb1908eea298a935abb60a75fbd334549be5ed3c9767ba14729c414fb5881d2"
    FollowGPSWaypoints, FollowGPSWaypointsGoal, FollowGPSWaypointsResult, FollowGPSWaypointsFeedback,
    FollowGPSWaypointsSendGoal, FollowGPSWaypointsGetResult, FollowGPSWaypointsFeedbackMessage
}

crate::message! {
    /// Follows a moving object.
    "nav2_msgs/action/FollowObject_Goal" "RIHS01_9df7fb19fc953c0723ead5597fe3ed34c0edcc4d76f2bd9ccc8a48bc0bd85e7a"
    FollowObjectGoal {
        /// pose_topic
        pose_topic: std::string::String,
        /// tracked_frame
        tracked_frame: std::string::String,
        /// Maximum duration; 0 is none.
        max_duration: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowObject_Result`.
    "nav2_msgs/action/FollowObject_Result" "RIHS01_bee30321cc542d5bf5579a785d86bae2db5aea40797252eadcf183ea36875ae0"
    FollowObjectResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
        /// 0 without an error, else one of the values above.
        error_code: u16 = 0,
        /// Number of repetitions so far.
        num_retries: u16 = 0,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// NONE
    NONE: u16 = 0;
    /// GOAL_REJECTED
    GOAL_REJECTED: u16 = 1;
    /// SEND_GOAL_FAILURE
    SEND_GOAL_FAILURE: u16 = 2;
    /// TF_ERROR
    TF_ERROR: u16 = 901;
    /// FAILED_TO_DETECT_OBJECT
    FAILED_TO_DETECT_OBJECT: u16 = 902;
    /// FAILED_TO_CONTROL
    FAILED_TO_CONTROL: u16 = 903;
    /// TIMEOUT
    TIMEOUT: u16 = 904;
    /// UNKNOWN
    UNKNOWN: u16 = 999;
}

crate::message! {
    /// `nav2_msgs/action/FollowObject_Feedback`.
    "nav2_msgs/action/FollowObject_Feedback" "RIHS01_4d58bd5c9ea9248dec74ba7cc95f2e3ebeb44af9b02d6fa1ee30f0f6a17b7839"
    FollowObjectFeedback {
        /// state
        state: u16,
        /// following_time
        following_time: crate::builtin_interfaces::Duration,
        /// Number of repetitions so far.
        num_retries: u16 = 0,
    }
    /// NONE
    NONE: u16 = 0;
    /// INITIAL_PERCEPTION
    INITIAL_PERCEPTION: u16 = 1;
    /// CONTROLLING
    CONTROLLING: u16 = 2;
    /// STOPPING
    STOPPING: u16 = 3;
    /// RETRY
    RETRY: u16 = 4;
}

crate::message! {
    /// `nav2_msgs/action/FollowObject_SendGoal_Request`.
    "nav2_msgs/action/FollowObject_SendGoal_Request" "RIHS01_eaffb7ce6d6d3b9455eb867cb768a1b3d6c117e46f671832ff7aef004246c8a2"
    FollowObjectSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: FollowObjectGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowObject_SendGoal_Response`.
    "nav2_msgs/action/FollowObject_SendGoal_Response" "RIHS01_0abeed92562affb2537e23ee7c41cde677cba1ca27497486c68224f01f67d68a"
    FollowObjectSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowObject_GetResult_Request`.
    "nav2_msgs/action/FollowObject_GetResult_Request" "RIHS01_11383a8f10e64e6b08ce36f3fba298066ff2faff902517492aa73585928e199b"
    FollowObjectGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowObject_GetResult_Response`.
    "nav2_msgs/action/FollowObject_GetResult_Response" "RIHS01_3303c090239e6a106a6771d19ea0010175eeee18803eae9aad6958d4f3c04b78"
    FollowObjectGetResultResponse {
        /// status
        status: i8,
        /// result
        result: FollowObjectResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowObject_FeedbackMessage`.
    "nav2_msgs/action/FollowObject_FeedbackMessage" "RIHS01_0711fd141e723cc523724763fff0657e02d5e5292415ef1b19780e89308e8a23"
    FollowObjectFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: FollowObjectFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/FollowObject_SendGoal`.
    "nav2_msgs/action/FollowObject_SendGoal" "RIHS01_be8d4b9e9009767046743b47297c12d1487359a022888b04a72781cf029244d9"
    FollowObjectSendGoal, FollowObjectSendGoalRequest, FollowObjectSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/FollowObject_GetResult`.
    "nav2_msgs/action/FollowObject_GetResult" "RIHS01_c185b60e2fb1198b2d388eca8bb6502f324e58d1364cd883376043558e60f5a1"
    FollowObjectGetResult, FollowObjectGetResultRequest, FollowObjectGetResultResponse
}

crate::action! {
    /// Follows a moving object.
    "nav2_msgs/action/FollowObject" "RIHS01_4d6e71c4308e19ff8ab8d1a2f48ff27f8d1e24456280c3d0f716893f76b5494d"
    FollowObject, FollowObjectGoal, FollowObjectResult, FollowObjectFeedback,
    FollowObjectSendGoal, FollowObjectGetResult, FollowObjectFeedbackMessage
}

crate::message! {
    /// Drives along a path.
    "nav2_msgs/action/FollowPath_Goal" "RIHS01_7ec8732a3a001bf92b87db3989ef6984b1a4b9b9e62e166543ffa72344ecd194"
    FollowPathGoal {
        /// path
        path: crate::nav_msgs::Path,
        /// Name of the controller; may be empty if there is only one.
        controller_id: std::string::String,
        /// Name of the goal checker; may be empty if there is only one.
        goal_checker_id: std::string::String,
        /// Name of the progress checker; may be empty if there is only one.
        progress_checker_id: std::string::String,
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
    "nav2_msgs/action/FollowPath_Feedback" "RIHS01_496acbe672234cdb70be4f93d28a22aabbf441958e2e1ff443a44a96e9f3185b"
    FollowPathFeedback {
        /// Length of the path that remains; m.
        distance_to_goal: f32,
        /// Speed; m/s.
        speed: f32,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_SendGoal_Request`.
    "nav2_msgs/action/FollowPath_SendGoal_Request" "RIHS01_a4dfc2a22f6a63df6bd1974e38e378ded55bfd959d0162bc3a52b85ce09cd2ab"
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
    "nav2_msgs/action/FollowPath_FeedbackMessage" "RIHS01_3f4008700ba56ac4c82b01ef2b7fdd3fc18dc194399c48e5c43ebf8008b891d5"
    FollowPathFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: FollowPathFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/FollowPath_SendGoal`.
    "nav2_msgs/action/FollowPath_SendGoal" "RIHS01_5b662aee1159e1d7e7b5f8fef21f556b8bc67c818c730a68e18bb29b85f66946"
    FollowPathSendGoal, FollowPathSendGoalRequest, FollowPathSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/FollowPath_GetResult`.
    "nav2_msgs/action/FollowPath_GetResult" "RIHS01_8ab4c588c878f0e997316ec559f172bb56fc210b484c2f6b280d391d3bd6890f"
    FollowPathGetResult, FollowPathGetResultRequest, FollowPathGetResultResponse
}

crate::action! {
    /// Drives along a path.
    "nav2_msgs/action/FollowPath" "RIHS01_9d95513552fb578cfb933d7e0160273911269cbdf4b348f1acb87d8a903b13cf"
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
    "nav2_msgs/action/FollowWaypoints_Result" "RIHS01_f1211e430ddef3a92fa98ab5f095fab8815fd5c696d1d14ad03067dd6082cba7"
    FollowWaypointsResult {
        /// Poses that were not reached.
        missed_waypoints: Vec<MissedWaypoint>,
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
    "nav2_msgs/action/FollowWaypoints_GetResult_Response" "RIHS01_7ab1988a42cff9cf0effe22d523680ba5c9053d6c52bfeafd06df5ddd3e68604"
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
    "nav2_msgs/action/FollowWaypoints_GetResult" "RIHS01_feb0bffee2e1c19bae16974eb939974eab100c13f941daf6402d605e4b3203e4"
    FollowWaypointsGetResult, FollowWaypointsGetResultRequest, FollowWaypointsGetResultResponse
}

crate::action! {
    /// Drives to poses one after the other, with a task at each.
    "nav2_msgs/action/FollowWaypoints" "RIHS01_09e36a19e0374ab692e78b877e3345daa223ca4186b8af90f77939b78c6e6d7b"
    FollowWaypoints, FollowWaypointsGoal, FollowWaypointsResult, FollowWaypointsFeedback,
    FollowWaypointsSendGoal, FollowWaypointsGetResult, FollowWaypointsFeedbackMessage
}

crate::message! {
    /// Drives through several poses.
    "nav2_msgs/action/NavigateThroughPoses_Goal" "RIHS01_156eb642033047f1737b2f01c87da02ab81e841a3c896bbfba9317db388d2d8e"
    NavigateThroughPosesGoal {
        /// poses
        poses: Vec<crate::geometry_msgs::PoseStamped>,
        /// File or id of the tree; the default tree if empty.
        behavior_tree: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_Result`.
    "nav2_msgs/action/NavigateThroughPoses_Result" "RIHS01_e64524990d7d2778a414b35a00cc98e45acfda9aaa3cf810d07340fcde324d67"
    NavigateThroughPosesResult {
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
    "nav2_msgs/action/NavigateThroughPoses_Feedback" "RIHS01_56e169557485ca861b100e2530069cdf208bdc47cbb5bd9e9e9b5f3719bddb61"
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
        /// Number of poses not yet passed.
        number_of_poses_remaining: i16,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_SendGoal_Request`.
    "nav2_msgs/action/NavigateThroughPoses_SendGoal_Request" "RIHS01_3cfab113ccc3be41f05c8fc99f57df5d0e20b8350621d0bc843062f25e50f21b"
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
    "nav2_msgs/action/NavigateThroughPoses_GetResult_Response" "RIHS01_893b3d0f909977d49752d27b5efc5aa0e0e1ac5e5fbd4db0b2a1cb42e1998a32"
    NavigateThroughPosesGetResultResponse {
        /// status
        status: i8,
        /// result
        result: NavigateThroughPosesResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/NavigateThroughPoses_FeedbackMessage`.
    "nav2_msgs/action/NavigateThroughPoses_FeedbackMessage" "RIHS01_073962415ad2a226b3de7245b142aeb414268a4d35ef1321ff2a484e2130e2b1"
    NavigateThroughPosesFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: NavigateThroughPosesFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/NavigateThroughPoses_SendGoal`.
    "nav2_msgs/action/NavigateThroughPoses_SendGoal" "RIHS01_5a590fa8e9a32b7b9c838fdf5939a2fb8858d6cfd25bdf2f2e5f0f7bbb25f52b"
    NavigateThroughPosesSendGoal, NavigateThroughPosesSendGoalRequest, NavigateThroughPosesSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/NavigateThroughPoses_GetResult`.
    "nav2_msgs/action/NavigateThroughPoses_GetResult" "RIHS01_fdc12773de81ce69f7eeb4366702ea757d792ab5068bc461ee3b1438e66c7b36"
    NavigateThroughPosesGetResult, NavigateThroughPosesGetResultRequest, NavigateThroughPosesGetResultResponse
}

crate::action! {
    /// Drives through several poses.
    "nav2_msgs/action/NavigateThroughPoses" "RIHS01_4e680a34fd27772095da6ffdb32ae348adbc3d948248d38cf8d5ca3fc7a3a6c4"
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
    "nav2_msgs/action/NavigateToPose_Feedback" "RIHS01_9ebc544c7d41bd8c6060b191bf9f5e4ddca6c2f61ee9e04fcb62ed5d67218a33"
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
    "nav2_msgs/action/NavigateToPose_FeedbackMessage" "RIHS01_9d1f6fa2eb975ce733b419ac2e97b134d8ff92b6478b6559feed9a50bdfd82b3"
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
    "nav2_msgs/action/NavigateToPose" "RIHS01_a56dba8a3234a1215e610180dc703ae25bbf406dded8b54887891c9732857eab"
    NavigateToPose, NavigateToPoseGoal, NavigateToPoseResult, NavigateToPoseFeedback,
    NavigateToPoseSendGoal, NavigateToPoseGetResult, NavigateToPoseFeedbackMessage
}

crate::message! {
    /// Smooths a path.
    "nav2_msgs/action/SmoothPath_Goal" "RIHS01_1de12dc9eec5ecdd6c384fe2852787ea49669d7bc314be4ff5e89da5905f3347"
    SmoothPathGoal {
        /// path
        path: crate::nav_msgs::Path,
        /// Name of the smoother; may be empty if there is only one.
        smoother_id: std::string::String,
        /// Maximum time for the smoother.
        max_smoothing_duration: crate::builtin_interfaces::Duration,
        /// Tests the result for collisions.
        check_for_collisions: bool,
    }
}

crate::message! {
    /// `nav2_msgs/action/SmoothPath_Result`.
    "nav2_msgs/action/SmoothPath_Result" "RIHS01_67fa4798816f16d0a1eded9f2868a61a653da8b9d9a2dde1ed3aba2d6fd5b3b9"
    SmoothPathResult {
        /// path
        path: crate::nav_msgs::Path,
        /// Time that the smoother needed.
        smoothing_duration: crate::builtin_interfaces::Duration,
        /// False if the time was over before the smoother was done.
        was_completed: bool,
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
    UNKNOWN: u16 = 500;
    /// INVALID_SMOOTHER
    INVALID_SMOOTHER: u16 = 501;
    /// TIMEOUT
    TIMEOUT: u16 = 502;
    /// SMOOTHED_PATH_IN_COLLISION
    SMOOTHED_PATH_IN_COLLISION: u16 = 503;
    /// FAILED_TO_SMOOTH_PATH
    FAILED_TO_SMOOTH_PATH: u16 = 504;
    /// INVALID_PATH
    INVALID_PATH: u16 = 505;
}

crate::message! {
    /// `nav2_msgs/action/SmoothPath_Feedback`.
    "nav2_msgs/action/SmoothPath_Feedback" "RIHS01_3da564cd5b955796d075996a90b4d58e99d6688e83aa712ff5a329ed2dfebc38"
    SmoothPathFeedback {
    }
}

crate::message! {
    /// `nav2_msgs/action/SmoothPath_SendGoal_Request`.
    "nav2_msgs/action/SmoothPath_SendGoal_Request" "RIHS01_f8370eaddeca68682f497c22255548fe9cd55369637ddafd2b92d7aaa307250e"
    SmoothPathSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: SmoothPathGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/SmoothPath_SendGoal_Response`.
    "nav2_msgs/action/SmoothPath_SendGoal_Response" "RIHS01_70c9ce5ff38df4e0d4667011c6f0701152f1162197e6053d5831bb1f1bcb4626"
    SmoothPathSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/SmoothPath_GetResult_Request`.
    "nav2_msgs/action/SmoothPath_GetResult_Request" "RIHS01_b20bd138e1b93ce5e2333834456075eb17ddaff3e816232aca1edcae28c4930f"
    SmoothPathGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/SmoothPath_GetResult_Response`.
    "nav2_msgs/action/SmoothPath_GetResult_Response" "RIHS01_8b80dea01ff09a292a70f295abb4ba5bc4a261eedee2d27e399c31097267a2bb"
    SmoothPathGetResultResponse {
        /// status
        status: i8,
        /// result
        result: SmoothPathResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/SmoothPath_FeedbackMessage`.
    "nav2_msgs/action/SmoothPath_FeedbackMessage" "RIHS01_185338884216b3c62b5685968a0c8ed534691d3d3cb0ad65561be1d6a022123e"
    SmoothPathFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: SmoothPathFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/SmoothPath_SendGoal`.
    "nav2_msgs/action/SmoothPath_SendGoal" "RIHS01_923111f6c31210d4ddeca2fc7f74da83eb125239b5af33be8f88508ace2184e3"
    SmoothPathSendGoal, SmoothPathSendGoalRequest, SmoothPathSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/SmoothPath_GetResult`.
    "nav2_msgs/action/SmoothPath_GetResult" "RIHS01_174d0d28b7f6e25b07bc41031935b8c2cfc3afece12473fa31d0612f1ab2d42c"
    SmoothPathGetResult, SmoothPathGetResultRequest, SmoothPathGetResultResponse
}

crate::action! {
    /// Smooths a path.
    "nav2_msgs/action/SmoothPath" "RIHS01_84ea77c54dbe197a3d45c188124cf4535b1a1f3f0ffd2f86b841a1d63f1c2cda"
    SmoothPath, SmoothPathGoal, SmoothPathResult, SmoothPathFeedback,
    SmoothPathSendGoal, SmoothPathGetResult, SmoothPathFeedbackMessage
}

crate::message! {
    /// Turns in place.
    "nav2_msgs/action/Spin_Goal" "RIHS01_b8fac37d5254c24bf0d843531b89962c494689b9fb2f6645ba67fe5b6fa76be3"
    SpinGoal {
        /// Angle to turn; rad, anticlockwise.
        target_yaw: f32,
        /// Maximum duration; 0 is none.
        time_allowance: crate::builtin_interfaces::Duration,
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
    "nav2_msgs/action/Spin_SendGoal_Request" "RIHS01_22d757c59646d234fac03c3603d9c81508c069a5c6f555adbf1a53de11fbea5d"
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
    "nav2_msgs/action/Spin_SendGoal" "RIHS01_a863727716f5620b30cf493469d5668b37f3b51aa8ecec088cec89a86ca69e37"
    SpinSendGoal, SpinSendGoalRequest, SpinSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/Spin_GetResult`.
    "nav2_msgs/action/Spin_GetResult" "RIHS01_7f67d68c99609b11fce83d1912c5f69b3c2e78629da43f6c74f4e02b00b49653"
    SpinGetResult, SpinGetResultRequest, SpinGetResultResponse
}

crate::action! {
    /// Turns in place.
    "nav2_msgs/action/Spin" "RIHS01_9fc4653cfb2982465e9ca4e2710f0532de8f6dce77d6a6eada55e4e22273b55c"
    Spin, SpinGoal, SpinResult, SpinFeedback,
    SpinSendGoal, SpinGetResult, SpinFeedbackMessage
}

crate::message! {
    /// Drives a robot out of a dock.
    "nav2_msgs/action/UndockRobot_Goal" "RIHS01_4161041de8368e5140d3a4af41d24a8756e30e42249e022e258a30a0e1781ccb"
    UndockRobotGoal {
        /// dock_type
        dock_type: std::string::String,
        /// Maximum duration; s.
        max_undocking_time: f32 = 30.0,
    }
}

crate::message! {
    /// `nav2_msgs/action/UndockRobot_Result`.
    "nav2_msgs/action/UndockRobot_Result" "RIHS01_df25b55a44a1b73a03fe7f32c7ba0984dd077e5315cad6f25c7354ff5de6b310"
    UndockRobotResult {
        /// success
        success: bool = true,
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
    /// DOCK_NOT_VALID
    DOCK_NOT_VALID: u16 = 902;
    /// FAILED_TO_CONTROL
    FAILED_TO_CONTROL: u16 = 905;
    /// TIMEOUT
    TIMEOUT: u16 = 907;
    /// UNKNOWN
    UNKNOWN: u16 = 999;
}

crate::message! {
    /// `nav2_msgs/action/UndockRobot_Feedback`.
    "nav2_msgs/action/UndockRobot_Feedback" "RIHS01_cafb11296f8495bfdf9a773d2cdc226a906a67b466c1670a23e645334aa85996"
    UndockRobotFeedback {
    }
}

crate::message! {
    /// `nav2_msgs/action/UndockRobot_SendGoal_Request`.
    "nav2_msgs/action/UndockRobot_SendGoal_Request" "RIHS01_ec884ac27ce4373b831136ad8abfb3dc9b46f70d4e41c7448a7a8357ab02b295"
    UndockRobotSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: UndockRobotGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/UndockRobot_SendGoal_Response`.
    "nav2_msgs/action/UndockRobot_SendGoal_Response" "RIHS01_617d44847ffaf09a38c031a472157d986b316c87c27e1a1d2a3db940f6ab409e"
    UndockRobotSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/UndockRobot_GetResult_Request`.
    "nav2_msgs/action/UndockRobot_GetResult_Request" "RIHS01_7f4fcc0e04b17a147a94a96ca596a30619fe3016ce8f96adce3f6a47d873de6d"
    UndockRobotGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/UndockRobot_GetResult_Response`.
    "nav2_msgs/action/UndockRobot_GetResult_Response" "RIHS01_62d527a6c1162da1697872fd84920b8d8d4b42eddea2044daee040ea0d8da5eb"
    UndockRobotGetResultResponse {
        /// status
        status: i8,
        /// result
        result: UndockRobotResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/UndockRobot_FeedbackMessage`.
    "nav2_msgs/action/UndockRobot_FeedbackMessage" "RIHS01_e2204b39a6cd5f0563392b37a5945130d186c5df1c457fcb23ba72b3ff02eed1"
    UndockRobotFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: UndockRobotFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/UndockRobot_SendGoal`.
    "nav2_msgs/action/UndockRobot_SendGoal" "RIHS01_9c412dec37b7dad67b754dd860cdb03787c0924f01d4cd2b5c16506726b17dc3"
    UndockRobotSendGoal, UndockRobotSendGoalRequest, UndockRobotSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/UndockRobot_GetResult`.
    "nav2_msgs/action/UndockRobot_GetResult" "RIHS01_116641408dd0a5bbb7f0cb61d4519061884c7fcc70ca78b0f89779459cf04263"
    UndockRobotGetResult, UndockRobotGetResultRequest, UndockRobotGetResultResponse
}

crate::action! {
    /// Drives a robot out of a dock.
    "nav2_msgs/action/UndockRobot" "RIHS01_fe446bf5f84bbdc08b5a1123365e3c9b1e522e50a412d64c36995f808df915a2"
    UndockRobot, UndockRobotGoal, UndockRobotResult, UndockRobotFeedback,
    UndockRobotSendGoal, UndockRobotGetResult, UndockRobotFeedbackMessage
}

crate::message! {
    /// Waits.
    "nav2_msgs/action/Wait_Goal" "RIHS01_f97998c3733188e43ba93a54a60da2b22dfe4de349548428002305925246edd9"
    WaitGoal {
        /// Duration.
        time: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `nav2_msgs/action/Wait_Result`.
    "nav2_msgs/action/Wait_Result" "RIHS01_69a41e8b1d51db3993da45303f69fedf117fcd807d36543212f792743a534386"
    WaitResult {
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
    UNKNOWN: u16 = 740;
    /// TIMEOUT
    TIMEOUT: u16 = 741;
}

crate::message! {
    /// `nav2_msgs/action/Wait_Feedback`.
    "nav2_msgs/action/Wait_Feedback" "RIHS01_2a934be90be8dae603a970758be0d6247555e14bffac46b28aa220154f19f228"
    WaitFeedback {
        /// Time that remains.
        time_left: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `nav2_msgs/action/Wait_SendGoal_Request`.
    "nav2_msgs/action/Wait_SendGoal_Request" "RIHS01_2153054419debd2560f3b9514eeda1b14b31f029ff03383a519568b5f67ba18a"
    WaitSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: WaitGoal,
    }
}

crate::message! {
    /// `nav2_msgs/action/Wait_SendGoal_Response`.
    "nav2_msgs/action/Wait_SendGoal_Response" "RIHS01_c35d8e343b336397c42c603c919b870fdcd7aecf283b1012ee8f8a1b3fcde811"
    WaitSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `nav2_msgs/action/Wait_GetResult_Request`.
    "nav2_msgs/action/Wait_GetResult_Request" "RIHS01_6d9a1c73066f5e71b9da18b59e7bc30730492f41694432562e692fcec6da4c23"
    WaitGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `nav2_msgs/action/Wait_GetResult_Response`.
    "nav2_msgs/action/Wait_GetResult_Response" "RIHS01_c89ac345ba5364c16099f24b1166e1ca1dd13a0b0f7c7df283cf36f8948759cb"
    WaitGetResultResponse {
        /// status
        status: i8,
        /// result
        result: WaitResult,
    }
}

crate::message! {
    /// `nav2_msgs/action/Wait_FeedbackMessage`.
    "nav2_msgs/action/Wait_FeedbackMessage" "RIHS01_cb143310afa60cc18ef814ac127a730d4ee190828ce9b9a943fa8f0cb1a09f7c"
    WaitFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: WaitFeedback,
    }
}

crate::service! {
    /// `nav2_msgs/action/Wait_SendGoal`.
    "nav2_msgs/action/Wait_SendGoal" "RIHS01_aa768b9f4248c70a9c68fcf3a52f10300d4b0d21cad3cf39f01f4f3d248c2490"
    WaitSendGoal, WaitSendGoalRequest, WaitSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/Wait_GetResult`.
    "nav2_msgs/action/Wait_GetResult" "RIHS01_6fa1323df11147db06a24a126119f542104f535108774b930b8047cfa34df466"
    WaitGetResult, WaitGetResultRequest, WaitGetResultResponse
}

crate::action! {
    /// Waits.
    "nav2_msgs/action/Wait" "RIHS01_0c5d418b19d8d009bb5bce6dca27687d9d43659016a70dc08307e38a032af2c3"
    Wait, WaitGoal, WaitResult, WaitFeedback,
    WaitSendGoal, WaitGetResult, WaitFeedbackMessage
}

crate::message! {
    /// What changed in a behaviour tree during one tick.
    "nav2_msgs/msg/BehaviorTreeLog" "RIHS01_9335ecb688a4f61b7eb82a7c10f23eea5f4e8bbdb7edfa048e3539aa928f51b7"
    BehaviorTreeLog {
        /// timestamp
        timestamp: crate::builtin_interfaces::Time,
        /// event_log
        event_log: Vec<BehaviorTreeStatusChange>,
    }
}

crate::message! {
    /// A node of a behaviour tree changed its state.
    "nav2_msgs/msg/BehaviorTreeStatusChange" "RIHS01_54c5a8cc559e5eefc90b9c23a9f81c1b326c97c036d10baa556bac3ef07113c6"
    BehaviorTreeStatusChange {
        /// timestamp
        timestamp: crate::builtin_interfaces::Time,
        /// node_name
        node_name: std::string::String,
        /// uid
        uid: u16,
        /// IDLE, RUNNING, SUCCESS or FAILURE.
        previous_status: std::string::String,
        /// IDLE, RUNNING, SUCCESS or FAILURE.
        current_status: std::string::String,
    }
}

crate::message! {
    /// Circle of a vector map.
    "nav2_msgs/msg/CircleObject" "RIHS01_6e9f3f9c75c900b3a9bb5bf798d08a6efbbb3a72985e43161d05ec4a8f7eb705"
    CircleObject {
        /// header
        header: crate::std_msgs::Header,
        /// uuid
        uuid: crate::unique_identifier_msgs::UUID,
        /// center
        center: crate::geometry_msgs::Point32,
        /// m.
        radius: f32,
        /// fill
        fill: bool,
        /// value
        value: i8,
    }
}

crate::message! {
    /// Which polygons of the collision detector have something in them.
    "nav2_msgs/msg/CollisionDetectorState" "RIHS01_f3e8aba67135e9dd5fddd3d9d5c80a47a9798cc69c8f0620696338a120d2f5a5"
    CollisionDetectorState {
        /// polygons
        polygons: Vec<std::string::String>,
        /// detections
        detections: Vec<bool>,
    }
}

crate::message! {
    /// What the collision monitor does, and because of which polygon.
    "nav2_msgs/msg/CollisionMonitorState" "RIHS01_848f43f40716d6b3ac12a698cc3974a7eb2bf00158c5fca7bb93a128850d5a1e"
    CollisionMonitorState {
        /// action_type
        action_type: u8,
        /// polygon_name
        polygon_name: std::string::String,
    }
    /// DO_NOTHING
    DO_NOTHING: u8 = 0;
    /// STOP
    STOP: u8 = 1;
    /// SLOWDOWN
    SLOWDOWN: u8 = 2;
    /// APPROACH
    APPROACH: u8 = 3;
    /// LIMIT
    LIMIT: u8 = 4;
}

crate::message! {
    /// The costs of a costmap, unscaled.
    "nav2_msgs/msg/Costmap" "RIHS01_d51bf7aecafdbb3f8f98215de648abe6d53f8db69156d6e143125d2ad2bf0027"
    Costmap {
        /// header
        header: crate::std_msgs::Header,
        /// metadata
        metadata: CostmapMetaData,
        /// Row by row: 0 free, 253 inscribed, 254 lethal, 255 unknown.
        data: Vec<u8>,
    }
}

crate::message! {
    /// How to read the mask of a costmap filter.
    "nav2_msgs/msg/CostmapFilterInfo" "RIHS01_61ce391bf7690f76a331c01c9d5ce8ca71e6c99273b9fb75e48380f05c6dfdc8"
    CostmapFilterInfo {
        /// header
        header: crate::std_msgs::Header,
        /// 0 keep-out, 1 speed limit in percent, 2 speed limit in m/s, 3 binary.
        r#type: u8,
        /// filter_mask_topic
        filter_mask_topic: std::string::String,
        /// Added to every value of the mask, times the multiplier.
        base: f32,
        /// multiplier
        multiplier: f32,
    }
}

crate::message! {
    /// Size and place of a costmap.
    "nav2_msgs/msg/CostmapMetaData" "RIHS01_1a41ec8428d50c3b4cd3f9055e1adb0eaec72fb39ae11686b59218f6e0884cbd"
    CostmapMetaData {
        /// When its static map was loaded.
        map_load_time: crate::builtin_interfaces::Time,
        /// When it last changed.
        update_time: crate::builtin_interfaces::Time,
        /// Which layer it shows.
        layer: std::string::String,
        /// Side of a cell; m.
        resolution: f32,
        /// Columns.
        size_x: u32,
        /// Rows.
        size_y: u32,
        /// Of the outer corner of the first cell.
        origin: crate::geometry_msgs::Pose,
    }
}

crate::message! {
    /// A rectangle of a costmap that changed.
    "nav2_msgs/msg/CostmapUpdate" "RIHS01_b44706e1f0906a3f72a1640bc2153e85576ff8e8ad203ec48b78c187669168a2"
    CostmapUpdate {
        /// header
        header: crate::std_msgs::Header,
        /// First column.
        x: u32,
        /// First row.
        y: u32,
        /// Columns.
        size_x: u32,
        /// Rows.
        size_y: u32,
        /// Row by row.
        data: Vec<u8>,
    }
}

crate::message! {
    /// Share of each critic of MPPI in the costs of one cycle.
    "nav2_msgs/msg/CriticsStats" "RIHS01_e2ae3a92c99ed87e9088991f3121e81eb9d56d1399816d17d28aad4b2b8667c9"
    CriticsStats {
        /// stamp
        stamp: crate::builtin_interfaces::Time,
        /// critics
        critics: Vec<std::string::String>,
        /// True if the critic changed the costs.
        changed: Vec<bool>,
        /// Sums of the costs.
        costs_sum: Vec<f32>,
    }
}

crate::message! {
    /// New cost of an edge of a route graph.
    "nav2_msgs/msg/EdgeCost" "RIHS01_8dc1470fcd5fc0253ae48588f8f47d67214d2672d136c9f8c9d1f44220ddf56f"
    EdgeCost {
        /// edgeid
        edgeid: u16,
        /// cost
        cost: f32,
    }
}

crate::message! {
    /// Zone whose points the collision monitor ignores.
    "nav2_msgs/msg/ExclusionZoneDescription" "RIHS01_f9addbb3b5a21a61856c9914d745c8cd6fdc9839f58d8e91e928c38ec9e1db19"
    ExclusionZoneDescription {
        /// zone_name
        zone_name: std::string::String,
        /// type
        r#type: std::string::String,
        /// frame_id
        frame_id: std::string::String,
        /// points
        points: Vec<crate::geometry_msgs::Point32>,
        /// m.
        radius: f64 = 0.0,
        /// m.
        min_height: f64 = -1.7976931348623157e308,
        /// m.
        max_height: f64 = 1.7976931348623157e308,
        /// enabled
        enabled: bool = true,
        /// visualize
        visualize: bool = false,
        /// Time for which the last transform is used; s.
        frame_hold_timeout: f64 = 0.0,
    }
}

crate::message! {
    /// A waypoint that was not reached.
    "nav2_msgs/msg/MissedWaypoint" "RIHS01_cc79d1e3a1b86cd6a80788b16c844c396932462560936293011f062c21b82ed1"
    MissedWaypoint {
        /// index
        index: u32,
        /// goal
        goal: crate::geometry_msgs::PoseStamped,
        /// error_code
        error_code: u16,
    }
}

crate::message! {
    /// One guess of where the robot is.
    "nav2_msgs/msg/Particle" "RIHS01_c4c61cd1468c7253cc6cc483ebec0c07d8d7d76e5e6c2bcef15c1c77cf70534c"
    Particle {
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// weight
        weight: f64,
    }
}

crate::message! {
    /// All guesses of where the robot is.
    "nav2_msgs/msg/ParticleCloud" "RIHS01_193d8cb88ca2b98cd81ece15342744f054bb398ebfa8f6369914432303f42b11"
    ParticleCloud {
        /// header
        header: crate::std_msgs::Header,
        /// particles
        particles: Vec<Particle>,
    }
}

crate::message! {
    /// Polygon of a vector map.
    "nav2_msgs/msg/PolygonObject" "RIHS01_59ffd590860e0894c6ee0586108d2b44bb0d71c74f0c8af3e8928b1a930c1958"
    PolygonObject {
        /// header
        header: crate::std_msgs::Header,
        /// uuid
        uuid: crate::unique_identifier_msgs::UUID,
        /// points
        points: Vec<crate::geometry_msgs::Point32>,
        /// closed
        closed: bool,
        /// value
        value: i8,
    }
}

crate::message! {
    /// Route in a graph.
    "nav2_msgs/msg/Route" "RIHS01_e7a30327e3f17e37bb7c8d559ca6a84e189ed17725f0b6ecc02fbcceeef70184"
    Route {
        /// header
        header: crate::std_msgs::Header,
        /// Sum of the costs of the edges.
        route_cost: f32,
        /// nodes
        nodes: Vec<RouteNode>,
        /// edges
        edges: Vec<RouteEdge>,
    }
}

crate::message! {
    /// Edge of a route.
    "nav2_msgs/msg/RouteEdge" "RIHS01_d4839a851d45cc763aba226f9fa15a9e3725d7fd91f9f5b05fb0dc796ee45130"
    RouteEdge {
        /// edgeid
        edgeid: u16,
        /// start
        start: crate::geometry_msgs::Point,
        /// end
        end: crate::geometry_msgs::Point,
    }
}

crate::message! {
    /// Node of a route.
    "nav2_msgs/msg/RouteNode" "RIHS01_97eae28fcc469a6040bddd9da9d80c3551d4a782b0e6ac690722492735be7e46"
    RouteNode {
        /// nodeid
        nodeid: u16,
        /// position
        position: crate::geometry_msgs::Point,
    }
}

crate::message! {
    /// The speed that a robot must not exceed.
    "nav2_msgs/msg/SpeedLimit" "RIHS01_83d8e4e842559f4d9a988b19d31b162216ec738536389f98438d1a166f91845a"
    SpeedLimit {
        /// header
        header: crate::std_msgs::Header,
        /// Whether the limit is in percent of the greatest speed.
        percentage: bool,
        /// Percent or m/s; 0 lifts the limit.
        speed_limit: f64,
    }
}

crate::message! {
    /// Progress of a controller on its path.
    "nav2_msgs/msg/TrackingFeedback" "RIHS01_ef1661da15b2ffba3bc221078786d244a1872141874031aa7f490979f228fddf"
    TrackingFeedback {
        /// header
        header: crate::std_msgs::Header,
        /// Distance from the path, positive on its left; m.
        position_tracking_error: f32,
        /// Angle between robot and path; rad.
        heading_tracking_error: f32,
        /// Index of the nearest pose of the path.
        current_path_index: u32,
        /// robot_pose
        robot_pose: crate::geometry_msgs::PoseStamped,
        /// Length of the path that remains; m.
        distance_to_goal: f32,
        /// Speed; m/s.
        speed: f32,
        /// m.
        remaining_path_length: f32,
    }
}

crate::message! {
    /// The columns of a voxel layer.
    "nav2_msgs/msg/VoxelGrid" "RIHS01_346c2682d6ffd0293e6bc91ae87f60de4a6f7b97cf9339cc4ab4d0d207125a0d"
    VoxelGrid {
        /// header
        header: crate::std_msgs::Header,
        /// One number for each column: upper 16 bits known, lower 16 bits occupied.
        data: Vec<u32>,
        /// m.
        origin: crate::geometry_msgs::Point32,
        /// Sides of a voxel; m.
        resolutions: crate::geometry_msgs::Vector3,
        /// size_x
        size_x: u32,
        /// size_y
        size_y: u32,
        /// size_z
        size_z: u32,
    }
}

crate::message! {
    /// State of a waypoint.
    "nav2_msgs/msg/WaypointStatus" "RIHS01_4ac489f0a5a77648dcecf79b070c1ce5b126cd8fe4ed6ff0d316f87089b8f028"
    WaypointStatus {
        /// One of the values above.
        waypoint_status: u8,
        /// waypoint_index
        waypoint_index: u32,
        /// waypoint_pose
        waypoint_pose: crate::geometry_msgs::PoseStamped,
        /// 0 without an error, else one of the values above.
        error_code: u16,
        /// Reason of the error, in words.
        error_msg: std::string::String,
    }
    /// PENDING
    PENDING: u8 = 0;
    /// COMPLETED
    COMPLETED: u8 = 1;
    /// SKIPPED
    SKIPPED: u8 = 2;
    /// FAILED
    FAILED: u8 = 3;
}

crate::message! {
    /// Adds a zone to those the collision monitor ignores.
    "nav2_msgs/srv/AddExclusionZone_Request" "RIHS01_01079181dba1c7f0db224690e0c2d5b827180e273f45636e2378481517554404"
    AddExclusionZoneRequest {
        /// zone
        zone: ExclusionZoneDescription,
    }
}

crate::message! {
    /// `nav2_msgs/srv/AddExclusionZone_Response`.
    "nav2_msgs/srv/AddExclusionZone_Response" "RIHS01_a19f5d48ad7f6565886d0e09950e221dc6e7abbbeabaf0078b0acff92b5b1479"
    AddExclusionZoneResponse {
        /// success
        success: bool,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Adds a zone to those the collision monitor ignores.
    "nav2_msgs/srv/AddExclusionZone" "RIHS01_1c408a3fcf9adfc27e7f9886b0c842547cb8a7b07fe14b06c1fa3e82563b0861"
    AddExclusionZone, AddExclusionZoneRequest, AddExclusionZoneResponse
}

crate::message! {
    /// Adds shapes to a vector map, or replaces those with the same UUID.
    "nav2_msgs/srv/AddShapes_Request" "RIHS01_96f36d65855a76af833258f5deb69ad3e0d5a359fd59050dc5d12eac5acb7d63"
    AddShapesRequest {
        /// circles
        circles: Vec<CircleObject>,
        /// polygons
        polygons: Vec<PolygonObject>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/AddShapes_Response`.
    "nav2_msgs/srv/AddShapes_Response" "RIHS01_6ed036002ffee88cfb9dd4351612a2eb741c00b25c8c5c9a96b97a7274db4fbe"
    AddShapesResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Adds shapes to a vector map, or replaces those with the same UUID.
    "nav2_msgs/srv/AddShapes" "RIHS01_2c60685aada0c1a8e9a0d353ec326299e5c4b3d1a9070fbd7e4308f754708e51"
    AddShapes, AddShapesRequest, AddShapesResponse
}

crate::message! {
    /// Clears a square about a pose.
    "nav2_msgs/srv/ClearCostmapAroundPose_Request" "RIHS01_9bea29e25c85350413bc5109e26117ff2b76596d73dfedf37290e2d5c7f4ec00"
    ClearCostmapAroundPoseRequest {
        /// Its middle.
        pose: crate::geometry_msgs::PoseStamped,
        /// Side of the square; m.
        reset_distance: f64,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapAroundPose_Response`.
    "nav2_msgs/srv/ClearCostmapAroundPose_Response" "RIHS01_48fb9182164724f0585e5d7a362e0cb9e41834d37b785dea1cee9b0a9b7003de"
    ClearCostmapAroundPoseResponse {
        /// response
        response: crate::std_msgs::Empty,
    }
}

crate::service! {
    /// Clears a square about a pose.
    "nav2_msgs/srv/ClearCostmapAroundPose" "RIHS01_cd006590d0a7b5a357138518c1ac6f733782a0317f5d8fc92f46158e5438138c"
    ClearCostmapAroundPose, ClearCostmapAroundPoseRequest, ClearCostmapAroundPoseResponse
}

crate::message! {
    /// Clears a square about the robot.
    "nav2_msgs/srv/ClearCostmapAroundRobot_Request" "RIHS01_2734faf8fd07b3dc5ece2dc426177d51039a11b2ebbfb03a8696579aa02c9ee8"
    ClearCostmapAroundRobotRequest {
        /// Side of the square; m.
        reset_distance: f32,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapAroundRobot_Response`.
    "nav2_msgs/srv/ClearCostmapAroundRobot_Response" "RIHS01_d5396ec0bd1653042a9437c7f2cb3e093aada3ab8a67327f30ee235833f57897"
    ClearCostmapAroundRobotResponse {
        /// response
        response: crate::std_msgs::Empty,
    }
}

crate::service! {
    /// Clears a square about the robot.
    "nav2_msgs/srv/ClearCostmapAroundRobot" "RIHS01_24973b6e8b3e7ec70c37d6b411f1e32cef44051dfe7f34ad0ee7d6d9055cd6ea"
    ClearCostmapAroundRobot, ClearCostmapAroundRobotRequest, ClearCostmapAroundRobotResponse
}

crate::message! {
    /// Clears all but a square about the robot.
    "nav2_msgs/srv/ClearCostmapExceptRegion_Request" "RIHS01_3d5617401dcf2164725713597bc9eb24f1df8d8a7b0e2c6bb1e5185e64bf66db"
    ClearCostmapExceptRegionRequest {
        /// Side of the square; m.
        reset_distance: f32,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapExceptRegion_Response`.
    "nav2_msgs/srv/ClearCostmapExceptRegion_Response" "RIHS01_afa858c4f3968740aa98507a9141510e5561e970b37cd5380746ae796c1c238d"
    ClearCostmapExceptRegionResponse {
        /// response
        response: crate::std_msgs::Empty,
    }
}

crate::service! {
    /// Clears all but a square about the robot.
    "nav2_msgs/srv/ClearCostmapExceptRegion" "RIHS01_66032323269ef923ab356273a7b7fc1c5acd9ccd46cd14bdcd265642a4012b05"
    ClearCostmapExceptRegion, ClearCostmapExceptRegionRequest, ClearCostmapExceptRegionResponse
}

crate::message! {
    /// Clears a costmap.
    "nav2_msgs/srv/ClearEntireCostmap_Request" "RIHS01_365687a69e15ff9f199447a047ab6fdd264272e6b4d12de0b71bd4a6e4137e99"
    ClearEntireCostmapRequest {
        /// request
        request: crate::std_msgs::Empty,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearEntireCostmap_Response`.
    "nav2_msgs/srv/ClearEntireCostmap_Response" "RIHS01_a0aeab7debb4b503bf8d5edcadb896864aa3dda700452d8c9cfa6c4755956665"
    ClearEntireCostmapResponse {
        /// response
        response: crate::std_msgs::Empty,
    }
}

crate::service! {
    /// Clears a costmap.
    "nav2_msgs/srv/ClearEntireCostmap" "RIHS01_553f54f9cadab44553fdf5627433fcb6701f71c1fc2eb55a7b4a004fdeeab952"
    ClearEntireCostmap, ClearEntireCostmapRequest, ClearEntireCostmapResponse
}

crate::message! {
    /// Closes and opens edges of a route graph and changes their costs.
    "nav2_msgs/srv/DynamicEdges_Request" "RIHS01_90381964c8d9ee8fa67ae254a0fef0e29d310fdcfe477e6131a0aff1cdc22765"
    DynamicEdgesRequest {
        /// closed_edges
        closed_edges: Vec<u16>,
        /// opened_edges
        opened_edges: Vec<u16>,
        /// adjust_edges
        adjust_edges: Vec<EdgeCost>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/DynamicEdges_Response`.
    "nav2_msgs/srv/DynamicEdges_Response" "RIHS01_4b08bcbf652b7b8ce68a6cefe6e8fed8ac98bb578dd77631476dfd665b73a95c"
    DynamicEdgesResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Closes and opens edges of a route graph and changes their costs.
    "nav2_msgs/srv/DynamicEdges" "RIHS01_857b6e430a2aa89345e2b8bddc0a4956c425d526218ae43e636577de465da316"
    DynamicEdges, DynamicEdgesRequest, DynamicEdgesResponse
}

crate::message! {
    /// The cost at a place.
    "nav2_msgs/srv/GetCost_Request" "RIHS01_86158e1b6692ed888f2039f5ecc7c914b3484715e1fdc45f4ee7c3b467522293"
    GetCostRequest {
        /// Whether to take the greatest cost below the robot's outline.
        use_footprint: bool,
        /// m.
        x: f32,
        /// m.
        y: f32,
        /// rad.
        theta: f32,
    }
}

crate::message! {
    /// `nav2_msgs/srv/GetCost_Response`.
    "nav2_msgs/srv/GetCost_Response" "RIHS01_3fa6cbc521203b88bf455a704d4d943ec025e2bb0be5cf72df7e4edf40a1f790"
    GetCostResponse {
        /// 0 to 255.
        cost: f32,
    }
}

crate::service! {
    /// The cost at a place.
    "nav2_msgs/srv/GetCost" "RIHS01_be1bfe25180a915c2eb184172eccf9ea00420732e5f2c3f9e6d60754c41f499a"
    GetCost, GetCostRequest, GetCostResponse
}

crate::message! {
    /// The whole costmap.
    "nav2_msgs/srv/GetCostmap_Request" "RIHS01_8dec28d41023635b3a019512467e7685f364e26527cf696c9c9b9e559e1c455b"
    GetCostmapRequest {
        /// specs
        specs: CostmapMetaData,
    }
}

crate::message! {
    /// `nav2_msgs/srv/GetCostmap_Response`.
    "nav2_msgs/srv/GetCostmap_Response" "RIHS01_94dab1729b7a92f0a85542effc41b8acdacbad9d672a86c729d45746dbb6d9e9"
    GetCostmapResponse {
        /// map
        map: Costmap,
    }
}

crate::service! {
    /// The whole costmap.
    "nav2_msgs/srv/GetCostmap" "RIHS01_1c3d7c36488ea60fb6ddf76482faf36cee004e29433fea60b8cee011fcd8ad73"
    GetCostmap, GetCostmapRequest, GetCostmapResponse
}

crate::message! {
    /// The costs at many places, as from Kilted on.
    "nav2_msgs/srv/GetCosts_Request" "RIHS01_ebc7fb72d8164a080b23734eeac6af70ec7a68b22edc4a395a7f9f1e801b1235"
    GetCostsRequest {
        /// Whether to take the greatest cost below the robot's outline.
        use_footprint: bool,
        /// poses
        poses: Vec<crate::geometry_msgs::PoseStamped>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/GetCosts_Response`.
    "nav2_msgs/srv/GetCosts_Response" "RIHS01_b4d443c480924b7a3f71ab0f20721d5306d936416c1554e191e204e14488295a"
    GetCostsResponse {
        /// 0 to 255, or -1 outside of the map.
        costs: Vec<f32>,
        /// success
        success: bool,
    }
}

crate::service! {
    /// The costs at many places, as from Kilted on.
    "nav2_msgs/srv/GetCosts" "RIHS01_b71b396977d0c31ff23dc4fc277980502126e80138eca8ed803a2111afd9c108"
    GetCosts, GetCostsRequest, GetCostsResponse
}

crate::message! {
    /// Shapes of a vector map.
    "nav2_msgs/srv/GetShapes_Request" "RIHS01_845e03c41eca4805a9d5a620774d2bdb51d778e7f7cb583813e936be4c8200f9"
    GetShapesRequest {
    }
}

crate::message! {
    /// `nav2_msgs/srv/GetShapes_Response`.
    "nav2_msgs/srv/GetShapes_Response" "RIHS01_7178570283c535c2e47532f0c4095927e85f16d5d90fa4b985cb8b0cf2de9be6"
    GetShapesResponse {
        /// circles
        circles: Vec<CircleObject>,
        /// polygons
        polygons: Vec<PolygonObject>,
    }
}

crate::service! {
    /// Shapes of a vector map.
    "nav2_msgs/srv/GetShapes" "RIHS01_a9bfc0fa8341ddab748b7c91d6852eda2b7fad9d289ea25fddc272ff9d77d80a"
    GetShapes, GetShapesRequest, GetShapesResponse
}

crate::message! {
    /// Whether a path is free of obstacles.
    "nav2_msgs/srv/IsPathValid_Request" "RIHS01_2581491c3b0e2c7caf695a54ae0f7006e420c495abd5b0355d2e79b5b2168888"
    IsPathValidRequest {
        /// path
        path: crate::nav_msgs::Path,
    }
}

crate::message! {
    /// `nav2_msgs/srv/IsPathValid_Response`.
    "nav2_msgs/srv/IsPathValid_Response" "RIHS01_78b00a94704f89bf991a34b153b18c2a80b3ef2138ce89113e13e1de9c2b22c7"
    IsPathValidResponse {
        /// is_valid
        is_valid: bool,
        /// invalid_pose_indices
        invalid_pose_indices: Vec<i32>,
    }
}

crate::service! {
    /// Whether a path is free of obstacles.
    "nav2_msgs/srv/IsPathValid" "RIHS01_0949cf401a29b88bd6e2a8cd8c1df0ccd9374ca4e51557266eaab2b0a9db5778"
    IsPathValid, IsPathValidRequest, IsPathValidResponse
}

crate::message! {
    /// Loads a map from a file.
    "nav2_msgs/srv/LoadMap_Request" "RIHS01_31a494b051e07df8361b6af3c313a550abe7134e158835ce3563e5a126ef3f2b"
    LoadMapRequest {
        /// Path of the map's YAML file, or a URL.
        map_url: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/srv/LoadMap_Response`.
    "nav2_msgs/srv/LoadMap_Response" "RIHS01_65d8d760c5a0a14cee1a761372ad99d0b163e6d5400a0c55c20fe8d7e38a05c0"
    LoadMapResponse {
        /// map
        map: crate::nav_msgs::OccupancyGrid,
        /// One of the values above.
        result: u8,
    }
    /// RESULT_SUCCESS
    RESULT_SUCCESS: u8 = 0;
    /// RESULT_MAP_DOES_NOT_EXIST
    RESULT_MAP_DOES_NOT_EXIST: u8 = 1;
    /// RESULT_INVALID_MAP_DATA
    RESULT_INVALID_MAP_DATA: u8 = 2;
    /// RESULT_INVALID_MAP_METADATA
    RESULT_INVALID_MAP_METADATA: u8 = 3;
    /// RESULT_UNDEFINED_FAILURE
    RESULT_UNDEFINED_FAILURE: u8 = 255;
}

crate::service! {
    /// Loads a map from a file.
    "nav2_msgs/srv/LoadMap" "RIHS01_eb875de5ea9bb394573effc3f239015b19869dd7a8988136768372c6ef907ec1"
    LoadMap, LoadMapRequest, LoadMapResponse
}

crate::message! {
    /// Moves all nodes of a lifecycle manager.
    "nav2_msgs/srv/ManageLifecycleNodes_Request" "RIHS01_927841759575a5565b3d879a58fd035a5a69e9fdf3365c02b33cc9ad03a7a227"
    ManageLifecycleNodesRequest {
        /// One of the values above.
        command: u8,
    }
    /// STARTUP
    STARTUP: u8 = 0;
    /// PAUSE
    PAUSE: u8 = 1;
    /// RESUME
    RESUME: u8 = 2;
    /// RESET
    RESET: u8 = 3;
    /// SHUTDOWN
    SHUTDOWN: u8 = 4;
    /// CONFIGURE
    CONFIGURE: u8 = 5;
    /// CLEANUP
    CLEANUP: u8 = 6;
}

crate::message! {
    /// `nav2_msgs/srv/ManageLifecycleNodes_Response`.
    "nav2_msgs/srv/ManageLifecycleNodes_Response" "RIHS01_3ab0ddcbe7307ad89c089d1a8749030929efc63c22ec506faf11440ec2f5c159"
    ManageLifecycleNodesResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Moves all nodes of a lifecycle manager.
    "nav2_msgs/srv/ManageLifecycleNodes" "RIHS01_1850f4f677251bb8f7744e3c0a87ef4f66c205e2f8740a8330251af7d1804460"
    ManageLifecycleNodes, ManageLifecycleNodesRequest, ManageLifecycleNodesResponse
}

crate::message! {
    /// Loads the docks again.
    "nav2_msgs/srv/ReloadDockDatabase_Request" "RIHS01_bb663832b1ffb4deeb0451077ef71a7049d86f0819d21f031c2cb75696a8b75e"
    ReloadDockDatabaseRequest {
        /// filepath
        filepath: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ReloadDockDatabase_Response`.
    "nav2_msgs/srv/ReloadDockDatabase_Response" "RIHS01_cdbc3dcb8f31faefe8b862c6f24dadf763d93d58ccfdacc1b0ee06ac0a6a7310"
    ReloadDockDatabaseResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Loads the docks again.
    "nav2_msgs/srv/ReloadDockDatabase" "RIHS01_3fa9aa056bcc0dfcd10dbd1f61a215f600c82db832dccfdd98e55cf27ad502e6"
    ReloadDockDatabase, ReloadDockDatabaseRequest, ReloadDockDatabaseResponse
}

crate::message! {
    /// Removes a zone that the collision monitor ignores.
    "nav2_msgs/srv/RemoveExclusionZone_Request" "RIHS01_73e0a51b67dc77dd5c59624de4616ccd61a917f4c26260b4226e7b93529d2f53"
    RemoveExclusionZoneRequest {
        /// zone_name
        zone_name: std::string::String,
        /// remove_all
        remove_all: bool = false,
    }
}

crate::message! {
    /// `nav2_msgs/srv/RemoveExclusionZone_Response`.
    "nav2_msgs/srv/RemoveExclusionZone_Response" "RIHS01_cde0b4876f7e4cd4e54d91804dbb37fc992808901feee1394e3b5f87010ab6bf"
    RemoveExclusionZoneResponse {
        /// success
        success: bool,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Removes a zone that the collision monitor ignores.
    "nav2_msgs/srv/RemoveExclusionZone" "RIHS01_0a80d5985c6958971e32327c1d528fcc79ad0577f76c534bed5665fa831aae2d"
    RemoveExclusionZone, RemoveExclusionZoneRequest, RemoveExclusionZoneResponse
}

crate::message! {
    /// Removes shapes of a vector map.
    "nav2_msgs/srv/RemoveShapes_Request" "RIHS01_4ae0c7899a2b0cbe5e89aac715d4136b42e03e5ed6776994a4ec39eb8383b00f"
    RemoveShapesRequest {
        /// all_objects
        all_objects: bool,
        /// uuids
        uuids: Vec<crate::unique_identifier_msgs::UUID>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/RemoveShapes_Response`.
    "nav2_msgs/srv/RemoveShapes_Response" "RIHS01_d6b4d625ea9d37c2b8f2eacdba46ab5e45e97007da2bd2f4b35f5a3980a99e23"
    RemoveShapesResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Removes shapes of a vector map.
    "nav2_msgs/srv/RemoveShapes" "RIHS01_adde9ff834f2dfd411fe2be73000a4f7d958e9447760f8ed279af6b4a2b606ba"
    RemoveShapes, RemoveShapesRequest, RemoveShapesResponse
}

crate::message! {
    /// Saves a map to a file.
    "nav2_msgs/srv/SaveMap_Request" "RIHS01_fe1a2f779cded53a2557c79c7071c7c5660ecc1b28c376269828a51341f71fe5"
    SaveMapRequest {
        /// Where the map is heard.
        map_topic: std::string::String,
        /// Path of the files without ending.
        map_url: std::string::String,
        /// pgm, png or bmp.
        image_format: std::string::String,
        /// trinary, scale or raw.
        map_mode: std::string::String,
        /// Below: free; 0 to 1.
        free_thresh: f32,
        /// Above: occupied; 0 to 1.
        occupied_thresh: f32,
    }
}

crate::message! {
    /// `nav2_msgs/srv/SaveMap_Response`.
    "nav2_msgs/srv/SaveMap_Response" "RIHS01_bdd0b25c769f096bcde88c98b23ae612c8f70ab770f57014884412ff41fe0f88"
    SaveMapResponse {
        /// result
        result: bool,
    }
}

crate::service! {
    /// Saves a map to a file.
    "nav2_msgs/srv/SaveMap" "RIHS01_fd31bfe2c69b4e15bf86155148940d27d762296b058bda8d450a7f38b6c557e7"
    SaveMap, SaveMapRequest, SaveMapResponse
}

crate::message! {
    /// Tells AMCL where the robot is.
    "nav2_msgs/srv/SetInitialPose_Request" "RIHS01_a1e5b4edfd483c6156bfc7f529da1e60e21b6ca6def1d607b3d0097ccd4c307e"
    SetInitialPoseRequest {
        /// pose
        pose: crate::geometry_msgs::PoseWithCovarianceStamped,
    }
}

crate::message! {
    /// `nav2_msgs/srv/SetInitialPose_Response`.
    "nav2_msgs/srv/SetInitialPose_Response" "RIHS01_f6ef1209a86ec59107b4000c03860ef4c4ba3e60d6be0c66140a3c4373b6203a"
    SetInitialPoseResponse {
    }
}

crate::service! {
    /// Tells AMCL where the robot is.
    "nav2_msgs/srv/SetInitialPose" "RIHS01_1f818551d505d16d89c8bf9b07121a6408de4408b7889dfda9a0db326c296153"
    SetInitialPose, SetInitialPoseRequest, SetInitialPoseResponse
}

crate::message! {
    /// Loads another route graph.
    "nav2_msgs/srv/SetRouteGraph_Request" "RIHS01_7ad5419e6d1382ba770f7c0b0aa72f155feb26c6ab243e1d407879f2262acc81"
    SetRouteGraphRequest {
        /// graph_filepath
        graph_filepath: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/srv/SetRouteGraph_Response`.
    "nav2_msgs/srv/SetRouteGraph_Response" "RIHS01_b47bda8229261aae8772dab16cf17215fa2de04cbd3fa5da2727017f4ac077d9"
    SetRouteGraphResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Loads another route graph.
    "nav2_msgs/srv/SetRouteGraph" "RIHS01_7bc1e20b3457e7e9d44cbc512e0d68d0658657379a56e8112f489e8f96eacd0e"
    SetRouteGraph, SetRouteGraphRequest, SetRouteGraphResponse
}

crate::message! {
    /// Turns a function on or off.
    "nav2_msgs/srv/Toggle_Request" "RIHS01_cfab1b7d178e141328aac9d82dd02397edff337776265d19a23f2c2d0ee1134d"
    ToggleRequest {
        /// enable
        enable: bool,
    }
}

crate::message! {
    /// `nav2_msgs/srv/Toggle_Response`.
    "nav2_msgs/srv/Toggle_Response" "RIHS01_0592b15505fa7165ad556e510700210a341d1a9bab872012fa7f3c861c778e26"
    ToggleResponse {
        /// success
        success: bool,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Turns a function on or off.
    "nav2_msgs/srv/Toggle" "RIHS01_b2bdc685d2421a1d0151247de7cdfde358ae2b5f4826a6f4b57128c1d0c3f13c"
    Toggle, ToggleRequest, ToggleResponse
}
