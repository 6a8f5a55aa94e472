//! Free space of a robot: cells in which it fits with any heading, and that are connected.

use std::collections::{BinaryHeap, VecDeque};

use periplus_geometry::{Pose2, Stream};
use periplus_grid::{Grid, GridInfo};

use crate::obstacles::Obstacles;
use crate::plane::squared_distance;

/// Resolution of the grid of distances \[m\].
const RESOLUTION_M: f64 = 0.1;
/// Maximum number of cells; larger worlds get larger cells.
const MAX_CELL_COUNT: f64 = 400_000.0;
/// Distance of the grid beyond all obstacles \[m\].
const MARGIN_M: f64 = 1.0;
/// Half of an open plane without obstacles \[m\].
const OPEN_HALF_SIZE_M: f64 = 10.0;
/// Maximum distance that is stored \[m\].
const MAX_DISTANCE_M: f64 = 2.0;
/// Minimum side of an area \[m\] that is inside walls for it to be preferred to the largest.
const MIN_INNER_SIDE_M: f64 = 1.5;
/// Number of goals that are drawn before the best of them is used.
const MAX_GOAL_DRAW_COUNT: usize = 64;

/// Grid of distances to obstacles, and the connected cells that are free.
#[derive(Clone, Debug)]
pub struct FreeSpace {
    /// Distance of each cell's centre to the nearest obstacle, at most [`MAX_DISTANCE_M`] \[m\].
    distances_m: Grid<f32>,
    /// Indices of the free cells, ascending.
    cells: Vec<u32>,
    /// Maximum offset of a random pose from the centre of its cell, along x and y \[m\].
    jitter_m: f64,
}

/// Start and goal of an episode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartAndGoal {
    /// Start in the world.
    pub start: Pose2,
    /// Goal in the world \[m\].
    pub goal_m: [f64; 2],
}

impl FreeSpace {
    /// Finds the free space of a robot with this circumscribed radius \[m\]: the largest connected area inside walls,
    /// or the largest of all if none is inside walls.
    #[must_use]
    pub fn new(obstacles: &Obstacles, radius_m: f64) -> Self {
        let [low, high] = obstacles.bounds_m().unwrap_or_else(|| {
            let half = OPEN_HALF_SIZE_M - MARGIN_M;
            [[-half, -half], [half, half]]
        });
        let low = low.map(|it| it - MARGIN_M);
        let size = [high[0] + MARGIN_M - low[0], high[1] + MARGIN_M - low[1]];
        let resolution_m = RESOLUTION_M.max((size[0] * size[1] / MAX_CELL_COUNT).sqrt());
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "limited above"
        )]
        let cells = size.map(|side| (side / resolution_m).ceil().max(1.0) as usize);
        let origin = Pose2::new(low[0], low[1], 0.0);
        let Ok(info) = GridInfo::new(resolution_m, cells[0], cells[1], origin) else {
            return Self::none();
        };
        let mut distances_m = Grid::new(info, 0.0_f32);
        for index in 0..info.len() {
            let (x, y) = info.centre_of(info.cell(index));
            #[expect(clippy::cast_possible_truncation, reason = "single precision will do")]
            let distance = obstacles.distance_to_point_m([x, y], MAX_DISTANCE_M) as f32;
            distances_m.cells[index] = distance;
        }
        // The distance falls by at most the distance travelled: a robot fits everywhere in a cell and between it and a neighbour.
        let needed_m = radius_m + 0.75 * resolution_m;
        #[expect(clippy::cast_possible_truncation, reason = "single precision will do")]
        let is_free = distances_m.map(|distance| *distance > needed_m.min(MAX_DISTANCE_M) as f32);
        let cells = largest_area(&is_free, resolution_m);
        Self { distances_m, cells, jitter_m: 0.5 * resolution_m }
    }

    fn none() -> Self {
        let info =
            GridInfo { resolution_m: RESOLUTION_M, width: 0, height: 0, origin: Pose2::IDENTITY };
        let distances_m = Grid { info, cells: Vec::new() };
        Self { distances_m, cells: Vec::new(), jitter_m: 0.0 }
    }

    /// Returns true if no pose is free.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Returns the free area \[m²\].
    #[must_use]
    pub fn area_m2(&self) -> f64 {
        let resolution_m = self.distances_m.info.resolution_m;
        #[expect(clippy::cast_precision_loss, reason = "cells are below 2^28")]
        let count = self.cells.len() as f64;
        count * resolution_m * resolution_m
    }

    /// Returns the corners of the grid: lower left, upper right \[m\].
    #[must_use]
    pub fn bounds_m(&self) -> [[f64; 2]; 2] {
        let info = &self.distances_m.info;
        let (width_m, height_m) = info.size_m();
        let low = [info.origin.x_m, info.origin.y_m];
        [low, [low[0] + width_m, low[1] + height_m]]
    }

    /// Returns true if a robot at a point can reach all other free points.
    #[must_use]
    pub fn contains(&self, [x_m, y_m]: [f64; 2]) -> bool {
        let info = &self.distances_m.info;
        let cell = info.cell_of(x_m, y_m).and_then(|cell| u32::try_from(info.index(cell)).ok());
        cell.is_some_and(|cell| self.cells.binary_search(&cell).is_ok())
    }

    /// Returns a distance that the nearest obstacle is not nearer than \[m\]: quick, and too small by up to a cell.
    #[must_use]
    pub fn min_distance_m(&self, [x_m, y_m]: [f64; 2]) -> f64 {
        let info = &self.distances_m.info;
        let Some(cell) = info.cell_of(x_m, y_m) else { return 0.0 };
        let (x, y) = info.centre_of(cell);
        let off_m = squared_distance([x_m, y_m], [x, y]).sqrt();
        // Margin for the rounding to single precision.
        (f64::from(self.distances_m[cell]) * 0.999_999 - off_m).max(0.0)
    }

    /// Returns a random start and a random goal, at a distance between `min_m` and `max_m` where there is such a
    /// goal. None without free space.
    #[must_use]
    pub fn draw(&self, stream: &mut Stream, min_m: f64, max_m: f64) -> Option<StartAndGoal> {
        let start = self.draw_point(stream)?;
        let yaw_rad = (stream.unit() * 2.0 - 1.0) * std::f64::consts::PI;
        let start_pose = Pose2::new(start[0], start[1], yaw_rad);
        let mut best = (f64::INFINITY, start);
        for _ in 0..MAX_GOAL_DRAW_COUNT {
            let goal = self.draw_point(stream)?;
            let distance_m = squared_distance(start, goal).sqrt();
            let error_m = (min_m - distance_m).max(distance_m - max_m).max(0.0);
            if error_m < best.0 {
                best = (error_m, goal);
            }
            if error_m == 0.0 {
                break;
            }
        }
        Some(StartAndGoal { start: start_pose, goal_m: best.1 })
    }

    fn draw_point(&self, stream: &mut Stream) -> Option<[f64; 2]> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "below 2^28"
        )]
        let at = (stream.unit() * self.cells.len() as f64) as usize;
        let cell = *self.cells.get(at)? as usize;
        let info = &self.distances_m.info;
        let (x, y) = info.centre_of(info.cell(cell));
        let mut jitter = || (stream.unit() * 2.0 - 1.0) * self.jitter_m;
        Some([x + jitter(), y + jitter()])
    }

    /// Returns the length of the shortest path over the centres of free cells and their eight neighbours, by
    /// Dijkstra's algorithm; none if an end is not free. Longer than the true path by at most 8 % \[m\].
    #[must_use]
    pub fn path_length_m(&self, from: [f64; 2], to: [f64; 2]) -> Option<f64> {
        let info = &self.distances_m.info;
        let mut is_free = vec![false; info.len()];
        self.cells.iter().for_each(|cell| is_free[*cell as usize] = true);
        let cell = |[x, y]: [f64; 2]| {
            info.cell_of(x, y).map(|cell| info.index(cell)).filter(|cell| is_free[*cell])
        };
        let (start, end) = (cell(from)?, cell(to)?);
        let mut costs = vec![f64::INFINITY; info.len()];
        costs[start] = 0.0;
        // Costs are positive, so their bits have the same order.
        let mut open = BinaryHeap::from([std::cmp::Reverse((0_u64, start))]);
        while let Some(std::cmp::Reverse((bits, cell))) = open.pop() {
            let cost = f64::from_bits(bits);
            if cell == end {
                return Some(cost * info.resolution_m);
            }
            if cost > costs[cell] {
                continue;
            }
            for (next, length) in neighbours(info, cell) {
                if is_free[next] && cost + length < costs[next] {
                    costs[next] = cost + length;
                    open.push(std::cmp::Reverse(((cost + length).to_bits(), next)));
                }
            }
        }
        None
    }
}

/// The eight neighbours of a cell, with their distances in cells.
fn neighbours(info: &GridInfo, cell: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
    const STEPS_CELLS: [[isize; 2]; 8] =
        [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]];
    let (column, row) = info.cell(cell);
    STEPS_CELLS.iter().filter_map(move |[dx, dy]| {
        let next = (column.checked_add_signed(*dx)?, row.checked_add_signed(*dy)?);
        let length = if *dx != 0 && *dy != 0 { std::f64::consts::SQRT_2 } else { 1.0 };
        info.contains(next).then(|| (info.index(next), length))
    })
}

/// Cells of one connected area.
struct Area {
    cells: Vec<u32>,
    is_at_border: bool,
}

fn largest_area(is_free: &Grid<bool>, resolution_m: f64) -> Vec<u32> {
    let info = &is_free.info;
    let mut is_seen = vec![false; info.len()];
    let (mut inner, mut outer): (Vec<u32>, Vec<u32>) = (Vec::new(), Vec::new());
    for first in 0..info.len() {
        if is_free.cells[first] && !is_seen[first] {
            let area = area_of(is_free, first, &mut is_seen);
            let best = if area.is_at_border { &mut outer } else { &mut inner };
            if area.cells.len() > best.len() {
                *best = area.cells;
            }
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "cells are below 2^28")]
    let is_large =
        inner.len() as f64 * resolution_m * resolution_m > MIN_INNER_SIDE_M * MIN_INNER_SIDE_M;
    let mut chosen = if is_large || outer.is_empty() { inner } else { outer };
    chosen.sort_unstable();
    chosen
}

fn area_of(is_free: &Grid<bool>, first: usize, is_seen: &mut [bool]) -> Area {
    let info = &is_free.info;
    let mut area = Area { cells: Vec::new(), is_at_border: false };
    let mut open = VecDeque::from([first]);
    is_seen[first] = true;
    while let Some(cell) = open.pop_front() {
        area.cells.push(u32::try_from(cell).unwrap_or(u32::MAX));
        let (column, row) = info.cell(cell);
        area.is_at_border |=
            column == 0 || row == 0 || column + 1 == info.width || row + 1 == info.height;
        for (next, length) in neighbours(info, cell) {
            // Only over the sides of cells: a diagonal is between two obstacles.
            if length == 1.0 && is_free.cells[next] && !is_seen[next] {
                is_seen[next] = true;
                open.push_back(next);
            }
        }
    }
    area
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obstacles::ObstacleArea;

    fn wall(x: f64, y: f64, w: f64, h: f64) -> ObstacleArea {
        ObstacleArea::Polygon(vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]])
    }

    /// Two rooms of 4 x 4 m beside each other, with a door of this width.
    fn rooms(door_m: f64) -> Obstacles {
        let (low, high) = (2.0 - door_m / 2.0, 2.0 + door_m / 2.0);
        Obstacles::new(vec![
            wall(-0.2, -0.2, 8.4, 0.2),
            wall(-0.2, 4.0, 8.4, 0.2),
            wall(-0.2, 0.0, 0.2, 4.0),
            wall(8.0, 0.0, 0.2, 4.0),
            wall(3.9, 0.0, 0.2, low),
            wall(3.9, high, 0.2, 4.0 - high),
        ])
    }

    #[test]
    fn the_outside_is_not_free() {
        let free = FreeSpace::new(&rooms(1.0), 0.2);
        assert!(free.contains([1.0, 1.0]) && free.contains([6.0, 1.0]));
        assert!(!free.contains([-0.6, 2.0]), "outside");
        assert!(!free.contains([0.1, 0.1]), "at a wall");
        // Two areas of 3.4 x 3.4 m, and the door between them.
        assert!((22.0..24.0).contains(&free.area_m2()), "{}", free.area_m2());
    }

    #[test]
    fn a_narrow_door_separates() {
        let free = FreeSpace::new(&rooms(0.3), 0.2);
        assert!(free.contains([1.0, 1.0]) != free.contains([6.0, 1.0]));
        let free = FreeSpace::new(&rooms(1.0), 0.2);
        let length_m = free.path_length_m([1.0, 2.0], [7.0, 2.0]).expect("a path");
        assert!((length_m - 6.0).abs() < 0.11, "{length_m}");
        assert_eq!(free.path_length_m([1.0, 2.0], [-0.6, 2.0]), None);
    }

    #[test]
    fn starts_and_goals_are_free() {
        let obstacles = rooms(1.0);
        let free = FreeSpace::new(&obstacles, 0.2);
        for episode in 0..200 {
            let mut stream = Stream::keyed(0, "episode", episode);
            let StartAndGoal { start, goal_m } = free.draw(&mut stream, 2.0, 3.0).expect("space");
            let start = [start.x_m, start.y_m];
            for point in [start, goal_m] {
                assert!(obstacles.distance_to_point_m(point, 1.0) > 0.2, "{point:?}");
                assert!(free.contains(point));
                let distance_m = obstacles.distance_to_point_m(point, MAX_DISTANCE_M);
                assert!(free.min_distance_m(point) <= distance_m);
            }
            let distance_m = squared_distance(start, goal_m).sqrt();
            assert!((2.0..3.0).contains(&distance_m), "{distance_m}");
        }
    }

    #[test]
    fn a_plane_without_obstacles_is_free() {
        let free = FreeSpace::new(&Obstacles::new(Vec::new()), 0.2);
        assert!((390.0..=401.0).contains(&free.area_m2()), "{}", free.area_m2());
    }
}
