//! Agreement of a map with the ground truth over its explored part.

use periplus_grid::occupancy::UNKNOWN;
use periplus_grid::{GridInfo, GridInfoError, OccupancyGrid};

use crate::align::{Alignment, align, is_wall};
use crate::compare::{CompareOptions, MapComparison, compare};

/// Comparison of a map with the ground truth.
#[derive(Clone, Debug, PartialEq)]
pub struct BesideTruth {
    /// The known part of the ground truth as the first map, the map as the other.
    pub comparison: MapComparison,
    /// Transform that aligns the map with the ground truth.
    pub alignment: Alignment,
    /// Explored fraction of the free space, 0 to 1; none without free space.
    pub explored: Option<f64>,
}

impl BesideTruth {
    /// Returns the metrics by name: `free_iou` and `walls_iou` (where a neighbouring cell counts as
    /// a match), 0 to 1; `wall_mean_m` and `wall_p95_m` from the walls of the map to the nearest
    /// true walls \[m\]; `explored`, 0 to 1; `shift_m` and `turn_rad`, by which the map was moved.
    /// Unknown metrics are omitted.
    #[must_use]
    pub fn numbers(&self) -> Vec<(&'static str, f64)> {
        let walls = self.comparison.other_to_first;
        let moved = self.alignment.reference_from_other;
        let all = [
            ("free_iou", self.comparison.free.iou()),
            ("walls_iou", self.comparison.walls_nearby.iou()),
            ("wall_mean_m", walls.mean_m),
            ("wall_p95_m", walls.p95_m),
            ("explored", self.explored.unwrap_or(f64::NAN)),
            ("shift_m", libm::hypot(moved.x_m, moved.y_m)),
            ("turn_rad", moved.yaw_rad),
        ];
        all.into_iter().filter(|(_, value)| value.is_finite()).collect()
    }
}

/// Compares a map with the ground truth after aligning it within `window_m` metres and `window_rad`
/// radians. Free cells of the truth that are unknown in the map, and walls without a known
/// neighbour in the map, are ignored: they were not explored yet.
/// # Errors
/// When the common grid would have too many cells.
pub fn beside_truth(
    truth: &OccupancyGrid,
    map: &OccupancyGrid,
    window_m: f64,
    window_rad: f64,
) -> Result<BesideTruth, GridInfoError> {
    beside_truth_at(truth, map, align(truth, map, window_m, window_rad))
}

/// Compares a map with the ground truth as [`beside_truth`] does, with a known alignment.
/// # Errors
/// When the common grid would have too many cells.
pub fn beside_truth_at(
    truth: &OccupancyGrid,
    map: &OccupancyGrid,
    alignment: Alignment,
) -> Result<BesideTruth, GridInfoError> {
    let mut laid = map.clone();
    laid.info.origin = alignment.reference_from_other * map.info.origin;
    let is_known = known(&laid, &truth.info);
    let is_free = |cell: i8| cell >= 0 && !is_wall(cell);
    let free = || (0..truth.cells.len()).filter(|&index| is_free(truth.cells[index]));
    let explored = match free().count() {
        0 => None,
        all => Some(free().filter(|&index| is_known[index]).count() as f64 / all as f64),
    };
    let seen = |index: usize| {
        let cell = truth.cells[index];
        let counts =
            if is_wall(cell) { beside(&truth.info, index, &is_known) } else { is_known[index] };
        if counts { cell } else { UNKNOWN }
    };
    let cells = (0..truth.cells.len()).map(seen).collect();
    let seen = OccupancyGrid { info: truth.info, cells };
    let as_it_lies = CompareOptions { align: false, window_m: 0.0, window_rad: 0.0 };
    let comparison = compare(&seen, &laid, as_it_lies)?;
    Ok(BesideTruth { comparison, alignment, explored })
}

/// Returns for each cell true if it is known in the map.
fn known(map: &OccupancyGrid, cells: &GridInfo) -> Vec<bool> {
    let finder = map.info.finder();
    let knows = |index: usize| {
        let (x_m, y_m) = cells.centre_of(cells.cell(index));
        finder.cell_of(x_m, y_m).and_then(|cell| map.get(cell)).is_some_and(|&value| value >= 0)
    };
    (0..cells.len()).map(knows).collect()
}

/// Returns true if a cell or one of its eight neighbours is known.
fn beside(cells: &GridInfo, index: usize, is_known: &[bool]) -> bool {
    let (column, row) = cells.cell(index);
    let rows = row.saturating_sub(1)..=(row + 1).min(cells.height - 1);
    let columns = column.saturating_sub(1)..=(column + 1).min(cells.width - 1);
    rows.into_iter().any(|row| columns.clone().any(|column| is_known[cells.index((column, row))]))
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use periplus_grid::Grid;
    use periplus_grid::occupancy::{FREE, OCCUPIED};

    use super::*;

    /// A room of 8 by 8 cells of 0.5 m, with a box inside that breaks its symmetry.
    fn room() -> OccupancyGrid {
        let info = GridInfo::new(0.5, 10, 10, Pose2::IDENTITY).unwrap();
        let mut room = Grid::new(info, FREE);
        for index in 0..info.len() {
            let (column, row) = info.cell(index);
            let is_edge = [0, 9].contains(&column) || [0, 9].contains(&row);
            if is_edge || (column, row) == (3, 6) {
                room.cells[index] = OCCUPIED;
            }
        }
        room
    }

    #[test]
    fn half_a_map_is_half_explored_and_right() {
        let room = room();
        let mut map = room.clone();
        for index in 0..map.cells.len() {
            if map.info.cell(index).1 >= 5 {
                map.cells[index] = UNKNOWN;
            }
        }
        let found = beside_truth(&room, &map, 0.0, 0.0).unwrap();
        // Four of eight rows; one of the other four has a box.
        assert_eq!(found.explored, Some(32.0 / 63.0));
        assert_eq!([found.comparison.free.iou(), found.comparison.walls_nearby.iou()], [1.0; 2]);
        assert_eq!(found.comparison.other_to_first.largest_m, 0.0);
    }

    #[test]
    fn a_map_that_lies_elsewhere_is_moved_first() {
        let (room, mut map) = (room(), room());
        map.info.origin = Pose2::new(0.3, -0.2, 0.0);
        let found = beside_truth(&room, &map, 1.0, 0.05).unwrap();
        let moved = found.alignment.reference_from_other;
        assert!((moved.x_m + 0.3).abs() < 0.03 && (moved.y_m - 0.2).abs() < 0.03, "{moved:?}");
        assert!(found.comparison.free.iou() > 0.9, "{:?}", found.comparison.free);
    }

    #[test]
    fn a_wall_that_is_not_there_is_far_from_any() {
        let (room, mut map) = (room(), room());
        map[(6, 3)] = OCCUPIED;
        let found = beside_truth(&room, &map, 0.0, 0.0).unwrap();
        // Three cells from the nearest wall, of half a metre each.
        assert_eq!(found.comparison.other_to_first.largest_m, 1.5);
        assert_eq!(found.comparison.free.other_only, 0);
        assert_eq!(found.comparison.free.first_only, 1);
    }
}
