//! `tf2_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/tf2_msgs`
//! instead.

crate::message! {
    /// A transform, waited for.
    "tf2_msgs/action/LookupTransform_Goal" "RIHS01_815efc294ad17c813c6043cdde781ff55810d49da02ed07f9237dcd20e88d498"
    LookupTransformGoal {
        /// The frame into which to transform.
        target_frame: std::string::String,
        /// The frame from which.
        source_frame: std::string::String,
        /// At which time.
        source_time: crate::builtin_interfaces::Time,
        /// How long to wait.
        timeout: crate::builtin_interfaces::Duration,
        /// With advanced: the time of the target frame.
        target_time: crate::builtin_interfaces::Time,
        /// With advanced: the frame that does not move between the two times.
        fixed_frame: std::string::String,
        /// Whether two times and a fixed frame are given.
        advanced: bool,
    }
}

crate::message! {
    /// `tf2_msgs/action/LookupTransform_Result`.
    "tf2_msgs/action/LookupTransform_Result" "RIHS01_061d4423af5352ff5314c8effef8faab133991a78f1b2bcd1fecabad80871225"
    LookupTransformResult {
        /// transform
        transform: crate::geometry_msgs::TransformStamped,
        /// error
        error: TF2Error,
    }
}

crate::message! {
    /// `tf2_msgs/action/LookupTransform_Feedback`.
    "tf2_msgs/action/LookupTransform_Feedback" "RIHS01_2da0b02f990f04404ab8c98a2a68cf5bbc773ae747f96911f2d55499cfb51542"
    LookupTransformFeedback {
    }
}

crate::message! {
    /// `tf2_msgs/action/LookupTransform_SendGoal_Request`.
    "tf2_msgs/action/LookupTransform_SendGoal_Request" "RIHS01_eb1312eb7aab35e35c71bb87c2ba3a94747c5a6544ea32bb2b32b0f75775b8ca"
    LookupTransformSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: LookupTransformGoal,
    }
}

crate::message! {
    /// `tf2_msgs/action/LookupTransform_SendGoal_Response`.
    "tf2_msgs/action/LookupTransform_SendGoal_Response" "RIHS01_c1ada93304793c08813657255e7bde2e40e2114aa634b702c3f8d4b72ae098bc"
    LookupTransformSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `tf2_msgs/action/LookupTransform_GetResult_Request`.
    "tf2_msgs/action/LookupTransform_GetResult_Request" "RIHS01_148f9bdc01f98922d6fb2072cb64468b89c57c7825d9d83b932c183deaa4697d"
    LookupTransformGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `tf2_msgs/action/LookupTransform_GetResult_Response`.
    "tf2_msgs/action/LookupTransform_GetResult_Response" "RIHS01_954de3efc36b164c4d21116abdbdcc52746e454fd9c169b55d9cfd89e83d299d"
    LookupTransformGetResultResponse {
        /// status
        status: i8,
        /// result
        result: LookupTransformResult,
    }
}

crate::message! {
    /// `tf2_msgs/action/LookupTransform_FeedbackMessage`.
    "tf2_msgs/action/LookupTransform_FeedbackMessage" "RIHS01_10cb89922dcb103e95c185d43e8a5efa3d38db996f733151a2f3e2ac133f4839"
    LookupTransformFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: LookupTransformFeedback,
    }
}

crate::service! {
    /// `tf2_msgs/action/LookupTransform_SendGoal`.
    "tf2_msgs/action/LookupTransform_SendGoal" "RIHS01_4646ff5706c86b04d0a1098d329951a9731a7517e16702905de6073cc72c8530"
    LookupTransformSendGoal, LookupTransformSendGoalRequest, LookupTransformSendGoalResponse
}

crate::service! {
    /// `tf2_msgs/action/LookupTransform_GetResult`.
    "tf2_msgs/action/LookupTransform_GetResult" "RIHS01_3cd1715751899e3167b5aec3e4ac194f7da9e8493a77285f9f6a4c914f5e8b24"
    LookupTransformGetResult, LookupTransformGetResultRequest, LookupTransformGetResultResponse
}

crate::action! {
    /// A transform, waited for.
    "tf2_msgs/action/LookupTransform" "RIHS01_0b8adf6bc0b5958879e3265b41a457e03558fe523890a81252c70eba97a82c5d"
    LookupTransform, LookupTransformGoal, LookupTransformResult, LookupTransformFeedback,
    LookupTransformSendGoal, LookupTransformGetResult, LookupTransformFeedbackMessage
}

crate::message! {
    /// Why a transform could not be had.
    "tf2_msgs/msg/TF2Error" "RIHS01_db2485e7d6a0ec75bf087e058ee45df682acc3a621ca7780503d10aac141809a"
    TF2Error {
        /// One of the values above.
        error: u8,
        /// The reason in words.
        error_string: std::string::String,
    }
    /// NO_ERROR
    NO_ERROR: u8 = 0;
    /// No such frame.
    LOOKUP_ERROR: u8 = 1;
    /// The frames are in different trees.
    CONNECTIVITY_ERROR: u8 = 2;
    /// The time lies outside of what was heard.
    EXTRAPOLATION_ERROR: u8 = 3;
    /// INVALID_ARGUMENT_ERROR
    INVALID_ARGUMENT_ERROR: u8 = 4;
    /// TIMEOUT_ERROR
    TIMEOUT_ERROR: u8 = 5;
    /// TRANSFORM_ERROR
    TRANSFORM_ERROR: u8 = 6;
}

crate::message! {
    /// Transforms between frames, on /tf while they change and on /tf_static when they never do.
    "tf2_msgs/msg/TFMessage" "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"
    TFMessage {
        /// transforms
        transforms: Vec<crate::geometry_msgs::TransformStamped>,
    }
}

crate::message! {
    /// The tree of frames that a listener knows.
    "tf2_msgs/srv/FrameGraph_Request" "RIHS01_4cc565da6b64726d0b0be1ce20f3a3a695679b841a79abfca2fcdc94f562b08d"
    FrameGraphRequest {
    }
}

crate::message! {
    /// `tf2_msgs/srv/FrameGraph_Response`.
    "tf2_msgs/srv/FrameGraph_Response" "RIHS01_e33d5473ce0fac04c66203779f2b719a9de0f8388b248852d3a47a019e62e36d"
    FrameGraphResponse {
        /// The tree as YAML.
        frame_yaml: std::string::String,
    }
}

crate::service! {
    /// The tree of frames that a listener knows.
    "tf2_msgs/srv/FrameGraph" "RIHS01_0d1fbc6222c018ba5f33822904a2fdd4063705289956d3fdde07cd8c50fe8067"
    FrameGraph, FrameGraphRequest, FrameGraphResponse
}
