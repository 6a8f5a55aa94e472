//! Small costmaps as text, and calls of planners.

#![allow(dead_code, reason = "each test uses a part")]

use periplus_costmap::{Costmap, CostmapView, Footprint};
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_planners::{PlanError, PlanRequest, PlannedPath, Planner};

/// Costmap of cells of 0.1 m from rows of characters, the highest row first: `.` free, `#` lethal,
/// `i` inscribed, `?` unknown, a digit d the cost 25 d.
pub(crate) fn costmap(rows: &[&str]) -> Costmap {
    let info = GridInfo::new(0.1, rows[0].len(), rows.len(), Pose2::IDENTITY).unwrap();
    let mut costmap = Costmap::new(info, 0);
    for (row, line) in rows.iter().rev().enumerate() {
        for (column, character) in line.bytes().enumerate() {
            let cost = match character {
                b'#' => 254,
                b'i' => 253,
                b'?' => 255,
                b'.' => 0,
                digit => (digit - b'0') * 25,
            };
            costmap.set((column, row), cost);
        }
    }
    costmap
}

/// A robot of this radius on a costmap.
pub(crate) fn view<'a>(costs: &'a Costmap, footprint: &'a Footprint) -> CostmapView<'a> {
    CostmapView { costs, footprint, is_circular: true, tracks_unknown: true, inflation: None }
}

/// Plans without limits of time.
pub(crate) fn plan(
    planner: &mut dyn Planner,
    costs: &Costmap,
    start: Pose2,
    goal: Pose2,
) -> Result<PlannedPath, PlanError> {
    plan_with(planner, costs, [start, goal], [false, false])
}

/// Plans with hooks that return `is_cancelled` and `is_out_of_time`.
pub(crate) fn plan_with(
    planner: &mut dyn Planner,
    costs: &Costmap,
    [start, goal]: [Pose2; 2],
    [is_cancelled, is_out_of_time]: [bool; 2],
) -> Result<PlannedPath, PlanError> {
    let footprint = Footprint::circle(0.05);
    let costmap = view(costs, &footprint);
    let (is_cancelled, is_out_of_time) = (&mut || is_cancelled, &mut || is_out_of_time);
    planner.plan(PlanRequest { costmap, start, goal, is_cancelled, is_out_of_time })
}

/// A pose without a turn.
pub(crate) fn at(x_m: f64, y_m: f64) -> Pose2 {
    Pose2::new(x_m, y_m, 0.0)
}
