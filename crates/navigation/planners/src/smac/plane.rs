//! A* on the cells of a costmap.
//!
//! Source of the rules: `nav2_smac_planner/smac_planner_2d_impl.hpp`, `node_2d.cpp`. Poses are at the centres
//! of cells; Nav2 puts them at the lower left corners.

use std::f64::consts::SQRT_2;

use periplus_costmap::Costmap;
use periplus_costmap::cost::{INSCRIBED, UNKNOWN};
use periplus_geometry::Pose2;
use periplus_grid::Cell;
use periplus_params::{ParamValue, ParamValues};

use super::collision::downsampled;
use super::hybrid::{failure, is_same_cell, limit};
use super::path_smoothing::{SmacSmoother, smooth};
use super::search::{Hooks, SearchLimits};
use crate::cell_index::CellIndex;
use crate::obstruction::{Passable, explain};
use crate::open_list::OpenList;
use crate::parameters::{ChangeRules, ParameterStore};
use crate::poses::approach_yaw_rad;
use crate::tables::{SMAC_2D, Smac2dParams};
use crate::{
    ParameterRejected, PlanError, PlanErrorKind, PlanRequest, PlannedPath, Planner, outside,
};

const RULES: ChangeRules = ChangeRules {
    fixed: &[
        "smoother.do_refinement",
        "smoother.refinement_num",
        "smoother.w_data",
        "smoother.w_smooth",
    ],
    allows_zero: true,
    unlimited: &["max_iterations", "max_on_approach_iterations"],
};

/// The planner `SmacPlanner2D`.
#[derive(Debug)]
pub struct Smac2dPlanner {
    store: ParameterStore,
    params: Smac2dParams,
    buffers: Buffers,
}

impl Default for Smac2dPlanner {
    fn default() -> Self {
        Self::new(ParamValues::defaults(&SMAC_2D))
    }
}

#[derive(Clone, Copy, Debug)]
struct Node {
    cell: u32,
    parent: u32,
    g: f32,
    is_visited: bool,
}

#[derive(Debug, Default)]
struct Buffers {
    index: CellIndex,
    nodes: Vec<Node>,
    open: OpenList,
}

/// End of a search.
enum Outcome {
    /// Cells from the start to the goal.
    Found(Vec<Cell>),
    Cancelled,
    OutOfTime,
    Exhausted,
}

/// Neighbours of a cell in the order of Nav2; the last four are diagonal.
const NEIGHBOURS: [[isize; 2]; 8] =
    [[-1, 0], [1, 0], [0, -1], [0, 1], [-1, -1], [1, -1], [-1, 1], [1, 1]];

/// Returns the cost of a straight step into a cell by its cost; infinite if it blocks.
fn step_costs(params: &Smac2dParams) -> Vec<f32> {
    let step = |cost: u8| {
        let is_free = if cost == UNKNOWN { params.search.allow_unknown } else { cost < INSCRIBED };
        let weight = params.cost_travel_multiplier * f64::from(cost) / 252.0;
        if is_free { (1.0 + weight) as f32 } else { f32::INFINITY }
    };
    (0..=u8::MAX).map(step).collect()
}

impl Buffers {
    fn search(
        &mut self,
        map: &Costmap,
        steps: &[f32],
        [start, goal]: [Cell; 2],
        limits: &SearchLimits,
        hooks: &mut Hooks<'_>,
    ) -> (Outcome, usize) {
        let info = map.info();
        let estimate = |(column, row): Cell| {
            let (dx, dy) = (column as f32 - goal.0 as f32, row as f32 - goal.1 as f32);
            (dx * dx + dy * dy).sqrt()
        };
        self.index.reset(info.len());
        self.nodes.clear();
        self.open.clear();
        let first = Node { cell: info.index(start) as u32, parent: 0, g: 0.0, is_visited: false };
        self.nodes.push(first);
        self.index.insert(info.index(start), 0);
        self.open.push(0.0, 0);
        let tolerance = limits.tolerance as f32;
        let mut nearest = (f32::INFINITY, 0);
        let (mut iterations, mut approach_iterations) = (0, 0);
        let mut is_checked = false;
        let end = loop {
            if iterations >= limits.max_iterations {
                break Outcome::Exhausted;
            }
            if iterations % limits.check_interval == 0 && !is_checked {
                is_checked = true;
                if (hooks.is_cancelled)() {
                    return (Outcome::Cancelled, iterations);
                }
                if (hooks.is_out_of_time)() {
                    break Outcome::OutOfTime;
                }
            }
            let Some((_, current)) = self.open.pop() else { break Outcome::Exhausted };
            let node = self.nodes[current];
            if node.is_visited {
                continue;
            }
            iterations += 1;
            is_checked = false;
            self.nodes[current].is_visited = true;
            let at = info.cell(node.cell as usize);
            if at == goal {
                return (Outcome::Found(self.path_to(map, current)), iterations);
            }
            if nearest.0 < tolerance {
                approach_iterations += 1;
                if approach_iterations >= limits.max_on_approach {
                    return (Outcome::Found(self.path_to(map, nearest.1)), iterations);
                }
            }
            for (index, [dx, dy]) in NEIGHBOURS.into_iter().enumerate() {
                let cell = (at.0.wrapping_add_signed(dx), at.1.wrapping_add_signed(dy));
                if !info.contains(cell) {
                    continue;
                }
                let cell_index = info.index(cell);
                let length = if index > 3 { SQRT_2 as f32 } else { 1.0 };
                let g = node.g + length * steps[usize::from(map.costs()[cell_index])];
                if g == f32::INFINITY {
                    continue;
                }
                let new =
                    Node { cell: cell_index as u32, parent: current as u32, g, is_visited: false };
                let neighbour = match self.index.get(cell_index) {
                    Some(known) if self.nodes[known].is_visited || self.nodes[known].g <= g => {
                        continue;
                    }
                    Some(known) => {
                        self.nodes[known] = new;
                        known
                    }
                    None => {
                        self.nodes.push(new);
                        self.index.insert(cell_index, self.nodes.len() - 1);
                        self.nodes.len() - 1
                    }
                };
                let heuristic = estimate(cell);
                if heuristic < nearest.0 {
                    nearest = (heuristic, neighbour);
                }
                self.open.push(g + heuristic, neighbour);
            }
        };
        if nearest.0 < tolerance {
            return (Outcome::Found(self.path_to(map, nearest.1)), iterations);
        }
        (end, iterations)
    }

    fn path_to(&self, map: &Costmap, node: usize) -> Vec<Cell> {
        let step = |at: &usize| (*at != 0).then(|| self.nodes[*at].parent as usize);
        let back = std::iter::successors(Some(node), step).take(self.nodes.len());
        let mut path: Vec<Cell> =
            back.map(|at| map.info().cell(self.nodes[at].cell as usize)).collect();
        path.reverse();
        path
    }
}

/// Returns true if the goal, or a cell within the tolerance \[cells\], is free.
fn is_goal_valid(map: &Costmap, goal: Cell, tolerance: f64, steps: &[f32]) -> bool {
    let is_free =
        |cell: Cell| map.cost(cell).is_some_and(|cost| steps[usize::from(cost)] < f32::INFINITY);
    if is_free(goal) || tolerance < 1.0 {
        return is_free(goal);
    }
    let reach = tolerance as isize;
    let offsets = || -reach..=reach;
    offsets().any(|dx| {
        offsets().any(|dy| {
            (dx * dx + dy * dy) as f64 <= tolerance * tolerance
                && is_free((goal.0.wrapping_add_signed(dx), goal.1.wrapping_add_signed(dy)))
        })
    })
}

impl Smac2dPlanner {
    /// Creates a planner with values of [`crate::tables::SMAC_2D`].
    #[must_use]
    pub fn new(values: ParamValues) -> Self {
        let params = Smac2dParams::from_values(&values);
        let store = ParameterStore::new(values, &RULES);
        Self { store, params, buffers: Buffers::default() }
    }
}

impl Planner for Smac2dPlanner {
    fn plan(&mut self, request: PlanRequest<'_>) -> Result<PlannedPath, PlanError> {
        let PlanRequest { costmap: view, start, goal, is_cancelled, is_out_of_time } = request;
        let full_start_cell = outside::start_cell(view.costs.info(), start)?;
        outside::goal_cell(view.costs.info(), goal)?;
        let params = &self.params;
        let factor = if params.downsample_costmap { params.downsampling_factor } else { 1 };
        let coarse = (factor > 1).then(|| downsampled(view.costs, factor));
        let map = coarse.as_ref().unwrap_or(view.costs);
        let info = map.info();
        let start_cell = outside::start_cell(info, start)?;
        let goal_cell = outside::goal_cell(info, goal)?;
        let keeps_direction = params.use_final_approach_orientation;
        if is_same_cell(info, start, goal) {
            let yaw_rad = if keeps_direction { start.yaw_rad } else { goal.yaw_rad };
            let pose = Pose2 { yaw_rad, ..goal };
            return Ok(PlannedPath {
                poses: vec![pose],
                unsmoothed: vec![pose],
                ..PlannedPath::default()
            });
        }
        let steps = step_costs(params);
        let tolerance = params.tolerance_m / info.resolution_m;
        let explanation = || {
            let passable =
                Passable { max_cost: INSCRIBED - 1, unknown: params.search.allow_unknown };
            explain(view.costs, full_start_cell, goal, passable)
        };
        if !is_goal_valid(map, goal_cell, tolerance, &steps) {
            let error = PlanError::new(PlanErrorKind::GoalOccupied, "Goal was in lethal cost");
            return Err(error.with(explanation()));
        }
        let limits = SearchLimits {
            max_iterations: limit(params.search.max_iterations),
            max_on_approach: limit(params.search.max_on_approach_iterations),
            check_interval: params.search.terminal_checking_interval,
            tolerance,
        };
        let mut hooks = Hooks { is_cancelled, is_out_of_time };
        let ends = [start_cell, goal_cell];
        let (outcome, expansion_count) =
            self.buffers.search(map, &steps, ends, &limits, &mut hooks);
        let cells = match outcome {
            Outcome::Found(cells) => cells,
            Outcome::Cancelled => return Err(PlanError::cancelled()),
            outcome @ (Outcome::OutOfTime | Outcome::Exhausted) => {
                let is_out_of_time = matches!(outcome, Outcome::OutOfTime);
                let error = failure(expansion_count, limits.max_iterations, is_out_of_time);
                return Err(error.with(explanation()));
            }
        };
        let reaches_goal = cells.last() == Some(&goal_cell);
        let pose = |cell: &Cell| {
            let (x_m, y_m) = info.centre_of(*cell);
            Pose2::new(x_m, y_m, 0.0)
        };
        let mut poses: Vec<Pose2> = cells.iter().map(pose).collect();
        let unsmoothed = poses.clone();
        let smoother = SmacSmoother { relaxation: params.smoother.relaxation(), radius_m: None };
        smooth(&mut poses, &smoother, &view, map, hooks.is_out_of_time);
        if let Some(last) = poses.last_mut() {
            if reaches_goal {
                (last.x_m, last.y_m) = (goal.x_m, goal.y_m);
            }
            last.yaw_rad = goal.yaw_rad;
        }
        if keeps_direction {
            let yaw_rad = approach_yaw_rad(&poses).unwrap_or(start.yaw_rad);
            if let Some(last) = poses.last_mut() {
                last.yaw_rad = yaw_rad;
            }
        }
        Ok(PlannedPath { poses, cleared_cell: None, unsmoothed, expansion_count })
    }

    fn set_parameter(&mut self, name: &str, value: &ParamValue) -> Result<(), ParameterRejected> {
        self.store.change(name, value)?;
        self.params = Smac2dParams::from_values(self.store.values());
        Ok(())
    }

    fn max_planning_time_s(&self) -> Option<f64> {
        Some(self.params.max_planning_time_s)
    }
}
