//! Drives with a map and a reference, and changed maps: unknown parts and moved furniture.

use periplus_geometry::{LaserScan2, Pose2, Stream};
use periplus_grid::{OccupancyGrid, occupancy, squared_distances};

use crate::worlds::{Wanderer, World};

/// Maximum distance of a beam end at a wall \[m\].
const ON_WALL_M: f64 = 0.15;
/// Maximum distance from free space of a robot on the map \[m\].
const FREE_M: f64 = 0.3;
/// Minimum inlier ratio of a scan that the map covers.
const MIN_INLIER_RATIO: f64 = 0.5;
/// Steps of a drive through a world.
const STEPS: usize = 2500;

/// Scan with odometry and reference pose.
#[derive(Clone)]
pub(crate) struct Sight {
    pub(crate) odom_from_base: Pose2,
    pub(crate) map_from_base: Pose2,
    pub(crate) scan: LaserScan2,
}

/// Drive and its map.
pub(crate) struct Course {
    pub(crate) name: String,
    pub(crate) map: OccupancyGrid,
    pub(crate) sights: Vec<Sight>,
}

impl Course {
    /// Simulates a drive through a world.
    pub(crate) fn of_world(world: &World, seed: u64) -> Self {
        let map = world.map();
        let mut stream = Stream::keyed(seed, "course", 0);
        let mut robot = Wanderer::new(world.random_pose(&map, &mut stream), &mut stream);
        let sights = (0..STEPS).map(|_| {
            robot.step(world, &mut stream);
            let scan = world.scan(robot.truth, &mut stream);
            Sight { odom_from_base: robot.odom_from_base, map_from_base: robot.truth, scan }
        });
        let sights = sights.collect();
        Self { name: world.name.to_owned(), map, sights }
    }

    /// Distance of the reference between two sights \[m\].
    pub(crate) fn way_m(&self, from: usize, to: usize) -> f64 {
        self.sights[from..=to]
            .windows(2)
            .map(|pair| {
                let step = pair[0].map_from_base.inverse() * pair[1].map_from_base;
                step.x_m.hypot(step.y_m)
            })
            .sum()
    }

    /// First sight after a distance, if the drive is long enough.
    pub(crate) fn after_m(&self, from: usize, way_m: f64) -> Option<usize> {
        let mut sum = 0.0;
        for index in from + 1..self.sights.len() {
            sum += self.way_m(index - 1, index);
            if sum >= way_m {
                return Some(index);
            }
        }
        None
    }

    /// Random sight with at least a distance after it.
    pub(crate) fn anywhere(&self, way_m: f64, stream: &mut Stream) -> usize {
        let last =
            (0..self.sights.len()).rev().find(|&it| self.after_m(it, way_m).is_some()).unwrap_or(0);
        (stream.unit() * (last + 1) as f64) as usize
    }
}

/// Test whether a map covers a sight: the robot is near free space, and half of the hits are at
/// walls.
pub(crate) struct Cover<'a> {
    map: &'a OccupancyGrid,
    /// Squared distances to walls \[cells\].
    walls: Vec<u32>,
}

impl<'a> Cover<'a> {
    pub(crate) fn new(map: &'a OccupancyGrid) -> Self {
        Self { map, walls: squared_distances(map, |&value| value == occupancy::OCCUPIED).cells }
    }

    pub(crate) fn covers(&self, sight: &Sight) -> bool {
        let info = self.map.info;
        let cell_transform = info.finder();
        let scan = &sight.scan;
        let map_from_laser = sight.map_from_base * scan.mounting.base_from_scanner;
        let reach = ON_WALL_M / info.resolution_m;
        let (mut count, mut on) = (0_usize, 0_usize);
        for (index, &range) in scan.ranges_m.iter().enumerate() {
            let range = f64::from(range);
            if !(range > scan.range_min_m.into() && range < scan.range_max_m.into()) {
                continue;
            }
            let angle = scan.beam_angle_rad(index);
            let (x, y) = map_from_laser.transform_point(range * angle.cos(), range * angle.sin());
            count += 1;
            let cell = cell_transform.cell_of(x, y).map(|cell| info.index(cell));
            on += usize::from(cell.is_some_and(|it| f64::from(self.walls[it]) < reach * reach));
        }
        let place = sight.map_from_base;
        let is_free_at = |x: f64, y: f64| {
            cell_transform.cell_of(x, y).is_some_and(|cell| self.map[cell] == occupancy::FREE)
        };
        let around = (0..16).map(|it| std::f64::consts::PI / 8.0 * f64::from(it));
        let is_free = is_free_at(place.x_m, place.y_m)
            || around
                .map(|bearing| (FREE_M * bearing.cos(), FREE_M * bearing.sin()))
                .any(|(dx, dy)| is_free_at(place.x_m + dx, place.y_m + dy));
        is_free && on as f64 >= MIN_INLIER_RATIO * count as f64
    }
}

/// Map with one side unknown: beyond a line across direction `angle` \[rad\] that halves the drive.
pub(crate) fn erased(course: &Course, angle: f64) -> OccupancyGrid {
    let (sine, cosine) = angle.sin_cos();
    let beyond = |x: f64, y: f64| cosine * x + sine * y;
    let mut places: Vec<f64> = course
        .sights
        .iter()
        .map(|sight| beyond(sight.map_from_base.x_m, sight.map_from_base.y_m))
        .collect();
    places.sort_by(f64::total_cmp);
    let line = places[places.len() / 2];
    let mut map = course.map.clone();
    for index in 0..map.cells.len() {
        let (column, row) = map.info.cell(index);
        let (x, y) = map.info.point_at(column as f64 + 0.5, row as f64 + 0.5);
        if beyond(x, y) > line {
            map.cells[index] = occupancy::UNKNOWN;
        }
    }
    map
}

/// Map before furniture was moved: a share of the pieces of wall is missing, and as many boxes are
/// elsewhere, none on the path of the robot.
pub(crate) fn rearranged(course: &Course, share: f64, stream: &mut Stream) -> OccupancyGrid {
    let mut map = course.map.clone();
    let info = map.info;
    let piece = (1.2 / info.resolution_m) as usize;
    let walls: Vec<usize> =
        (0..map.cells.len()).filter(|&it| map.cells[it] == occupancy::OCCUPIED).collect();
    let free: Vec<usize> =
        (0..map.cells.len()).filter(|&it| map.cells[it] == occupancy::FREE).collect();
    let mut driven = course.map.clone();
    driven.cells.fill(0);
    for sight in &course.sights {
        if let Some(cell) = info.finder().cell_of(sight.map_from_base.x_m, sight.map_from_base.y_m)
        {
            driven[cell] = 1;
        }
    }
    let far = squared_distances(&driven, |&value| value == 1).cells;
    let keep = (0.6 / info.resolution_m).powi(2) as u32;
    let pick = |from: &[usize], stream: &mut Stream| {
        from[((stream.unit() * from.len() as f64) as usize).min(from.len() - 1)]
    };
    let mut gone = 0;
    while (gone as f64) < share * walls.len() as f64 {
        let (column, row) = info.cell(pick(&walls, stream));
        for (a, b) in (0..piece * piece).map(|it| (it % piece, it / piece)) {
            let (column, row) =
                ((column + a).wrapping_sub(piece / 2), (row + b).wrapping_sub(piece / 2));
            if info.contains((column, row)) && map[(column, row)] == occupancy::OCCUPIED {
                map[(column, row)] = occupancy::FREE;
                gone += 1;
            }
        }
    }
    let mut come = 0;
    for _ in 0..100_000 {
        if come >= gone {
            break;
        }
        let (column, row) = info.cell(pick(&free, stream));
        let (wide, high) =
            (6 + (14.0 * stream.unit()) as usize, 6 + (14.0 * stream.unit()) as usize);
        let all: Vec<(usize, usize)> = (0..wide * high)
            .map(|it| (column + it % wide, row + it / wide))
            .filter(|&cell| info.contains(cell))
            .collect();
        if all.len() < wide * high || all.iter().any(|&cell| far[info.index(cell)] < keep) {
            continue;
        }
        for cell in all {
            let is_edge = cell.0 == column
                || cell.1 == row
                || cell.0 == column + wide - 1
                || cell.1 == row + high - 1;
            if is_edge {
                map[cell] = occupancy::OCCUPIED;
                come += 1;
            }
        }
    }
    map
}
