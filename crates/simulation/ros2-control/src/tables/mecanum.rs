//! Parameters of `mecanum_drive_controller`.

use periplus_params::{NamedEntity, params};

params! {
    /// Drive with four mecanum wheels.
    #[table(MECANUM, "mecanum_drive_controller")]
    pub struct MecanumParams {
        /// Maximum age of a command; 0 for none (default 0).
        #[param("reference_timeout", unit("s"))]
        reference_timeout_s: f64 = 0,
        /// Commanded joint of the front left wheel.
        #[param("front_left_wheel_command_joint_name", naming(NamedEntity::Joint))]
        front_left_wheel_command_joint_name: String = "",
        /// Joint whose state is read for that wheel (default the commanded one).
        #[param("front_left_wheel_state_joint_name", naming(NamedEntity::Joint))]
        front_left_wheel_state_joint_name: String = "",
        /// Commanded joint of the front right wheel.
        #[param("front_right_wheel_command_joint_name", naming(NamedEntity::Joint))]
        front_right_wheel_command_joint_name: String = "",
        /// Joint whose state is read for that wheel (default the commanded one).
        #[param("front_right_wheel_state_joint_name", naming(NamedEntity::Joint))]
        front_right_wheel_state_joint_name: String = "",
        /// Commanded joint of the rear right wheel.
        #[param("rear_right_wheel_command_joint_name", naming(NamedEntity::Joint))]
        rear_right_wheel_command_joint_name: String = "",
        /// Joint whose state is read for that wheel (default the commanded one).
        #[param("rear_right_wheel_state_joint_name", naming(NamedEntity::Joint))]
        rear_right_wheel_state_joint_name: String = "",
        /// Commanded joint of the rear left wheel.
        #[param("rear_left_wheel_command_joint_name", naming(NamedEntity::Joint))]
        rear_left_wheel_command_joint_name: String = "",
        /// Joint whose state is read for that wheel (default the commanded one).
        #[param("rear_left_wheel_state_joint_name", naming(NamedEntity::Joint))]
        rear_left_wheel_state_joint_name: String = "",
        /// Position of the base in the centre frame, x (default 0).
        #[param("kinematics.base_frame_offset.x", unit("m"))]
        base_frame_offset_x_m: f64 = 0,
        /// Position of the base in the centre frame, y (default 0).
        #[param("kinematics.base_frame_offset.y", unit("m"))]
        base_frame_offset_y_m: f64 = 0,
        /// Yaw of the base in the centre frame (default 0).
        #[param("kinematics.base_frame_offset.theta", unit("rad"))]
        base_frame_offset_theta_rad: f64 = 0,
        /// Radius of the wheels (default 0).
        #[param("kinematics.wheels_radius", unit("m"))]
        wheels_radius_m: f64 = 0,
        /// Sum of the distances from the centre to a wheel along x and y (default 0).
        #[param("kinematics.sum_of_robot_center_projection_on_X_Y_axis", unit("m"))]
        sum_of_projections_m: f64 = 0,
        /// Prepends a prefix to the frame names (default true).
        #[param("tf_frame_prefix_enable")]
        tf_frame_prefix_enable: bool = true,
        /// Prefix of the frame names (default the namespace of the node).
        #[param("tf_frame_prefix")]
        tf_frame_prefix: String = "",
        /// Frame of the robot (default `base_link`).
        #[param("base_frame_id", naming(NamedEntity::Frame))]
        base_frame_id: String = "base_link",
        /// Frame of the odometry (default `odom`).
        #[param("odom_frame_id", naming(NamedEntity::Frame))]
        odom_frame_id: String = "odom",
        /// Publishes the transform of the odometry (default true).
        #[param("enable_odom_tf")]
        enable_odom_tf: bool = true,
        /// Variances of the velocity: x, y, z, roll, pitch, yaw (default 0.1).
        #[param("twist_covariance_diagonal")]
        twist_covariance_diagonal: Vec<f64> = "0.1 0.1 0.1 0.1 0.1 0.1",
        /// Variances of the pose: x, y, z, roll, pitch, yaw (default 0.1).
        #[param("pose_covariance_diagonal")]
        pose_covariance_diagonal: Vec<f64> = "0.1 0.1 0.1 0.1 0.1 0.1",
        /// Receives `TwistStamped`; false for `Twist` on `~/reference_unstamped`, in Humble (default
        /// true).
        #[param("use_stamped_vel")]
        use_stamped_vel: bool = true,
        /// Maximum of the speed along x (default none).
        #[param("linear.x.max_velocity", unit("m/s"))]
        linear_x_max_velocity: Option<f64>,
        /// Minimum of the speed along x (default the negative maximum).
        #[param("linear.x.min_velocity", unit("m/s"))]
        linear_x_min_velocity: Option<f64>,
        /// Maximum acceleration (default none).
        #[param("linear.x.max_acceleration", unit("m/s/s"))]
        linear_x_max_acceleration: Option<f64>,
        /// Maximum deceleration, a negative number (default the negative acceleration).
        #[param("linear.x.max_deceleration", unit("m/s/s"))]
        linear_x_max_deceleration: Option<f64>,
        /// Maximum acceleration backwards, a negative number (default the negative acceleration).
        #[param("linear.x.max_acceleration_reverse", unit("m/s/s"))]
        linear_x_max_acceleration_reverse: Option<f64>,
        /// Maximum deceleration backwards (default the acceleration).
        #[param("linear.x.max_deceleration_reverse", unit("m/s/s"))]
        linear_x_max_deceleration_reverse: Option<f64>,
        /// Maximum jerk (default none).
        #[param("linear.x.max_jerk", unit("m/s/s²"))]
        linear_x_max_jerk: Option<f64>,
        /// Minimum jerk (default the negative maximum).
        #[param("linear.x.min_jerk", unit("m/s/s²"))]
        linear_x_min_jerk: Option<f64>,
        /// Maximum of the speed along y (default none).
        #[param("linear.y.max_velocity", unit("m/s"))]
        linear_y_max_velocity: Option<f64>,
        /// Minimum of the speed along y (default the negative maximum).
        #[param("linear.y.min_velocity", unit("m/s"))]
        linear_y_min_velocity: Option<f64>,
        /// Maximum acceleration (default none).
        #[param("linear.y.max_acceleration", unit("m/s/s"))]
        linear_y_max_acceleration: Option<f64>,
        /// Maximum deceleration, a negative number (default the negative acceleration).
        #[param("linear.y.max_deceleration", unit("m/s/s"))]
        linear_y_max_deceleration: Option<f64>,
        /// Maximum acceleration backwards, a negative number (default the negative acceleration).
        #[param("linear.y.max_acceleration_reverse", unit("m/s/s"))]
        linear_y_max_acceleration_reverse: Option<f64>,
        /// Maximum deceleration backwards (default the acceleration).
        #[param("linear.y.max_deceleration_reverse", unit("m/s/s"))]
        linear_y_max_deceleration_reverse: Option<f64>,
        /// Maximum jerk (default none).
        #[param("linear.y.max_jerk", unit("m/s/s²"))]
        linear_y_max_jerk: Option<f64>,
        /// Minimum jerk (default the negative maximum).
        #[param("linear.y.min_jerk", unit("m/s/s²"))]
        linear_y_min_jerk: Option<f64>,
        /// Maximum of the yaw rate (default none).
        #[param("angular.z.max_velocity", unit("rad/s"))]
        angular_z_max_velocity: Option<f64>,
        /// Minimum of the yaw rate (default the negative maximum).
        #[param("angular.z.min_velocity", unit("rad/s"))]
        angular_z_min_velocity: Option<f64>,
        /// Maximum acceleration (default none).
        #[param("angular.z.max_acceleration", unit("rad/s/s"))]
        angular_z_max_acceleration: Option<f64>,
        /// Maximum deceleration, a negative number (default the negative acceleration).
        #[param("angular.z.max_deceleration", unit("rad/s/s"))]
        angular_z_max_deceleration: Option<f64>,
        /// Maximum acceleration backwards, a negative number (default the negative acceleration).
        #[param("angular.z.max_acceleration_reverse", unit("rad/s/s"))]
        angular_z_max_acceleration_reverse: Option<f64>,
        /// Maximum deceleration backwards (default the acceleration).
        #[param("angular.z.max_deceleration_reverse", unit("rad/s/s"))]
        angular_z_max_deceleration_reverse: Option<f64>,
        /// Maximum jerk (default none).
        #[param("angular.z.max_jerk", unit("rad/s/s²"))]
        angular_z_max_jerk: Option<f64>,
        /// Minimum jerk (default the negative maximum).
        #[param("angular.z.min_jerk", unit("rad/s/s²"))]
        angular_z_min_jerk: Option<f64>,
    }
}
