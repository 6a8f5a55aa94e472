//! `dwb_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/dwb_msgs`
//! instead.

crate::message! {
    /// Score of a trajectory by one critic of DWB.
    "dwb_msgs/msg/CriticScore" "RIHS01_4dfb083c8d33fde7d1e1482381507ff333b86233238880a8968210692cddab6f"
    CriticScore {
        /// name
        name: std::string::String,
        /// raw_score
        raw_score: f32,
        /// scale
        scale: f32,
    }
}

crate::message! {
    /// Trajectories that DWB has scored in one cycle.
    "dwb_msgs/msg/LocalPlanEvaluation" "RIHS01_6bb7af7f92591fcb4e637dd0803ca59a0b3125a0962eeb9919b55cd68db3e97b"
    LocalPlanEvaluation {
        /// header
        header: crate::std_msgs::Header,
        /// twists
        twists: Vec<TrajectoryScore>,
        /// best_index
        best_index: u16,
        /// worst_index
        worst_index: u16,
    }
}

crate::message! {
    /// Velocity command with the poses it leads to.
    "dwb_msgs/msg/Trajectory2D" "RIHS01_5a276e6e04db5177d49f2672aa6d883a6c5d994cfed31c94dba2d66970ba8f4a"
    Trajectory2D {
        /// velocity
        velocity: crate::nav_2d_msgs::Twist2D,
        /// time_offsets
        time_offsets: Vec<crate::builtin_interfaces::Duration>,
        /// poses
        poses: Vec<crate::geometry_msgs::Pose2D>,
    }
}

crate::message! {
    /// Trajectory with the scores of all critics.
    "dwb_msgs/msg/TrajectoryScore" "RIHS01_80bd1829f8872d38c22b976c3a2d6040ebd1162b3a6a4bf649a08d7959f84465"
    TrajectoryScore {
        /// traj
        traj: Trajectory2D,
        /// scores
        scores: Vec<CriticScore>,
        /// total
        total: f32,
    }
}

crate::message! {
    /// Local plan of DWB for a pose, with all scores.
    "dwb_msgs/srv/DebugLocalPlan_Request" "RIHS01_1663c792a30cab503edcc9680b5fa625625d1157d92434b90b4f79527a515e94"
    DebugLocalPlanRequest {
        /// pose
        pose: crate::nav_2d_msgs::Pose2DStamped,
        /// velocity
        velocity: crate::nav_2d_msgs::Twist2D,
        /// global_plan
        global_plan: crate::nav_2d_msgs::Path2D,
    }
}

crate::message! {
    /// `dwb_msgs/srv/DebugLocalPlan_Response`.
    "dwb_msgs/srv/DebugLocalPlan_Response" "RIHS01_9071bfd803a04ab88c1085544e61418f54e72f2faf53a9f38c73889a55ae8e5e"
    DebugLocalPlanResponse {
        /// results
        results: LocalPlanEvaluation,
    }
}

crate::service! {
    /// Local plan of DWB for a pose, with all scores.
    "dwb_msgs/srv/DebugLocalPlan" "RIHS01_5919669eea45addb5c93795fb77534140de27a3b4e20d612a93ae8c290e8dec4"
    DebugLocalPlan, DebugLocalPlanRequest, DebugLocalPlanResponse
}

crate::message! {
    /// Trajectory of DWB for a velocity command.
    "dwb_msgs/srv/GenerateTrajectory_Request" "RIHS01_ac3498d7fce1bad13ae0fb6011b70d4ba9942b2fe34c021e658cca64a57043bc"
    GenerateTrajectoryRequest {
        /// start_pose
        start_pose: crate::geometry_msgs::Pose2D,
        /// start_vel
        start_vel: crate::nav_2d_msgs::Twist2D,
        /// cmd_vel
        cmd_vel: crate::nav_2d_msgs::Twist2D,
    }
}

crate::message! {
    /// `dwb_msgs/srv/GenerateTrajectory_Response`.
    "dwb_msgs/srv/GenerateTrajectory_Response" "RIHS01_0e16eaab0c3d9b5bfb06a01f16bcae932e55ff2147feb626a017655783de7e58"
    GenerateTrajectoryResponse {
        /// traj
        traj: Trajectory2D,
    }
}

crate::service! {
    /// Trajectory of DWB for a velocity command.
    "dwb_msgs/srv/GenerateTrajectory" "RIHS01_1fe4e4758573d7bff56458320d1e2f3b1f2f975d5719650880561b75b05a963d"
    GenerateTrajectory, GenerateTrajectoryRequest, GenerateTrajectoryResponse
}

crate::message! {
    /// Velocity commands that DWB samples.
    "dwb_msgs/srv/GenerateTwists_Request" "RIHS01_95b31a6a287e1d68ada4621124f96d809ed4d5ec6722b05bfaecea8d24b5688c"
    GenerateTwistsRequest {
        /// current_vel
        current_vel: crate::nav_2d_msgs::Twist2D,
    }
}

crate::message! {
    /// `dwb_msgs/srv/GenerateTwists_Response`.
    "dwb_msgs/srv/GenerateTwists_Response" "RIHS01_71630df7695c13e8a457df1af9b1dff0d9ef8735d7d3d7909d7a9a1ed706551d"
    GenerateTwistsResponse {
        /// twists
        twists: Vec<crate::nav_2d_msgs::Twist2D>,
    }
}

crate::service! {
    /// Velocity commands that DWB samples.
    "dwb_msgs/srv/GenerateTwists" "RIHS01_50d759ac34f5c7509edf89488f4a5365366e11cd760e78c0b2060abc79b2917f"
    GenerateTwists, GenerateTwistsRequest, GenerateTwistsResponse
}

crate::message! {
    /// Score of a trajectory by one critic.
    "dwb_msgs/srv/GetCriticScore_Request" "RIHS01_688a7f50bcff51d035dd3fb98518e8586ec9b801c7a3c7d45c7739c9b64c8902"
    GetCriticScoreRequest {
        /// pose
        pose: crate::nav_2d_msgs::Pose2DStamped,
        /// velocity
        velocity: crate::nav_2d_msgs::Twist2D,
        /// global_plan
        global_plan: crate::nav_2d_msgs::Path2D,
        /// traj
        traj: Trajectory2D,
        /// critic_name
        critic_name: std::string::String,
    }
}

crate::message! {
    /// `dwb_msgs/srv/GetCriticScore_Response`.
    "dwb_msgs/srv/GetCriticScore_Response" "RIHS01_ec8e53ec076b943c42089b3b8abe972bf4492c7cb5236a3fbb0fa38498522182"
    GetCriticScoreResponse {
        /// score
        score: CriticScore,
    }
}

crate::service! {
    /// Score of a trajectory by one critic.
    "dwb_msgs/srv/GetCriticScore" "RIHS01_35c54b4f70e921363742ca68fa34f698fdd73470be3daeca331c32ca3eef98dc"
    GetCriticScore, GetCriticScoreRequest, GetCriticScoreResponse
}

crate::message! {
    /// Score of a trajectory by all critics.
    "dwb_msgs/srv/ScoreTrajectory_Request" "RIHS01_58e3a0599267c849ad60386182c70faa69b5a699840c1d8e0a766a648d2baf86"
    ScoreTrajectoryRequest {
        /// pose
        pose: crate::nav_2d_msgs::Pose2DStamped,
        /// velocity
        velocity: crate::nav_2d_msgs::Twist2D,
        /// global_plan
        global_plan: crate::nav_2d_msgs::Path2D,
        /// traj
        traj: Trajectory2D,
    }
}

crate::message! {
    /// `dwb_msgs/srv/ScoreTrajectory_Response`.
    "dwb_msgs/srv/ScoreTrajectory_Response" "RIHS01_aa43973f7749c64f347da0e8128cc9a7596f2f76df7de6981a8b266ff75d2210"
    ScoreTrajectoryResponse {
        /// score
        score: TrajectoryScore,
    }
}

crate::service! {
    /// Score of a trajectory by all critics.
    "dwb_msgs/srv/ScoreTrajectory" "RIHS01_01421370a4682891d957b1b577af7996d41b09c859fe831271dd7255d4b142f0"
    ScoreTrajectory, ScoreTrajectoryRequest, ScoreTrajectoryResponse
}
