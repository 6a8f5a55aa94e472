//! NavFn: potentials from the robot to the goal, and a path down their gradient.
//!
//! Source of the rules: `nav2_navfn_planner/src/navfn_planner.cpp`. Two defects of NavFn are kept, since
//! paths depend on them: a cell is at its lower left corner, half a cell off the rest of Nav2, and the cell
//! of the robot counts as free. Its queues of at most 10,000 cells, which lose cells on large open maps, are
//! not kept. Where NavFn finds no path, as the robot is nearer to an obstacle than its inscribed radius, the path
//! begins with the escape from there.

mod descent;
mod escape;
mod field;
mod front;

pub use field::{NavFnMethod, PotentialField, Propagation, PropagationCancelled};

use periplus_costmap::cost::{LETHAL, MAX_NON_OBSTACLE};
use periplus_geometry::Pose2;
use periplus_grid::{Cell, GridInfo};
use periplus_params::{ParamValue, ParamValues};

use crate::obstruction::{Passable, blocking_cell, explain};
use crate::parameters::{ChangeRules, ParameterStore};
use crate::poses::{approach_yaw_rad, single_pose};
use crate::tables::{NAVFN, NavFnParams};
use crate::{
    BlockedPart, ParameterRejected, PlanError, PlanErrorKind, PlanObstruction, PlanRequest,
    PlannedPath, Planner, outside,
};

/// Squared distance below which the last point of the gradient is the goal \[m²\].
const SAME_POINT_M2: f64 = 1e-6;

/// Number of cells from which only the part of the map around the path is computed.
const MIN_DIRECTED_COUNT: usize = 250_000;

const RULES: ChangeRules = ChangeRules { fixed: &[], allows_zero: false, unlimited: &[] };

/// Returns the cell of a point as NavFn rounds it: the nearest lower left corner; none outside the grid.
#[must_use]
pub fn navfn_cell_of(info: &GridInfo, x_m: f64, y_m: f64) -> Option<Cell> {
    let (columns, rows) = (x_m - info.origin.x_m, y_m - info.origin.y_m);
    if !(columns >= 0.0 && rows >= 0.0) {
        return None;
    }
    let nearest = |length_m: f64| libm::round(length_m / info.resolution_m);
    let (column, row) = (nearest(columns), nearest(rows));
    let is_inside = column < info.width as f64 && row < info.height as f64;
    is_inside.then_some((column as usize, row as usize))
}

/// Returns the point at which NavFn assumes a cell, which may be fractional: its lower left corner \[m\].
#[must_use]
pub fn navfn_point_of(info: &GridInfo, column: f64, row: f64) -> (f64, f64) {
    let GridInfo { origin, resolution_m, .. } = *info;
    (origin.x_m + column * resolution_m, origin.y_m + row * resolution_m)
}

/// The NavFn planner.
#[derive(Debug)]
pub struct NavFnPlanner {
    store: ParameterStore,
    params: NavFnParams,
    field: PotentialField,
}

impl Default for NavFnPlanner {
    fn default() -> Self {
        Self::new(ParamValues::defaults(&NAVFN))
    }
}

impl NavFnPlanner {
    /// Creates a planner with values of [`crate::tables::NAVFN`].
    #[must_use]
    pub fn new(values: ParamValues) -> Self {
        let params = NavFnParams::from_values(&values);
        let store = ParameterStore::new(values, &RULES);
        Self { store, params, field: PotentialField::default() }
    }

    /// Returns the potentials of the last plan.
    #[must_use]
    pub fn potentials(&self) -> &PotentialField {
        &self.field
    }

    fn passable(&self) -> Passable {
        Passable { max_cost: MAX_NON_OBSTACLE, unknown: self.params.allow_unknown }
    }

    /// Returns the goal, or the sample nearest to it within the tolerance that has a potential.
    fn reachable_goal(&self, info: &GridInfo, goal: Pose2) -> Option<Pose2> {
        let has_potential = |pose: &Pose2| {
            let cell = navfn_cell_of(info, pose.x_m, pose.y_m);
            cell.is_some_and(|cell| self.field.potential(cell).is_some())
        };
        if has_potential(&goal) {
            return Some(goal);
        }
        let tolerance_m = self.params.tolerance_m;
        let samples = |centre_m: f64| {
            let mut at = centre_m - tolerance_m;
            std::iter::from_fn(move || {
                let sample = at;
                at += info.resolution_m;
                (sample <= centre_m + tolerance_m).then_some(sample)
            })
        };
        let mut best: Option<(f64, Pose2)> = None;
        for y_m in samples(goal.y_m) {
            for x_m in samples(goal.x_m) {
                let pose = Pose2 { x_m, y_m, ..goal };
                let square_m2 = square_m2(pose, goal);
                let is_nearer = best.is_none_or(|(best_m2, _)| square_m2 < best_m2);
                if is_nearer && has_potential(&pose) {
                    best = Some((square_m2, pose));
                }
            }
        }
        best.map(|(_, pose)| pose)
    }

    /// Returns the poses from the robot to a goal that has a potential.
    fn path_to(&self, info: &GridInfo, robot: Cell, goal: Pose2) -> Option<Vec<Pose2>> {
        let from = navfn_cell_of(info, goal.x_m, goal.y_m)?;
        let max_step_count = info.width.max(info.height) * self.params.max_cycles_factor;
        let path = descent::descend(&self.field, from, robot, max_step_count)?;
        let pose = |[column, row]: &[f32; 2]| {
            let (x_m, y_m) = navfn_point_of(info, f64::from(*column), f64::from(*row));
            Pose2::new(x_m, y_m, 0.0)
        };
        Some(path.iter().rev().map(pose).collect())
    }
}

fn square_m2(a: Pose2, b: Pose2) -> f64 {
    let (x_m, y_m) = (a.x_m - b.x_m, a.y_m - b.y_m);
    x_m * x_m + y_m * y_m
}

/// Ends a path at the goal: in place of the last pose if that is farther, or the same point.
fn end_at(goal: Pose2, poses: &mut Vec<Pose2>) {
    if let [.., before, last] = poses.as_mut_slice() {
        let is_beyond = square_m2(*last, *before) > square_m2(goal, *before);
        if is_beyond || square_m2(*last, goal) < SAME_POINT_M2 {
            *last = goal;
            return;
        }
    }
    poses.push(goal);
}

impl Planner for NavFnPlanner {
    fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError> {
        let PlanRequest { costmap, start, goal, is_cancelled, .. } = request;
        let (map, info) = (costmap.costs, costmap.costs.info());
        let start_cell = outside::start_cell(info, start)?;
        let goal_cell = outside::goal_cell(info, goal)?;
        let tolerance_m = self.params.tolerance_m;
        if tolerance_m == 0.0 && map.cost(goal_cell) == Some(LETHAL) {
            let passable = self.passable();
            let blocking = blocking_cell(map, goal_cell, BlockedPart::Goal, passable);
            return Err(outside::occupied(PlanErrorKind::GoalOccupied, goal)
                .with(PlanObstruction { blocking, ..explain(map, start_cell, goal, passable) }));
        }
        if start.x_m == goal.x_m && start.y_m == goal.y_m {
            let pose = single_pose(start, goal, self.params.use_final_approach_orientation);
            return Ok(PlannedPath { poses: vec![pose], ..PlannedPath::default() });
        }
        // A point beyond the middle of the last cell rounds to one outside the grid.
        let last = (info.width - 1, info.height - 1);
        let robot = navfn_cell_of(info, start.x_m, start.y_m).unwrap_or_else(|| {
            let (columns, rows) = info.finder().cells_to(start.x_m, start.y_m);
            let nearest = |cells: f64, last: usize| (libm::round(cells) as usize).min(last);
            (nearest(columns, last.0), nearest(rows, last.1))
        });
        let changed = escape::with_escape(map.costs(), info.width, robot);
        let costs = changed.as_deref().unwrap_or(map.costs());
        let method = if self.params.use_astar { NavFnMethod::AStar } else { NavFnMethod::Dijkstra };
        let how = Propagation {
            method,
            allow_unknown: self.params.allow_unknown,
            robot,
            goal: navfn_cell_of(info, goal.x_m, goal.y_m),
        };
        let is_directed = method == NavFnMethod::Dijkstra && info.len() >= MIN_DIRECTED_COUNT;
        let field = &mut self.field;
        let computed = if is_directed {
            field.compute_towards_goal(costs, info.width, &how, is_cancelled)
        } else {
            field.compute(costs, info.width, &how, is_cancelled)
        };
        let expansion_count = computed.map_err(|PropagationCancelled| PlanError::cancelled())?;
        let path = self.reachable_goal(info, goal).and_then(|end| {
            let mut poses = self.path_to(info, robot, end)?;
            end_at(end, &mut poses);
            Some(poses)
        });
        let Some(mut poses) = path else {
            let message = format!("Failed to create plan with tolerance of: {tolerance_m:.6}");
            return Err(PlanError::new(PlanErrorKind::NoValidPath, message).with(explain(
                map,
                start_cell,
                goal,
                self.passable(),
            )));
        };
        if self.params.use_final_approach_orientation {
            let yaw_rad = approach_yaw_rad(&poses).unwrap_or(start.yaw_rad);
            if let Some(last) = poses.last_mut() {
                last.yaw_rad = yaw_rad;
            }
        }
        Ok(PlannedPath {
            poses,
            cleared_cell: Some(robot),
            expansion_count,
            ..PlannedPath::default()
        })
    }

    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected> {
        self.store.change(name, value)?;
        self.params = NavFnParams::from_values(self.store.values());
        Ok(())
    }
}
