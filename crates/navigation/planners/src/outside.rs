//! Checks of start and goal that all planners share, with the texts of Nav2.

use periplus_geometry::Pose2;
use periplus_grid::{Cell, GridInfo};

use crate::{PlanError, PlanErrorKind};

/// Returns the cell of the start.
///
/// # Errors
/// `START_OUTSIDE_MAP`, with the bounds of the map.
pub(crate) fn start_cell(info: &GridInfo, start: Pose2) -> Result<Cell, PlanError> {
    cell(info, start, "Start", PlanErrorKind::StartOutsideMap)
}

/// Returns the cell of the goal.
///
/// # Errors
/// `GOAL_OUTSIDE_MAP`, with the bounds of the map.
pub(crate) fn goal_cell(info: &GridInfo, goal: Pose2) -> Result<Cell, PlanError> {
    cell(info, goal, "Goal", PlanErrorKind::GoalOutsideMap)
}

fn cell(info: &GridInfo, pose: Pose2, name: &str, kind: PlanErrorKind) -> Result<Cell, PlanError> {
    let (x_m, y_m) = (pose.x_m, pose.y_m);
    if !pose.is_finite() {
        let message = format!(
            "{name} Coordinates of({x_m:.6}, {y_m:.6}) was outside bounds; its position and its heading of {} rad \
             must be finite numbers",
            pose.yaw_rad
        );
        return Err(PlanError::new(kind, message));
    }
    info.cell_of(x_m, y_m).ok_or_else(|| {
        let GridInfo { origin, .. } = *info;
        let (width_m, height_m) = info.size_m();
        let bounds = format!(
            "the map extends from ({:.2}, {:.2}) to ({:.2}, {:.2})",
            origin.x_m,
            origin.y_m,
            origin.x_m + width_m,
            origin.y_m + height_m
        );
        let message =
            format!("{name} Coordinates of({x_m:.6}, {y_m:.6}) was outside bounds; {bounds}");
        PlanError::new(kind, message)
    })
}

/// Returns the error of a goal in an obstacle.
pub(crate) fn occupied(kind: PlanErrorKind, goal: Pose2) -> PlanError {
    let (x_m, y_m) = (goal.x_m, goal.y_m);
    PlanError::new(kind, format!("Goal Coordinates of({x_m:.6}, {y_m:.6}) was in lethal cost"))
}
