//! Search for the cause of a failed plan: the blocking cell, and the nearest reachable position.

use periplus_costmap::Costmap;
use periplus_geometry::Pose2;
use periplus_grid::{Cell, GridInfo, Line};

use crate::error::{BlockedPart, BlockingCell, PlanObstruction, ReachablePose};

/// Costs that a planner passes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passable {
    /// Maximum passable cost.
    pub(crate) max_cost: u8,
    /// True if unknown cells are passable.
    pub(crate) unknown: bool,
}

impl Passable {
    /// Returns true if a cell with this cost is passable.
    pub(crate) fn contains(self, cost: u8) -> bool {
        if cost == periplus_costmap::cost::UNKNOWN { self.unknown } else { cost <= self.max_cost }
    }
}

/// Explains why a planner found no path from the cell of the robot to that of the goal.
pub(crate) fn explain(
    costmap: &Costmap,
    start: Cell,
    goal_pose: Pose2,
    passable: Passable,
) -> PlanObstruction {
    let info = costmap.info();
    let goal = info.cell_of(goal_pose.x_m, goal_pose.y_m);
    let block = |cell: Cell, part| blocking_cell(costmap, cell, part, passable);
    let reached = flood(costmap, start, passable);
    let nearest = nearest_reached(info, &reached, goal_pose);
    let blocking = block(start, BlockedPart::Start)
        .or_else(|| block(goal?, BlockedPart::Goal))
        .or_else(|| {
            let from = info.cell_of(nearest?.pose.x_m, nearest?.pose.y_m)?;
            Line::between(from, goal?).find_map(|cell| block(cell, BlockedPart::Between))
        });
    PlanObstruction { blocking, nearest }
}

/// Returns a cell if it blocks.
pub(crate) fn blocking_cell(
    costmap: &Costmap,
    cell: Cell,
    part: BlockedPart,
    passable: Passable,
) -> Option<BlockingCell> {
    let cost = costmap.cost(cell).filter(|cost| !passable.contains(*cost))?;
    let (x_m, y_m) = costmap.info().centre_of(cell);
    Some(BlockingCell { part, cell, centre: Pose2::new(x_m, y_m, 0.0), cost })
}

/// Returns the cells that are connected with the start over the sides of passable cells.
fn flood(costmap: &Costmap, start: Cell, passable: Passable) -> Vec<bool> {
    let (info, costs) = (costmap.info(), costmap.costs());
    let mut reached = vec![false; info.len()];
    if !info.contains(start) {
        return reached;
    }
    let mut open = vec![start];
    reached[info.index(start)] = true;
    while let Some((column, row)) = open.pop() {
        let neighbours = [
            (column.wrapping_sub(1), row),
            (column + 1, row),
            (column, row.wrapping_sub(1)),
            (column, row + 1),
        ];
        for cell in neighbours.into_iter().filter(|cell| info.contains(*cell)) {
            let index = info.index(cell);
            if !reached[index] && passable.contains(costs[index]) {
                reached[index] = true;
                open.push(cell);
            }
        }
    }
    reached
}

fn nearest_reached(info: &GridInfo, reached: &[bool], goal: Pose2) -> Option<ReachablePose> {
    let squared_distance = |index: usize| {
        let (x_m, y_m) = info.centre_of(info.cell(index));
        let (dx_m, dy_m) = (x_m - goal.x_m, y_m - goal.y_m);
        dx_m * dx_m + dy_m * dy_m
    };
    let indices = reached.iter().enumerate().filter(|(_, reached)| **reached);
    let index = indices
        .map(|(index, _)| index)
        .min_by(|left, right| squared_distance(*left).total_cmp(&squared_distance(*right)))?;
    let (x_m, y_m) = info.centre_of(info.cell(index));
    let pose = Pose2 { x_m, y_m, ..goal };
    Some(ReachablePose { pose, distance_m: squared_distance(index).sqrt() })
}
