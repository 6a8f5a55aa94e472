//! Scores of a map against the true map.

use periplus_geometry::Pose2;
use periplus_grid::{GridInfoError, OccupancyGrid};
use periplus_maps::{Alignment, BesideTruth, Overlap, align, beside_truth_at};

/// Scores of a map. Cells that the robot has not explored are not counted, except in `unknown_ratio`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapScore {
    /// Intersection over union of the occupied cells, 0 to 1, where an occupied cell within the tolerance
    /// counts as a match; none without occupied cells.
    pub wall_iou: Option<f64>,
    /// Intersection over union of the free cells, 0 to 1; none without free cells.
    pub free_iou: Option<f64>,
    /// Mean distance of the occupied cells of the map to the nearest true ones \[m\]; none without them.
    pub wall_mean_m: Option<f64>,
    /// 95th percentile of these distances \[m\].
    pub wall_p95_m: Option<f64>,
    /// Part of the true free cells that are unknown in the map, 0 to 1; none without free cells.
    pub unknown_ratio: Option<f64>,
    /// `truth_from_map`: alignment that was applied to the map first.
    pub truth_from_map: Pose2,
}

/// Scores a map against the true map, with a tolerance of `tolerance_m` metres between the centres of
/// occupied cells.
///
/// `window_m` and `window_rad` are the maximum translation and rotation by which the map is moved first, to
/// align its occupied cells with the true ones. Without a translation and rotation the frames are taken as
/// equal.
///
/// # Errors
/// When the common grid would have too many cells.
pub fn score_map(
    truth: &OccupancyGrid,
    map: &OccupancyGrid,
    tolerance_m: f64,
    window_m: f64,
    window_rad: f64,
) -> Result<MapScore, GridInfoError> {
    let alignment = if window_m > 0.0 || window_rad > 0.0 {
        align(truth, map, window_m, window_rad)
    } else {
        Alignment { reference_from_other: Pose2::IDENTITY, score: f64::NAN }
    };
    let BesideTruth { comparison, explored, .. } = beside_truth_at(truth, map, alignment)?;
    let walls = comparison.other_to_first;
    let finite = |number: f64| Some(number).filter(|it| it.is_finite());
    Ok(MapScore {
        wall_iou: iou(comparison.walls_within(tolerance_m)),
        free_iou: iou(comparison.free),
        wall_mean_m: finite(walls.mean_m),
        wall_p95_m: finite(walls.p95_m),
        unknown_ratio: explored.map(|it| 1.0 - it),
        truth_from_map: alignment.reference_from_other,
    })
}

fn iou(cells: Overlap) -> Option<f64> {
    let is_empty = cells == Overlap::default();
    (!is_empty).then(|| cells.iou())
}

#[cfg(test)]
mod tests {
    use periplus_grid::occupancy::{FREE, OCCUPIED, UNKNOWN};
    use periplus_grid::{Grid, GridInfo};

    use super::*;

    /// Free cells of half a metre with occupied columns.
    fn columns(occupied: &[usize]) -> OccupancyGrid {
        let info = GridInfo::new(0.5, 8, 4, Pose2::IDENTITY).unwrap();
        let mut map = Grid::new(info, FREE);
        for (column, row) in occupied.iter().flat_map(|it| (0..4).map(move |row| (*it, row))) {
            map[(column, row)] = OCCUPIED;
        }
        map
    }

    #[test]
    fn a_wall_two_cells_beside_the_true_one() {
        let check = |tolerance_m: f64, expected: f64| {
            let score = score_map(&columns(&[2]), &columns(&[4]), tolerance_m, 0.0, 0.0).unwrap();
            assert_eq!(score.wall_iou, Some(expected), "{tolerance_m}");
            assert_eq!((score.wall_mean_m, score.wall_p95_m), (Some(1.0), Some(1.0)));
        };
        check(0.0, 0.0);
        check(0.9, 0.0);
        check(1.0, 1.0);
    }

    #[test]
    fn scores_without_cells_are_undefined() {
        let free = columns(&[]);
        let score = score_map(&free, &free, 0.1, 0.0, 0.0).unwrap();
        assert_eq!((score.wall_iou, score.wall_mean_m), (None, None));
        assert_eq!((score.free_iou, score.unknown_ratio), (Some(1.0), Some(0.0)));
    }

    #[test]
    fn half_of_the_free_space_is_unknown() {
        let mut map = columns(&[0, 7]);
        for row in 2..4 {
            for column in 0..8 {
                map[(column, row)] = UNKNOWN;
            }
        }
        let score = score_map(&columns(&[0, 7]), &map, 0.0, 0.0, 0.0).unwrap();
        assert_eq!(score.unknown_ratio, Some(0.5));
    }

    #[test]
    fn a_moved_map_is_aligned_within_the_window() {
        let mut map = columns(&[1, 6]);
        map[(3, 2)] = OCCUPIED;
        let truth = map.clone();
        map.info.origin = Pose2::new(0.25, 0.0, 0.0);
        let score = score_map(&truth, &map, 0.5, 0.5, 0.05).unwrap();
        assert!((score.truth_from_map.x_m + 0.25).abs() < 0.05, "{score:?}");
        assert_eq!(score.wall_iou, Some(1.0));
    }
}
