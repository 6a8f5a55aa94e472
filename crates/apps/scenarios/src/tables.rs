//! Declarations of all parts of a scenario file: the reader, the JSON schema and the documentation use them.

use periplus_params::{Table, param_choice, params};

param_choice! {
    /// Kind of motion of a scenario.
    pub enum ScenarioPhysics {
        /// Masses, forces, contacts.
        #[default]
        Rigid = "rigid",
        /// Exactly as commanded, without contacts; several times as fast.
        Kinematic = "kinematic",
    }
}

param_choice! {
    /// Base of a robot, for the default parameters of navigation.
    pub enum ScenarioBase {
        /// Two driven wheels, tracks, or four wheels that slip.
        #[default]
        Differential = "differential",
        /// In all directions.
        Omni = "omni",
        /// As a car.
        Ackermann = "ackermann",
    }
}

param_choice! {
    /// Statistic of an error over a run.
    pub enum ErrorStatistic {
        /// Largest value.
        #[default]
        Max = "max",
        /// Root of the mean of the squares.
        Rms = "rms",
        /// Mean value.
        Mean = "mean",
    }
}

params! {
    /// A scenario: a world, a robot, nodes, events, faults and assertions.
    #[table(SCENARIO, "scenario")]
    pub struct ScenarioParams {
        /// Name (default: that of the file).
        #[param("name")]
        name: Option<String>,
        /// Purpose of the scenario.
        #[param("description")]
        description: Option<String>,
        /// World file, relative to the scenario file or the working folder.
        #[param("world", required())]
        world: String,
        /// Seed of all noise and faults.
        #[param("seed", min(0.0))]
        seed: i64 = 0,
        /// Kind of motion.
        #[param("physics")]
        physics: ScenarioPhysics = "rigid",
        /// End of the run in simulated time. A run with goals ends earlier, when all goals have ended.
        #[param("timeout", unit("s"), within(0.1, 86400.0))]
        timeout_s: f64 = 60,
        /// Region of the true map: smallest x, smallest y, largest x, largest y (default: 8 m around start and
        /// goals).
        #[param("region", unit("m"))]
        region_m: Vec<f64>,
    }
}

params! {
    /// The robot.
    #[table(ROBOT, "robot")]
    pub struct ScenarioRobotParams {
        /// URDF, xacro or SDF file of the robot, relative to the scenario file or the working folder.
        #[param("file", required())]
        file: String,
        /// Pose at the start: x \[m\], y \[m\], and yaw \[rad\] (default 0).
        #[param("pose")]
        pose: Vec<f64> = "0 0 0",
    }
}

params! {
    /// SLAM, as `slam_toolbox` does it: publishes `/map` and localizes in it.
    #[table(SLAM, "slam")]
    pub struct ScenarioSlamParams {
        /// Parameter file of `slam_toolbox` or `slam_gmapping` (default: default parameters).
        #[param("parameters")]
        parameters: Option<String>,
    }
}

params! {
    /// Localization on a map: `map_server` and `amcl`.
    #[table(LOCALIZATION, "localization")]
    pub struct ScenarioLocalizationParams {
        /// YAML file of the map, or `truth` for the true map of the world.
        #[param("map")]
        map: String = "truth",
        /// Pose of the robot in the map at the start (default: the true pose): x \[m\], y \[m\], yaw \[rad\].
        #[param("initial_pose")]
        initial_pose: Vec<f64>,
        /// Parameter file of `amcl`.
        #[param("parameters")]
        parameters: Option<String>,
    }
}

params! {
    /// Costmaps beside the robot.
    #[table(COSTMAPS, "costmaps")]
    pub struct ScenarioCostmapParams {
        /// Parameter file of Nav2 (default: both costmaps with default parameters).
        #[param("parameters")]
        parameters: Option<String>,
    }
}

params! {
    /// The servers of Nav2: planner, controller, behaviors, navigator.
    #[table(NAVIGATION, "navigation")]
    pub struct ScenarioNavigationParams {
        /// Parameter file of Nav2 (default: default parameters for the robot).
        #[param("parameters")]
        parameters: Option<String>,
        /// Base of the robot, for the default parameters.
        #[param("base")]
        base: ScenarioBase = "differential",
        /// Maximum speed, for the default parameters.
        #[param("max_speed", unit("m/s"), above(0.0))]
        max_speed_m_s: f64 = 0.5,
        /// Maximum turn rate, for the default parameters.
        #[param("max_turn_rate", unit("rad/s"), above(0.0))]
        max_turn_rate_rad_s: f64 = 1.9,
        /// Smallest radius of a turn, for the base `ackermann`.
        #[param("min_turning_radius", unit("m"), above(0.0))]
        min_turning_radius_m: f64 = 0.5,
    }
}

/// Tables of the nodes.
pub static NODES: [&Table; 4] = [&SLAM, &LOCALIZATION, &COSTMAPS, &NAVIGATION];

params! {
    /// Time or condition of an event. Without one, a goal follows the goal before it, and anything else happens at the
    /// start.
    #[table(TRIGGER, "event")]
    pub struct TriggerParams {
        /// Name of the event, for `after`.
        #[param("name")]
        name: Option<String>,
        /// Simulated time.
        #[param("at", unit("s"), min(0.0))]
        at_s: Option<f64>,
        /// Circle: the robot enters a circle about x, y with a radius (default 0.5).
        #[param("near", unit("m"))]
        near_m: Vec<f64>,
        /// Topic: a message is published on it.
        #[param("on")]
        on: Option<String>,
        /// Number of the message for `on`.
        #[param("count", min(1.0))]
        count: usize = 1,
        /// Name of another event that has happened; for a goal, that has ended.
        #[param("after")]
        after: Option<String>,
        /// Delay after the condition.
        #[param("delay", unit("s"), min(0.0))]
        delay_s: f64 = 0,
    }
}

params! {
    /// Sends the robot to a goal with `navigate_to_pose`. Goals follow each other.
    #[table(GOAL, "goal")]
    pub struct GoalEventParams {
        /// Pose in the world: x \[m\], y \[m\], and yaw \[rad\] (default 0).
        #[param("pose", required())]
        pose: Vec<f64>,
    }
}

params! {
    /// Puts a model at another pose, at rest.
    #[table(TELEPORT, "teleport")]
    pub struct TeleportEventParams {
        /// Pose in the world: x \[m\], y \[m\], and yaw \[rad\] (default: the present yaw).
        #[param("pose", required())]
        pose: Vec<f64>,
        /// Name of the model (default: the robot).
        #[param("model")]
        model: Option<String>,
    }
}

params! {
    /// Inserts a model from a file.
    #[table(SPAWN, "spawn")]
    pub struct SpawnEventParams {
        /// URDF or SDF file.
        #[param("file", required())]
        file: String,
        /// Name in the world (default: that of the file).
        #[param("name")]
        name: Option<String>,
        /// Pose in the world: x \[m\], y \[m\], and yaw \[rad\] (default 0).
        #[param("pose")]
        pose: Vec<f64> = "0 0 0",
    }
}

params! {
    /// Removes a model.
    #[table(REMOVE, "remove")]
    pub struct RemoveEventParams {
        /// Name of the model.
        #[param("model", required())]
        model: String,
    }
}

params! {
    /// Sets a parameter of a running node.
    #[table(SET_PARAMETER, "set_parameter")]
    pub struct SetParameterEventParams {
        /// Full name of the node.
        #[param("node", required())]
        node: String,
        /// Name of the parameter.
        #[param("parameter", required())]
        parameter: String,
        /// Value, as in a parameter file.
        #[param("value", required())]
        value: String,
    }
}

params! {
    /// Publishes a message; `message` has its fields, as for `ros2 topic pub`.
    #[table(PUBLISH, "publish")]
    pub struct PublishEventParams {
        /// Topic.
        #[param("topic", required())]
        topic: String,
        /// Type, such as `std_msgs/msg/String`.
        #[param("type", required())]
        type_name: String,
    }
}

/// Tables of the events, without `fault`, whose tables are those of the kinds of faults.
pub static EVENTS: [&Table; 6] = [&GOAL, &TELEPORT, &SPAWN, &REMOVE, &SET_PARAMETER, &PUBLISH];

/// Word of an event that starts a fault.
pub const FAULT_EVENT: &str = "fault";

params! {
    /// The robot reaches a goal.
    #[table(REACHED, "reached")]
    pub struct ReachedParams {
        /// Point in the world: x, y (default: the navigator reports success for every goal of the events, and the
        /// robot is there).
        #[param("goal", unit("m"))]
        goal_m: Vec<f64>,
        /// Largest distance from the goal.
        #[param("within", unit("m"), above(0.0))]
        within_m: f64 = 0.3,
        /// Latest time.
        #[param("before", unit("s"), above(0.0))]
        before_s: Option<f64>,
    }
}

params! {
    /// The robot touches nothing but the floor.
    #[table(NO_COLLISION, "no_collision")]
    pub struct NoCollisionParams {
    }
}

params! {
    /// The distance between the footprint and the nearest obstacle is at least a value.
    #[table(MIN_CLEARANCE, "min_clearance")]
    pub struct MinClearanceParams {
        /// Smallest distance.
        #[param("distance", unit("m"), min(0.0), required())]
        distance_m: f64,
    }
}

params! {
    /// The map of SLAM agrees with the true map in its explored part: intersection over union of the wall cells, where a
    /// neighbouring cell counts as a match.
    #[table(MAP_IOU, "map_iou")]
    pub struct MapIouParams {
        /// Smallest value.
        #[param("min", within(0.0, 1.0), required())]
        min_ratio: f64,
        /// Largest shift by which the map is aligned first.
        #[param("window", unit("m"), min(0.0))]
        window_m: f64 = 0.3,
    }
}

params! {
    /// The robot stays on the planned path: distance of the true pose from the latest path of `/plan`.
    #[table(TRACKING_ERROR, "tracking_error")]
    pub struct TrackingErrorParams {
        /// Largest value.
        #[param("max", unit("m"), min(0.0), required())]
        max_m: f64,
        /// Statistic over the run.
        #[param("statistic")]
        statistic: ErrorStatistic = "max",
    }
}

params! {
    /// The estimated position in the map agrees with the true one.
    #[table(LOCALIZATION_ERROR, "localization_error")]
    pub struct LocalizationErrorParams {
        /// Largest value.
        #[param("max", unit("m"), min(0.0), required())]
        max_m: f64,
        /// Statistic over the run.
        #[param("statistic")]
        statistic: ErrorStatistic = "max",
        /// Start of the measurement.
        #[param("from", unit("s"), min(0.0))]
        from_s: f64 = 0,
    }
}

params! {
    /// The position by odometry agrees with the true one, counted from the start.
    #[table(ODOMETRY_ERROR, "odometry_error")]
    pub struct OdometryErrorParams {
        /// Largest value.
        #[param("max", unit("m"), min(0.0), required())]
        max_m: f64,
        /// Statistic over the run.
        #[param("statistic")]
        statistic: ErrorStatistic = "max",
        /// Start of the measurement.
        #[param("from", unit("s"), min(0.0))]
        from_s: f64 = 0,
    }
}

params! {
    /// Messages are published at a rate.
    #[table(RATE, "rate")]
    pub struct RateParams {
        /// Topic.
        #[param("topic", required())]
        topic: String,
        /// Rate.
        #[param("hz", unit("Hz"), above(0.0), required())]
        rate_hz: f64,
        /// Largest relative deviation of the mean rate.
        #[param("tolerance", within(0.0, 1.0))]
        tolerance_ratio: f64 = 0.1,
        /// Start of the measurement.
        #[param("from", unit("s"), min(0.0))]
        from_s: f64 = 1,
        /// End of the measurement (default: end of the run).
        #[param("until", unit("s"), min(0.0))]
        until_s: Option<f64>,
    }
}

params! {
    /// Stamped messages arrive in time: time of arrival minus stamp. A stamp in the future fails, too.
    #[table(LATENCY, "latency")]
    pub struct LatencyCheckParams {
        /// Topic with stamped messages.
        #[param("topic", required())]
        topic: String,
        /// Largest value.
        #[param("max", unit("s"), min(0.0), required())]
        max_s: f64,
    }
}

params! {
    /// Stamped messages arrive in the order of their stamps, each once.
    #[table(IN_ORDER, "in_order")]
    pub struct InOrderParams {
        /// Topic with stamped messages.
        #[param("topic", required())]
        topic: String,
    }
}

params! {
    /// The driven path is not longer than a factor of the straight lines between start and goals.
    #[table(PATH_RATIO, "path_ratio")]
    pub struct PathRatioParams {
        /// Largest value.
        #[param("max", min(1.0), required())]
        max_ratio: f64,
    }
}

params! {
    /// The goals are reached on short paths: success weighted by path length (Anderson et al. 2018), the mean over all
    /// goals of the events of shortest / max(driven, shortest), 0 for a goal that is not reached. The shortest path is
    /// that of the circle inside the footprint on the true map at the end of the run.
    #[table(SPL, "spl")]
    pub struct SplParams {
        /// Smallest value.
        #[param("min", within(0.0, 1.0), required())]
        min_ratio: f64,
        /// Largest distance from a goal that is reached.
        #[param("within", unit("m"), above(0.0))]
        within_m: f64 = 0.3,
    }
}

/// Tables of the assertions.
pub static ASSERTIONS: [&Table; 12] = [
    &REACHED,
    &NO_COLLISION,
    &MIN_CLEARANCE,
    &MAP_IOU,
    &TRACKING_ERROR,
    &LOCALIZATION_ERROR,
    &ODOMETRY_ERROR,
    &RATE,
    &LATENCY,
    &IN_ORDER,
    &PATH_RATIO,
    &SPL,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_have_no_faults() {
        let single = [&SCENARIO, &ROBOT, &TRIGGER];
        for table in single.into_iter().chain(NODES).chain(EVENTS).chain(ASSERTIONS) {
            assert_eq!(table.faults(), [""; 0], "{}", table.name);
        }
    }
}
