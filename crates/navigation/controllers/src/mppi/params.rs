//! Parameters of MPPI and of its critics, with the names and defaults of Nav2.
//!
//! Source: `nav2_mppi_controller/src/*.cpp`, `src/critics/*.cpp` (main, 2026-08). Defaults of Humble that
//! differ are set by [`super::MppiConfig::read`].

use periplus_params::params;

params! {
    /// Model predictive path integral control.
    #[table(MPPI, "MPPI")]
    pub struct MppiParams {
        /// Duration of a time step; not above the period of the controller server.
        #[param("model_dt", unit("s"), above(0.0))]
        model_dt_s: f64 = 0.05,
        /// Number of time steps.
        #[param("time_steps", within(2.0, 10_000.0))]
        time_steps: usize = 56,
        /// Number of samples.
        #[param("batch_size", within(1.0, 1_000_000.0))]
        batch_size: usize = 1000,
        /// Number of optimizations in each cycle.
        #[param("iteration_count", within(1.0, 1000.0))]
        iteration_count: usize = 1,
        /// Temperature of the weights: lower values follow the best samples alone.
        #[param("temperature", above(0.0))]
        temperature: f64 = 0.3,
        /// Weight of the control cost, which keeps the sequence near the last one.
        #[param("gamma")]
        gamma: f64 = 0.015,
        /// Maximum velocity forwards.
        #[param("vx_max", unit("m/s"))]
        vx_max_m_s: f64 = 0.5,
        /// Minimum velocity forwards; negative for reversing.
        #[param("vx_min", unit("m/s"))]
        vx_min_m_s: f64 = -0.35,
        /// Maximum speed sideways.
        #[param("vy_max", unit("m/s"))]
        vy_max_m_s: f64 = 0.5,
        /// Maximum turn rate.
        #[param("wz_max", unit("rad/s"))]
        wz_max_rad_s: f64 = 1.9,
        /// Maximum acceleration forwards; not in Humble.
        #[param("ax_max", unit("m/s^2"))]
        ax_max_m_s2: f64 = 3,
        /// Strongest deceleration, negative; not in Humble.
        #[param("ax_min", unit("m/s^2"))]
        ax_min_m_s2: f64 = -3,
        /// Maximum acceleration sideways; not in Humble.
        #[param("ay_max", unit("m/s^2"))]
        ay_max_m_s2: f64 = 3,
        /// Strongest deceleration sideways, negative; not in Humble.
        #[param("ay_min", unit("m/s^2"))]
        ay_min_m_s2: f64 = -3,
        /// Maximum angular acceleration; not in Humble.
        #[param("az_max", unit("rad/s^2"))]
        az_max_rad_s2: f64 = 3.5,
        /// Standard deviation of sampled velocities forwards.
        #[param("vx_std", unit("m/s"), min(0.0))]
        vx_std_m_s: f64 = 0.2,
        /// Standard deviation of sampled velocities sideways.
        #[param("vy_std", unit("m/s"), min(0.0))]
        vy_std_m_s: f64 = 0.2,
        /// Standard deviation of sampled turn rates.
        #[param("wz_std", unit("rad/s"), min(0.0))]
        wz_std_rad_s: f64 = 0.4,
        /// Number of further attempts after a failure.
        #[param("retry_attempt_limit", within(0.0, 1000.0))]
        retry_attempt_limit: usize = 1,
        /// Draws new noise in each cycle instead of using the first again.
        #[param("regenerate_noises")]
        regenerate_noises: bool = false,
        /// Starts from the last command instead of the measured velocity; not in Humble.
        #[param("open_loop")]
        is_open_loop: bool = false,
        /// Degree of the smoothing polynomial: 1 or 2 (main).
        #[param("sgf_order", within(1.0, 2.0))]
        smoothing_order: i64 = 2,
        /// Delay of the response to `vx` (main).
        #[param("model_delay_vx", unit("s"), min(0.0))]
        delay_vx_s: f64 = 0,
        /// Delay of the response to `vy` (main).
        #[param("model_delay_vy", unit("s"), min(0.0))]
        delay_vy_s: f64 = 0,
        /// Delay of the response to `wz` (main).
        #[param("model_delay_wz", unit("s"), min(0.0))]
        delay_wz_s: f64 = 0,
        /// Limits the sampled controls to velocities that can be reached; always done in Jazzy and Kilted (main).
        #[param("clamp_raw_controls")]
        clamp_raw_controls: bool = false,
        /// Motion model: `DiffDrive`, `Omni` or `Ackermann`; on main the name of a group with a `plugin`.
        #[param("motion_model")]
        motion_model: Option<String>,
        /// Names of the critics, in the order of their evaluation.
        #[param("critics")]
        critics: Vec<String> = "",
        /// Publishes the sampled trajectories and the statistics of the critics.
        #[param("visualize")]
        visualize: bool = false,
        /// Critic whose costs colour the published samples: 1 for the first, 0 for the total (main).
        #[param("critic_index_to_visualize")]
        critic_index_to_visualize: i64 = 0,
        /// Publishes the optimal trajectory with its velocities (main).
        #[param("publish_optimal_trajectory")]
        publish_optimal_trajectory: bool = false,
        /// Time without a call after which the controller starts from rest (Humble).
        #[param("reset_period", unit("s"), min(0.0))]
        reset_period_s: f64 = 1,
        /// Prints each change of a parameter.
        #[param("verbose")]
        _: bool = false,
        /// Class of the controller.
        #[param("plugin")]
        _: String = "nav2_mppi_controller::MPPIController",
        /// Length of the plan that is used; read by the path handler.
        #[param("prune_distance", unit("m"))]
        _: f64 = 1.5,
        /// Length of the plan in which the robot is searched; read by the path handler.
        #[param("max_robot_pose_search_dist", unit("m"))]
        _: f64 = 1.5,
        /// Cuts the plan at changes of direction; read by the path handler.
        #[param("enforce_path_inversion")]
        _: bool = false,
        /// Distance within which a change of direction is reached; read by the path handler.
        #[param("inversion_xy_tolerance", unit("m"))]
        _: f64 = 0.2,
        /// Angle within which a change of direction is reached; read by the path handler.
        #[param("inversion_yaw_tolerance", unit("rad"))]
        _: f64 = 0.4,
        /// Maximum age of transforms; read by the path handler.
        #[param("transform_tolerance", unit("s"))]
        _: f64 = 0.1,
    }
}

params! {
    /// Motion model for steered wheels.
    #[table(ACKERMANN, "the motion model")]
    pub struct AckermannParams {
        /// Class of the motion model (main).
        #[param("plugin")]
        plugin: String = "",
        /// Minimum radius of a curve.
        #[param("min_turning_r", unit("m"), above(0.0))]
        min_turning_radius_m: f64 = 0.2,
        /// Samples curvatures instead of turn rates: samples that are faster or slower than the sequence drive along
        /// its curve, and none along a narrower one than the robot can. Not in Nav2, where the samples of a car turn in
        /// place, and it stops at cusps.
        #[param("sample_curvatures")]
        samples_curvatures: bool = false,
    }
}

params! {
    /// Published samples.
    #[table(VISUALIZER, "`TrajectoryVisualizer`")]
    pub struct VisualizerParams {
        /// Distance between published samples.
        #[param("trajectory_step", within(1.0, 1_000_000.0))]
        trajectory_step: usize = 5,
        /// Distance between published points of a sample.
        #[param("time_step", within(1.0, 1_000_000.0))]
        time_step: usize = 3,
    }
}

params! {
    /// Test of the optimal trajectory (main).
    #[table(VALIDATOR, "`TrajectoryValidator`")]
    pub struct ValidatorParams {
        /// Class of the validator.
        #[param("plugin")]
        _: String = "mppi::DefaultOptimalTrajectoryValidator",
        /// Time up to which the trajectory must be free.
        #[param("collision_lookahead_time", unit("s"), min(0.0))]
        collision_lookahead_s: f64 = 2,
        /// Tests the outline of the robot instead of its centre.
        #[param("consider_footprint")]
        considers_footprint: bool = false,
    }
}

params! {
    /// Parameters of every critic.
    pub struct MppiCriticParams {
        /// Enables the critic.
        #[param("enabled")]
        is_enabled: bool = true,
        /// Power of the weighted cost.
        #[param("cost_power", within(0.0, 100.0))]
        power: usize = 1,
    }
}

params! {
    /// Critic of velocities beyond the limits.
    #[table(CONSTRAINT_CRITIC, "`ConstraintCritic`")]
    pub struct ConstraintParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 4,
    }
}

params! {
    /// Critic of the costs along a trajectory.
    #[table(COST_CRITIC, "`CostCritic`")]
    pub struct CostParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 3.81,
        /// Cost of a point near an obstacle.
        #[param("critical_cost")]
        critical_cost: f64 = 300,
        /// Cost of the map from which a point is near an obstacle; fixed in Humble.
        #[param("near_collision_cost", within(0.0, 255.0))]
        near_collision_cost: usize = 253,
        /// Cost of a trajectory that touches an obstacle.
        #[param("collision_cost")]
        collision_cost: f64 = 1000000,
        /// Distance to the goal below which costs without a collision are ignored.
        #[param("near_goal_distance", unit("m"))]
        near_goal_distance_m: f64 = 0.5,
        /// Tests the outline of the robot instead of its centre.
        #[param("consider_footprint")]
        considers_footprint: bool = false,
        /// Distance between tested points, in time steps; 1 in Humble.
        #[param("trajectory_point_step", within(1.0, 10_000.0))]
        point_step: usize = 2,
        /// Name of the inflation layer; the first by default.
        #[param("inflation_layer_name")]
        _: String = "",
    }
}

params! {
    /// Critic of the distance to obstacles.
    #[table(OBSTACLES_CRITIC, "`ObstaclesCritic`")]
    pub struct ObstaclesParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight of the distance to obstacles.
        #[param("repulsion_weight")]
        repulsion_weight: f64 = 1.5,
        /// Weight of points within the margin.
        #[param("critical_weight")]
        critical_weight: f64 = 20,
        /// Cost of a trajectory that touches an obstacle; 10000 in Humble.
        #[param("collision_cost")]
        collision_cost: f64 = 100000,
        /// Width of the margin around obstacles.
        #[param("collision_margin_distance", unit("m"))]
        margin_m: f64 = 0.1,
        /// Distance to the goal below which the repulsion is off.
        #[param("near_goal_distance", unit("m"))]
        near_goal_distance_m: f64 = 0.5,
        /// Tests the outline of the robot instead of its centre.
        #[param("consider_footprint")]
        considers_footprint: bool = false,
        /// Decay of the inflation, the same as that of the costmap (Humble).
        #[param("cost_scaling_factor", unit("1/m"))]
        scaling_per_m: f64 = 10,
        /// Radius of the inflation, the same as that of the costmap (Humble).
        #[param("inflation_radius", unit("m"))]
        inflation_radius_m: f64 = 0.55,
        /// Name of the inflation layer; the first by default.
        #[param("inflation_layer_name")]
        _: String = "",
    }
}

params! {
    /// Critic of the distance to the goal.
    #[table(GOAL_CRITIC, "`GoalCritic`")]
    pub struct GoalParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 5,
        /// Distance to the goal up to which the critic applies.
        #[param("threshold_to_consider", unit("m"))]
        threshold_m: f64 = 1.4,
    }
}

params! {
    /// Critic of the heading at the goal.
    #[table(GOAL_ANGLE_CRITIC, "`GoalAngleCritic`")]
    pub struct GoalAngleParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 3,
        /// Distance to the goal up to which the critic applies.
        #[param("threshold_to_consider", unit("m"))]
        threshold_m: f64 = 0.5,
        /// Accepts the opposite heading as well.
        #[param("symmetric_yaw_tolerance")]
        is_symmetric: bool = false,
    }
}

params! {
    /// Critic of the distance to the path.
    #[table(PATH_ALIGN_CRITIC, "`PathAlignCritic`")]
    pub struct PathAlignParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 10,
        /// Fraction of occupied path points above which the critic is off.
        #[param("max_path_occupancy_ratio")]
        max_occupancy_ratio: f64 = 0.07,
        /// Number of path points that samples must reach before the critic applies.
        #[param("offset_from_furthest", min(0.0))]
        min_reached_points: usize = 20,
        /// Distance between compared points, in time steps.
        #[param("trajectory_point_step", within(1.0, 10_000.0))]
        point_step: usize = 4,
        /// Distance to the goal below which the critic is off.
        #[param("threshold_to_consider", unit("m"))]
        threshold_m: f64 = 0.5,
        /// Compares headings as well.
        #[param("use_path_orientations")]
        uses_headings: bool = false,
    }
}

params! {
    /// Critic of the heading towards the path.
    #[table(PATH_ANGLE_CRITIC, "`PathAngleCritic`")]
    pub struct PathAngleParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight; 2.0 in Humble.
        #[param("cost_weight")]
        weight: f64 = 2.2,
        /// Distance of the aim beyond the furthest reached path point, in points.
        #[param("offset_from_furthest", min(0.0))]
        offset_points: usize = 4,
        /// Distance to the goal below which the critic is off.
        #[param("threshold_to_consider", unit("m"))]
        threshold_m: f64 = 0.5,
        /// Angle to the aim up to which the critic is off; 1.2 in Humble.
        #[param("max_angle_to_furthest", unit("rad"))]
        max_angle_rad: f64 = 0.785398,
        /// 0: forwards; 1: either direction; 2: the direction of the path. Not in Humble.
        #[param("mode", within(0.0, 2.0))]
        mode: i64 = 0,
        /// Prefers forwards (Humble).
        #[param("forward_preference")]
        prefers_forward: bool = true,
    }
}

params! {
    /// Critic of the progress along the path.
    #[table(PATH_FOLLOW_CRITIC, "`PathFollowCritic`")]
    pub struct PathFollowParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 5,
        /// Distance of the aim beyond the furthest reached path point, in points.
        #[param("offset_from_furthest", min(0.0))]
        offset_points: usize = 6,
        /// Distance to the goal below which the critic is off.
        #[param("threshold_to_consider", unit("m"))]
        threshold_m: f64 = 1.4,
    }
}

params! {
    /// Critic of motion backwards.
    #[table(PREFER_FORWARD_CRITIC, "`PreferForwardCritic`")]
    pub struct MppiPreferForwardParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 5,
        /// Distance to the goal below which the critic is off.
        #[param("threshold_to_consider", unit("m"))]
        threshold_m: f64 = 0.5,
    }
}

params! {
    /// Critic of turns.
    #[table(TWIRLING_CRITIC, "`TwirlingCritic`")]
    pub struct MppiTwirlingParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 10,
    }
}

params! {
    /// Critic of speeds that the robot cannot drive.
    #[table(VELOCITY_DEADBAND_CRITIC, "`VelocityDeadbandCritic`")]
    pub struct VelocityDeadbandParams {
        /// Parameters of every critic.
        #[shared]
        common: MppiCriticParams,
        /// Weight.
        #[param("cost_weight")]
        weight: f64 = 35,
        /// Lowest speeds forwards, sideways and of turns.
        #[param("deadband_velocities", unit("m/s, m/s, rad/s"))]
        deadband: Vec<f64> = "0 0 0",
    }
}
