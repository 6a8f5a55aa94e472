//! Parameters of DWB and of its critics.

use periplus_params::{param_choice, params};

params! {
    /// Limits of velocities and accelerations. All are 0 unless set: the robot then cannot move.
    pub struct KinematicParams {
        /// Minimum velocity along x; negative for backwards.
        #[param("min_vel_x", unit("m/s"))]
        min_vel_x_m_s: f64 = 0,
        /// Minimum velocity along y.
        #[param("min_vel_y", unit("m/s"))]
        min_vel_y_m_s: f64 = 0,
        /// Maximum velocity along x.
        #[param("max_vel_x", unit("m/s"))]
        max_vel_x_m_s: f64 = 0,
        /// Maximum velocity along y; 0 for robots that cannot move sideways.
        #[param("max_vel_y", unit("m/s"))]
        max_vel_y_m_s: f64 = 0,
        /// Maximum turn rate, in both directions.
        #[param("max_vel_theta", unit("rad/s"))]
        max_vel_theta_rad_s: f64 = 0,
        /// Minimum speed of translation of trajectories that turn slower than `min_speed_theta`; negative for none.
        #[param("min_speed_xy", unit("m/s"))]
        min_speed_xy_m_s: f64 = 0,
        /// Maximum speed of translation; negative for none.
        #[param("max_speed_xy", unit("m/s"))]
        max_speed_xy_m_s: f64 = 0,
        /// Minimum turn rate of trajectories that are slower than `min_speed_xy`; negative for none.
        #[param("min_speed_theta", unit("rad/s"))]
        min_speed_theta_rad_s: f64 = 0,
        /// Acceleration along x.
        #[param("acc_lim_x", unit("m/s^2"))]
        acc_lim_x_m_s2: f64 = 0,
        /// Acceleration along y.
        #[param("acc_lim_y", unit("m/s^2"))]
        acc_lim_y_m_s2: f64 = 0,
        /// Angular acceleration.
        #[param("acc_lim_theta", unit("rad/s^2"))]
        acc_lim_theta_rad_s2: f64 = 0,
        /// Deceleration along x; negative.
        #[param("decel_lim_x", unit("m/s^2"))]
        decel_lim_x_m_s2: f64 = 0,
        /// Deceleration along y; negative.
        #[param("decel_lim_y", unit("m/s^2"))]
        decel_lim_y_m_s2: f64 = 0,
        /// Angular deceleration; negative.
        #[param("decel_lim_theta", unit("rad/s^2"))]
        decel_lim_theta_rad_s2: f64 = 0,
    }
}

params! {
    /// Samples of velocities and the simulation of their trajectories.
    pub struct TrajectoryParams {
        /// Number of velocities along x.
        #[param("vx_samples", within(0.0, 10_000.0))]
        vx_samples: usize = 20,
        /// Number of velocities along y.
        #[param("vy_samples", within(0.0, 10_000.0))]
        vy_samples: usize = 5,
        /// Number of turn rates.
        #[param("vtheta_samples", within(0.0, 10_000.0))]
        vtheta_samples: usize = 20,
        /// Duration of a trajectory.
        #[param("sim_time", unit("s"))]
        sim_time_s: f64 = 1.7,
        /// Divides trajectories into steps of `time_granularity`.
        #[param("discretize_by_time")]
        discretize_by_time: bool = false,
        /// Maximum duration of a step.
        #[param("time_granularity", unit("s"), above(0.0))]
        time_granularity_s: f64 = 0.5,
        /// Maximum length of a step.
        #[param("linear_granularity", unit("m"), above(0.0))]
        linear_granularity_m: f64 = 0.5,
        /// Maximum rotation of a step.
        #[param("angular_granularity", unit("rad"), above(0.0))]
        angular_granularity_rad: f64 = 0.025,
        /// Adds the last pose a second time.
        #[param("include_last_point")]
        include_last_point: bool = true,
        /// Commands the velocity of the first step instead of the sampled one.
        #[param("limit_vel_cmd_in_traj")]
        limit_vel_cmd_in_traj: bool = false,
        /// Time in which LimitedAccelGenerator reaches a velocity (default: the period of the control loop).
        #[param("sim_period", unit("s"))]
        sim_period_s: Option<f64>,
    }
}

params! {
    /// The controller DWB.
    #[table(DWB, "DWB")]
    pub struct DwbParams {
        /// Names of the critics, in the order of evaluation.
        #[param("critics", required())]
        critics: Vec<String>,
        /// Packages in which classes of critics are searched.
        #[param("default_critic_namespaces")]
        default_critic_namespaces: Vec<String> = "dwb_critics",
        /// Class of the trajectory generator.
        #[param("trajectory_generator_name")]
        trajectory_generator_name: String = "dwb_plugins::StandardTrajectoryGenerator",
        /// Stops the evaluation of a trajectory once it is worse than the best one.
        #[param("short_circuit_trajectory_evaluation")]
        short_circuit_trajectory_evaluation: bool = true,
        /// Logs the reasons when there is no valid trajectory.
        #[param("debug_trajectory_details")]
        debug_trajectory_details: bool = false,
        /// Limits.
        #[shared]
        kinematics: KinematicParams,
        /// Trajectories.
        #[shared]
        trajectories: TrajectoryParams,
        /// Distance to the goal at which RotateToGoal acts.
        #[param("xy_goal_tolerance", unit("m"))]
        xy_goal_tolerance_m: f64 = 0.25,
        /// Speed at which a robot stands still for RotateToGoal.
        #[param("trans_stopped_velocity", unit("m/s"))]
        trans_stopped_velocity_m_s: f64 = 0.25,
        /// Length of the rest of the plan at which RotateToGoal acts (main).
        #[param("path_length_tolerance", unit("m"))]
        path_length_tolerance_m: f64 = 1,
        /// Distance behind the robot up to which the plan is kept (Humble, Jazzy).
        #[param("prune_distance", unit("m"))]
        prune_distance_m: f64 = 2,
        /// Distance ahead of the robot up to which the plan is used (Humble, Jazzy).
        #[param("forward_prune_distance", unit("m"))]
        forward_prune_distance_m: f64 = 2,
        /// Removes poses of the plan that were passed (Humble, Jazzy).
        #[param("prune_plan")]
        prune_plan: bool = true,
        /// Limits the plan to `forward_prune_distance` (Humble, Jazzy).
        #[param("shorten_transformed_plan")]
        shorten_transformed_plan: bool = true,
        /// Publishes the evaluation.
        #[param("publish_evaluation")]
        publish_evaluation: bool = true,
        /// Publishes the best trajectory.
        #[param("publish_local_plan")]
        publish_local_plan: bool = true,
        /// Publishes the trajectories as markers.
        #[param("publish_trajectories")]
        publish_trajectories: bool = true,
        /// Publishes the scores of cells.
        #[param("publish_cost_grid_pc")]
        publish_cost_grid_pc: bool = false,
        /// Lifetime of the markers.
        #[param("marker_lifetime", unit("s"))]
        marker_lifetime_s: f64 = 0.1,
        /// Publishes the plan (Humble, Jazzy).
        #[param("publish_global_plan")]
        publish_global_plan: bool = true,
        /// Publishes the local plan that the critics get (Humble, Jazzy).
        #[param("publish_transformed_plan")]
        publish_transformed_plan: bool = true,
        /// Unused; the caller passes the transform (Humble, Jazzy).
        #[param("transform_tolerance", unit("s"))]
        _: f64 = 0.1,
        /// Unused; the server subscribes to odometry.
        #[param("odom_topic")]
        _: String = "odom",
        /// Unused; an old parameter of the goal checker, which stock files set.
        #[param("stateful")]
        _: bool = true,
    }
}

params! {
    /// Parameters of every critic.
    pub struct CriticParams {
        /// Weight; 0 switches the critic off.
        #[param("scale")]
        scale: f64 = 1,
        /// Class (default: the name of the critic).
        #[param("class")]
        class: String = "",
    }
}

params! {
    /// A critic without parameters.
    #[table(PLAIN_CRITIC, "a critic")]
    pub struct PlainCriticParams {
        /// Parameters of every critic.
        #[shared]
        critic: CriticParams,
    }
}

params! {
    /// The critics BaseObstacle and ObstacleFootprint.
    #[table(OBSTACLE_CRITIC, "an obstacle critic")]
    pub struct ObstacleCriticParams {
        /// Parameters of every critic.
        #[shared]
        critic: CriticParams,
        /// Adds the costs of all poses, instead of that of the last one.
        #[param("sum_scores")]
        sum_scores: bool = false,
    }
}

param_choice! {
    /// Combination of the scores of the poses of a trajectory.
    pub enum ScoreAggregation {
        /// Score of the last pose.
        #[default]
        Last = "last",
        /// Sum.
        Sum = "sum",
        /// Product.
        Product = "product",
    }
}

params! {
    /// The critics PathDist, GoalDist, PathAlign and GoalAlign.
    #[table(MAP_GRID_CRITIC, "a map grid critic")]
    pub struct MapGridCriticParams {
        /// Parameters of every critic.
        #[shared]
        critic: CriticParams,
        /// Combination of the scores of poses.
        #[param("aggregation_type")]
        aggregation: ScoreAggregation = "last",
        /// Distance of the point ahead of the robot, for PathAlign and GoalAlign.
        #[param("forward_point_distance", unit("m"))]
        forward_point_distance_m: f64 = 0.325,
    }
}

params! {
    /// The critic Oscillation.
    #[table(OSCILLATION_CRITIC, "the critic Oscillation")]
    pub struct OscillationCriticParams {
        /// Parameters of every critic.
        #[shared]
        critic: CriticParams,
        /// Distance that ends a restriction; negative for none.
        #[param("oscillation_reset_dist", unit("m"))]
        oscillation_reset_dist_m: f64 = 0.05,
        /// Rotation that ends a restriction; negative for none.
        #[param("oscillation_reset_angle", unit("rad"))]
        oscillation_reset_angle_rad: f64 = 0.2,
        /// Time that ends a restriction; negative for none.
        #[param("oscillation_reset_time", unit("s"))]
        oscillation_reset_time_s: f64 = -1,
        /// Speed along x up to which the signs of y and of the turn rate count; negative for any speed.
        #[param("x_only_threshold", unit("m/s"))]
        x_only_threshold_m_s: f64 = 0.05,
    }
}

params! {
    /// The critic PreferForward.
    #[table(PREFER_FORWARD_CRITIC, "the critic PreferForward")]
    pub struct PreferForwardCriticParams {
        /// Parameters of every critic.
        #[shared]
        critic: CriticParams,
        /// Score of trajectories backwards, and of slow ones.
        #[param("penalty")]
        penalty: f64 = 1,
        /// Velocity along x below which a trajectory is slow.
        #[param("strafe_x", unit("m/s"))]
        strafe_x_m_s: f64 = 0.1,
        /// Turn rate below which a trajectory is slow.
        #[param("strafe_theta", unit("rad/s"))]
        strafe_theta_rad_s: f64 = 0.2,
        /// Score of a turn rate of 1 rad/s.
        #[param("theta_scale")]
        theta_scale: f64 = 10,
    }
}

params! {
    /// The critic RotateToGoal.
    #[table(ROTATE_TO_GOAL_CRITIC, "the critic RotateToGoal")]
    pub struct RotateToGoalCriticParams {
        /// Parameters of every critic.
        #[shared]
        critic: CriticParams,
        /// Weight of the squared speed while the robot slows down.
        #[param("slowing_factor")]
        slowing_factor: f64 = 5,
        /// Time ahead of the heading that counts; negative for the end of the trajectory.
        #[param("lookahead_time", unit("s"))]
        lookahead_time_s: f64 = -1,
    }
}
