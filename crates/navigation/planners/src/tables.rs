//! Parameters of planners and smoothers, with the names and defaults of Nav2.
//!
//! Sources: `nav2_navfn_planner`, `nav2_theta_star_planner`, `nav2_smac_planner`, `nav2_smoother` (main,
//! 2026-08).

use periplus_params::params;

use crate::smac::{GoalHeadingMode, SmacMotionModel};
use crate::smoothing::relaxation::Relaxation;

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

params! {
    /// Theta*: A* with lines of sight.
    #[table(THETA_STAR, "ThetaStarPlanner")]
    pub struct ThetaStarParams {
        /// Number of neighbours of a cell: 4 or 8. Other numbers are 8.
        #[param("how_many_corners")]
        how_many_corners: i64 = 8,
        /// Weight of the length of a path.
        #[param("w_euc_cost", min(0.0))]
        w_euc_cost: f64 = 1,
        /// Weight of the costs along a path.
        #[param("w_traversal_cost", min(0.0))]
        w_traversal_cost: f64 = 2,
        /// Plans through unknown cells.
        #[param("allow_unknown")]
        allow_unknown: bool = true,
        /// Number of expanded nodes between two checks for a cancelled goal.
        #[param("terminal_checking_interval", min(1.0))]
        terminal_checking_interval: usize = 5000,
        /// Ends with the direction of travel instead of the yaw of the goal.
        #[param("use_final_approach_orientation")]
        use_final_approach_orientation: bool = false,
    }
}

params! {
    /// Simple smoother: relaxation on a costmap.
    #[table(SIMPLE_SMOOTHER, "SimpleSmoother")]
    pub struct SimpleSmootherParams {
        /// Sum of all movements of a pass at which the smoothing ends.
        #[param("tolerance", unit("m"))]
        tolerance_m: f64 = 1e-10,
        /// Maximum number of passes.
        #[param("max_its", within(0.0, 1_000_000_000.0))]
        max_its: usize = 1000,
        /// Weight of the original positions.
        #[param("w_data")]
        w_data: f64 = 0.2,
        /// Weight of the neighbours.
        #[param("w_smooth")]
        w_smooth: f64 = 0.3,
        /// Smooths the result again.
        #[param("do_refinement")]
        do_refinement: bool = true,
        /// Number of repetitions.
        #[param("refinement_num", within(0.0, 1_000_000.0))]
        refinement_num: usize = 2,
        /// Smooths the parts between changes of the direction of travel one by one.
        #[param("enforce_path_inversion")]
        enforce_path_inversion: bool = true,
    }
}

params! {
    /// Savitzky-Golay smoother: a local polynomial of least squares.
    #[table(SAVITZKY_GOLAY_SMOOTHER, "SavitzkyGolaySmoother")]
    pub struct SavitzkyGolayParams {
        /// Smooths the result again.
        #[param("do_refinement")]
        do_refinement: bool = true,
        /// Number of repetitions.
        #[param("refinement_num", within(0.0, 1_000_000.0))]
        refinement_num: usize = 2,
        /// Smooths the parts between changes of the direction of travel one by one.
        #[param("enforce_path_inversion")]
        enforce_path_inversion: bool = true,
        /// Number of poses of the polynomial; odd.
        #[param("window_size", within(0.0, 1001.0))]
        window_size: usize = 7,
        /// Order of the polynomial.
        #[param("poly_order", within(0.0, 1000.0))]
        poly_order: usize = 3,
    }
}

params! {
    /// Smoother of the Smac planners.
    pub struct SmacSmootherParams {
        /// Sum of all movements of a pass at which the smoothing ends.
        #[param("smoother.tolerance", unit("m"))]
        tolerance_m: f64 = 1e-10,
        /// Maximum number of passes; 0 to smooth nothing.
        #[param("smoother.max_iterations", within(0.0, 1_000_000_000.0))]
        max_iterations: usize = 1000,
        /// Weight of the original positions.
        #[param("smoother.w_data")]
        w_data: f64 = 0.2,
        /// Weight of the neighbours.
        #[param("smoother.w_smooth")]
        w_smooth: f64 = 0.3,
        /// Smooths the result again.
        #[param("smoother.do_refinement")]
        do_refinement: bool = true,
        /// Number of repetitions.
        #[param("smoother.refinement_num", within(0.0, 1_000_000.0))]
        refinement_num: usize = 2,
    }
}

impl SmacSmootherParams {
    pub(crate) fn relaxation(&self) -> Relaxation {
        Relaxation {
            data_weight: self.w_data,
            smooth_weight: self.w_smooth,
            tolerance_m: self.tolerance_m,
            max_pass_count: self.max_iterations,
            refinement_count: if self.do_refinement { self.refinement_num } else { 0 },
        }
    }
}

params! {
    /// Parameters of all Smac planners.
    pub struct SmacParams {
        /// Plans through unknown cells.
        #[param("allow_unknown")]
        allow_unknown: bool = true,
        /// Maximum number of expanded nodes; 0 or less for no limit.
        #[param("max_iterations")]
        max_iterations: i64 = 1000000,
        /// Maximum number of further nodes once one is within the tolerance; 0 or less for no limit.
        #[param("max_on_approach_iterations")]
        max_on_approach_iterations: i64 = 1000,
        /// Number of expanded nodes between two checks for a cancelled goal and the time.
        #[param("terminal_checking_interval", min(1.0))]
        terminal_checking_interval: usize = 5000,
    }
}

params! {
    /// A* on the cells of a costmap.
    #[table(SMAC_2D, "SmacPlanner2D")]
    pub struct Smac2dParams {
        /// Parameters of all Smac planners.
        #[shared]
        search: SmacParams,
        /// Maximum distance of the end of the path from a goal that cannot be reached.
        #[param("tolerance", unit("m"), min(0.0))]
        tolerance_m: f64 = 0.125,
        /// Weight of the costs of cells.
        #[param("cost_travel_multiplier", min(0.0))]
        cost_travel_multiplier: f64 = 1,
        /// Maximum duration of a plan.
        #[param("max_planning_time", unit("s"), min(0.0))]
        max_planning_time_s: f64 = 2,
        /// Plans on larger cells.
        #[param("downsample_costmap")]
        downsample_costmap: bool = false,
        /// Size of the larger cells, in cells.
        #[param("downsampling_factor", within(1.0, 1000.0))]
        downsampling_factor: usize = 1,
        /// Ends with the direction of travel instead of the yaw of the goal.
        #[param("use_final_approach_orientation")]
        use_final_approach_orientation: bool = false,
        /// Smoother of the path.
        #[shared]
        smoother: SmacSmootherParams,
    }
}

params! {
    /// Parameters of the Smac planners on cells and headings.
    pub struct SmacHeadingParams {
        /// Parameters of all Smac planners.
        #[shared]
        search: SmacParams,
        /// Maximum distance of the end of the path from a goal that cannot be reached.
        #[param("tolerance", unit("m"), min(0.0))]
        tolerance_m: f64 = 0.25,
        /// Maximum duration of a plan.
        #[param("max_planning_time", unit("s"), min(0.0))]
        max_planning_time_s: f64 = 5,
        /// Unused; the heuristic of a goal is always computed again, which is fast.
        #[param("cache_obstacle_heuristic")]
        _: bool = false,
        /// Factor of the cost of motions backwards.
        #[param("reverse_penalty", min(0.0))]
        reverse_penalty: f64 = 2,
        /// Weight of the costs of cells.
        #[param("cost_penalty", min(0.0))]
        cost_penalty: f64 = 2,
        /// Part of the length that is not charged, so that the search prefers later parts of the path.
        #[param("retrospective_penalty")]
        retrospective_penalty: f64 = 0.015,
        /// Squares the costs of cells.
        #[param("use_quadratic_cost_penalty")]
        use_quadratic_cost_penalty: bool = false,
        /// Ratio of the distance to the goal to the number of nodes between two analytic expansions.
        #[param("analytic_expansion_ratio", min(0.0))]
        analytic_expansion_ratio: f64 = 3.5,
        /// Maximum length of an analytic expansion.
        #[param("analytic_expansion_max_length", unit("m"), min(0.0))]
        analytic_expansion_max_length_m: f64 = 3,
        /// Cost above which an analytic expansion must not enter a region again.
        #[param("analytic_expansion_max_cost", min(0.0))]
        analytic_expansion_max_cost: f64 = 200,
        /// Accepts short analytic expansions in spite of `analytic_expansion_max_cost`.
        #[param("analytic_expansion_max_cost_override")]
        analytic_expansion_max_cost_override: bool = false,
        /// Side of the square around the goal in which the shortest curve is the heuristic.
        #[param("lookup_table_size", unit("m"), within(0.0, 1000.0))]
        lookup_table_size_m: f64 = 20,
        /// Headings at the goal.
        #[param("goal_heading_mode")]
        goal_heading_mode: GoalHeadingMode = "DEFAULT",
        /// Every Nth heading that the analytic expansion tries first, with `ALL_DIRECTION`.
        #[param("coarse_search_resolution", within(1.0, 1000.0))]
        coarse_search_resolution: usize = 1,
        /// Unused; the heuristic around obstacles always uses cells of twice the size.
        #[param("downsample_obstacle_heuristic")]
        _: bool = true,
        /// Unused; debug topics are not published.
        #[param("debug_visualizations")]
        _: bool = false,
        /// Smooths the path.
        #[param("smooth_path")]
        smooth_path: bool = true,
        /// Smoother of the path.
        #[shared]
        smoother: SmacSmootherParams,
    }
}

params! {
    /// Hybrid-A*: A* on cells and headings, with the motions of a car.
    #[table(SMAC_HYBRID, "SmacPlannerHybrid")]
    pub struct SmacHybridParams {
        /// Parameters of planners on cells and headings.
        #[shared]
        common: SmacHeadingParams,
        /// Plans on larger cells.
        #[param("downsample_costmap")]
        downsample_costmap: bool = false,
        /// Size of the larger cells, in cells.
        #[param("downsampling_factor", within(1.0, 1000.0))]
        downsampling_factor: usize = 1,
        /// Number of headings.
        #[param("angle_quantization_bins", within(1.0, 1000.0))]
        angle_quantization_bins: usize = 72,
        /// Motions of the robot.
        #[param("motion_model_for_search")]
        motion_model_for_search: SmacMotionModel = "DUBIN",
        /// Radius of the tightest turn.
        #[param("minimum_turning_radius", unit("m"), min(0.0))]
        minimum_turning_radius_m: f64 = 0.4,
        /// Uses turns of all numbers of bins, not only the tightest (before main: false).
        #[param("allow_primitive_interpolation")]
        allow_primitive_interpolation: bool = true,
        /// Addition to `non_straight_penalty` where a turn changes its direction.
        #[param("change_penalty", min(0.0))]
        change_penalty: f64 = 0,
        /// Factor of the cost of turns.
        #[param("non_straight_penalty", min(0.0))]
        non_straight_penalty: f64 = 1.2,
        /// Length of path that a cusp costs, a change between forwards and backwards. Not in Nav2, where a car turns
        /// around by many short strokes.
        #[param("cusp_penalty", unit("m"), min(0.0))]
        cusp_penalty_m: f64 = 0,
    }
}

params! {
    /// State Lattice: A* on cells and headings, with the motions of a file.
    #[table(SMAC_LATTICE, "SmacPlannerLattice")]
    pub struct SmacLatticeParams {
        /// Parameters of planners on cells and headings.
        #[shared]
        common: SmacHeadingParams,
        /// File of the motions, in JSON; empty for a car with a radius of 0.5 m on cells of 0.05 m.
        #[param("lattice_filepath")]
        lattice_filepath: String = "",
        /// Drives also backwards.
        #[param("allow_reverse_expansion")]
        allow_reverse_expansion: bool = false,
        /// Addition to `non_straight_penalty` where a turn changes its direction.
        #[param("change_penalty", min(0.0))]
        change_penalty: f64 = 0.05,
        /// Factor of the cost of turns.
        #[param("non_straight_penalty", min(0.0))]
        non_straight_penalty: f64 = 1.05,
        /// Cost of a rotation in place.
        #[param("rotation_penalty", min(0.0))]
        rotation_penalty: f64 = 5,
    }
}
