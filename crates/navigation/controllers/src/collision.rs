//! Collisions of the footprint with cells of the local costmap.
//!
//! Source: `footprint_collision_checker.cpp`, `collision_checker.cpp` of RegulatedPurePursuit.

use std::fmt;

use periplus_costmap::{CostmapView, cost};
use periplus_geometry::Pose2;
use periplus_grid::{Cell, Line};

/// Cell that the footprint must not touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockedCell {
    /// Pose of the robot in the frame of the costmap.
    pub pose: Pose2,
    /// Cell; none where the footprint leaves the costmap.
    pub cell: Option<Cell>,
    /// Centre of the cell, or the corner of the footprint outside of the costmap \[m\].
    pub position_m: (f64, f64),
    /// Cost of the cell.
    pub cost: u8,
}

impl fmt::Display for BlockedCell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { pose, cell, position_m: (x_m, y_m), cost } = self;
        let Pose2 { x_m: robot_x_m, y_m: robot_y_m, yaw_rad } = pose;
        write!(
            f,
            "the footprint of the robot at ({robot_x_m:.2}, {robot_y_m:.2}) m, {yaw_rad:.2} rad "
        )?;
        match cell {
            Some((column, row)) => write!(
                f,
                "touches cell ({column}, {row}) at ({x_m:.2}, {y_m:.2}) m with cost {cost}, {}",
                cost_name(*cost)
            ),
            None => write!(f, "leaves the local costmap at ({x_m:.2}, {y_m:.2}) m"),
        }
    }
}

/// Returns the meaning of a cost.
pub(crate) fn cost_name(cost: u8) -> &'static str {
    match cost {
        cost::UNKNOWN => "unknown",
        cost::LETHAL => "an obstacle",
        cost::INSCRIBED => "nearer to an obstacle than the inscribed radius",
        cost::FREE => "free",
        _ => "near an obstacle",
    }
}

/// Returns the cell by which the footprint at a pose collides: a lethal one, or an unknown one if unknown cells are
/// not tracked. None if it does not collide, or if its centre is outside of the costmap.
#[must_use]
pub fn footprint_collision(view: &CostmapView<'_>, pose: Pose2) -> Option<BlockedCell> {
    view.costs.info().cell_of(pose.x_m, pose.y_m)?;
    let min_cost = match view.footprint.cost(view.costs, pose) {
        cost::UNKNOWN if view.tracks_unknown => return None,
        cost::LETHAL => cost::LETHAL,
        cost::UNKNOWN => cost::UNKNOWN,
        _ => return None,
    };
    blocking_cell(view, pose, |cost| cost == min_cost)
}

/// Returns the first cell of the outline of the footprint with such a cost; a corner outside of the costmap counts
/// as lethal.
pub(crate) fn blocking_cell(
    view: &CostmapView<'_>,
    pose: Pose2,
    is_blocked: impl Fn(u8) -> bool,
) -> Option<BlockedCell> {
    let corners = view.footprint.placed(pose);
    let finder = view.costs.finder();
    let mut cells = Vec::with_capacity(corners.len());
    for [x_m, y_m] in &corners {
        match finder.cell_of(*x_m, *y_m) {
            Some(cell) => cells.push(cell),
            None => {
                let outside =
                    BlockedCell { pose, cell: None, position_m: (*x_m, *y_m), cost: cost::LETHAL };
                return is_blocked(cost::LETHAL).then_some(outside);
            }
        }
    }
    let sides = cells.iter().zip(cells.iter().cycle().skip(1));
    let mut outline = sides.flat_map(|(start, end)| Line::between(*start, *end));
    outline.find_map(|cell| {
        let cost = view.costs.cost(cell).filter(|cost| is_blocked(*cost))?;
        let position_m = view.costs.info().centre_of(cell);
        Some(BlockedCell { pose, cell: Some(cell), position_m, cost })
    })
}
