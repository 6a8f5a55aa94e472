//! Parameters with the names and defaults of Nav2 (main).
//!
//! Sources: `nav2_velocity_smoother`, `nav2_collision_monitor`, `nav2_behaviors` (2026-08).

use periplus_costmap::Nav2Release;
use periplus_params::{NamedEntity, params};

use crate::velocity_smoother::VelocityFeedback;

params! {
    /// Parameters of every node of this package.
    pub struct MotionNodeParams {
        /// Uses the time of `/clock`.
        #[param("use_sim_time")]
        use_sim_time: bool = false,
        /// Publishes and receives TwistStamped instead of Twist; default: true from Kilted on.
        #[param("enable_stamped_cmd_vel")]
        enable_stamped_cmd_vel: Option<bool>,
        /// Period of the heartbeats to a lifecycle manager; no bond if not positive.
        #[param("bond_heartbeat_period", unit("s"))]
        bond_heartbeat_period_s: f64 = 0.1,
        /// Unused; threads have no priorities here.
        #[param("use_realtime_priority")]
        _: bool = false,
        /// Unused; service introspection is not supported.
        #[param("service_introspection_mode")]
        _: String = "disabled",
        /// Unused; nodes are activated by a lifecycle manager or by the launch file.
        #[param("autostart_node")]
        _: bool = false,
        /// Allows parameters to set QoS.
        #[param("allow_parameter_qos_overrides")]
        _: bool = true,
        /// Release of Nav2 whose behaviour and messages are used where releases differ.
        #[param("compat")]
        compat: Nav2Release = "main",
    }
}

params! {
    /// Limits of the velocity and its changes.
    #[table(VELOCITY_SMOOTHER, "the velocity smoother")]
    pub struct VelocitySmootherParams {
        /// Parameters of every node.
        #[shared]
        node: MotionNodeParams,
        /// Rate of the output.
        #[param("smoothing_frequency", unit("Hz"), above(0.0))]
        smoothing_frequency_hz: f64 = 20,
        /// Velocity from which the next command is computed.
        #[param("feedback")]
        feedback: VelocityFeedback = "OPEN_LOOP",
        /// Scales all components by one factor, so that the direction of the change is kept.
        #[param("scale_velocities")]
        scale_velocities: bool = false,
        /// Maximum velocity: x, y [m/s], theta [rad/s]; or x, y, z, roll, pitch, yaw.
        #[param("max_velocity")]
        max_velocity: Vec<f64> = "0.5 0.0 2.5",
        /// Minimum velocity, 0 or less.
        #[param("min_velocity")]
        min_velocity: Vec<f64> = "-0.5 0.0 -2.5",
        /// Maximum acceleration, 0 or more.
        #[param("max_accel")]
        max_accel: Vec<f64> = "2.5 0.0 3.2",
        /// Maximum deceleration, 0 or less.
        #[param("max_decel")]
        max_decel: Vec<f64> = "-2.5 0.0 -3.2",
        /// Speed below which 0 is published.
        #[param("deadband_velocity")]
        deadband_velocity: Vec<f64> = "0.0 0.0 0.0",
        /// Topic of the odometry, for CLOSED_LOOP.
        #[param("odom_topic", naming(NamedEntity::Topic))]
        odom_topic: String = "odom",
        /// Time over which the odometry is averaged.
        #[param("odom_duration", unit("s"), min(0.0))]
        odom_duration_s: f64 = 0.1,
        /// Age of a command after which the robot is stopped.
        #[param("velocity_timeout", unit("s"), min(0.0))]
        velocity_timeout_s: f64 = 1,
        /// Stamps the output with the present time (Jazzy); other releases have a fixed rule.
        #[param("stamp_smoothed_velocity_with_smoothing_time")]
        stamps_present_time: bool = false,
    }
}

params! {
    /// Parameters of collision monitor and collision detector.
    pub struct MonitorCommonParams {
        /// Parameters of every node.
        #[shared]
        node: MotionNodeParams,
        /// Names of the zones, in order.
        #[param("polygons")]
        polygons: Vec<String> = "",
        /// Names of the sources.
        #[param("observation_sources")]
        observation_sources: Vec<String> = "",
        /// Base frame of the robot.
        #[param("base_frame_id", naming(NamedEntity::Frame))]
        base_frame_id: String = "base_footprint",
        /// Frame in which the robot moves smoothly.
        #[param("odom_frame_id", naming(NamedEntity::Frame))]
        odom_frame_id: String = "odom",
        /// Maximum age of transforms.
        #[param("transform_tolerance", unit("s"), min(0.0))]
        transform_tolerance_s: f64 = 0.1,
        /// Age of the data of a source after which it is invalid; 0 for no limit.
        #[param("source_timeout", unit("s"), min(0.0))]
        source_timeout_s: f64 = 2,
        /// Moves points by the motion of the robot since their time.
        #[param("base_shift_correction")]
        base_shift_correction: bool = true,
        /// Publishes the heights of points in markers.
        #[param("collision_points_marker_3d")]
        collision_points_marker_3d: bool = false,
    }
}

params! {
    /// Reduction of velocities near obstacles.
    #[table(COLLISION_MONITOR, "the collision monitor")]
    pub struct CollisionMonitorParams {
        /// Parameters of collision monitor and collision detector.
        #[shared]
        common: MonitorCommonParams,
        /// Topic of the commands; default: `cmd_vel_smoothed`, in Humble `cmd_vel_raw`.
        #[param("cmd_vel_in_topic", naming(NamedEntity::Topic))]
        cmd_vel_in_topic: Option<String>,
        /// Topic of the allowed velocities.
        #[param("cmd_vel_out_topic", naming(NamedEntity::Topic))]
        cmd_vel_out_topic: String = "cmd_vel",
        /// Topic of the state; empty for none.
        #[param("state_topic", naming(NamedEntity::Topic))]
        state_topic: String = "",
        /// Time for which zeros are published after the robot was stopped.
        #[param("stop_pub_timeout", unit("s"), min(0.0))]
        stop_pub_timeout_s: f64 = 1,
        /// Enables the zones at the start; `~/toggle` changes it.
        #[param("enabled")]
        is_enabled: bool = true,
    }
}

params! {
    /// Report of the zones with points.
    #[table(COLLISION_DETECTOR, "the collision detector")]
    pub struct CollisionDetectorParams {
        /// Parameters of collision monitor and collision detector.
        #[shared]
        common: MonitorCommonParams,
        /// Rate of the reports.
        #[param("frequency", unit("Hz"), above(0.0))]
        frequency_hz: f64 = 10,
    }
}

params! {
    /// A zone around the robot.
    #[table(MONITOR_ZONE, "a polygon of the collision monitor")]
    pub struct MonitorZoneParams {
        /// Shape: polygon, circle or velocity_polygon.
        #[param("type", required())]
        shape_type: String,
        /// Action: stop, slowdown, limit, approach or none.
        #[param("action_type", required())]
        action_type: String,
        /// Corners in the base frame, `[[x, y], ...]`.
        #[param("points")]
        points: String = "",
        /// Radius of a circle.
        #[param("radius", unit("m"), min(0.0))]
        radius_m: Option<f64>,
        /// Enables the zone.
        #[param("enabled")]
        is_enabled: bool = true,
        /// Number of points inside that trigger it.
        #[param("min_points", min(0.0))]
        min_points: i64 = 4,
        /// Old name with another meaning: more points than this trigger it.
        #[param("max_points", min(0.0))]
        max_points: Option<i64>,
        /// Number of consecutive evaluations that trigger it.
        #[param("trigger_consecutive_points", min(1.0))]
        trigger_consecutive_points: i64 = 1,
        /// Number of consecutive evaluations that release it.
        #[param("release_consecutive_points", min(1.0))]
        release_consecutive_points: i64 = 1,
        /// Factor of a slowdown.
        #[param("slowdown_ratio")]
        slowdown_ratio: f64 = 0.5,
        /// Maximum linear speed of a limit.
        #[param("linear_limit", unit("m/s"))]
        linear_limit_m_s: f64 = 0.5,
        /// Maximum angular speed of a limit.
        #[param("angular_limit", unit("rad/s"))]
        angular_limit_rad_s: f64 = 0.5,
        /// Time before a collision from which an approach slows down.
        #[param("time_before_collision", unit("s"), above(0.0))]
        time_before_collision_s: f64 = 2,
        /// Step of the simulated motion of an approach.
        #[param("simulation_time_step", unit("s"), above(0.0))]
        simulation_time_step_s: f64 = 0.1,
        /// Publishes the shape.
        #[param("visualize")]
        visualize: bool = false,
        /// Topic of the published shape; default: the name of the zone.
        #[param("polygon_pub_topic", naming(NamedEntity::Topic))]
        polygon_pub_topic: Option<String>,
        /// Topic from which the shape is received.
        #[param("polygon_sub_topic", naming(NamedEntity::Topic))]
        polygon_sub_topic: Option<String>,
        /// Receives a shape that was published earlier.
        #[param("polygon_subscribe_transient_local")]
        polygon_subscribe_transient_local: bool = false,
        /// Topic of the footprint, for an approach without points.
        #[param("footprint_topic", naming(NamedEntity::Topic))]
        footprint_topic: String = "local_costmap/published_footprint",
        /// Sources whose points count; default: all.
        #[param("sources_names")]
        sources_names: Option<Vec<String>>,
        /// Names of the parts of a velocity_polygon, in order.
        #[param("velocity_polygons")]
        velocity_polygons: Vec<String> = "",
        /// Parts of a velocity_polygon depend on speed and direction instead of the x velocity.
        #[param("holonomic")]
        is_holonomic: bool = false,
    }
}

params! {
    /// A polygon for a range of velocities.
    #[table(VELOCITY_PART, "a part of a velocity polygon")]
    pub struct VelocityPartParams {
        /// Corners in the base frame, `[[x, y], ...]`.
        #[param("points", required())]
        points: String,
        /// Minimum linear velocity.
        #[param("linear_min", unit("m/s"), required())]
        linear_min_m_s: f64,
        /// Maximum linear velocity.
        #[param("linear_max", unit("m/s"), required())]
        linear_max_m_s: f64,
        /// Minimum angular velocity.
        #[param("theta_min", unit("rad/s"), required())]
        theta_min_rad_s: f64,
        /// Maximum angular velocity.
        #[param("theta_max", unit("rad/s"), required())]
        theta_max_rad_s: f64,
        /// First direction of travel of a holonomic robot.
        #[param("direction_start_angle", unit("rad"))]
        direction_start_rad: f64 = -3.141592653589793,
        /// Last direction of travel of a holonomic robot.
        #[param("direction_end_angle", unit("rad"))]
        direction_end_rad: f64 = 3.141592653589793,
    }
}

params! {
    /// A source of points.
    #[table(MONITOR_SOURCE, "a source of the collision monitor")]
    pub struct MonitorSourceParams {
        /// Type: scan, pointcloud, range, polygon or costmap.
        #[param("type")]
        source_type: String = "scan",
        /// Topic.
        #[param("topic", naming(NamedEntity::Topic))]
        topic: String = "scan",
        /// Enables the source.
        #[param("enabled")]
        is_enabled: bool = true,
        /// Age of the data after which the source is invalid; default: that of the node.
        #[param("source_timeout", unit("s"), min(0.0))]
        source_timeout_s: Option<f64>,
        /// Names of exclusion zones, in which points are ignored.
        #[param("exclusion_zones")]
        exclusion_zones: Vec<String> = "",
        /// Minimum height of points of a cloud, in the base frame.
        #[param("min_height", unit("m"))]
        min_height_m: f64 = 0.05,
        /// Maximum height of points of a cloud, in the base frame.
        #[param("max_height", unit("m"))]
        max_height_m: f64 = 0.5,
        /// Minimum distance of points of a cloud from the sensor.
        #[param("min_range", unit("m"))]
        min_range_m: f64 = 0,
        /// Takes heights from the field `height` of a cloud.
        #[param("use_global_height")]
        use_global_height: bool = false,
        /// Transport of clouds; only `raw` is supported.
        #[param("transport_type")]
        transport_type: String = "raw",
        /// Angle between the points of a range reading; default: one degree.
        #[param("obstacles_angle", unit("rad"), above(0.0))]
        obstacles_angle_rad: f64 = 0.017453292519943295,
        /// Distance between the points of a polygon.
        #[param("sampling_distance", unit("m"), above(0.0))]
        sampling_distance_m: f64 = 0.1,
        /// Minimum cost of the cells of a costmap that are obstacles.
        #[param("cost_threshold", within(0.0, 255.0))]
        cost_threshold: i64 = 253,
        /// Treats unknown cells of a costmap as obstacles.
        #[param("treat_unknown_as_obstacle")]
        treat_unknown_as_obstacle: bool = true,
    }
}

params! {
    /// An area in which points are ignored.
    #[table(EXCLUSION_ZONE, "an exclusion zone")]
    pub struct ExclusionZoneParams {
        /// Enables the zone.
        #[param("enabled")]
        is_enabled: bool = false,
        /// Publishes the shape.
        #[param("visualize")]
        visualize: bool = false,
        /// Frame of the shape; default: the base frame.
        #[param("frame_id", naming(NamedEntity::Frame))]
        frame_id: String = "",
        /// Time for which the last pose of the frame is used.
        #[param("frame_hold_timeout", unit("s"), min(0.0))]
        frame_hold_timeout_s: f64 = 0,
        /// Minimum height of ignored points, in the base frame; default: no limit.
        #[param("min_height", unit("m"))]
        min_height_m: Option<f64>,
        /// Maximum height of ignored points, in the base frame; default: no limit.
        #[param("max_height", unit("m"))]
        max_height_m: Option<f64>,
        /// Shape: polygon or circle.
        #[param("type")]
        shape_type: String = "polygon",
        /// Radius of a circle.
        #[param("radius", unit("m"))]
        radius_m: f64 = -1,
        /// Corners, `[[x, y], ...]`.
        #[param("points")]
        points: String = "",
    }
}

params! {
    /// Recovery motions.
    #[table(BEHAVIOR_SERVER, "the behavior server")]
    pub struct BehaviorServerParams {
        /// Parameters of every node.
        #[shared]
        node: MotionNodeParams,
        /// Names of the behaviors, which are the names of their actions.
        #[param("behavior_plugins")]
        behavior_plugins: Vec<String> = "spin backup drive_on_heading wait",
        /// Rate at which behaviors publish velocities.
        #[param("cycle_frequency", unit("Hz"), above(0.0))]
        cycle_frequency_hz: f64 = 10,
        /// Frame in which motions are measured; Humble uses `global_frame`.
        #[param("local_frame", naming(NamedEntity::Frame))]
        local_frame: String = "odom",
        /// Global frame; default: map, in Humble odom.
        #[param("global_frame", naming(NamedEntity::Frame))]
        global_frame: Option<String>,
        /// Base frame of the robot.
        #[param("robot_base_frame", naming(NamedEntity::Frame))]
        robot_base_frame: String = "base_link",
        /// Maximum age of the pose of the robot.
        #[param("transform_tolerance", unit("s"), min(0.0))]
        transform_tolerance_s: f64 = 0.1,
        /// Topic of the local costmap.
        #[param("local_costmap_topic", naming(NamedEntity::Topic), also(&["costmap_topic"]))]
        local_costmap_topic: String = "local_costmap/costmap_raw",
        /// Topic of the local footprint.
        #[param("local_footprint_topic", naming(NamedEntity::Topic), also(&["footprint_topic"]))]
        local_footprint_topic: String = "local_costmap/published_footprint",
        /// Topic of the global costmap; no behavior uses it.
        #[param("global_costmap_topic")]
        _: String = "global_costmap/costmap_raw",
        /// Topic of the global footprint; no behavior uses it.
        #[param("global_footprint_topic")]
        _: String = "global_costmap/published_footprint",
        /// Time for which motions are checked for collisions.
        #[param("simulate_ahead_time", unit("s"), min(0.0))]
        simulate_ahead_time_s: f64 = 2,
        /// Maximum speed of a spin.
        #[param("max_rotational_vel", unit("rad/s"), min(0.0))]
        max_rotational_vel_rad_s: f64 = 1,
        /// Minimum speed of a spin.
        #[param("min_rotational_vel", unit("rad/s"), min(0.0))]
        min_rotational_vel_rad_s: f64 = 0.4,
        /// Deceleration of a spin.
        #[param("rotational_acc_lim", unit("rad/s^2"), min(0.0))]
        rotational_acc_lim_rad_s2: f64 = 3.2,
        /// Time for which the motion of a teleoperated robot is simulated.
        #[param("projection_time", unit("s"), min(0.0))]
        projection_time_s: f64 = 1,
        /// Step of that simulation.
        #[param("simulation_time_step", unit("s"), min(0.0))]
        simulation_time_step_s: f64 = 0.1,
        /// Topic of the commands of an assisted teleoperation.
        #[param("cmd_vel_teleop", naming(NamedEntity::Topic))]
        cmd_vel_teleop: String = "cmd_vel_teleop",
        /// Time for which the results of actions are kept.
        #[param("action_server_result_timeout", unit("s"), min(0.0))]
        action_server_result_timeout_s: f64 = 10,
    }
}

params! {
    /// A behavior.
    #[table(BEHAVIOR, "a behavior")]
    pub struct BehaviorParams {
        /// Class, such as `nav2_behaviors::Spin`.
        #[param("plugin")]
        plugin: String = "",
        /// Acceleration of a drive; default: 2.5, in Humble none, unused in Jazzy.
        #[param("acceleration_limit", unit("m/s^2"))]
        acceleration_limit_m_s2: Option<f64>,
        /// Deceleration of a drive, negative; default: -2.5, in Humble none, unused in Jazzy.
        #[param("deceleration_limit", unit("m/s^2"))]
        deceleration_limit_m_s2: Option<f64>,
        /// Minimum speed of a drive; default: 0.1, in Humble 0, unused in Jazzy.
        #[param("minimum_speed", unit("m/s"), min(0.0))]
        minimum_speed_m_s: Option<f64>,
    }
}

#[cfg(test)]
mod tests {
    use periplus_params::Table;

    use super::*;

    #[test]
    fn tables_are_consistent() {
        let tables: [&'static Table; 9] = [
            &VELOCITY_SMOOTHER,
            &COLLISION_MONITOR,
            &COLLISION_DETECTOR,
            &MONITOR_ZONE,
            &VELOCITY_PART,
            &MONITOR_SOURCE,
            &EXCLUSION_ZONE,
            &BEHAVIOR_SERVER,
            &BEHAVIOR,
        ];
        for table in tables {
            assert_eq!(table.faults(), Vec::<String>::new());
        }
    }
}
