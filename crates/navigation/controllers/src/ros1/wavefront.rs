//! Distances of cells to the plan around obstacles.
//!
//! Source: `map_grid.cpp` of `base_local_planner`.

use std::collections::VecDeque;

use periplus_costmap::{Costmap, cost};
use periplus_geometry::Pose2;
use periplus_grid::{Cell, Line};

use crate::dwb::critics::{IllegalTrajectory, plan_cells};
use crate::path::distance_m;

/// Distance of each cell to the nearest of some cells, in steps to one of four neighbours that is free.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WavefrontDistances {
    width: usize,
    distances: Vec<u32>,
}

impl WavefrontDistances {
    /// Computes the distances to cells of a costmap. Lethal, inscribed and unknown cells are obstacles, except those of
    /// which `is_passable` is true.
    #[must_use]
    pub fn new(costmap: &Costmap, targets: &[Cell], is_passable: impl Fn(usize) -> bool) -> Self {
        let info = costmap.info();
        let (obstacle, unreached) = Self::marks(info.len());
        let mut distances = vec![unreached; info.len()];
        let mut queue = VecDeque::new();
        for target in targets {
            let index = info.index(*target);
            if distances[index] != 0 {
                distances[index] = 0;
                queue.push_back(index);
            }
        }
        let width = info.width;
        while let Some(from) = queue.pop_front() {
            let neighbours = [
                (!from.is_multiple_of(width)).then(|| from - 1),
                (from % width + 1 < width).then_some(from + 1),
                (from >= width).then(|| from - width),
                (from + width < distances.len()).then_some(from + width),
            ];
            for index in neighbours.into_iter().flatten() {
                if distances[index] != unreached {
                    continue;
                }
                let cost = costmap.costs()[index];
                if cost >= cost::INSCRIBED && !is_passable(index) {
                    distances[index] = obstacle;
                } else {
                    distances[index] = distances[from] + 1;
                    queue.push_back(index);
                }
            }
        }
        Self { width, distances }
    }

    /// Distances of obstacles, and of cells without a path.
    fn marks(count: usize) -> (u32, u32) {
        let count = u32::try_from(count).unwrap_or(u32::MAX - 1);
        (count, count + 1)
    }

    /// Returns the distance of a cell \[cells\]; that of obstacles is the number of cells, and that of cells without a
    /// path one more.
    #[must_use]
    pub fn distance(&self, (column, row): Cell) -> u32 {
        let unreached = Self::marks(self.distances.len()).1;
        self.distances.get(row * self.width + column).copied().unwrap_or(unreached)
    }

    /// Returns the distance of a cell with a path.
    ///
    /// # Errors
    /// If the cell is an obstacle or has no path.
    pub fn reachable(&self, cell: Cell) -> Result<u32, IllegalTrajectory> {
        let (obstacle, unreached) = Self::marks(self.distances.len());
        let distance = self.distance(cell);
        if distance == obstacle {
            Err(IllegalTrajectory::new("Trajectory Hits Obstacle."))
        } else if distance == unreached {
            Err(IllegalTrajectory::new("Trajectory Hits Unreachable Area."))
        } else {
            Ok(distance)
        }
    }

    /// Returns the distances, row by row.
    #[must_use]
    pub fn distances(&self) -> &[u32] {
        &self.distances
    }
}

/// Returns the known cells of the first part of a plan that is on the costmap; poses are inserted where they are
/// farther apart than a cell.
pub(super) fn dense_plan_cells(costmap: &Costmap, plan: &[Pose2]) -> Vec<Cell> {
    let resolution_m = costmap.resolution_m();
    let mut dense: Vec<Pose2> = Vec::with_capacity(plan.len());
    for pose in plan {
        if let Some(last) = dense.last().copied() {
            let gap_m = distance_m(last, *pose);
            let steps = if gap_m > resolution_m { libm::ceil(gap_m / resolution_m) } else { 1.0 };
            for step in 1..steps as usize {
                let part = step as f64 / steps;
                let x_m = last.x_m + part * (pose.x_m - last.x_m);
                let y_m = last.y_m + part * (pose.y_m - last.y_m);
                dense.push(Pose2::new(x_m, y_m, pose.yaw_rad));
            }
        }
        dense.push(*pose);
    }
    plan_cells(costmap, &dense)
}

/// Returns the cells within a polygon of cells, with its outline, as flags by index.
pub(super) fn filled(costmap: &Costmap, corners: &[[f64; 2]]) -> Vec<bool> {
    let info = costmap.info();
    let mut inside = vec![false; info.len()];
    let finder = costmap.finder();
    let cells: Option<Vec<Cell>> =
        corners.iter().map(|[x_m, y_m]| finder.cell_of(*x_m, *y_m)).collect();
    let Some(cells) = cells else { return inside };
    let sides = cells.iter().zip(cells.iter().cycle().skip(1));
    let mut rows: std::collections::BTreeMap<usize, (usize, usize)> = Default::default();
    for (column, row) in sides.flat_map(|(start, end)| Line::between(*start, *end)) {
        let range = rows.entry(row).or_insert((column, column));
        *range = (range.0.min(column), range.1.max(column));
    }
    for (row, (first, last)) in rows {
        for column in first..=last {
            inside[info.index((column, row))] = true;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use periplus_grid::GridInfo;

    use super::*;

    #[test]
    fn obstacles_are_passed_around() {
        let info = GridInfo::new(1.0, 3, 3, Pose2::IDENTITY).unwrap();
        let mut costmap = Costmap::new(info, 0);
        costmap.set((1, 0), 254);
        costmap.set((1, 1), 253);
        let grid = WavefrontDistances::new(&costmap, &[(0, 0)], |_| false);
        assert_eq!(grid.distances(), [0, 9, 6, 1, 9, 5, 2, 3, 4]);
        assert!(grid.reachable((1, 0)).is_err());
        let passable = WavefrontDistances::new(&costmap, &[(0, 0)], |index| index == 1);
        assert_eq!(passable.distance((2, 0)), 2);
    }

    #[test]
    fn a_footprint_is_filled() {
        let info = GridInfo::new(1.0, 5, 5, Pose2::IDENTITY).unwrap();
        let costmap = Costmap::new(info, 0);
        let inside = filled(&costmap, &[[1.5, 1.5], [3.5, 1.5], [3.5, 3.5], [1.5, 3.5]]);
        assert_eq!(inside.iter().filter(|inside| **inside).count(), 9);
        assert!(inside[2 * 5 + 2] && !inside[0]);
    }
}
