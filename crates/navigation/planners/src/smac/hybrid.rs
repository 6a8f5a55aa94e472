//! Hybrid-A*.
//!
//! Source of the rules: `nav2_smac_planner/smac_planner_hybrid_impl.hpp`.

use periplus_costmap::cost::{INSCRIBED, MAX_NON_OBSTACLE};
use periplus_costmap::{Costmap, Nav2Release};
use periplus_geometry::Pose2;
use periplus_grid::{Cell, GridInfo};
use periplus_params::{ParamValue, ParamValues, param_choice};

use super::analytic::AnalyticSettings;
use super::collision::{CollisionChecker, downsampled};
use super::distance_table::{BinPose, DistanceTable};
use super::headings::Headings;
use super::lattice::Lattice;
use super::motions::{CarMotions, LatticeMotions, Motions};
use super::path_smoothing::{SmacSmoother, smooth};
use super::primitives::{PrimitiveSet, SmacMotionModel, StepPenalties};
use super::search::{
    Hooks, MotionTables, SearchBuffers, SearchLimits, SmacGoal, SmacOutcome, SmacSearch,
};
use crate::obstruction::{Passable, explain};
use crate::parameters::{ChangeRules, ParameterStore};
use crate::tables::{SMAC_HYBRID, SmacHybridParams, SmacLatticeParams};
use crate::{
    ParameterRejected, PlanError, PlanErrorKind, PlanRequest, PlannedPath, Planner, outside,
};

param_choice! {
    /// Headings at the goal that a plan may end with: `goal_heading_mode`.
    pub enum GoalHeadingMode {
        /// The heading of the goal.
        #[default]
        Default = "DEFAULT",
        /// The heading of the goal, or the opposite one.
        Bidirectional = "BIDIRECTIONAL",
        /// Any heading.
        AllDirection = "ALL_DIRECTION",
    }
}

const RULES: ChangeRules = ChangeRules {
    fixed: &[
        "debug_visualizations",
        "downsample_obstacle_heuristic",
        "lattice_filepath",
        "retrospective_penalty",
        "use_quadratic_cost_penalty",
        "smoother.do_refinement",
        "smoother.refinement_num",
        "smoother.w_data",
        "smoother.w_smooth",
    ],
    allows_zero: true,
    unlimited: &["max_iterations", "max_on_approach_iterations"],
};

/// The Hybrid-A* planner.
#[derive(Debug)]
pub struct SmacHybridPlanner {
    store: ParameterStore,
    params: SmacHybridParams,
    release: Nav2Release,
    headings: Headings,
    /// Motions of the State Lattice planner; none for those of a car.
    lattice: Option<(Lattice, LatticeSettings)>,
    /// Tables for a resolution \[m\]; rebuilt when it or a parameter changes.
    tables: Option<(f64, MotionTables)>,
    buffers: SearchBuffers,
}

impl Default for SmacHybridPlanner {
    fn default() -> Self {
        Self::new(ParamValues::defaults(&SMAC_HYBRID), Nav2Release::Main)
    }
}

/// Parameters that only the State Lattice planner has.
#[derive(Clone, Copy, Debug)]
struct LatticeSettings {
    reverses: bool,
    rotation_penalty: f64,
}

/// Returns the parameters with the defaults of a release.
fn params_of(values: &ParamValues, release: Nav2Release) -> SmacHybridParams {
    let mut params = SmacHybridParams::from_values(values);
    if release < Nav2Release::Main && !values.is_given("allow_primitive_interpolation") {
        params.allow_primitive_interpolation = false;
    }
    params
}

/// Returns the parameters of the State Lattice planner in terms of Hybrid-A*.
fn params_of_lattice(
    values: &ParamValues,
    lattice: &Lattice,
) -> (SmacHybridParams, LatticeSettings) {
    let params = SmacLatticeParams::from_values(values);
    let reverses = params.allow_reverse_expansion;
    let settings = LatticeSettings { reverses, rotation_penalty: params.rotation_penalty };
    let model = if reverses { SmacMotionModel::ReedsShepp } else { SmacMotionModel::Dubin };
    let hybrid = SmacHybridParams {
        change_penalty: params.change_penalty,
        non_straight_penalty: params.non_straight_penalty,
        common: params.common,
        angle_quantization_bins: lattice.headings_rad.len(),
        motion_model_for_search: model,
        minimum_turning_radius_m: lattice.radius_m,
        ..SmacHybridParams::default()
    };
    (hybrid, settings)
}

impl SmacHybridPlanner {
    /// Creates a planner with values of [`crate::tables::SMAC_HYBRID`]; those that were not given have the
    /// defaults of the release.
    #[must_use]
    pub fn new(values: ParamValues, release: Nav2Release) -> Self {
        let params = params_of(&values, release);
        let headings = Headings::uniform(params.angle_quantization_bins);
        let store = ParameterStore::new(values, &RULES);
        let buffers = SearchBuffers::default();
        Self { store, params, release, headings, lattice: None, tables: None, buffers }
    }

    /// Creates the State Lattice planner with values of [`crate::tables::SMAC_LATTICE`]. The caller reads the
    /// file `lattice_filepath`; without one Nav2 uses a lattice as [`Lattice::ackermann`] generates it for
    /// cells of 0.05 m and a radius of 0.5 m.
    #[must_use]
    pub fn with_lattice(values: ParamValues, lattice: Lattice) -> Self {
        let (params, settings) = params_of_lattice(&values, &lattice);
        let headings = Headings::listed(lattice.headings_rad.clone());
        let store = ParameterStore::new(values, &RULES);
        let (release, buffers) = (Nav2Release::Main, SearchBuffers::default());
        let lattice = Some((lattice, settings));
        Self { store, params, release, headings, lattice, tables: None, buffers }
    }

    fn bin_count(&self) -> usize {
        self.headings.count()
    }

    /// Returns the turning radius \[m\]: at least one cell.
    fn radius_m(&self, resolution_m: f64) -> f64 {
        self.params.minimum_turning_radius_m.max(resolution_m)
    }

    fn build_tables(&self, resolution_m: f64) -> MotionTables {
        let params = &self.params;
        let model = params.motion_model_for_search;
        let radius = self.radius_m(resolution_m) / resolution_m;
        let penalties = StepPenalties {
            retrospective: params.common.retrospective_penalty,
            cost: params.common.cost_penalty,
            non_straight: params.non_straight_penalty,
            change: params.change_penalty,
            reverse: params.common.reverse_penalty,
            is_quadratic: params.common.use_quadratic_cost_penalty,
        };
        let motions = match &self.lattice {
            Some((lattice, LatticeSettings { reverses, rotation_penalty })) => Motions::Lattice(
                LatticeMotions::new(lattice, penalties, *rotation_penalty, *reverses),
            ),
            None => {
                let interpolates = params.allow_primitive_interpolation;
                let set = PrimitiveSet::new(model, radius, self.bin_count(), interpolates);
                let cusp_cost = params.cusp_penalty_m / resolution_m;
                Motions::Car(CarMotions::new(set, penalties, cusp_cost, &self.headings))
            }
        };
        // The side of the table is odd, so that the goal is in its middle.
        let side = (params.common.lookup_table_size_m / resolution_m) as usize | 1;
        let lengths = DistanceTable::new(model.curves(), radius, self.headings.clone(), side);
        let analytic = AnalyticSettings {
            family: model.curves(),
            radius,
            max_length: params.common.analytic_expansion_max_length_m / resolution_m,
            max_cost: params.common.analytic_expansion_max_cost,
            overrides_max_cost: params.common.analytic_expansion_max_cost_override,
            cost_penalty: params.common.cost_penalty,
            cusp_cost: params.cusp_penalty_m / resolution_m,
        };
        let analytic_ratio = params.common.analytic_expansion_ratio.max(f64::MIN_POSITIVE);
        MotionTables { bin_count: self.bin_count(), motions, lengths, analytic, analytic_ratio }
    }

    /// Returns the goals that are valid: in a free cell, or within the tolerance of one.
    fn goals(
        &self,
        goal: BinPose,
        tolerance: f64,
        checker: &CollisionChecker<'_>,
        map: &Costmap,
    ) -> Vec<SmacGoal> {
        let bins = self.bin_count();
        let coarse = self.params.common.coarse_search_resolution.max(1);
        let headings: Vec<(usize, bool)> = match self.params.common.goal_heading_mode {
            GoalHeadingMode::Default => vec![(goal.bin, true)],
            GoalHeadingMode::Bidirectional => {
                vec![(goal.bin, true), ((goal.bin + bins / 2) % bins, true)]
            }
            GoalHeadingMode::AllDirection => {
                (0..bins).map(|bin| (bin, bin % coarse == 0)).collect()
            }
        };
        let goals = headings
            .into_iter()
            .map(|(bin, is_coarse)| SmacGoal { pose: BinPose { bin, ..goal }, is_coarse });
        let is_valid = |goal: &SmacGoal| {
            let BinPose { x, y, bin } = goal.pose;
            checker.free_cost(x, y, bin).is_some()
                || has_free_zone(goal.pose, tolerance, checker, map)
        };
        goals.filter(is_valid).collect()
    }

    fn smoother(&self, resolution_m: f64) -> SmacSmoother {
        SmacSmoother {
            relaxation: self.params.common.smoother.relaxation(),
            radius_m: Some(self.radius_m(resolution_m)),
        }
    }
}

/// Returns true if a cell within a radius around a pose \[cells\] is free.
fn has_free_zone(at: BinPose, radius: f64, checker: &CollisionChecker<'_>, map: &Costmap) -> bool {
    if radius < 1.0 {
        return false;
    }
    let range = |centre: f64, count: usize| {
        let low = libm::floor(centre - radius).max(0.0) as usize;
        let high = (libm::ceil(centre + radius) as usize).min(count.saturating_sub(1));
        low..=high
    };
    let (columns, rows) = (range(at.x, map.info().width), range(at.y, map.info().height));
    columns.into_iter().any(|column| {
        rows.clone().any(|row| {
            let (dx, dy) = (column as f64 - at.x, row as f64 - at.y);
            dx * dx + dy * dy <= radius * radius
                && checker.free_cost(column as f64 + 0.5, row as f64 + 0.5, at.bin).is_some()
        })
    })
}

fn bin_pose(info: &GridInfo, pose: Pose2, headings: &Headings) -> BinPose {
    let (x, y) = info.finder().cells_to(pose.x_m, pose.y_m);
    BinPose { x, y, bin: headings.nearest(pose.yaw_rad) }
}

/// Returns the error of a search that found no path.
pub(super) fn failure(iterations: usize, max_iterations: usize, is_out_of_time: bool) -> PlanError {
    if is_out_of_time {
        PlanError::new(PlanErrorKind::Timeout, "exceeded maximum planning time")
    } else if iterations == 1 {
        PlanError::new(PlanErrorKind::StartOccupied, "Start occupied")
    } else if iterations < max_iterations {
        PlanError::new(PlanErrorKind::NoValidPath, "no valid path found")
    } else {
        PlanError::new(PlanErrorKind::Timeout, "exceeded maximum iterations")
    }
}

/// Returns a limit, of which 0 and negative numbers mean none.
pub(super) fn limit(count: i64) -> usize {
    if count <= 0 { usize::MAX } else { usize::try_from(count).unwrap_or(usize::MAX) }
}

/// Returns true if two cells are the same.
pub(super) fn is_same_cell(info: &GridInfo, a: Pose2, b: Pose2) -> bool {
    let cell = |pose: Pose2| -> Option<Cell> { info.cell_of(pose.x_m, pose.y_m) };
    cell(a) == cell(b)
}

impl Planner for SmacHybridPlanner {
    fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError> {
        let PlanRequest { costmap: view, start, goal, is_cancelled, is_out_of_time } = request;
        let start_cell = outside::start_cell(view.costs.info(), start)?;
        outside::goal_cell(view.costs.info(), goal)?;
        let factor =
            if self.params.downsample_costmap { self.params.downsampling_factor } else { 1 };
        let coarse = (factor > 1).then(|| downsampled(view.costs, factor));
        let map = coarse.as_ref().unwrap_or(view.costs);
        let (info, resolution_m) = (map.info(), map.resolution_m());
        let start_bins = bin_pose(info, start, &self.headings);
        let goal_bins = bin_pose(info, goal, &self.headings);
        if is_same_cell(info, start, goal) && start_bins.bin == goal_bins.bin {
            let pose = Pose2 { yaw_rad: goal.yaw_rad, ..start };
            return Ok(PlannedPath {
                poses: vec![pose],
                unsmoothed: vec![pose],
                ..PlannedPath::default()
            });
        }
        let headings = self.headings.clone();
        let allow_unknown = self.params.common.search.allow_unknown;
        let checker = CollisionChecker::new(&view, map, &headings, allow_unknown);
        let tolerance = self.params.common.tolerance_m / resolution_m;
        let goals = self.goals(goal_bins, tolerance, &checker, map);
        let explanation = || {
            let passable =
                Passable { max_cost: MAX_NON_OBSTACLE.min(INSCRIBED - 1), unknown: allow_unknown };
            explain(view.costs, start_cell, goal, passable)
        };
        if goals.is_empty() {
            let error = PlanError::new(PlanErrorKind::GoalOccupied, "Goal was in lethal cost");
            return Err(error.with(explanation()));
        }
        if self.tables.as_ref().is_none_or(|(built_m, _)| *built_m != resolution_m) {
            self.tables = Some((resolution_m, self.build_tables(resolution_m)));
        }
        let smoother = self.smoother(resolution_m);
        let params = &self.params;
        let Some((_, tables)) = &mut self.tables else {
            return Err(PlanError::new(PlanErrorKind::Unknown, "there are no motion tables"));
        };
        let is_quadratic = params.common.use_quadratic_cost_penalty;
        let goal_cells = [goal_bins.x, goal_bins.y];
        self.buffers.obstacles.reset(map, goal_cells, params.common.cost_penalty, is_quadratic);
        let limits = SearchLimits {
            max_iterations: limit(params.common.search.max_iterations),
            max_on_approach: limit(params.common.search.max_on_approach_iterations),
            check_interval: params.common.search.terminal_checking_interval,
            tolerance,
        };
        let buffers = &mut self.buffers;
        let search = SmacSearch { map, checker: &checker, tables, buffers, limits, goals: &goals };
        let mut hooks = Hooks { is_cancelled, is_out_of_time };
        let (outcome, expansion_count) = search.run(start_bins, &mut hooks);
        let path = match outcome {
            SmacOutcome::Found(path) => path,
            SmacOutcome::Cancelled => return Err(PlanError::cancelled()),
            outcome @ (SmacOutcome::OutOfTime | SmacOutcome::Exhausted) => {
                let is_out_of_time = matches!(outcome, SmacOutcome::OutOfTime);
                let error = failure(expansion_count, limits.max_iterations, is_out_of_time);
                return Err(error.with(explanation()));
            }
        };
        let in_map = |pose: &Pose2| {
            let (x_m, y_m) = info.point_at(pose.x_m, pose.y_m);
            Pose2::new(x_m, y_m, pose.yaw_rad).normalized()
        };
        let mut poses: Vec<Pose2> = path.iter().map(in_map).collect();
        let unsmoothed = poses.clone();
        if params.common.smooth_path && expansion_count > 1 {
            smooth(&mut poses, &smoother, &view, map, hooks.is_out_of_time);
        }
        Ok(PlannedPath { poses, cleared_cell: None, unsmoothed, expansion_count })
    }

    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected> {
        let bins = self.params.angle_quantization_bins as i64;
        let coarse = self.params.common.coarse_search_resolution as i64;
        match (name, value) {
            ("angle_quantization_bins", ParamValue::Integer(new))
                if *new > 0 && new % coarse != 0 =>
            {
                let reason =
                    format!("{new} is not a multiple of `coarse_search_resolution` {coarse}");
                return Err(ParameterRejected::Value("angle_quantization_bins", reason));
            }
            ("coarse_search_resolution", ParamValue::Integer(new))
                if *new > 0 && bins % new != 0 =>
            {
                let reason = format!("{new} does not divide `angle_quantization_bins` {bins}");
                return Err(ParameterRejected::Value("coarse_search_resolution", reason));
            }
            ("minimum_turning_radius", ParamValue::Number(new)) => {
                let cell_m = self.tables.as_ref().map_or(0.0, |(resolution_m, _)| *resolution_m);
                if *new < cell_m {
                    let reason = format!("{new} m is below the side of a cell, {cell_m} m");
                    return Err(ParameterRejected::Value("minimum_turning_radius", reason));
                }
            }
            _ => {}
        }
        self.store.change(name, value)?;
        let values = self.store.values();
        match &mut self.lattice {
            Some((lattice, settings)) => {
                (self.params, *settings) = params_of_lattice(values, lattice);
            }
            None => {
                self.params = params_of(values, self.release);
                self.headings = Headings::uniform(self.params.angle_quantization_bins);
            }
        }
        self.tables = None;
        Ok(())
    }

    fn max_planning_time_s(&self) -> Option<f64> {
        Some(self.params.common.max_planning_time_s)
    }
}
