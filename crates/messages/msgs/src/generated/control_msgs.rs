//! `control_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/control_msgs`
//! instead.

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
    "control_msgs/action/FollowJointTrajectory_Feedback" "RIHS01_3fd0aaecf71725121ae1ff7f01098a5e0da581e672be18a6b2c286cb43d96b49"
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
        /// multi_dof_joint_names
        multi_dof_joint_names: Vec<std::string::String>,
        /// multi_dof_desired
        multi_dof_desired: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_actual
        multi_dof_actual: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_error
        multi_dof_error: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
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
    "control_msgs/action/FollowJointTrajectory_FeedbackMessage" "RIHS01_80398fcb9674a79081a9906e2ccf0c804dd7cb15e22e362e606ee87186beab71"
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
    "control_msgs/action/FollowJointTrajectory" "RIHS01_738ebcb7a2d7cfa42f9f1001cc99ce3a4383d1cfe508015d9be8485e4b1c66f6"
    FollowJointTrajectory, FollowJointTrajectoryGoal, FollowJointTrajectoryResult, FollowJointTrajectoryFeedback,
    FollowJointTrajectorySendGoal, FollowJointTrajectoryGetResult, FollowJointTrajectoryFeedbackMessage
}

crate::message! {
    /// Values of all interfaces of joints.
    "control_msgs/msg/DynamicJointState" "RIHS01_18024c98a62697680f581108eeed40b28fb4542fa0ac5a8e36f56c62b6813d26"
    DynamicJointState {
        /// header
        header: crate::std_msgs::Header,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// interface_values
        interface_values: Vec<InterfaceValue>,
    }
}

crate::message! {
    /// Values of the interfaces of one joint.
    "control_msgs/msg/InterfaceValue" "RIHS01_74a12144ef6b7af67533195cb30f7f607d3301b66950208a72d280695f3e190c"
    InterfaceValue {
        /// interface_names
        interface_names: Vec<std::string::String>,
        /// values
        values: Vec<f64>,
    }
}

crate::message! {
    /// Tolerance of one degree of freedom of a joint with several.
    "control_msgs/msg/JointComponentTolerance" "RIHS01_739ea7566931944d33830fa10f1bf5e7a7fbdc3172bce7a7eaac642bd6e3ffa4"
    JointComponentTolerance {
        /// joint_name
        joint_name: std::string::String,
        /// component
        component: u16,
        /// position
        position: f64,
        /// velocity
        velocity: f64,
        /// acceleration
        acceleration: f64,
    }
    /// X_AXIS
    X_AXIS: u16 = 1;
    /// Y_AXIS
    Y_AXIS: u16 = 2;
    /// Z_AXIS
    Z_AXIS: u16 = 3;
    /// TRANSLATION
    TRANSLATION: u16 = 4;
    /// ROTATION
    ROTATION: u16 = 5;
}

crate::message! {
    /// Immediate displacements or velocities of joints.
    "control_msgs/msg/JointJog" "RIHS01_ba249455a20f70168a1acb7bf43b776b72ff1f7eb5fc4cfea443f749e963c6e7"
    JointJog {
        /// header
        header: crate::std_msgs::Header,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// displacements
        displacements: Vec<f64>,
        /// velocities
        velocities: Vec<f64>,
        /// duration
        duration: f64,
    }
}

crate::message! {
    /// Tolerance of a joint. 0 means the default, a negative value no limit.
    "control_msgs/msg/JointTolerance" "RIHS01_c254f9cece0f3b733017b6990fd46d1326e25242d6b8844398c97d9a88e7d648"
    JointTolerance {
        /// name
        name: std::string::String,
        /// position
        position: f64,
        /// velocity
        velocity: f64,
        /// acceleration
        acceleration: f64,
    }
}

crate::message! {
    /// State of a joint trajectory controller.
    "control_msgs/msg/JointTrajectoryControllerState" "RIHS01_51d8dd89cc624cbe9daaeeb4d80d6de9b86168ffdc3be41fefc0953e3c26e480"
    JointTrajectoryControllerState {
        /// header
        header: crate::std_msgs::Header,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// reference
        reference: crate::trajectory_msgs::JointTrajectoryPoint,
        /// feedback
        feedback: crate::trajectory_msgs::JointTrajectoryPoint,
        /// error
        error: crate::trajectory_msgs::JointTrajectoryPoint,
        /// output
        output: crate::trajectory_msgs::JointTrajectoryPoint,
        /// multi_dof_joint_names
        multi_dof_joint_names: Vec<std::string::String>,
        /// multi_dof_reference
        multi_dof_reference: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_feedback
        multi_dof_feedback: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_error
        multi_dof_error: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_output
        multi_dof_output: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// speed_scaling_factor
        speed_scaling_factor: f64,
    }
}

crate::message! {
    /// State of a mecanum drive controller.
    "control_msgs/msg/MecanumDriveControllerState" "RIHS01_c560d21a4484fd5f2c05896a11de3315f4c33535a203d3e8d62af4b6a9cd3355"
    MecanumDriveControllerState {
        /// header
        header: crate::std_msgs::Header,
        /// front_left_wheel_velocity
        front_left_wheel_velocity: f64,
        /// back_left_wheel_velocity
        back_left_wheel_velocity: f64,
        /// back_right_wheel_velocity
        back_right_wheel_velocity: f64,
        /// front_right_wheel_velocity
        front_right_wheel_velocity: f64,
        /// reference_velocity
        reference_velocity: crate::geometry_msgs::Twist,
    }
}

crate::message! {
    /// State of a PID controller.
    "control_msgs/msg/PidState" "RIHS01_9ab329825048ab6152868c2d086fc19f5525ed2c6fec886f719577e1ae3a6acd"
    PidState {
        /// header
        header: crate::std_msgs::Header,
        /// timestep
        timestep: crate::builtin_interfaces::Duration,
        /// error
        error: f64,
        /// error_dot
        error_dot: f64,
        /// p_error
        p_error: f64,
        /// i_error
        i_error: f64,
        /// d_error
        d_error: f64,
        /// p_term
        p_term: f64,
        /// i_term
        i_term: f64,
        /// d_term
        d_term: f64,
        /// i_max
        i_max: f64,
        /// i_min
        i_min: f64,
        /// output
        output: f64,
    }
}

crate::message! {
    /// State of a controller of one degree of freedom.
    "control_msgs/msg/SingleDOFState" "RIHS01_fe8365f86265bddfefbd26698975a818bf024a1c267c8ce577cd366ef06d7163"
    SingleDOFState {
        /// name
        name: std::string::String,
        /// reference
        reference: f64,
        /// feedback
        feedback: f64,
        /// feedback_dot
        feedback_dot: f64,
        /// error
        error: f64,
        /// error_dot
        error_dot: f64,
        /// time_step
        time_step: f64,
        /// output
        output: f64,
    }
}

crate::message! {
    /// Factor by which a controller slows a trajectory down.
    "control_msgs/msg/SpeedScalingFactor" "RIHS01_0c240f349f2b74e33e8741f83e0f196ddeb6585923663876ed3c1f51f0566037"
    SpeedScalingFactor {
        /// factor
        factor: f64,
    }
}

crate::message! {
    /// Steering angle and speed that a steering controller commands.
    "control_msgs/msg/SteeringControllerCommand" "RIHS01_19fba4bf598c8755a79d33c7742c999bec87ebedc2fc99dd38c51479ffcfac14"
    SteeringControllerCommand {
        /// header
        header: crate::std_msgs::Header,
        /// steering_angle
        steering_angle: f64,
        /// linear_velocity
        linear_velocity: f64,
    }
}

crate::message! {
    /// State and commands of a steering controller.
    "control_msgs/msg/SteeringControllerStatus" "RIHS01_151ec2fabdfdf10cabe982ceab9fec8882c9efff0effc8d07ba7a1d404cf8143"
    SteeringControllerStatus {
        /// header
        header: crate::std_msgs::Header,
        /// traction_wheels_position
        traction_wheels_position: Vec<f64>,
        /// traction_wheels_velocity
        traction_wheels_velocity: Vec<f64>,
        /// steer_positions
        steer_positions: Vec<f64>,
        /// linear_velocity_command
        linear_velocity_command: Vec<f64>,
        /// steering_angle_command
        steering_angle_command: Vec<f64>,
    }
}

crate::message! {
    /// State of a trajectory at a time.
    "control_msgs/srv/QueryTrajectoryState_Request" "RIHS01_ec3322824b7a1ee850e03ff951f48b10395cab62a5a5662da32000f8b06aa791"
    QueryTrajectoryStateRequest {
        /// Duration.
        time: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `control_msgs/srv/QueryTrajectoryState_Response`.
    "control_msgs/srv/QueryTrajectoryState_Response" "RIHS01_f7b920129b8d5841312bcb89e6275508e19b3735a371b2df6e417447a44ea5db"
    QueryTrajectoryStateResponse {
        /// success
        success: bool,
        /// message
        message: std::string::String,
        /// name
        name: Vec<std::string::String>,
        /// position
        position: Vec<f64>,
        /// velocity
        velocity: Vec<f64>,
        /// acceleration
        acceleration: Vec<f64>,
    }
}

crate::service! {
    /// State of a trajectory at a time.
    "control_msgs/srv/QueryTrajectoryState" "RIHS01_4a0935dffef18bc5b9e101c9d03d84e681ecd4cebd724b8f11fde008751a325a"
    QueryTrajectoryState, QueryTrajectoryStateRequest, QueryTrajectoryStateResponse
}

crate::message! {
    /// Sets the pose of an odometry.
    "control_msgs/srv/SetOdometry_Request" "RIHS01_6300e1c1c8eb4ebbbc4176a32a51b72dc287f38929eea3174ad0129f871679f4"
    SetOdometryRequest {
        /// x
        x: f64,
        /// y
        y: f64,
        /// z
        z: f64,
        /// roll
        roll: f64,
        /// pitch
        pitch: f64,
        /// yaw
        yaw: f64,
    }
}

crate::message! {
    /// `control_msgs/srv/SetOdometry_Response`.
    "control_msgs/srv/SetOdometry_Response" "RIHS01_e102ea4b988b481c5eeab5d8396efd0637a688d557c1e33b8d11723ddd45b616"
    SetOdometryResponse {
        /// success
        success: bool,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Sets the pose of an odometry.
    "control_msgs/srv/SetOdometry" "RIHS01_cf3fe2bf6627a67b4883ba6e876a7b46cdd991417ece9f4f4dac5452fbfdea48"
    SetOdometry, SetOdometryRequest, SetOdometryResponse
}
