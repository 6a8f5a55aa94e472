//! Parameters of TrajectoryPlannerROS.

use periplus_params::params;

params! {
    /// The local planner TrajectoryPlannerROS.
    #[table(TRAJECTORY_PLANNER, "TrajectoryPlannerROS")]
    pub struct TrajectoryPlannerParams {
        /// Acceleration along x.
        #[param("acc_lim_x", unit("m/s^2"))]
        acc_lim_x_m_s2: f64 = 2.5,
        /// Acceleration along y.
        #[param("acc_lim_y", unit("m/s^2"))]
        acc_lim_y_m_s2: f64 = 2.5,
        /// Angular acceleration.
        #[param("acc_lim_theta", unit("rad/s^2"), also(&["acc_lim_th"]))]
        acc_lim_theta_rad_s2: f64 = 3.2,
        /// Maximum velocity along x.
        #[param("max_vel_x", unit("m/s"))]
        max_vel_x_m_s: f64 = 0.55,
        /// Minimum velocity along x of trajectories that drive.
        #[param("min_vel_x", unit("m/s"))]
        min_vel_x_m_s: f64 = 0,
        /// Maximum turn rate of trajectories.
        #[param("max_vel_theta", unit("rad/s"))]
        max_vel_theta_rad_s: f64 = 1,
        /// Minimum turn rate of trajectories; negative.
        #[param("min_vel_theta", unit("rad/s"))]
        min_vel_theta_rad_s: f64 = -1,
        /// Minimum turn rate of rotations in place.
        #[param("min_in_place_vel_theta", unit("rad/s"), also(&["min_in_place_rotational_vel"]))]
        min_in_place_vel_theta_rad_s: f64 = 0.4,
        /// Maximum turn rate of the rotation at the goal.
        #[param("max_rotational_vel", unit("rad/s"))]
        max_rotational_vel_rad_s: f64 = 1,
        /// Velocity of a robot that cannot move otherwise; negative.
        #[param("escape_vel", unit("m/s"), also(&["backup_vel"]))]
        escape_vel_m_s: f64 = -0.1,
        /// Tries velocities along y.
        #[param("holonomic_robot")]
        holonomic_robot: bool = true,
        /// Velocities along y for robots that cannot move otherwise.
        #[param("y_vels", unit("m/s"))]
        y_vels_m_s: Vec<f64> = "-0.3 -0.1 0.1 -0.3",
        /// Maximum difference to the heading of the goal.
        #[param("yaw_goal_tolerance", unit("rad"))]
        yaw_goal_tolerance_rad: f64 = 0.05,
        /// Maximum distance to the goal.
        #[param("xy_goal_tolerance", unit("m"))]
        xy_goal_tolerance_m: f64 = 0.1,
        /// Counts the position of the goal as reached until the next plan.
        #[param("latch_xy_goal_tolerance")]
        latch_xy_goal_tolerance: bool = false,
        /// Duration of a trajectory.
        #[param("sim_time", unit("s"), above(0.0))]
        sim_time_s: f64 = 1.7,
        /// Maximum length of a step.
        #[param("sim_granularity", unit("m"), above(0.0))]
        sim_granularity_m: f64 = 0.025,
        /// Maximum rotation of a step.
        #[param("angular_sim_granularity", unit("rad"), above(0.0))]
        angular_sim_granularity_rad: f64 = 0.025,
        /// Number of velocities along x.
        #[param("vx_samples", within(0.0, 10_000.0))]
        vx_samples: usize = 20,
        /// Number of turn rates.
        #[param("vtheta_samples", within(0.0, 10_000.0))]
        vtheta_samples: usize = 20,
        /// Samples only velocities that are reachable within a control period.
        #[param("dwa")]
        dwa: bool = false,
        /// Multiplies the weights of distances by the resolution of the costmap.
        #[param("meter_scoring")]
        meter_scoring: bool = false,
        /// Weight of the distance to the plan.
        #[param("path_distance_bias", also(&["pdist_scale"]))]
        path_distance_bias: f64 = 0.6,
        /// Weight of the distance to the end of the plan.
        #[param("goal_distance_bias", also(&["gdist_scale"]))]
        goal_distance_bias: f64 = 0.8,
        /// Weight of the cost of the footprint.
        #[param("occdist_scale")]
        occdist_scale: f64 = 0.01,
        /// Distance ahead of the robot by which rotations in place are compared.
        #[param("heading_lookahead", unit("m"))]
        heading_lookahead_m: f64 = 0.325,
        /// Scores the heading to the plan.
        #[param("heading_scoring")]
        heading_scoring: bool = false,
        /// Time along a trajectory at which the heading is scored.
        #[param("heading_scoring_timestep", unit("s"))]
        heading_scoring_timestep_s: f64 = 0.1,
        /// Drives straight to the end of the plan.
        #[param("simple_attractor")]
        simple_attractor: bool = false,
        /// Distance that ends the restriction of an oscillating rotation.
        #[param("oscillation_reset_dist", unit("m"))]
        oscillation_reset_dist_m: f64 = 0.05,
        /// Distance that ends an escape.
        #[param("escape_reset_dist", unit("m"))]
        escape_reset_dist_m: f64 = 0.1,
        /// Rotation that ends an escape.
        #[param("escape_reset_theta", unit("rad"))]
        escape_reset_theta_rad: f64 = 1.5707963267948966,
        /// Removes poses of the plan that are farther than 1 m behind.
        #[param("prune_plan")]
        prune_plan: bool = true,
        /// Publishes the scores of cells.
        #[param("publish_cost_grid_pc")]
        publish_cost_grid_pc: bool = false,
        /// Frame of the published cloud.
        #[param("global_frame_id")]
        global_frame_id: String = "odom",
        /// Restores the first values by dynamic reconfigure.
        #[param("restore_defaults")]
        restore_defaults: bool = false,
        /// Unused, also in ROS.
        #[param("stop_time_buffer", unit("s"))]
        _: f64 = 0.2,
        /// Unused; only costmaps are supported, also in ROS.
        #[param("world_model")]
        _: String = "costmap",
        /// Unused, also in ROS.
        #[param("inscribed_radius", unit("m"))]
        _: f64 = 1,
        /// Unused, also in ROS.
        #[param("point_grid/max_sensor_range", unit("m"))]
        _: f64 = 2,
        /// Unused, also in ROS.
        #[param("point_grid/min_pt_separation", unit("m"))]
        _: f64 = 0.01,
        /// Unused, also in ROS.
        #[param("point_grid/max_obstacle_height", unit("m"))]
        _: f64 = 2,
        /// Unused, also in ROS.
        #[param("point_grid/grid_resolution", unit("m"))]
        _: f64 = 0.2,
        /// Unused; the server decides about its rate.
        #[param("controller_frequency", unit("Hz"))]
        _: f64 = 20,
        /// Unused; the server subscribes to odometry.
        #[param("odom_topic")]
        _: String = "odom",
    }
}
