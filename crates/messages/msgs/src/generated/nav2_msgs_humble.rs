//! `nav2_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces_humble/nav2_msgs`
//! instead.

pub use super::nav2_msgs::*;

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
    "nav2_msgs/action/AssistedTeleop_Result" "RIHS01_935acc3959fe22359fa60aa675613fc9b74050679e8aa83987bad215e60561be"
    AssistedTeleopResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
    }
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
    "nav2_msgs/action/AssistedTeleop_GetResult_Response" "RIHS01_e6e8bfb4e9b5fa282444c38e30e5b7b0abf9c8530715e19a2c15e5ecf48f7251"
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
    "nav2_msgs/action/AssistedTeleop_GetResult" "RIHS01_732a6a063466c506f6348298f02dc13447c9cafb70187ab2cb00ecca74837d58"
    AssistedTeleopGetResult, AssistedTeleopGetResultRequest, AssistedTeleopGetResultResponse
}

crate::action! {
    /// Lets a user drive and stops before obstacles.
    "nav2_msgs/action/AssistedTeleop" "RIHS01_50dfb313f0a9e4f1ba37afc9c66970995d12a80fade67c7bbceaa4b0b546297e"
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
    "nav2_msgs/action/BackUp_Result" "RIHS01_88a0932185e756f9fe7da333c1ff64779036f1e96f9e9b31dd56a88c8b5c8362"
    BackUpResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
    }
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
    "nav2_msgs/action/BackUp_GetResult_Response" "RIHS01_2e7b2a748bbd1bb3a3555d6e688cdd1f506cf97819d280b0ce11cc20adacb383"
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
    "nav2_msgs/action/BackUp_GetResult" "RIHS01_925ef3dc3ae029e7053b5fbfdfbe537564420786ad8833310d334ab8a26379e2"
    BackUpGetResult, BackUpGetResultRequest, BackUpGetResultResponse
}

crate::action! {
    /// Drives straight backwards.
    "nav2_msgs/action/BackUp" "RIHS01_e740207e9662c579fcb9b67a89efd26ee020644b2177db12fa9f6d87986b927c"
    BackUp, BackUpGoal, BackUpResult, BackUpFeedback,
    BackUpSendGoal, BackUpGetResult, BackUpFeedbackMessage
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
    "nav2_msgs/action/ComputePathThroughPoses_Result" "RIHS01_01d0d1b9ed3f4e8548c53449705abc2f00f73dd1f12af270c145657797a6bbff"
    ComputePathThroughPosesResult {
        /// path
        path: crate::nav_msgs::Path,
        /// Time that the planner needed.
        planning_time: crate::builtin_interfaces::Duration,
    }
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
    "nav2_msgs/action/ComputePathThroughPoses_GetResult_Response" "RIHS01_142759b759ac8319491fc990a785aff047933e8aa232cb856ba19e5ed919fb1d"
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
    "nav2_msgs/action/ComputePathThroughPoses_GetResult" "RIHS01_7cc04b4ca68b0410fe5f17b5a9ff31442f1dd8c4dfb1c1b831de45c2c201d730"
    ComputePathThroughPosesGetResult, ComputePathThroughPosesGetResultRequest, ComputePathThroughPosesGetResultResponse
}

crate::action! {
    /// Plans a path through several poses.
    "nav2_msgs/action/ComputePathThroughPoses" "RIHS01_52f2051e5c60bfc0380821f15c4ce2630f439de72f47e7015d0c23ac4e268f71"
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
    "nav2_msgs/action/ComputePathToPose_Result" "RIHS01_c26fa1107265185df8089a8e456bfa7c209321035aee9a0f3bd88590e0d3fc3f"
    ComputePathToPoseResult {
        /// path
        path: crate::nav_msgs::Path,
        /// Time that the planner needed.
        planning_time: crate::builtin_interfaces::Duration,
    }
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
    "nav2_msgs/action/ComputePathToPose_GetResult_Response" "RIHS01_cf74929d5c20a1745a63dee6d7c44aa1ab7663aae75ca7555b28d67ad61f57c3"
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
    "nav2_msgs/action/ComputePathToPose_GetResult" "RIHS01_dbd11a95d5c74496418e2b4ac3811c5f8112879662cf1a6364476751c69ccc83"
    ComputePathToPoseGetResult, ComputePathToPoseGetResultRequest, ComputePathToPoseGetResultResponse
}

crate::action! {
    /// Plans a path to a pose.
    "nav2_msgs/action/ComputePathToPose" "RIHS01_97a8062aa0d410770dd1777304b55a881c0c29fcdd3124c3c5315283535b62b3"
    ComputePathToPose, ComputePathToPoseGoal, ComputePathToPoseResult, ComputePathToPoseFeedback,
    ComputePathToPoseSendGoal, ComputePathToPoseGetResult, ComputePathToPoseFeedbackMessage
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
    "nav2_msgs/action/DriveOnHeading_Result" "RIHS01_c1a4d49b0d189911826479f8fd741c7ddd5e3a6c47c4ec0abac6a4e87ba4a668"
    DriveOnHeadingResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
    }
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
    "nav2_msgs/action/DriveOnHeading_GetResult_Response" "RIHS01_73591d59f7d587aed27b83359cc5640a9a29b359e75662a3901753d895f95cdc"
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
    "nav2_msgs/action/DriveOnHeading_GetResult" "RIHS01_9938951fbb7b8c93e22f1c48a304364c8a0cbfa1b8eca0ee9770452c115b8323"
    DriveOnHeadingGetResult, DriveOnHeadingGetResultRequest, DriveOnHeadingGetResultResponse
}

crate::action! {
    /// Drives straight ahead.
    "nav2_msgs/action/DriveOnHeading" "RIHS01_5d67fc18f5a3fec786ccb352efd892f8ac06a4619382ec72900e98124ba4a320"
    DriveOnHeading, DriveOnHeadingGoal, DriveOnHeadingResult, DriveOnHeadingFeedback,
    DriveOnHeadingSendGoal, DriveOnHeadingGetResult, DriveOnHeadingFeedbackMessage
}

crate::message! {
    /// Drives along a path.
    "nav2_msgs/action/FollowPath_Goal" "RIHS01_7df9d9fbc74df41870fe8d5deeb9a59cdcdb1851012e38adb9368cca286ec7a0"
    FollowPathGoal {
        /// path
        path: crate::nav_msgs::Path,
        /// Name of the controller; may be empty if there is only one.
        controller_id: std::string::String,
        /// Name of the goal checker; may be empty if there is only one.
        goal_checker_id: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowPath_Result`.
    "nav2_msgs/action/FollowPath_Result" "RIHS01_ee110462e01eb5d3f97883470a2a8c1cca83ee996e34565853a4b57dd3711c81"
    FollowPathResult {
        /// result
        result: crate::std_msgs::Empty,
    }
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
    "nav2_msgs/action/FollowPath_SendGoal_Request" "RIHS01_d324f783bb8514a6ee0ef5dd7edb10d56d92043a0c481c62b7f0fb6f3533f097"
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
    "nav2_msgs/action/FollowPath_GetResult_Response" "RIHS01_a15bc960e7bad3b8a4d2701a30aa71d3fef30d408ad9a6e262558b70153f4602"
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
    "nav2_msgs/action/FollowPath_SendGoal" "RIHS01_641b6b18e202305d95c6c7b42eaf834abc3957eba70d02ed18a21c3dbe636d2d"
    FollowPathSendGoal, FollowPathSendGoalRequest, FollowPathSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/FollowPath_GetResult`.
    "nav2_msgs/action/FollowPath_GetResult" "RIHS01_cac12fd92cd2879ebe7821091c1bca1bd8c30b081b313bd4ba144610f3aa4530"
    FollowPathGetResult, FollowPathGetResultRequest, FollowPathGetResultResponse
}

crate::action! {
    /// Drives along a path.
    "nav2_msgs/action/FollowPath" "RIHS01_05aa0e1d0743e940518eb8f014af436e2c1fefb9c7c05b12d3d1d21fa4325bc4"
    FollowPath, FollowPathGoal, FollowPathResult, FollowPathFeedback,
    FollowPathSendGoal, FollowPathGetResult, FollowPathFeedbackMessage
}

crate::message! {
    /// Drives to poses one after the other, with a task at each.
    "nav2_msgs/action/FollowWaypoints_Goal" "RIHS01_705912b38c7b878b142b4b444e65e7999fa18d6374c6ac81f49a0f43d6bbd2de"
    FollowWaypointsGoal {
        /// poses
        poses: Vec<crate::geometry_msgs::PoseStamped>,
    }
}

crate::message! {
    /// `nav2_msgs/action/FollowWaypoints_Result`.
    "nav2_msgs/action/FollowWaypoints_Result" "RIHS01_4f8b84a3d1d6f1cdff31d8e81c1bfdda1c32293b2442f0d39685f0793a9b023f"
    FollowWaypointsResult {
        /// Poses that were not reached.
        missed_waypoints: Vec<i32>,
    }
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
    "nav2_msgs/action/FollowWaypoints_SendGoal_Request" "RIHS01_5815f835c249d0c3be0e10462dd5b88e408b9907c3a66f6cedb2c74c8294ce9f"
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
    "nav2_msgs/action/FollowWaypoints_GetResult_Response" "RIHS01_ba22122e5c5e1ef9b2346e49e232f0daba00851a9387f3a76423d0e9f62c3fd0"
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
    "nav2_msgs/action/FollowWaypoints_SendGoal" "RIHS01_ec2d9635329cd2b96ed2c1de7f81ddee0aa600dd1356788b33754e5690752026"
    FollowWaypointsSendGoal, FollowWaypointsSendGoalRequest, FollowWaypointsSendGoalResponse
}

crate::service! {
    /// `nav2_msgs/action/FollowWaypoints_GetResult`.
    "nav2_msgs/action/FollowWaypoints_GetResult" "RIHS01_132755784bf89c8e3c00541e61f82bcede7ecf3e26334b37e5424a01868fd952"
    FollowWaypointsGetResult, FollowWaypointsGetResultRequest, FollowWaypointsGetResultResponse
}

crate::action! {
    /// Drives to poses one after the other, with a task at each.
    "nav2_msgs/action/FollowWaypoints" "RIHS01_82144b5e93b473ac1e37706e7a7457b4ce87dcdc69ddca4be23090ec50c76e6e"
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
    "nav2_msgs/action/NavigateThroughPoses_Result" "RIHS01_dfda8ecc7b4aa28cbda43e9a34a8fae2e4b63a1b8eea2039e20ddd4dcbe9985c"
    NavigateThroughPosesResult {
        /// result
        result: crate::std_msgs::Empty,
    }
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
    "nav2_msgs/action/NavigateThroughPoses_GetResult_Response" "RIHS01_e0f529ca21e6a1b4bdde950f10396b26d51bb40f794b74528340cef563af799e"
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
    "nav2_msgs/action/NavigateThroughPoses_GetResult" "RIHS01_bf41302981efee1614e42423aa1619aed1c067b96e7c25774bafc9309d30d5f3"
    NavigateThroughPosesGetResult, NavigateThroughPosesGetResultRequest, NavigateThroughPosesGetResultResponse
}

crate::action! {
    /// Drives through several poses.
    "nav2_msgs/action/NavigateThroughPoses" "RIHS01_0e89b237a32035fc4125fd40a0b3949e8f7df1a00e563bb3c5fb60c53b2e6669"
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
    "nav2_msgs/action/NavigateToPose_Result" "RIHS01_2c8125ecf3f80722dbb2f90b0c7977e16e494bd8d183995420f2efa0cffe5c1d"
    NavigateToPoseResult {
        /// result
        result: crate::std_msgs::Empty,
    }
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
    "nav2_msgs/action/NavigateToPose_GetResult_Response" "RIHS01_6acfb8cff093868001fe9b46e1262c481cd65cc06e93b655548ded7640b050b0"
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
    "nav2_msgs/action/NavigateToPose_GetResult" "RIHS01_ecdf36dd1b71f9a255fbe5636c4d40c9923cf3b32aaf0b241431b4bb1c1e2e71"
    NavigateToPoseGetResult, NavigateToPoseGetResultRequest, NavigateToPoseGetResultResponse
}

crate::action! {
    /// Drives to a pose.
    "nav2_msgs/action/NavigateToPose" "RIHS01_4263df8f55588475680eae1c47fdd2cc6efb9e5bee0465d7c1e502cc2e05a651"
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
    "nav2_msgs/action/SmoothPath_Result" "RIHS01_f6dec6d46bb4f38ca664951e3e6d30d9ea476a926818a02549795425e5826e4a"
    SmoothPathResult {
        /// path
        path: crate::nav_msgs::Path,
        /// Time that the smoother needed.
        smoothing_duration: crate::builtin_interfaces::Duration,
        /// False if the time was over before the smoother was done.
        was_completed: bool,
    }
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
    "nav2_msgs/action/SmoothPath_GetResult_Response" "RIHS01_b44e22850fe2f8c11b4b38aa04a52a022a8a991d75cb2ba6b1f5a34835427a61"
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
    "nav2_msgs/action/SmoothPath_GetResult" "RIHS01_cae22441c4643fd353f210c821c3c56ac6b721bc46fbbe2b596d275b9f63efdd"
    SmoothPathGetResult, SmoothPathGetResultRequest, SmoothPathGetResultResponse
}

crate::action! {
    /// Smooths a path.
    "nav2_msgs/action/SmoothPath" "RIHS01_66c390913be8114ca587068418b30e7eeb143f9b7dfb9bd6a477c4054eadabb3"
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
    "nav2_msgs/action/Spin_Result" "RIHS01_af05434556133ad5bce69178b6d7ee72751f361baf5c97fdf57e1f693bcf5294"
    SpinResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
    }
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
    "nav2_msgs/action/Spin_GetResult_Response" "RIHS01_a5fdaf9db93cbf1f8c218487e0631d68b6435a193fa97999c9fbc9c44c22a148"
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
    "nav2_msgs/action/Spin_GetResult" "RIHS01_c4a91ccef7bd4f57d1ef62aa36a6a4a617fe3bad6861fe5ffaa795c59ece5f16"
    SpinGetResult, SpinGetResultRequest, SpinGetResultResponse
}

crate::action! {
    /// Turns in place.
    "nav2_msgs/action/Spin" "RIHS01_c4216a32ea7da07f9cddcd673eb364a8becb01647b61080584fa8b6dd96de581"
    Spin, SpinGoal, SpinResult, SpinFeedback,
    SpinSendGoal, SpinGetResult, SpinFeedbackMessage
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
    "nav2_msgs/action/Wait_Result" "RIHS01_5f5e619175d0f8b7f42ce6135cc32768eb2f6ca9b1c4dae5c4697ced276126fa"
    WaitResult {
        /// Duration of the action.
        total_elapsed_time: crate::builtin_interfaces::Duration,
    }
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
    "nav2_msgs/action/Wait_GetResult_Response" "RIHS01_95e5c80d2d5f0d40e87c50200455998e32ac2c7aaa8ae8276cf095e621eec474"
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
    "nav2_msgs/action/Wait_GetResult" "RIHS01_fd8dddc2a5be9d8247587a082c8484e603efb2d62369d4c619186c6b7c9f6365"
    WaitGetResult, WaitGetResultRequest, WaitGetResultResponse
}

crate::action! {
    /// Waits.
    "nav2_msgs/action/Wait" "RIHS01_313d88f28cc574e9ec3bd60f15fcf170e11e5faf0e71da050b1d68097878e82e"
    Wait, WaitGoal, WaitResult, WaitFeedback,
    WaitSendGoal, WaitGetResult, WaitFeedbackMessage
}

crate::message! {
    /// Changes of state in one tick of a behavior tree.
    "nav2_msgs/msg/BehaviorTreeLog" "RIHS01_1ea5a3b1188cda1cbc49f1e09277756a7cd20271954eac1a6c6cee03cdbf16bb"
    BehaviorTreeLog {
        /// timestamp
        timestamp: crate::builtin_interfaces::Time,
        /// event_log
        event_log: Vec<BehaviorTreeStatusChange>,
    }
}

crate::message! {
    /// Change of state of a node of a behavior tree.
    "nav2_msgs/msg/BehaviorTreeStatusChange" "RIHS01_02ba84073d4da9095ae11dbf9f1e3a762165107e95ff631eab8380d41eca60b4"
    BehaviorTreeStatusChange {
        /// timestamp
        timestamp: crate::builtin_interfaces::Time,
        /// node_name
        node_name: std::string::String,
        /// IDLE, RUNNING, SUCCESS or FAILURE.
        previous_status: std::string::String,
        /// IDLE, RUNNING, SUCCESS or FAILURE.
        current_status: std::string::String,
    }
}
