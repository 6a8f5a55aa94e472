//! Distances of cells to the plan.
//!
//! Source: `map_grid.cpp`, `costmap_queue.cpp`, `nav_2d_utils/path_ops.cpp`.

use periplus_costmap::{Costmap, cost};
use periplus_geometry::Pose2;
use periplus_grid::Cell;

use crate::path::distance_m;

/// Number of cells that poses of a plan may be apart before poses are inserted.
const MAX_GAP_RATIO: f64 = 2.0;

/// Distance of each cell to the nearest of some cells, along x plus along y. Obstacles are no obstacles to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellDistances {
    width: usize,
    distances: Vec<u32>,
}

impl CellDistances {
    /// Computes the distances to some cells of a grid with `width` columns and `height` rows.
    #[must_use]
    pub fn new(width: usize, height: usize, targets: &[Cell]) -> Self {
        let unreached = Self::unreached(width * height);
        let mut distances = vec![unreached; width * height];
        for (column, row) in targets.iter().copied().filter(|(x, y)| *x < width && *y < height) {
            distances[row * width + column] = 0;
        }
        if !targets.is_empty() {
            spread(&mut distances, width, height);
        }
        Self { width, distances }
    }

    fn unreached(count: usize) -> u32 {
        u32::try_from(count + 1).unwrap_or(u32::MAX)
    }

    /// Returns the distance of a cell of the grid \[cells\].
    #[must_use]
    pub fn distance(&self, (column, row): Cell) -> u32 {
        let distance = self.distances.get(row * self.width + column);
        distance.copied().unwrap_or_else(|| Self::unreached(self.distances.len()))
    }

    /// Returns true if a distance is that of cells without any target.
    #[must_use]
    pub fn is_unreached(&self, distance: u32) -> bool {
        distance >= Self::unreached(self.distances.len())
    }

    /// Returns the distances, row by row.
    #[must_use]
    pub fn distances(&self) -> &[u32] {
        &self.distances
    }
}

/// Exact distances in two passes: each cell is reached through the neighbours before it or after it.
fn spread(distances: &mut [u32], width: usize, height: usize) {
    let closer = |distances: &mut [u32], index: usize, from: usize| {
        distances[index] = distances[index].min(distances[from].saturating_add(1));
    };
    for index in 0..distances.len() {
        if !index.is_multiple_of(width) {
            closer(distances, index, index - 1);
        }
        if index >= width {
            closer(distances, index, index - width);
        }
    }
    for index in (0..distances.len()).rev() {
        if index % width + 1 < width {
            closer(distances, index, index + 1);
        }
        if index + width < width * height {
            closer(distances, index, index + width);
        }
    }
}

/// Returns a plan with poses inserted where they are farther apart than two cells.
#[must_use]
pub fn densified(plan: &[Pose2], resolution_m: f64) -> Vec<Pose2> {
    let mut dense: Vec<Pose2> = Vec::with_capacity(plan.len());
    for pose in plan {
        if let Some(last) = dense.last().copied() {
            let gap_m = distance_m(last, *pose) - MAX_GAP_RATIO * resolution_m;
            let count = if gap_m > 0.0 { (gap_m / resolution_m) as usize } else { 0 };
            // As in Nav2 there is one pose fewer than the gap has cells.
            let steps = count.saturating_sub(1);
            for step in 1..steps {
                let part = step as f64 / steps as f64;
                dense.push(Pose2::new(
                    last.x_m + part * (pose.x_m - last.x_m),
                    last.y_m + part * (pose.y_m - last.y_m),
                    last.yaw_rad + part * (pose.yaw_rad - last.yaw_rad),
                ));
            }
        }
        dense.push(*pose);
    }
    dense
}

/// Returns the known cells of the first part of a plan that is on the costmap.
pub(crate) fn plan_cells(costmap: &Costmap, plan: &[Pose2]) -> Vec<Cell> {
    let finder = costmap.finder();
    let cell_of = |pose: &Pose2| {
        let cell = finder.cell_of(pose.x_m, pose.y_m)?;
        (costmap.cost(cell)? != cost::UNKNOWN).then_some(cell)
    };
    let cells = plan.iter().map(cell_of).skip_while(Option::is_none);
    cells.take_while(Option::is_some).flatten().collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn poses_are_inserted_into_gaps() {
        let plan = [Pose2::IDENTITY, Pose2::new(0.2, 0.0, 0.0), Pose2::new(1.0, 0.0, 0.0)];
        let xs: Vec<f64> = densified(&plan, 0.1).iter().map(|pose| pose.x_m).collect();
        // 0.8 m are 6 cells more than 2: 5 steps of 0.16 m.
        assert_eq!(xs.len(), 7);
        assert_eq!((xs[0], xs[1], xs[6]), (0.0, 0.2, 1.0));
        assert!((xs[2] - 0.36).abs() < 1e-12, "{xs:?}");
    }

    proptest! {
        #[test]
        fn distances_are_those_to_the_nearest_target(
            targets in prop::collection::vec((0..7_usize, 0..5_usize), 1..4),
        ) {
            let grid = CellDistances::new(7, 5, &targets);
            for column in 0..7_usize {
                for row in 0..5_usize {
                    let away = |&(x, y): &Cell| column.abs_diff(x) + row.abs_diff(y);
                    let nearest = targets.iter().map(away).min();
                    prop_assert_eq!(Some(grid.distance((column, row)) as usize), nearest);
                }
            }
        }
    }
}
