//! Parameters of the node itself.

use periplus_params::params;

params! {
    /// The node move_base of ROS 1.
    #[table(MOVE_BASE, "move_base")]
    pub struct MoveBaseParams {
        /// Class of the global planner: `navfn/NavfnROS` or `global_planner/GlobalPlanner`.
        #[param("base_global_planner")]
        base_global_planner: String = "navfn/NavfnROS",
        /// Class of the local planner: `base_local_planner/TrajectoryPlannerROS`, `dwa_local_planner/DWAPlannerROS` or
        /// `teb_local_planner/TebLocalPlannerROS`.
        #[param("base_local_planner")]
        base_local_planner: String = "base_local_planner/TrajectoryPlannerROS",
        /// Rate of the control loop.
        #[param("controller_frequency", unit("Hz"), above(0.0))]
        controller_frequency_hz: f64 = 20,
        /// Rate of new plans while the robot drives; 0 plans for a new goal and after a failure only.
        #[param("planner_frequency", unit("Hz"), min(0.0))]
        planner_frequency_hz: f64 = 0,
        /// Time without a plan after which a recovery starts.
        #[param("planner_patience", unit("s"))]
        planner_patience_s: f64 = 5,
        /// Time without a valid velocity after which a recovery starts.
        #[param("controller_patience", unit("s"))]
        controller_patience_s: f64 = 15,
        /// Number of failed plans after which a recovery starts; -1 for no limit.
        #[param("max_planning_retries", min(-1.0))]
        max_planning_retries: i64 = -1,
        /// Time without a move of `oscillation_distance` after which a recovery starts; 0 for none.
        #[param("oscillation_timeout", unit("s"), min(0.0))]
        oscillation_timeout_s: f64 = 0,
        /// Distance that a robot moves when it does not oscillate.
        #[param("oscillation_distance", unit("m"), min(0.0))]
        oscillation_distance_m: f64 = 0.5,
        /// Runs the recoveries.
        #[param("recovery_behavior_enabled")]
        recovery_behavior_enabled: bool = true,
        /// Has rotations among the default recoveries.
        #[param("clearing_rotation_allowed")]
        clearing_rotation_allowed: bool = true,
        /// Side of the square around the robot that the first default recovery keeps.
        #[param("conservative_reset_dist", unit("m"), min(0.0))]
        conservative_reset_dist_m: f64 = 3,
        /// Names of the recoveries, in their order. Files have a list of mappings with `name` and `type`.
        #[param("recovery_behaviors")]
        recovery_behaviors: Vec<String> =
            "conservative_reset rotate_recovery aggressive_reset rotate_recovery",
        /// Stops the costmaps while there is no goal.
        #[param("shutdown_costmaps")]
        shutdown_costmaps: bool = false,
        /// Radius around the robot that `make_plan` clears (default: the circumscribed radius of the robot).
        #[param("clearing_radius", unit("m"), min(0.0))]
        clearing_radius_m: Option<f64>,
        /// Clears the surroundings of the robot before `make_plan` plans.
        #[param("make_plan_clear_costmap")]
        make_plan_clear_costmap: bool = true,
        /// Adds the requested goal to a plan of `make_plan` that ends near it.
        #[param("make_plan_add_unreachable_goal")]
        make_plan_add_unreachable_goal: bool = true,
        /// Unused; for dynamic reconfigure only.
        #[param("restore_defaults")]
        _: bool = false,
    }
}
