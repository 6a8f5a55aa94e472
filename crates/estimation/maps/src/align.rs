//! Alignment of two maps.

use periplus_geometry::Pose2;
use periplus_grid::{CellFinder, Grid, NO_SITE_CELLS, OccupancyGrid, squared_distances};

/// Minimum occupancy of walls \[%\]: `occupied_thresh` 0.65 of Nav2.
const OCCUPIED_PERCENT: i8 = 65;

/// Maximum number of wall points to compare; larger sets are subsampled.
const MOST_POINTS: usize = 2000;

/// Number of candidates of the coarse search that are refined.
const REFINED_CANDIDATES: usize = 8;

/// Blur of the coarse search \[m\]; its step is half of that.
const BLUR_M: f64 = 0.3;

/// Pose of one map relative to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// `reference_from_other`: transform of the other map into the frame of the first.
    pub reference_from_other: Pose2,
    /// Match score: 1 when each wall point is on a wall of the other map.
    pub score: f64,
}

pub(crate) fn is_wall(cell: i8) -> bool {
    cell >= OCCUPIED_PERCENT
}

/// Aligns the walls of a map with those of another, within `window_m` metres and `window_rad`
/// radians of the origins in the files. A map without walls is not moved.
///
/// Searches the whole window coarsely with walls blurred to a third of a metre, rotated about the
/// centroid of the walls, then climbs from the best candidates with decreasing blur.
#[must_use]
pub fn align(
    reference: &OccupancyGrid,
    other: &OccupancyGrid,
    window_m: f64,
    window_rad: f64,
) -> Alignment {
    let walls = Walls::new(reference);
    let points = Points::new(other);
    let stay = |score| Alignment { reference_from_other: Pose2::IDENTITY, score };
    let (Some(walls), Some(points)) = (walls, points) else { return stay(0.0) };
    let resolution_m = reference.info.resolution_m.max(other.info.resolution_m);
    let blur_m = BLUR_M.max(2.0 * resolution_m);
    let step_m = blur_m / 2.0;
    let step_rad = step_m / points.reach_m.max(step_m);
    let steps = |window: f64, step: f64| (window / step).ceil().min(200.0) as i64;
    let (count, turns) = (steps(window_m, step_m), steps(window_rad, step_rad));

    let mut best: Vec<(f64, [f64; 3])> = Vec::new();
    for turn in -turns..=turns {
        let turned = points.turned(turn as f64 * step_rad);
        for row in -count..=count {
            for column in -count..=count {
                let shift = [column as f64 * step_m, row as f64 * step_m];
                let score = walls.score(&turned, shift, blur_m);
                if best.len() < REFINED_CANDIDATES || score > best[REFINED_CANDIDATES - 1].0 {
                    // Of equal scores the first stays in front.
                    let at = best.partition_point(|(other, _)| *other >= score);
                    best.insert(at, (score, [shift[0], shift[1], turn as f64 * step_rad]));
                    best.truncate(REFINED_CANDIDATES);
                }
            }
        }
    }
    let finest_m = resolution_m / 50.0;
    let mut winner = (f64::MIN, [0.0; 3]);
    for (_, start) in best {
        let mut place = start;
        let mut step = step_m;
        while step > finest_m {
            let blur_m = (2.0 * step).max(resolution_m);
            place = walls.climb(&points, place, step, blur_m);
            step /= 2.0;
        }
        let turned = points.turned(place[2]);
        let score = walls.score(&turned, [place[0], place[1]], resolution_m);
        if score > winner.0 {
            winner = (score, place);
        }
    }
    let (score, [x_m, y_m, yaw_rad]) = winner;
    Alignment { reference_from_other: points.about_middle(x_m, y_m, yaw_rad), score }
}

/// Distance field of the walls.
struct Walls {
    distances_m: Grid<f32>,
    finder: CellFinder,
    /// Distance assumed outside the map \[m\].
    far_m: f64,
}

impl Walls {
    fn new(map: &OccupancyGrid) -> Option<Self> {
        let squares = squared_distances(map, |&cell| is_wall(cell));
        if squares.cells.first().is_none_or(|&square| square == NO_SITE_CELLS) {
            return None;
        }
        let resolution_m = map.info.resolution_m;
        let distances_m = squares.map(|&square| (f64::from(square).sqrt() * resolution_m) as f32);
        Some(Self { finder: map.info.finder(), distances_m, far_m: 10.0 * BLUR_M })
    }

    /// Interpolated bilinearly between the centres of four cells.
    fn distance_m(&self, x_m: f64, y_m: f64) -> f64 {
        let (columns, rows) = self.finder.cells_to(x_m, y_m);
        let (columns, rows) = (columns - 0.5, rows - 0.5);
        let info = self.distances_m.info;
        let is_inside = columns >= 0.0
            && rows >= 0.0
            && columns < (info.width - 1) as f64
            && rows < (info.height - 1) as f64;
        if !is_inside {
            return self.distances_m.at(x_m, y_m).map_or(self.far_m, |&it| f64::from(it));
        }
        let (column, row) = (columns as usize, rows as usize);
        let (right, up) = (columns - column as f64, rows - row as f64);
        let at = |column, row| f64::from(self.distances_m[(column, row)]);
        let below = at(column, row) * (1.0 - right) + at(column + 1, row) * right;
        let above = at(column, row + 1) * (1.0 - right) + at(column + 1, row + 1) * right;
        below * (1.0 - up) + above * up
    }

    /// Returns the mean of a bell curve over the distances.
    fn score(&self, points: &[(f64, f64)], [x_m, y_m]: [f64; 2], blur_m: f64) -> f64 {
        let sum: f64 = points
            .iter()
            .map(|&(x, y)| {
                let away = self.distance_m(x + x_m, y + y_m) / blur_m;
                // A rational bell curve is cheaper than an exponential one, and has a single peak
                // as well.
                1.0 / (1.0 + away * away * away * away)
            })
            .sum();
        sum / points.len() as f64
    }

    /// Hill climbing with steps of one size along each axis.
    fn climb(&self, points: &Points, start: [f64; 3], step_m: f64, blur_m: f64) -> [f64; 3] {
        const MOST_STEPS: usize = 40;
        let step_rad = step_m / points.reach_m.max(step_m);
        let rate =
            |place: [f64; 3]| self.score(&points.turned(place[2]), [place[0], place[1]], blur_m);
        let (mut place, mut score) = (start, rate(start));
        for _ in 0..MOST_STEPS {
            let before = score;
            for (axis, step) in [(0, step_m), (1, step_m), (2, step_rad)] {
                for step in [step, -step] {
                    let mut tried = place;
                    tried[axis] += step;
                    let rated = rate(tried);
                    if rated > score {
                        (place, score) = (tried, rated);
                    }
                }
            }
            if score == before {
                break;
            }
        }
        place
    }
}

/// Wall points relative to their centroid.
struct Points {
    points: Vec<(f64, f64)>,
    middle: (f64, f64),
    /// Roughly the median distance from the centroid \[m\].
    reach_m: f64,
}

impl Points {
    fn new(map: &OccupancyGrid) -> Option<Self> {
        let cells: Vec<usize> =
            (0..map.cells.len()).filter(|&index| is_wall(map.cells[index])).collect();
        let every = cells.len().div_ceil(MOST_POINTS).max(1);
        let points: Vec<(f64, f64)> = cells
            .iter()
            .step_by(every)
            .map(|&index| map.info.centre_of(map.info.cell(index)))
            .collect();
        if points.is_empty() {
            return None;
        }
        let count = points.len() as f64;
        let sum = points.iter().fold((0.0, 0.0), |sum, it| (sum.0 + it.0, sum.1 + it.1));
        let middle = (sum.0 / count, sum.1 / count);
        let points: Vec<_> = points.iter().map(|it| (it.0 - middle.0, it.1 - middle.1)).collect();
        let squares: f64 = points.iter().map(|(x, y)| x * x + y * y).sum();
        Some(Self { points, middle, reach_m: (squares / count).sqrt() })
    }

    /// Returns the points in the map frame, rotated about their centroid.
    fn turned(&self, yaw_rad: f64) -> Vec<(f64, f64)> {
        let about = Pose2::new(self.middle.0, self.middle.1, yaw_rad);
        let finder = Turn::new(about);
        self.points.iter().map(|&(x, y)| finder.apply(x, y)).collect()
    }

    /// Returns a rotation about the centroid with a translation as one transform of the map.
    fn about_middle(&self, x_m: f64, y_m: f64, yaw_rad: f64) -> Pose2 {
        let middle = Pose2::new(self.middle.0, self.middle.1, 0.0);
        Pose2::new(x_m, y_m, 0.0) * middle * Pose2::new(0.0, 0.0, yaw_rad) * middle.inverse()
    }
}

/// A transform with precomputed sine and cosine.
struct Turn {
    sine: f64,
    cosine: f64,
    x_m: f64,
    y_m: f64,
}

impl Turn {
    fn new(pose: Pose2) -> Self {
        let (sine, cosine) = libm::sincos(pose.yaw_rad);
        Self { sine, cosine, x_m: pose.x_m, y_m: pose.y_m }
    }

    fn apply(&self, x: f64, y: f64) -> (f64, f64) {
        (self.x_m + self.cosine * x - self.sine * y, self.y_m + self.sine * x + self.cosine * y)
    }
}

#[cfg(test)]
mod tests {
    use periplus_grid::{GridInfo, occupancy};

    use super::*;

    /// A room of 6 by 4 m with an inner wall, in a frame with a rotated corner as origin.
    pub(crate) fn room(origin: Pose2, resolution_m: f64) -> OccupancyGrid {
        let cells = |length_m: f64| (length_m / resolution_m).round() as usize;
        let info = GridInfo::new(resolution_m, cells(8.0), cells(6.0), origin).unwrap();
        let mut map = Grid::new(info, occupancy::UNKNOWN);
        for index in 0..map.cells.len() {
            // In coordinates of the room.
            let (x, y) = info.centre_of(info.cell(index));
            let thick = 0.1;
            let inside =
                |x0: f64, x1: f64, y0: f64, y1: f64| x >= x0 && x < x1 && y >= y0 && y < y1;
            let wall = inside(-3.0 - thick, 3.0 + thick, -2.0 - thick, 2.0 + thick)
                && !inside(-3.0, 3.0, -2.0, 2.0)
                || inside(1.0, 1.0 + thick, -2.0, 0.5);
            map.cells[index] = match wall {
                true => occupancy::OCCUPIED,
                false if inside(-3.0, 3.0, -2.0, 2.0) => occupancy::FREE,
                false => occupancy::UNKNOWN,
            };
        }
        map
    }

    #[test]
    fn a_shifted_and_turned_map_is_laid_back() {
        let reference = room(Pose2::new(-4.0, -3.0, 0.0), 0.05);
        let error = Pose2::new(0.43, -0.31, 0.12);
        // The same cells with another origin.
        let mut other = reference.clone();
        other.info.origin = error * reference.info.origin;
        let found = align(&reference, &other, 1.0, 0.2);
        let rest = found.reference_from_other * error;
        assert!(libm::hypot(rest.x_m, rest.y_m) < 0.01, "{rest:?}");
        assert!(rest.yaw_rad.abs() < 0.003, "{rest:?}");
        assert!(found.score > 0.99);
    }

    #[test]
    fn maps_without_walls_stay() {
        let map = room(Pose2::new(-4.0, -3.0, 0.0), 0.2);
        let empty = Grid::new(map.info, occupancy::FREE);
        let stay = Alignment { reference_from_other: Pose2::IDENTITY, score: 0.0 };
        assert_eq!(align(&map, &empty, 1.0, 0.1), stay);
        assert_eq!(align(&empty, &map, 1.0, 0.1), stay);
    }
}
