//! Parameters of planners and smoothers, with the names and defaults of Nav2.
//!
//! Sources: `nav2_navfn_planner`, `nav2_theta_star_planner`, `nav2_smac_planner`, `nav2_smoother` (main,
//! 2026-08).

use periplus_params::params;

params! {
    /// NavFn: Dijkstra or A* on the cells, and a path down the gradient.
    #[table(NAVFN, "NavfnPlanner")]
    pub struct NavFnParams {
        /// Maximum distance of the end of the path from a goal that cannot be reached.
        #[param("tolerance", unit("m"), min(0.0))]
        tolerance_m: f64 = 0.5,
        /// Searches towards the goal (A*) instead of in all directions.
        #[param("use_astar")]
        use_astar: bool = false,
        /// Maximum number of points of a path, in multiples of the longer side of the costmap in cells.
        #[param("max_cycles_factor", within(1.0, 1_000_000.0))]
        max_cycles_factor: usize = 4,
        /// Plans through unknown cells.
        #[param("allow_unknown")]
        allow_unknown: bool = true,
        /// Ends with the direction of travel instead of the yaw of the goal.
        #[param("use_final_approach_orientation")]
        use_final_approach_orientation: bool = false,
    }
}
