//! What a robot can reach on a map, and by which way.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use periplus_grid::{Cell, Grid, OccupancyGrid, squared_distances};

/// From this value on a cell counts as a wall, as in `map_server`'s `occupied_thresh` of 0.65.
const WALL: i8 = 65;

/// Up to this value a cell counts as free, as in `free_thresh` of 0.25.
const FREE: i8 = 25;

/// The robot, as far as ways depend on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Robot {
    /// No nearer to a wall does its middle come \[m\].
    pub radius_m: f64,
    /// Nearer than this it does not like to be \[m\].
    pub comfort_m: f64,
}

/// What a robot can reach from where it is. Costs are lengths \[m\], longer near walls.
pub struct Reach<'a> {
    map: &'a OccupancyGrid,
    /// Cost to each cell; infinite where it cannot go.
    costs: Vec<f64>,
    /// From which cell each is reached.
    from: Vec<u32>,
}

/// Costs compare by their bits: they are never negative and never NaN.
type Open = BinaryHeap<Reverse<(u64, usize)>>;

impl<'a> Reach<'a> {
    /// Walks the map from a place; none if that is outside of it.
    #[must_use]
    pub fn new(map: &'a OccupancyGrid, robot: &Robot, x_m: f64, y_m: f64) -> Option<Self> {
        let info = map.info;
        let start = info.index(info.cell_of(x_m, y_m)?);
        let far = squared_distances(map, |value| *value >= WALL);
        let to_wall_m = |index: usize| info.resolution_m * f64::from(far.cells[index]).sqrt();
        // A robot that stands too near to a wall may go away from it, but not nearer.
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

    /// What it costs to get to a cell \[m\]; none where the robot cannot go.
    #[must_use]
    pub fn cost(&self, index: usize) -> Option<f64> {
        self.costs.get(index).copied().filter(|cost| cost.is_finite())
    }

    /// How many cells it can go to, beside the one where it is.
    #[must_use]
    pub fn count(&self) -> usize {
        self.costs.iter().filter(|cost| cost.is_finite() && **cost > 0.0).count()
    }

    /// The map that was walked.
    #[must_use]
    pub fn map(&self) -> &OccupancyGrid {
        self.map
    }

    /// The way to a cell, from where the robot is \[m\].
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

/// The eight cells around one, with their distances in cells.
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
