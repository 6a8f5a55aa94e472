//! Parameters of robots, tasks and rewards.

use periplus_params::{param_choice, params};

param_choice! {
    /// Drive of a kinematic robot.
    pub enum DriveKind {
        /// Two velocities: forwards, and the turn rate.
        #[default]
        Differential = "differential",
        /// Three velocities: forwards, to the left, and the turn rate.
        Omni = "omni" | "omnidirectional",
    }
}

param_choice! {
    /// Shapes that a lidar measures.
    pub enum LidarGeometry {
        /// Visual shapes, as Gazebo's `gpu_lidar`.
        #[default]
        Visual = "visual",
        /// Collision shapes, as Gazebo Classic's `ray`.
        Collision = "collision",
    }
}

params! {
    /// A kinematic robot with a planar lidar.
    #[table(ENVIRONMENT_ROBOT, "a robot of an environment")]
    pub struct EnvironmentRobotParams {
        /// Corners of the footprint in the base frame: x1 y1 x2 y2 x3 y3 and so on; empty for a circle.
        #[param("footprint", unit("m"))]
        footprint_m: Vec<f64> = "",
        /// Radius of a circular footprint.
        #[param("radius", unit("m"), above(0.0))]
        radius_m: f64 = 0.2,
        /// Drive: `differential` or `omni`.
        #[param("drive")]
        drive: DriveKind = "differential",
        /// Maximum speed forwards.
        #[param("max_speed", unit("m/s"), above(0.0))]
        max_speed_m_s: f64 = 0.8,
        /// Minimum speed forwards; below 0 to drive backwards.
        #[param("min_speed", unit("m/s"))]
        min_speed_m_s: f64 = 0,
        /// Maximum speed to the left and to the right of an omnidirectional robot.
        #[param("max_lateral_speed", unit("m/s"), min(0.0))]
        max_lateral_speed_m_s: f64 = 0.5,
        /// Maximum turn rate.
        #[param("max_turn_rate", unit("rad/s"), above(0.0))]
        max_turn_rate_rad_s: f64 = 1.5,
        /// Maximum acceleration along each axis; 0 for no limit.
        #[param("max_acceleration", unit("m/s²"), min(0.0))]
        max_acceleration_m_s2: f64 = 2.5,
        /// Maximum change of the turn rate; 0 for no limit.
        #[param("max_turn_acceleration", unit("rad/s²"), min(0.0))]
        max_turn_acceleration_rad_s2: f64 = 6,
        /// Height above which shapes are obstacles.
        #[param("body_bottom", unit("m"))]
        body_bottom_m: f64 = 0.03,
        /// Height below which shapes are obstacles.
        #[param("body_top", unit("m"))]
        body_top_m: f64 = 0.4,
        /// Number of lidar beams.
        #[param("lidar_beams", within(1.0, 100_000.0))]
        lidar_beams: usize = 360,
        /// Angle of the first beam.
        #[param("lidar_min_angle", unit("rad"))]
        lidar_min_angle_rad: f64 = -3.141592653589793,
        /// Angle of the last beam; of a full turn the beam before it is the last.
        #[param("lidar_max_angle", unit("rad"))]
        lidar_max_angle_rad: f64 = 3.141592653589793,
        /// Minimum range of the lidar.
        #[param("lidar_min_range", unit("m"), min(0.0))]
        lidar_min_range_m: f64 = 0.05,
        /// Maximum range of the lidar; also the range of a beam without a hit.
        #[param("lidar_max_range", unit("m"), above(0.0))]
        lidar_max_range_m: f64 = 10,
        /// Position of the lidar forwards of the base.
        #[param("lidar_x", unit("m"))]
        lidar_x_m: f64 = 0,
        /// Position of the lidar to the left of the base.
        #[param("lidar_y", unit("m"))]
        lidar_y_m: f64 = 0,
        /// Heading of the lidar in the base frame.
        #[param("lidar_yaw", unit("rad"))]
        lidar_yaw_rad: f64 = 0,
        /// Height of the lidar above the floor.
        #[param("lidar_height", unit("m"))]
        lidar_height_m: f64 = 0.2,
        /// Standard deviation of the ranges.
        #[param("lidar_noise", unit("m"), min(0.0))]
        lidar_noise_m: f64 = 0,
        /// Shapes that the lidar measures: `visual` or `collision`.
        #[param("lidar_geometry")]
        lidar_geometry: LidarGeometry = "visual",
    }
}

params! {
    /// A navigation task: from a random start to a random goal.
    #[table(NAVIGATION_TASK, "a navigation task")]
    pub struct NavigationTaskParams {
        /// Time between two actions.
        #[param("step_period", unit("s"), within(0.001, 10.0))]
        step_period_s: f64 = 0.1,
        /// Number of steps after which an episode is truncated.
        #[param("max_steps", within(1.0, 100_000_000.0))]
        max_steps: usize = 500,
        /// Distance from the goal at which it is reached.
        #[param("goal_tolerance", unit("m"), above(0.0))]
        goal_tolerance_m: f64 = 0.3,
        /// Minimum distance from the start to the goal.
        #[param("min_goal_distance", unit("m"), min(0.0))]
        min_goal_distance_m: f64 = 1,
        /// Maximum distance from the start to the goal.
        #[param("max_goal_distance", unit("m"), above(0.0))]
        max_goal_distance_m: f64 = 1000,
        /// Number of sectors of the observation `sectors`, each with the minimum range of its beams.
        #[param("lidar_sectors", within(1.0, 100_000.0))]
        lidar_sectors: usize = 72,
        /// Parts of an observation, in order: `ranges`, `sectors`, `goal`, `velocity`, `pose`, `previous_action`.
        #[param("observation")]
        observation: Vec<String> = "ranges goal velocity",
        /// Scales all parts to -1..1: ranges by the maximum range, distances by 10 m, velocities by the limits.
        #[param("normalize")]
        is_normalized: bool = false,
    }
}

params! {
    /// Weights of the terms of a reward, whose sum is the reward of a step.
    #[table(NAVIGATION_REWARD, "a reward")]
    pub struct NavigationRewardParams {
        /// Weight of the progress: metres by which the robot came nearer to the goal.
        #[param("progress")]
        progress: f64 = 1,
        /// Weight of the goal: 1 in the step that reaches it.
        #[param("goal")]
        goal: f64 = 10,
        /// Weight of the collision: 1 in the step that ends in one.
        #[param("collision")]
        collision: f64 = -10,
        /// Weight of the time: 1 in each step.
        #[param("time")]
        time: f64 = -0.01,
        /// Weight of turning: the turn rate as a fraction of its limit, 0 to 1.
        #[param("turning")]
        turning: f64 = -0.01,
        /// Weight of the clearance: 0 at `clearance_distance` from the nearest obstacle or further, 1 in contact.
        #[param("clearance")]
        clearance: f64 = -0.05,
        /// Distance between footprint and obstacle below which `clearance` counts.
        #[param("clearance_distance", unit("m"), above(0.0))]
        clearance_distance_m: f64 = 0.3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_have_no_faults() {
        for table in [&ENVIRONMENT_ROBOT, &NAVIGATION_TASK, &NAVIGATION_REWARD] {
            assert_eq!(table.faults(), Vec::<String>::new());
        }
    }
}
