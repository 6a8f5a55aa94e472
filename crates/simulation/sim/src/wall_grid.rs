//! Cells on which the walls around a drive are looked for.

use periplus_geometry::Pose2;
use periplus_grid::GridInfo;

/// Region around the poses of a drive in which walls are looked for \[m\].
const MARGIN_M: f64 = 8.0;

/// Cells of the walls \[m\].
const RESOLUTION_M: f64 = 0.05;

/// Largest number of cells along a side: larger regions get larger cells.
const MAX_SIDE_CELL_COUNT: f64 = 3000.0;

/// Returns the cells around poses in the frame of the world, with a margin of 8 m; of 0.05 m, in large regions larger.
/// The poses are at least one, and finite.
#[must_use]
pub fn wall_grid_around(poses: &[Pose2]) -> GridInfo {
    let low =
        |value: fn(&Pose2) -> f64| poses.iter().map(value).fold(f64::INFINITY, f64::min) - MARGIN_M;
    let high = |value: fn(&Pose2) -> f64| {
        poses.iter().map(value).fold(f64::NEG_INFINITY, f64::max) + MARGIN_M
    };
    wall_grid(
        low(|pose| pose.x_m),
        low(|pose| pose.y_m),
        high(|pose| pose.x_m),
        high(|pose| pose.y_m),
    )
}

/// Returns the cells of a region of the world, from its lowest to its highest x and y \[m\].
#[must_use]
pub fn wall_grid(low_x_m: f64, low_y_m: f64, high_x_m: f64, high_y_m: f64) -> GridInfo {
    let (width_m, height_m) = (high_x_m - low_x_m, high_y_m - low_y_m);
    let resolution_m = (width_m.max(height_m) / MAX_SIDE_CELL_COUNT).max(RESOLUTION_M);
    GridInfo {
        resolution_m,
        width: libm::ceil(width_m / resolution_m) as usize,
        height: libm::ceil(height_m / resolution_m) as usize,
        origin: Pose2::new(low_x_m, low_y_m, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_have_a_margin_around_the_poses() {
        let grid = wall_grid_around(&[Pose2::new(1.0, 0.0, 0.0), Pose2::new(3.0, 0.0, 0.0)]);
        assert_eq!((grid.origin.x_m, grid.origin.y_m), (-7.0, -8.0));
        assert_eq!((grid.width, grid.height), (360, 320));
    }

    #[test]
    fn large_regions_have_large_cells() {
        let grid = wall_grid(0.0, 0.0, 300.0, 30.0);
        assert_eq!((grid.resolution_m, grid.width, grid.height), (0.1, 3000, 300));
    }
}
