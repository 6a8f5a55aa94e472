//! Parameters of the controllers of joints, and of the broadcasters.

use periplus_params::{NamedEntity, params};

params! {
    /// Publisher of joint states.
    #[table(JOINT_STATE_BROADCASTER, "joint_state_broadcaster")]
    pub struct JointStateBroadcasterParams {
        /// Publishes below `~/` (default false).
        #[param("use_local_topics")]
        use_local_topics: bool = false,
        /// Publishes all interfaces on `dynamic_joint_states` (default true).
        #[param("publish_dynamic_joint_states")]
        publish_dynamic_joint_states: bool = true,
        /// Joints to publish; with `interfaces` only those (default all).
        #[param("joints", naming(NamedEntity::Joint))]
        joints: Vec<String>,
        /// Joints without hardware, published at zero (default none).
        #[param("extra_joints")]
        extra_joints: Vec<String>,
        /// Interfaces to publish (default all).
        #[param("interfaces")]
        interfaces: Vec<String>,
        /// Interface whose value is the position (default `position`).
        #[param("map_interface_to_joint_state.position")]
        map_position: String = "position",
        /// Interface whose value is the velocity (default `velocity`).
        #[param("map_interface_to_joint_state.velocity")]
        map_velocity: String = "velocity",
        /// Interface whose value is the effort (default `effort`).
        #[param("map_interface_to_joint_state.effort")]
        map_effort: String = "effort",
        /// Publishes only joints of the robot's description (default true).
        #[param("use_urdf_to_filter")]
        use_urdf_to_filter: bool = true,
        /// Frame of the messages (default `base_link`).
        #[param("frame_id", naming(NamedEntity::Frame))]
        frame_id: String = "base_link",
        /// Rate of the messages, in ROS 1 (default 50).
        #[param("publish_rate", unit("Hz"))]
        publish_rate_hz: f64 = 50,
    }
}

params! {
    /// Publisher of an inertial sensor.
    #[table(IMU_BROADCASTER, "imu_sensor_broadcaster")]
    pub struct ImuBroadcasterParams {
        /// Name of the sensor.
        #[param("sensor_name")]
        sensor_name: String = "",
        /// Frame of the messages.
        #[param("frame_id", naming(NamedEntity::Frame))]
        frame_id: String = "",
        /// Covariance of the orientation, by rows (default 0).
        #[param("static_covariance_orientation")]
        static_covariance_orientation: Vec<f64> = "0 0 0 0 0 0 0 0 0",
        /// Covariance of the angular velocity, by rows (default 0).
        #[param("static_covariance_angular_velocity")]
        static_covariance_angular_velocity: Vec<f64> = "0 0 0 0 0 0 0 0 0",
        /// Covariance of the linear acceleration, by rows (default 0).
        #[param("static_covariance_linear_acceleration")]
        static_covariance_linear_acceleration: Vec<f64> = "0 0 0 0 0 0 0 0 0",
    }
}

params! {
    /// Commands forwarded to one interface of several joints.
    #[table(FORWARD_COMMAND, "forward_command_controller")]
    pub struct ForwardCommandParams {
        /// Joints.
        #[param("joints", naming(NamedEntity::Joint))]
        joints: Vec<String>,
        /// Interface; the groups for positions, velocities and efforts have their own.
        #[param("interface_name")]
        interface_name: String = "",
    }
}

params! {
    /// Controller of one joint of ROS 1.
    #[table(SINGLE_JOINT, "joint controller")]
    pub struct SingleJointParams {
        /// Joint.
        #[param("joint", naming(NamedEntity::Joint))]
        joint: String = "",
        /// Proportional gain (default 0).
        #[param("pid.p")]
        p: f64 = 0,
        /// Integral gain (default 0).
        #[param("pid.i")]
        i: f64 = 0,
        /// Derivative gain (default 0).
        #[param("pid.d")]
        d: f64 = 0,
        /// Maximum of the integral term; 0 for none (default 0).
        #[param("pid.i_clamp")]
        i_clamp: f64 = 0,
    }
}

params! {
    /// Follower of joint trajectories.
    #[table(JOINT_TRAJECTORY, "joint_trajectory_controller")]
    pub struct JointTrajectoryParams {
        /// Joints of the trajectories.
        #[param("joints", naming(NamedEntity::Joint))]
        joints: Vec<String>,
        /// Joints that are commanded (default those of the trajectories).
        #[param("command_joints", naming(NamedEntity::Joint))]
        command_joints: Vec<String>,
        /// Commanded interfaces: `position`, `velocity`, `effort`.
        #[param("command_interfaces")]
        command_interfaces: Vec<String>,
        /// Interfaces that are read: `position`, `velocity`.
        #[param("state_interfaces")]
        state_interfaces: Vec<String>,
        /// Accepts trajectories of some of the joints (default false).
        #[param("allow_partial_joints_goal")]
        allow_partial_joints_goal: bool = false,
        /// Begins a trajectory at the last command, before Rolling (default false).
        #[param("open_loop_control")]
        open_loop_control: bool = false,
        /// Begins a trajectory at the last command, since Jazzy (default false).
        #[param("interpolate_from_desired_state")]
        interpolate_from_desired_state: bool = false,
        /// Accepts points without positions (default false).
        #[param("allow_integration_in_goal_trajectories")]
        allow_integration_in_goal_trajectories: bool = false,
        /// Rate of `~/state`, in Humble (default 50).
        #[param("state_publish_rate", unit("Hz"))]
        state_publish_rate_hz: f64 = 50,
        /// Rate of the feedback of a goal (default 20).
        #[param("action_monitor_rate", unit("Hz"))]
        action_monitor_rate_hz: f64 = 20,
        /// Interpolation: `splines` or `none` (default `splines`).
        #[param("interpolation_method")]
        interpolation_method: String = "splines",
        /// Accepts a velocity at the last point (default true in Humble, else false).
        #[param("allow_nonzero_velocity_at_trajectory_end")]
        allow_nonzero_velocity_at_trajectory_end: Option<bool>,
        /// Maximum age of a command; no effect.
        #[param("cmd_timeout", unit("s"))]
        _: f64 = 0,
        /// Largest speed at the end that counts as zero (default 0.01).
        #[param("constraints.stopped_velocity_tolerance")]
        stopped_velocity_tolerance: f64 = 0.01,
        /// Time after the end within which the goal must be reached; 0 for none (default 0).
        #[param("constraints.goal_time", unit("s"))]
        goal_time_s: f64 = 0,
    }
}

params! {
    /// Tolerances of a joint.
    #[table(JOINT_CONSTRAINTS, "constraints")]
    pub struct JointConstraintParams {
        /// Maximum position error on the path; 0 for none (default 0).
        #[param("trajectory")]
        trajectory: f64 = 0,
        /// Maximum position error at the end; 0 for none (default 0).
        #[param("goal")]
        goal: f64 = 0,
    }
}

params! {
    /// Gains of a joint.
    #[table(JOINT_GAINS, "gains")]
    pub struct JointGainParams {
        /// Proportional gain (default 0).
        #[param("p")]
        p: f64 = 0,
        /// Integral gain (default 0).
        #[param("i")]
        i: f64 = 0,
        /// Derivative gain (default 0).
        #[param("d")]
        d: f64 = 0,
        /// Maximum of the integral term (default none).
        #[param("i_clamp")]
        i_clamp: Option<f64>,
        /// Part of the desired velocity that is added (default 0).
        #[param("ff_velocity_scale")]
        ff_velocity_scale: f64 = 0,
        /// Takes the shorter direction, in Humble (default as the joint).
        #[param("angle_wraparound")]
        angle_wraparound: Option<bool>,
    }
}
