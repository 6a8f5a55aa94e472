//! Parameters of TebLocalPlannerROS.

use periplus_params::params;

params! {
    /// Parameters of TEB without effect, first part.
    pub struct TebUnusedParams {
        /// Unused; a parameter of the optimization.
        #[param("complete_global_plan")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("delete_detours_backwards")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("detours_orientation_tolerance")]
        _: f64 = 1.5707963267948966,
        /// Unused; a parameter of the optimization.
        #[param("enable_homotopy_class_planning")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("enable_multithreading")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("h_signature_prescaler")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("h_signature_threshold")]
        _: f64 = 0.1,
        /// Unused; a parameter of the optimization.
        #[param("length_start_orientation_vector")]
        _: f64 = 0.4,
        /// Unused; a parameter of the optimization.
        #[param("max_number_classes")]
        _: f64 = 5,
        /// Unused; a parameter of the optimization.
        #[param("max_number_plans_in_current_class")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("max_ratio_detours_duration_best_duration")]
        _: f64 = 3.0,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_heading_threshold")]
        _: f64 = 0.45,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_keypoint_offset")]
        _: f64 = 0.1,
        /// Unused; a parameter of the optimization.
        #[param("roadmap_graph_area_length_scale")]
        _: f64 = 1.0,
        /// Unused; a parameter of the optimization.
        #[param("roadmap_graph_area_width")]
        _: f64 = 5,
        /// Unused; a parameter of the optimization.
        #[param("roadmap_graph_samples")]
        _: f64 = 15,
        /// Unused; a parameter of the optimization.
        #[param("selection_alternative_time_cost")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("selection_cost_hysteresis")]
        _: f64 = 1.0,
        /// Unused; a parameter of the optimization.
        #[param("selection_dropping_probability")]
        _: f64 = 0.0,
        /// Unused; a parameter of the optimization.
        #[param("selection_obst_cost_scale")]
        _: f64 = 2.0,
        /// Unused; a parameter of the optimization.
        #[param("selection_prefer_initial_plan")]
        _: f64 = 0.95,
        /// Unused; a parameter of the optimization.
        #[param("selection_viapoint_cost_scale")]
        _: f64 = 1.0,
        /// Unused; a parameter of the optimization.
        #[param("simple_exploration")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("switching_blocking_period")]
        _: f64 = 0.0,
        /// Unused; a parameter of the optimization.
        #[param("viapoints_all_candidates")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("visualize_hc_graph")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("visualize_with_time_as_z_axis_scale")]
        _: f64 = 0,
        /// Unused; a parameter of the optimization.
        #[param("map_frame")]
        _: String = "odom",
        /// Unused; a parameter of the optimization.
        #[param("odom_topic")]
        _: String = "odom",
        /// Unused; a parameter of the optimization.
        #[param("roadmap_graph_no_samples")]
        _: f64 = 15,
        /// Unused; a parameter of the optimization.
        #[param("costmap_converter_plugin")]
        _: String = "",
        /// Unused; a parameter of the optimization.
        #[param("costmap_converter_spin_thread")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("costmap_obstacles_behind_robot_dist")]
        _: f64 = 1.5,
        /// Unused; a parameter of the optimization.
        #[param("dynamic_obstacle_inflation_dist")]
        _: f64 = 0.6,
        /// Unused; a parameter of the optimization.
        #[param("include_costmap_obstacles")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("include_dynamic_obstacles")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("inflation_dist")]
        _: f64 = 0.6,
        /// Unused; a parameter of the optimization.
        #[param("legacy_obstacle_association")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("min_obstacle_dist")]
        _: f64 = 0.5,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_association_cutoff_factor")]
        _: f64 = 5.0,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_association_force_inclusion_factor")]
        _: f64 = 1.5,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_poses_affected")]
        _: f64 = 30,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_proximity_lower_bound")]
        _: f64 = 0,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_proximity_ratio_max_vel")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_proximity_upper_bound")]
        _: f64 = 0.5,
        /// Unused; a parameter of the optimization.
        #[param("no_inner_iterations")]
        _: f64 = 5,
        /// Unused; a parameter of the optimization.
        #[param("no_outer_iterations")]
        _: f64 = 4,
        /// Unused; a parameter of the optimization.
        #[param("obstacle_cost_exponent")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("optimization_activate")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("optimization_verbose")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("penalty_epsilon")]
        _: f64 = 0.05,
        /// Unused; a parameter of the optimization.
        #[param("weight_acc_lim_theta")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("weight_acc_lim_x")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("weight_acc_lim_y")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("weight_adapt_factor")]
        _: f64 = 2,
    }
}

params! {
    /// Parameters of TEB without effect, second part.
    pub struct TebMoreUnusedParams {
        /// Unused; a parameter of the optimization.
        #[param("weight_dynamic_obstacle")]
        _: f64 = 50,
        /// Unused; a parameter of the optimization.
        #[param("weight_dynamic_obstacle_inflation")]
        _: f64 = 0.1,
        /// Unused; a parameter of the optimization.
        #[param("weight_inflation")]
        _: f64 = 0.1,
        /// Unused; a parameter of the optimization.
        #[param("weight_kinematics_forward_drive")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("weight_kinematics_nh")]
        _: f64 = 1000,
        /// Unused; a parameter of the optimization.
        #[param("weight_kinematics_turning_radius")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("weight_max_vel_theta")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("weight_max_vel_x")]
        _: f64 = 2,
        /// Unused; a parameter of the optimization.
        #[param("weight_max_vel_y")]
        _: f64 = 2,
        /// Unused; a parameter of the optimization.
        #[param("weight_obstacle")]
        _: f64 = 50,
        /// Unused; a parameter of the optimization.
        #[param("weight_optimaltime")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("weight_prefer_rotdir")]
        _: f64 = 50,
        /// Unused; a parameter of the optimization.
        #[param("weight_shortest_path")]
        _: f64 = 0,
        /// Unused; a parameter of the optimization.
        #[param("weight_velocity_obstacle_ratio")]
        _: f64 = 0,
        /// Unused; a parameter of the optimization.
        #[param("weight_viapoint")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("divergence_detection")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("divergence_detection_max_chi_squared")]
        _: f64 = 10,
        /// Unused; a parameter of the optimization.
        #[param("oscillation_filter_duration")]
        _: f64 = 10,
        /// Unused; a parameter of the optimization.
        #[param("oscillation_omega_eps")]
        _: f64 = 0.1,
        /// Unused; a parameter of the optimization.
        #[param("oscillation_recovery")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("oscillation_recovery_min_duration")]
        _: f64 = 10,
        /// Unused; a parameter of the optimization.
        #[param("oscillation_v_eps")]
        _: f64 = 0.1,
        /// Unused; a parameter of the optimization.
        #[param("shrink_horizon_backup")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("shrink_horizon_min_duration")]
        _: f64 = 10,
        /// Unused; a parameter of the optimization.
        #[param("is_footprint_dynamic")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("transform_tolerance")]
        _: f64 = 0.5,
        /// Unused; a parameter of the optimization.
        #[param("use_proportional_saturation")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("control_look_ahead_poses")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("dt_hysteresis")]
        _: f64 = 0.1,
        /// Unused; a parameter of the optimization.
        #[param("dt_ref")]
        _: f64 = 0.3,
        /// Unused; a parameter of the optimization.
        #[param("exact_arc_length")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("feasibility_check_lookahead_distance")]
        _: f64 = -1,
        /// Unused; a parameter of the optimization.
        #[param("feasibility_check_no_poses")]
        _: f64 = 5,
        /// Unused; a parameter of the optimization.
        #[param("force_reinit_new_goal_angular")]
        _: f64 = 0.78,
        /// Unused; a parameter of the optimization.
        #[param("force_reinit_new_goal_dist")]
        _: f64 = 1.0,
        /// Unused; a parameter of the optimization.
        #[param("global_plan_overwrite_orientation")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("global_plan_prune_distance")]
        _: f64 = 1,
        /// Unused; a parameter of the optimization.
        #[param("global_plan_viapoint_sep")]
        _: f64 = -0.1,
        /// Unused; a parameter of the optimization.
        #[param("max_samples")]
        _: f64 = 500,
        /// Unused; a parameter of the optimization.
        #[param("min_resolution_collision_check_angular")]
        _: f64 = 3.141592653589793,
        /// Unused; a parameter of the optimization.
        #[param("min_samples")]
        _: f64 = 3,
        /// Unused; a parameter of the optimization.
        #[param("prevent_look_ahead_poses_near_goal")]
        _: f64 = 0,
        /// Unused; a parameter of the optimization.
        #[param("publish_feedback")]
        _: bool = false,
        /// Unused; a parameter of the optimization.
        #[param("teb_autosize")]
        _: bool = true,
        /// Unused; a parameter of the optimization.
        #[param("via_points_ordered")]
        _: bool = false,
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/type")]
        _: String = "",
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/radius")]
        _: f64 = 0,
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/line_start")]
        _: Vec<f64>,
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/line_end")]
        _: Vec<f64>,
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/front_offset")]
        _: f64 = 0,
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/front_radius")]
        _: f64 = 0,
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/rear_offset")]
        _: f64 = 0,
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/rear_radius")]
        _: f64 = 0,
        /// Unused; the footprint of the costmap is used.
        #[param("footprint_model/vertices")]
        _: String = "",
        /// Unused; costmaps are not converted.
        #[param("costmap_converter_rate")]
        _: f64 = 5,
    }
}

params! {
    /// The local planner TebLocalPlannerROS. Another controller drives in place of it, and uses the limits and tolerances.
    #[table(TEB_PLANNER, "TebLocalPlannerROS")]
    pub struct TebPlannerParams {
        /// Without effect.
        #[shared]
        unused: TebUnusedParams,
        /// Without effect.
        #[shared]
        more_unused: TebMoreUnusedParams,
        /// Accepts any velocity at the goal.
        #[param("free_goal_vel")]
        free_goal_vel: bool = false,
        /// Turn rate at which the robot stands still.
        #[param("theta_stopped_vel", unit("rad/s"))]
        theta_stopped_vel_rad_s: f64 = 0.1,
        /// Speed at which the robot stands still.
        #[param("trans_stopped_vel", unit("m/s"))]
        trans_stopped_vel_m_s: f64 = 0.1,
        /// Maximum distance to the goal.
        #[param("xy_goal_tolerance", unit("m"))]
        xy_goal_tolerance_m: f64 = 0.2,
        /// Maximum difference to the heading of the goal.
        #[param("yaw_goal_tolerance", unit("rad"))]
        yaw_goal_tolerance_rad: f64 = 0.1,
        /// Angular acceleration.
        #[param("acc_lim_theta", unit("rad/s^2"))]
        acc_lim_theta_rad_s2: f64 = 0.5,
        /// Acceleration along x.
        #[param("acc_lim_x", unit("m/s^2"))]
        acc_lim_x_m_s2: f64 = 0.5,
        /// Acceleration along y.
        #[param("acc_lim_y", unit("m/s^2"))]
        acc_lim_y_m_s2: f64 = 0.5,
        /// Commands a steering angle in place of the turn rate.
        #[param("cmd_angle_instead_rotvel")]
        cmd_angle_instead_rotvel: bool = false,
        /// Maximum turn rate.
        #[param("max_vel_theta", unit("rad/s"))]
        max_vel_theta_rad_s: f64 = 0.3,
        /// Maximum speed of translation; 0 for none.
        #[param("max_vel_trans", unit("m/s"))]
        max_vel_trans_m_s: f64 = 0.0,
        /// Maximum velocity forwards.
        #[param("max_vel_x", unit("m/s"))]
        max_vel_x_m_s: f64 = 0.4,
        /// Maximum speed backwards.
        #[param("max_vel_x_backwards", unit("m/s"))]
        max_vel_x_backwards_m_s: f64 = 0.2,
        /// Maximum velocity along y; 0 for robots that cannot move sideways.
        #[param("max_vel_y", unit("m/s"))]
        max_vel_y_m_s: f64 = 0.0,
        /// Minimum turning radius; 0 for robots that rotate in place.
        #[param("min_turning_radius", unit("m"))]
        min_turning_radius_m: f64 = 0.0,
        /// Distance of the axles.
        #[param("wheelbase", unit("m"))]
        wheelbase_m: f64 = 1.0,
        /// Drives backwards to poses behind the robot.
        #[param("allow_init_with_backwards_motion")]
        allow_init_with_backwards_motion: bool = false,
        /// Length of the plan ahead that is used.
        #[param("max_global_plan_lookahead_dist", unit("m"))]
        max_global_plan_lookahead_dist_m: f64 = 3.0,
    }
}
