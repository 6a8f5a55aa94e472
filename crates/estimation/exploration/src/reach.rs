//! Reachable cells of a map, with shortest paths.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use periplus_grid::{Cell, Grid, OccupancyGrid, squared_distances};

/// Minimum occupancy of walls \[%\]: `occupied_thresh` 0.65 of `map_server`.
const OCCUPIED_PERCENT: i8 = 65;

/// Maximum occupancy of free cells \[%\]: `free_thresh` 0.25.
const FREE: i8 = 25;

/// Geometry of the robot for planning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Robot {
    /// Minimum distance of its centre from walls \[m\].
    pub radius_m: f64,
    /// Distance from walls below which costs increase \[m\].
    pub comfort_m: f64,
}

/// Reachable cells and shortest paths from the robot (Dijkstra). Costs are lengths \[m\], increased
/// near walls.
pub struct Reach<'a> {
    map: &'a OccupancyGrid,
    /// Cost of each cell; infinite if unreachable.
    costs: Vec<f64>,
    /// Predecessor of each cell.
    from: Vec<u32>,
}

/// Costs are compared by their bits: they are never negative and never NaN.
type Open = BinaryHeap<Reverse<(u64, usize)>>;

impl<'a> Reach<'a> {
    /// Runs Dijkstra's algorithm from a position; none if that is outside the map.
    #[must_use]
    pub fn new(map: &'a OccupancyGrid, robot: &Robot, x_m: f64, y_m: f64) -> Option<Self> {
        let info = map.info;
        let start = info.index(info.cell_of(x_m, y_m)?);
        let far = squared_distances(map, |value| *value >= OCCUPIED_PERCENT);
        let to_wall_m = |index: usize| info.resolution_m * f64::from(far.cells[index]).sqrt();
        // A robot that is too near to a wall may move away from it, but not closer.
        let least_m = robot.radius_m.min(to_wall_m(start) - 0.5 * info.resolution_m);
        let mut reach =
            Self { map, costs: vec![f64::INFINITY; info.len()], from: vec![0; info.len()] };
        reach.costs[start] = 0.0;
        let mut open: Open = BinaryHeap::from([Reverse((0, start))]);
        while let Some(Reverse((bits, index))) = open.pop() {
            let cost = f64::from_bits(bits);
            if cost > reach.costs[index] {
                continue;
            }
            for (next, step) in neighbours(map, info.cell(index)) {
                let wall_m = to_wall_m(next);
                let is_free = (0..=FREE).contains(&map.cells[next]);
                if !is_free || wall_m < least_m {
                    continue;
                }
                let lack = ((robot.comfort_m - wall_m) / robot.comfort_m.max(1e-9)).max(0.0);
                let new = cost + step * info.resolution_m * (1.0 + 4.0 * lack);
                if new < reach.costs[next] {
                    reach.costs[next] = new;
                    reach.from[next] = u32::try_from(index).unwrap_or(u32::MAX);
                    open.push(Reverse((new.to_bits(), next)));
                }
            }
        }
        Some(reach)
    }

    /// Returns the cost of a cell \[m\]; none if unreachable.
    #[must_use]
    pub fn cost(&self, index: usize) -> Option<f64> {
        self.costs.get(index).copied().filter(|cost| cost.is_finite())
    }

    /// Returns the number of reachable cells, without that of the robot.
    #[must_use]
    pub fn count(&self) -> usize {
        self.costs.iter().filter(|cost| cost.is_finite() && **cost > 0.0).count()
    }

    /// Returns the map.
    #[must_use]
    pub fn map(&self) -> &OccupancyGrid {
        self.map
    }

    /// Returns the path to a cell, from the robot \[m\].
    #[must_use]
    pub fn way(&self, index: usize) -> Vec<[f64; 2]> {
        let mut way = Vec::new();
        let mut at = index;
        while self.cost(at).is_some_and(|cost| cost > 0.0) {
            way.push(at);
            at = self.from[at] as usize;
        }
        let centre = |index: &usize| {
            let (x_m, y_m) = self.map.info.centre_of(self.map.info.cell(*index));
            [x_m, y_m]
        };
        way.iter().rev().map(centre).collect()
    }
}

/// Iterates over the eight neighbours of a cell, with their distances \[cells\].
pub(crate) fn neighbours<T>(
    grid: &Grid<T>,
    (column, row): Cell,
) -> impl Iterator<Item = (usize, f64)> + use<T> {
    let info = grid.info;
    let around = [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];
    around.into_iter().filter_map(move |(right, up): (isize, isize)| {
        let cell = (column.checked_add_signed(right)?, row.checked_add_signed(up)?);
        let step = if right != 0 && up != 0 { std::f64::consts::SQRT_2 } else { 1.0 };
        info.contains(cell).then(|| (info.index(cell), step))
    })
}
