//! Parameters of `diff_drive_controller`.

use periplus_params::{NamedEntity, params};

params! {
    /// Differential drive of ROS 2.
    #[table(DIFF_DRIVE, "diff_drive_controller")]
    pub struct DiffDriveParams {
        /// Joints of the left wheels (default none).
        #[param("left_wheel_names", naming(NamedEntity::Joint))]
        left_wheel_names: Vec<String>,
        /// Joints of the right wheels (default none).
        #[param("right_wheel_names", naming(NamedEntity::Joint))]
        right_wheel_names: Vec<String>,
        /// Number of wheels at each side (default as many as named).
        #[param("wheels_per_side")]
        _: i64 = 0,
        /// Distance between left and right wheels (default 0).
        #[param("wheel_separation", unit("m"))]
        wheel_separation_m: f64 = 0,
        /// Radius of the wheels (default 0).
        #[param("wheel_radius", unit("m"))]
        wheel_radius_m: f64 = 0,
        /// Factor of the wheel separation (default 1).
        #[param("wheel_separation_multiplier")]
        wheel_separation_multiplier: f64 = 1,
        /// Factor of the radius of the left wheels (default 1).
        #[param("left_wheel_radius_multiplier")]
        left_wheel_radius_multiplier: f64 = 1,
        /// Factor of the radius of the right wheels (default 1).
        #[param("right_wheel_radius_multiplier")]
        right_wheel_radius_multiplier: f64 = 1,
        /// Prepends a prefix to the frame names (default true).
        #[param("tf_frame_prefix_enable")]
        tf_frame_prefix_enable: bool = true,
        /// Prefix of the frame names (default the namespace of the node).
        #[param("tf_frame_prefix")]
        tf_frame_prefix: String = "",
        /// Frame of the odometry (default `odom`).
        #[param("odom_frame_id", naming(NamedEntity::Frame))]
        odom_frame_id: String = "odom",
        /// Frame of the robot (default `base_link`).
        #[param("base_frame_id", naming(NamedEntity::Frame))]
        base_frame_id: String = "base_link",
        /// Variances of the pose: x, y, z, roll, pitch, yaw (default 0).
        #[param("pose_covariance_diagonal")]
        pose_covariance_diagonal: Vec<f64> = "0 0 0 0 0 0",
        /// Variances of the velocity: x, y, z, roll, pitch, yaw (default 0).
        #[param("twist_covariance_diagonal")]
        twist_covariance_diagonal: Vec<f64> = "0 0 0 0 0 0",
        /// Computes odometry from commands instead of the wheels (default false).
        #[param("open_loop")]
        open_loop: bool = false,
        /// Computes odometry from wheel angles, not speeds (default true).
        #[param("position_feedback")]
        position_feedback: bool = true,
        /// Publishes the transform of the odometry (default true).
        #[param("enable_odom_tf")]
        enable_odom_tf: bool = true,
        /// Maximum age of a command; 0 for none (default 0.5).
        #[param("cmd_vel_timeout", unit("s"))]
        cmd_vel_timeout_s: f64 = 0.5,
        /// Publishes the limited command on `~/cmd_vel_out` (default false).
        #[param("publish_limited_velocity")]
        publish_limited_velocity: bool = false,
        /// Number of updates in the mean velocity (default 10).
        #[param("velocity_rolling_window_size", min(1.0))]
        velocity_rolling_window_size: usize = 10,
        /// Rate of the odometry (default 50).
        #[param("publish_rate", unit("Hz"))]
        publish_rate_hz: f64 = 50,
        /// Receives `TwistStamped`; false for `Twist` on `~/cmd_vel_unstamped`, in Humble (default
        /// true).
        #[param("use_stamped_vel")]
        use_stamped_vel: bool = true,
        /// Applies the limits of the forward speed (default false in Humble, else true).
        #[param("linear.x.has_velocity_limits")]
        linear_x_has_velocity_limits: Option<bool>,
        /// Applies the limits of the acceleration (default false in Humble, else true).
        #[param("linear.x.has_acceleration_limits")]
        linear_x_has_acceleration_limits: Option<bool>,
        /// Applies the limits of the jerk (default false in Humble, else true).
        #[param("linear.x.has_jerk_limits")]
        linear_x_has_jerk_limits: Option<bool>,
        /// Maximum of the forward speed (default none).
        #[param("linear.x.max_velocity", unit("m/s"))]
        linear_x_max_velocity: Option<f64>,
        /// Minimum of the forward speed (default the negative maximum).
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
        /// Minimum acceleration before Jazzy (default the negative maximum).
        #[param("linear.x.min_acceleration", unit("m/s/s"))]
        linear_x_min_acceleration: Option<f64>,
        /// Maximum jerk (default none).
        #[param("linear.x.max_jerk", unit("m/s/s²"))]
        linear_x_max_jerk: Option<f64>,
        /// Minimum jerk (default the negative maximum).
        #[param("linear.x.min_jerk", unit("m/s/s²"))]
        linear_x_min_jerk: Option<f64>,
        /// Applies the limits of the yaw rate (default false in Humble, else true).
        #[param("angular.z.has_velocity_limits")]
        angular_z_has_velocity_limits: Option<bool>,
        /// Applies the limits of the acceleration (default false in Humble, else true).
        #[param("angular.z.has_acceleration_limits")]
        angular_z_has_acceleration_limits: Option<bool>,
        /// Applies the limits of the jerk (default false in Humble, else true).
        #[param("angular.z.has_jerk_limits")]
        angular_z_has_jerk_limits: Option<bool>,
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
        /// Minimum acceleration before Jazzy (default the negative maximum).
        #[param("angular.z.min_acceleration", unit("rad/s/s"))]
        angular_z_min_acceleration: Option<f64>,
        /// Maximum jerk (default none).
        #[param("angular.z.max_jerk", unit("rad/s/s²"))]
        angular_z_max_jerk: Option<f64>,
        /// Minimum jerk (default the negative maximum).
        #[param("angular.z.min_jerk", unit("rad/s/s²"))]
        angular_z_min_jerk: Option<f64>,
    }
}

params! {
    /// Differential drive of ROS 1.
    #[table(DIFF_DRIVE_ROS1, "diff_drive_controller of ROS 1")]
    pub struct DiffDriveRos1Params {
        /// Joints of the left wheels.
        #[param("left_wheel", naming(NamedEntity::Joint))]
        left_wheel: Vec<String>,
        /// Joints of the right wheels.
        #[param("right_wheel", naming(NamedEntity::Joint))]
        right_wheel: Vec<String>,
        /// Distance between left and right wheels (default that of the robot's description).
        #[param("wheel_separation", unit("m"))]
        wheel_separation_m: Option<f64>,
        /// Radius of the wheels (default that of the robot's description).
        #[param("wheel_radius", unit("m"))]
        wheel_radius_m: Option<f64>,
        /// Factor of the wheel separation (default 1).
        #[param("wheel_separation_multiplier")]
        wheel_separation_multiplier: f64 = 1,
        /// Factor of the radius of all wheels (default 1).
        #[param("wheel_radius_multiplier")]
        wheel_radius_multiplier: f64 = 1,
        /// Factor of the radius of the left wheels (default that of all).
        #[param("left_wheel_radius_multiplier")]
        left_wheel_radius_multiplier: Option<f64>,
        /// Factor of the radius of the right wheels (default that of all).
        #[param("right_wheel_radius_multiplier")]
        right_wheel_radius_multiplier: Option<f64>,
        /// Frame of the odometry (default `odom`).
        #[param("odom_frame_id", naming(NamedEntity::Frame))]
        odom_frame_id: String = "odom",
        /// Frame of the robot (default `base_link`).
        #[param("base_frame_id", naming(NamedEntity::Frame))]
        base_frame_id: String = "base_link",
        /// Variances of the pose: x, y, z, roll, pitch, yaw (default 0).
        #[param("pose_covariance_diagonal")]
        pose_covariance_diagonal: Vec<f64> = "0 0 0 0 0 0",
        /// Variances of the velocity: x, y, z, roll, pitch, yaw (default 0).
        #[param("twist_covariance_diagonal")]
        twist_covariance_diagonal: Vec<f64> = "0 0 0 0 0 0",
        /// Computes odometry from commands instead of the wheels (default false).
        #[param("open_loop")]
        open_loop: bool = false,
        /// Publishes the transform of the odometry (default true).
        #[param("enable_odom_tf")]
        enable_odom_tf: bool = true,
        /// Maximum age of a command (default 0.5).
        #[param("cmd_vel_timeout", unit("s"))]
        cmd_vel_timeout_s: f64 = 0.5,
        /// Publishes the limited command on `cmd_vel_out` (default false).
        #[param("publish_cmd")]
        publish_cmd: bool = false,
        /// Number of updates in the mean velocity (default 10).
        #[param("velocity_rolling_window_size", min(1.0))]
        velocity_rolling_window_size: usize = 10,
        /// Rate of the odometry (default 50).
        #[param("publish_rate", unit("Hz"))]
        publish_rate_hz: f64 = 50,
        /// Applies the limits of the velocity (default false).
        #[param("linear.x.has_velocity_limits")]
        linear_x_has_velocity_limits: bool = false,
        /// Maximum velocity of the forward motion (default none).
        #[param("linear.x.max_velocity", unit("m/s"))]
        linear_x_max_velocity: Option<f64>,
        /// Minimum velocity of the forward motion (default the negative maximum).
        #[param("linear.x.min_velocity", unit("m/s"))]
        linear_x_min_velocity: Option<f64>,
        /// Applies the limits of the acceleration (default false).
        #[param("linear.x.has_acceleration_limits")]
        linear_x_has_acceleration_limits: bool = false,
        /// Maximum acceleration of the forward motion (default none).
        #[param("linear.x.max_acceleration", unit("m/s/s"))]
        linear_x_max_acceleration: Option<f64>,
        /// Minimum acceleration of the forward motion (default the negative maximum).
        #[param("linear.x.min_acceleration", unit("m/s/s"))]
        linear_x_min_acceleration: Option<f64>,
        /// Applies the limits of the jerk (default false).
        #[param("linear.x.has_jerk_limits")]
        linear_x_has_jerk_limits: bool = false,
        /// Maximum jerk of the forward motion (default none).
        #[param("linear.x.max_jerk", unit("m/s/s²"))]
        linear_x_max_jerk: Option<f64>,
        /// Minimum jerk of the forward motion (default the negative maximum).
        #[param("linear.x.min_jerk", unit("m/s/s²"))]
        linear_x_min_jerk: Option<f64>,
        /// Applies the limits of the velocity (default false).
        #[param("angular.z.has_velocity_limits")]
        angular_z_has_velocity_limits: bool = false,
        /// Maximum velocity of the turn (default none).
        #[param("angular.z.max_velocity", unit("rad/s"))]
        angular_z_max_velocity: Option<f64>,
        /// Minimum velocity of the turn (default the negative maximum).
        #[param("angular.z.min_velocity", unit("rad/s"))]
        angular_z_min_velocity: Option<f64>,
        /// Applies the limits of the acceleration (default false).
        #[param("angular.z.has_acceleration_limits")]
        angular_z_has_acceleration_limits: bool = false,
        /// Maximum acceleration of the turn (default none).
        #[param("angular.z.max_acceleration", unit("rad/s/s"))]
        angular_z_max_acceleration: Option<f64>,
        /// Minimum acceleration of the turn (default the negative maximum).
        #[param("angular.z.min_acceleration", unit("rad/s/s"))]
        angular_z_min_acceleration: Option<f64>,
        /// Applies the limits of the jerk (default false).
        #[param("angular.z.has_jerk_limits")]
        angular_z_has_jerk_limits: bool = false,
        /// Maximum jerk of the turn (default none).
        #[param("angular.z.max_jerk", unit("rad/s/s²"))]
        angular_z_max_jerk: Option<f64>,
        /// Minimum jerk of the turn (default the negative maximum).
        #[param("angular.z.min_jerk", unit("rad/s/s²"))]
        angular_z_min_jerk: Option<f64>,
    }
}
