//! Parameters of the controllers with steered wheels.

use periplus_params::{NamedEntity, params};

params! {
    /// Drive with steered wheels.
    #[table(STEERING, "steering_controllers_library")]
    pub struct SteeringParams {
        /// Maximum age of a command; 0 for none (default 1).
        #[param("reference_timeout", unit("s"))]
        reference_timeout_s: f64 = 1,
        /// True if the front wheels are steered, before Rolling (default true).
        #[param("front_steering")]
        front_steering: bool = true,
        /// Joints of the driven wheels, of two the right one first (default none).
        #[param("traction_joints_names", naming(NamedEntity::Joint))]
        traction_joints_names: Vec<String>,
        /// Joints of the steered wheels, of two the right one first (default none).
        #[param("steering_joints_names", naming(NamedEntity::Joint))]
        steering_joints_names: Vec<String>,
        /// Joints whose states are read for the driven wheels (default those).
        #[param("traction_joints_state_names", naming(NamedEntity::Joint))]
        traction_joints_state_names: Vec<String>,
        /// Joints whose states are read for the steered wheels (default those).
        #[param("steering_joints_state_names", naming(NamedEntity::Joint))]
        steering_joints_state_names: Vec<String>,
        /// Joints of the rear wheels, before Rolling (default none).
        #[param("rear_wheels_names", naming(NamedEntity::Joint))]
        rear_wheels_names: Vec<String>,
        /// Joints of the front wheels, before Rolling (default none).
        #[param("front_wheels_names", naming(NamedEntity::Joint))]
        front_wheels_names: Vec<String>,
        /// Joints whose states are read for the rear wheels (default those).
        #[param("rear_wheels_state_names", naming(NamedEntity::Joint))]
        rear_wheels_state_names: Vec<String>,
        /// Joints whose states are read for the front wheels (default those).
        #[param("front_wheels_state_names", naming(NamedEntity::Joint))]
        front_wheels_state_names: Vec<String>,
        /// Computes odometry from commands instead of the wheels (default false).
        #[param("open_loop")]
        open_loop: bool = false,
        /// Drives slowly until the steering has reached its angle (default false).
        #[param("reduce_wheel_speed_until_steering_reached")]
        reduce_wheel_speed_until_steering_reached: bool = false,
        /// Number of updates in the mean velocity (default 10).
        #[param("velocity_rolling_window_size", min(1.0))]
        velocity_rolling_window_size: usize = 10,
        /// Frame of the robot (default `base_link`).
        #[param("base_frame_id", naming(NamedEntity::Frame))]
        base_frame_id: String = "base_link",
        /// Frame of the odometry (default `odom`).
        #[param("odom_frame_id", naming(NamedEntity::Frame))]
        odom_frame_id: String = "odom",
        /// Publishes the transform of the odometry on `~/tf_odometry` (default true).
        #[param("enable_odom_tf")]
        enable_odom_tf: bool = true,
        /// Prefix of the frame names, after Jazzy (default none).
        #[param("tf_frame_prefix")]
        tf_frame_prefix: String = "",
        /// Variances of the velocity: x, y, z, roll, pitch, yaw.
        #[param("twist_covariance_diagonal")]
        twist_covariance_diagonal: Vec<f64> = "0 7 14 21 28 35",
        /// Variances of the pose: x, y, z, roll, pitch, yaw.
        #[param("pose_covariance_diagonal")]
        pose_covariance_diagonal: Vec<f64> = "0 7 14 21 28 35",
        /// Computes odometry from wheel angles, not speeds (default false).
        #[param("position_feedback")]
        position_feedback: bool = false,
        /// Receives `TwistStamped`; false for `Twist` on `~/reference_unstamped`, in Humble (default
        /// false in Humble).
        #[param("use_stamped_vel")]
        use_stamped_vel: Option<bool>,
        /// Distance between the axles (default 0).
        #[param("wheelbase", unit("m"))]
        wheelbase_m: f64 = 0,
        /// Radius of the driven wheels (default 0).
        #[param("traction_wheels_radius", unit("m"), also(&["traction_wheel_radius"]))]
        traction_wheels_radius_m: f64 = 0,
        /// Radius of the rear wheels, before Rolling (default 0).
        #[param("rear_wheels_radius", unit("m"), also(&["rear_wheel_radius"]))]
        rear_wheels_radius_m: f64 = 0,
        /// Radius of the front wheels, before Rolling (default 0).
        #[param("front_wheels_radius", unit("m"), also(&["front_wheel_radius"]))]
        front_wheels_radius_m: f64 = 0,
        /// Distance between the driven wheels (default 0).
        #[param("traction_track_width", unit("m"), also(&["wheel_track"]))]
        traction_track_width_m: f64 = 0,
        /// Distance between the steered wheels (default 0).
        #[param("steering_track_width", unit("m"))]
        steering_track_width_m: f64 = 0,
        /// Distance between the rear wheels, before Rolling (default 0).
        #[param("rear_wheel_track", unit("m"))]
        rear_wheel_track_m: f64 = 0,
        /// Distance between the front wheels, before Rolling (default 0).
        #[param("front_wheel_track", unit("m"))]
        front_wheel_track_m: f64 = 0,
    }
}

params! {
    /// Drive with one wheel that is steered and driven.
    #[table(TRICYCLE, "tricycle_controller")]
    pub struct TricycleParams {
        /// Joint that drives the wheel.
        #[param("traction_joint_name", naming(NamedEntity::Joint))]
        traction_joint_name: String = "",
        /// Joint that steers the wheel.
        #[param("steering_joint_name", naming(NamedEntity::Joint))]
        steering_joint_name: String = "",
        /// Distance from the wheel to the axle of the others (default 0).
        #[param("wheelbase", unit("m"))]
        wheelbase_m: f64 = 0,
        /// Radius of the wheel (default 0).
        #[param("wheel_radius", unit("m"))]
        wheel_radius_m: f64 = 0,
        /// Frame of the odometry (default `odom`).
        #[param("odom_frame_id", naming(NamedEntity::Frame))]
        odom_frame_id: String = "odom",
        /// Frame of the robot (default `base_link`).
        #[param("base_frame_id", naming(NamedEntity::Frame))]
        base_frame_id: String = "base_link",
        /// Publishes `~/cmd_ackermann` (default false).
        #[param("publish_ackermann_command")]
        publish_ackermann_command: bool = false,
        /// Computes odometry from commands instead of the wheel (default false).
        #[param("open_loop")]
        open_loop: bool = false,
        /// Publishes the transform of the odometry (default false).
        #[param("enable_odom_tf")]
        enable_odom_tf: bool = false,
        /// Publishes odometry without a pose (default false).
        #[param("odom_only_twist")]
        odom_only_twist: bool = false,
        /// Variances of the pose: x, y, z, roll, pitch, yaw (default 0).
        #[param("pose_covariance_diagonal")]
        pose_covariance_diagonal: Vec<f64> = "0 0 0 0 0 0",
        /// Variances of the velocity: x, y, z, roll, pitch, yaw (default 0).
        #[param("twist_covariance_diagonal")]
        twist_covariance_diagonal: Vec<f64> = "0 0 0 0 0 0",
        /// Number of updates in the mean velocity (default 10).
        #[param("velocity_rolling_window_size", min(1.0))]
        velocity_rolling_window_size: usize = 10,
        /// Maximum age of a command (default 500).
        #[param("cmd_vel_timeout", unit("ms"))]
        cmd_vel_timeout_ms: i64 = 500,
        /// Receives `TwistStamped`; false for `Twist`, in Humble (default true).
        #[param("use_stamped_vel")]
        use_stamped_vel: bool = true,
        /// Maximum wheel speed (default none).
        #[param("traction.max_velocity", unit("rad/s"))]
        traction_max_velocity: Option<f64>,
        /// Minimum wheel speed (default 0).
        #[param("traction.min_velocity", unit("rad/s"))]
        traction_min_velocity: Option<f64>,
        /// Maximum rate of a growing wheel speed (default none).
        #[param("traction.max_acceleration", unit("rad/s²"))]
        traction_max_acceleration: Option<f64>,
        /// Minimum rate of a growing wheel speed (default 0).
        #[param("traction.min_acceleration", unit("rad/s²"))]
        traction_min_acceleration: Option<f64>,
        /// Maximum rate of a falling wheel speed (default none).
        #[param("traction.max_deceleration", unit("rad/s²"))]
        traction_max_deceleration: Option<f64>,
        /// Minimum rate of a falling wheel speed (default 0).
        #[param("traction.min_deceleration", unit("rad/s²"))]
        traction_min_deceleration: Option<f64>,
        /// Maximum jerk of the wheel speed (default none).
        #[param("traction.max_jerk", unit("rad/s³"))]
        traction_max_jerk: Option<f64>,
        /// Minimum jerk of the wheel speed (default 0).
        #[param("traction.min_jerk", unit("rad/s³"))]
        traction_min_jerk: Option<f64>,
        /// Maximum steering angle (default none).
        #[param("steering.max_position", unit("rad"))]
        steering_max_position: Option<f64>,
        /// Minimum steering angle (default the negative maximum).
        #[param("steering.min_position", unit("rad"))]
        steering_min_position: Option<f64>,
        /// Maximum steering rate (default none).
        #[param("steering.max_velocity", unit("rad/s"))]
        steering_max_velocity: Option<f64>,
        /// Minimum steering rate (default 0).
        #[param("steering.min_velocity", unit("rad/s"))]
        steering_min_velocity: Option<f64>,
        /// Maximum steering acceleration (default none).
        #[param("steering.max_acceleration", unit("rad/s²"))]
        steering_max_acceleration: Option<f64>,
        /// Minimum steering acceleration (default 0).
        #[param("steering.min_acceleration", unit("rad/s²"))]
        steering_min_acceleration: Option<f64>,
    }
}
