//! Parameters of DWAPlannerROS.

use periplus_params::params;

params! {
    /// The local planner DWAPlannerROS.
    #[table(DWA_PLANNER, "DWAPlannerROS")]
    pub struct DwaPlannerParams {
        /// Maximum speed of translation; negative for none.
        #[param("max_vel_trans", unit("m/s"), also(&["max_trans_vel"]))]
        max_vel_trans_m_s: f64 = 0.55,
        /// Minimum speed of translation of trajectories that turn slower than `min_vel_theta`.
        #[param("min_vel_trans", unit("m/s"), also(&["min_trans_vel"]))]
        min_vel_trans_m_s: f64 = 0.1,
        /// Maximum velocity along x.
        #[param("max_vel_x", unit("m/s"))]
        max_vel_x_m_s: f64 = 0.55,
        /// Minimum velocity along x; negative for backwards.
        #[param("min_vel_x", unit("m/s"))]
        min_vel_x_m_s: f64 = 0,
        /// Maximum velocity along y.
        #[param("max_vel_y", unit("m/s"))]
        max_vel_y_m_s: f64 = 0.1,
        /// Minimum velocity along y.
        #[param("min_vel_y", unit("m/s"))]
        min_vel_y_m_s: f64 = -0.1,
        /// Maximum turn rate, in both directions.
        #[param("max_vel_theta", unit("rad/s"), also(&["max_rot_vel"]))]
        max_vel_theta_rad_s: f64 = 1,
        /// Minimum turn rate of trajectories that are slower than `min_vel_trans`.
        #[param("min_vel_theta", unit("rad/s"), also(&["min_rot_vel"]))]
        min_vel_theta_rad_s: f64 = 0.4,
        /// Acceleration along x.
        #[param("acc_lim_x", unit("m/s^2"))]
        acc_lim_x_m_s2: f64 = 2.5,
        /// Acceleration along y.
        #[param("acc_lim_y", unit("m/s^2"))]
        acc_lim_y_m_s2: f64 = 2.5,
        /// Angular acceleration.
        #[param("acc_lim_theta", unit("rad/s^2"), also(&["acc_lim_th"]))]
        acc_lim_theta_rad_s2: f64 = 3.2,
        /// Unused, also in ROS.
        #[param("acc_lim_trans", unit("m/s^2"), also(&["acc_limit_trans"]))]
        _: f64 = 0.1,
        /// Maximum distance to the goal.
        #[param("xy_goal_tolerance", unit("m"))]
        xy_goal_tolerance_m: f64 = 0.1,
        /// Maximum difference to the heading of the goal.
        #[param("yaw_goal_tolerance", unit("rad"))]
        yaw_goal_tolerance_rad: f64 = 0.1,
        /// Counts the position of the goal as reached until the next plan.
        #[param("latch_xy_goal_tolerance")]
        latch_xy_goal_tolerance: bool = false,
        /// Speed at which the robot stands still.
        #[param("trans_stopped_vel", unit("m/s"))]
        trans_stopped_vel_m_s: f64 = 0.1,
        /// Turn rate at which the robot stands still.
        #[param("theta_stopped_vel", unit("rad/s"), also(&["rot_stopped_vel"]))]
        theta_stopped_vel_rad_s: f64 = 0.1,
        /// Duration of a trajectory.
        #[param("sim_time", unit("s"), above(0.0))]
        sim_time_s: f64 = 1.7,
        /// Maximum length of a step.
        #[param("sim_granularity", unit("m"), above(0.0))]
        sim_granularity_m: f64 = 0.025,
        /// Maximum rotation of a step.
        #[param("angular_sim_granularity", unit("rad"), above(0.0))]
        angular_sim_granularity_rad: f64 = 0.1,
        /// Samples only velocities that are reachable within a control period.
        #[param("use_dwa")]
        use_dwa: bool = true,
        /// Number of velocities along x.
        #[param("vx_samples", within(0.0, 10_000.0))]
        vx_samples: usize = 3,
        /// Number of velocities along y.
        #[param("vy_samples", within(0.0, 10_000.0))]
        vy_samples: usize = 10,
        /// Number of turn rates.
        #[param("vth_samples", within(0.0, 10_000.0), also(&["vtheta_samples"]))]
        vth_samples: usize = 20,
        /// Weight of the distance to the plan.
        #[param("path_distance_bias", also(&["pdist_scale"]))]
        path_distance_bias: f64 = 0.6,
        /// Weight of the distance to the end of the plan.
        #[param("goal_distance_bias", also(&["gdist_scale"]))]
        goal_distance_bias: f64 = 0.8,
        /// Weight of the cost of the footprint.
        #[param("occdist_scale")]
        occdist_scale: f64 = 0.01,
        /// Weight of the turn rate.
        #[param("twirling_scale")]
        twirling_scale: f64 = 0,
        /// Distance of the point ahead of the robot that is kept on the plan.
        #[param("forward_point_distance", unit("m"))]
        forward_point_distance_m: f64 = 0.325,
        /// Factor on the squared `forward_point_distance` below which that point has no effect near the goal.
        #[param("cheat_factor")]
        cheat_factor: f64 = 1,
        /// Speed above which the footprint grows.
        #[param("scaling_speed", unit("m/s"))]
        scaling_speed_m_s: f64 = 0.25,
        /// Growth of the footprint at the maximum speed.
        #[param("max_scaling_factor")]
        max_scaling_factor: f64 = 0.2,
        /// Adds the costs of all poses, instead of their maximum.
        #[param("sum_scores")]
        sum_scores: bool = false,
        /// Distance that ends the restriction of an oscillating velocity.
        #[param("oscillation_reset_dist", unit("m"))]
        oscillation_reset_dist_m: f64 = 0.05,
        /// Rotation that ends the restriction of an oscillating velocity.
        #[param("oscillation_reset_angle", unit("rad"))]
        oscillation_reset_angle_rad: f64 = 0.2,
        /// Unused, also in ROS.
        #[param("stop_time_buffer", unit("s"))]
        _: f64 = 0.2,
        /// Removes poses of the plan that are farther than 1 m behind.
        #[param("prune_plan")]
        prune_plan: bool = false,
        /// Publishes the scores of cells.
        #[param("publish_cost_grid_pc", also(&["publish_cost_grid"]))]
        publish_cost_grid_pc: bool = false,
        /// Publishes the trajectories.
        #[param("publish_traj_pc")]
        publish_traj_pc: bool = false,
        /// Frame of the published clouds.
        #[param("global_frame_id")]
        global_frame_id: String = "odom",
        /// Topic of the odometry.
        #[param("odom_topic")]
        odom_topic: String = "odom",
        /// Restores the first values by dynamic reconfigure.
        #[param("restore_defaults")]
        restore_defaults: bool = false,
        /// Unused; the server decides about its rate.
        #[param("controller_frequency", unit("Hz"))]
        _: f64 = 20,
        /// Unused, also in ROS since Hydro.
        #[param("holonomic_robot")]
        _: bool = true,
        /// Unused, also in ROS since Hydro.
        #[param("meter_scoring")]
        _: bool = true,
    }
}
