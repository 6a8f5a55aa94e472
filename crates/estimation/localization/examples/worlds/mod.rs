//! Simulated worlds of straight walls: scans, odometry and maps.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use periplus_geometry::{LaserScan2, Pose2, ScannerMounting, Stream, normalize_angle};
use periplus_grid::{Grid, GridInfo, OccupancyGrid, occupancy};
use periplus_localization::InitialPose;

/// Cell size of the map \[m\].
const CELL_M: f64 = 0.05;
/// Number of beams around the scanner.
pub(crate) const BEAMS: usize = 360;
const RANGE_MAX_M: f64 = 12.0;
/// Standard deviation of the ranges \[m\].
const SIGMA_M: f64 = 0.01;
/// Fraction of beams that hit people, who are not on the map.
const PEOPLE_BEAM_RATIO: f64 = 0.1;
/// Wheel slip.
const SLIP_RATIO: f64 = 0.05;
/// Step between scans \[m\].
pub(crate) const STEP_M: f64 = 0.1;
/// Clearance from walls \[m\].
const CLEAR_M: f64 = 0.35;

/// World of straight walls.
pub(crate) struct World {
    pub(crate) name: &'static str,
    walls: Vec<[f64; 4]>,
    /// Point of the free space.
    inside: (f64, f64),
    size: (f64, f64),
}

impl World {
    fn new(name: &'static str, size: (f64, f64), inside: (f64, f64)) -> Self {
        let mut world = Self { name, walls: Vec::new(), inside, size };
        world.block(0.0, 0.0, size.0, size.1);
        world
    }

    fn wall(&mut self, x0: f64, y0: f64, x1: f64, y1: f64) {
        self.walls.push([x0, y0, x1, y1]);
    }

    fn block(&mut self, x0: f64, y0: f64, x1: f64, y1: f64) {
        self.wall(x0, y0, x1, y0);
        self.wall(x1, y0, x1, y1);
        self.wall(x1, y1, x0, y1);
        self.wall(x0, y1, x0, y0);
    }

    /// Block rotated about its center.
    fn turned(&mut self, x: f64, y: f64, length: f64, width: f64, yaw: f64) {
        let place = Pose2::new(x, y, yaw);
        let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
            .map(|(a, b)| place.transform_point(a * length, b * width));
        for index in 0..4 {
            let (from, to) = (corners[index], corners[(index + 1) % 4]);
            self.wall(from.0, from.1, to.0, to.1);
        }
    }

    /// Corridor with rooms on both sides that differ only in the position of a table: strongly
    /// symmetric.
    pub(crate) fn office() -> Self {
        let mut world = Self::new("office", (31.03, 12.07), (1.0, 6.0));
        world.rooms(0.0, 0.0, 6, 0);
        world
    }

    /// Rooms of 5 by 5 m along a corridor of 2 m.
    fn rooms(&mut self, x: f64, y: f64, count: usize, kind: usize) {
        let (low, high) = (y + 5.02, y + 7.03);
        for room in 0..count {
            let left = x + 5.17 * room as f64;
            let door = left + 1.6;
            for side in [low, high] {
                self.wall(left, side, door, side);
                self.wall(door + 1.0, side, left + 5.17, side);
            }
            self.wall(left, y, left, low);
            self.wall(left, high, left, y + 12.07);
            // A piece of furniture on either side of the corridor, each at another position.
            let mut stream = Stream::keyed(kind as u64, "furniture", room as u64);
            for middle in [y + 2.2, y + 9.8] {
                let (along, across) = (3.0 * stream.unit(), 1.6 * (stream.unit() - 0.5));
                let (length, width) = (0.6 + stream.unit(), 0.5 + 0.4 * stream.unit());
                let yaw = (4.0 * stream.unit()).floor() * 0.4;
                self.turned(left + 1.1 + along, middle + across, length, width, yaw);
            }
        }
    }

    /// Hall with a grid of pillars: strongly symmetric except for a few objects along its walls.
    pub(crate) fn hall() -> Self {
        let mut world = Self::new("hall", (24.02, 16.04), (2.0, 2.0));
        for column in 0..5 {
            for row in 0..3 {
                let (x, y) = (4.01 + 4.0 * column as f64, 4.02 + 4.0 * row as f64);
                world.block(x - 0.3, y - 0.3, x + 0.3, y + 0.3);
            }
        }
        world.block(0.0, 6.0, 0.8, 9.3);
        world.turned(9.0, 0.6, 2.0, 0.9, 0.1);
        world.wall(20.0, 16.04, 24.02, 13.0);
        world
    }

    /// Rooms of a flat without symmetries.
    pub(crate) fn house() -> Self {
        let mut world = Self::new("house", (12.04, 9.03), (2.0, 2.0));
        world.wall(4.51, 0.0, 4.51, 2.6);
        world.wall(4.51, 3.6, 4.51, 9.03);
        world.wall(0.0, 5.02, 1.9, 5.02);
        world.wall(2.9, 5.02, 4.51, 5.02);
        world.wall(4.51, 4.03, 6.3, 4.03);
        world.wall(7.3, 4.03, 12.04, 4.03);
        world.wall(8.52, 4.03, 8.52, 6.0);
        world.wall(8.52, 7.1, 8.52, 9.03);
        world.block(0.02, 0.02, 1.0, 1.6);
        world.turned(2.6, 7.3, 1.6, 0.9, 0.3);
        world.block(10.9, 0.1, 12.0, 2.1);
        world.turned(6.4, 1.4, 1.2, 1.2, 0.8);
        world.block(5.3, 7.9, 7.4, 8.9);
        world.turned(10.5, 6.4, 0.9, 1.6, -0.4);
        world
    }

    /// Rows of shelves of different lengths.
    pub(crate) fn store() -> Self {
        let mut world = Self::new("store", (26.06, 18.02), (1.0, 1.0));
        for row in 0..5 {
            let y = 2.7 + 3.0 * row as f64;
            let (begin, end) = (2.4 + 0.7 * (row % 3) as f64, 22.9 - 1.3 * (row * row % 4) as f64);
            let gap = 8.0 + 2.6 * row as f64;
            world.block(begin, y, gap, y + 0.9);
            world.block(gap + 1.4, y, end, y + 0.9);
        }
        world.turned(24.4, 5.0, 1.3, 0.9, 0.5);
        world.turned(24.2, 13.0, 0.9, 0.9, 0.2);
        world.block(0.02, 15.4, 0.9, 17.9);
        world
    }

    /// Walls in all directions.
    pub(crate) fn cave() -> Self {
        let mut world = Self::new("cave", (20.0, 16.0), (5.0, 5.0));
        let ring = |middle: (f64, f64), radius: f64, corners: usize, seed: u64| {
            let mut stream = Stream::keyed(seed, "cave", 0);
            let at = move |index: usize, stream: &mut Stream| {
                let angle = index as f64 / corners as f64 * TAU;
                let radius = radius * (0.8 + 0.4 * stream.unit());
                (middle.0 + 1.25 * radius * libm::cos(angle), middle.1 + radius * libm::sin(angle))
            };
            (0..corners).map(|index| at(index, &mut stream)).collect::<Vec<_>>()
        };
        for points in [
            ring((10.0, 8.0), 6.3, 17, 3),
            ring((10.4, 8.3), 1.5, 7, 4),
            ring((5.2, 9.0), 0.5, 5, 6),
        ] {
            for index in 0..points.len() {
                let (from, to) = (points[index], points[(index + 1) % points.len()]);
                world.wall(from.0, from.1, to.0, to.1);
            }
        }
        world
    }

    /// Offices of 100 by 100 m.
    pub(crate) fn block_of_offices() -> Self {
        let mut world = Self::new("100 x 100 m", (100.02, 100.03), (1.0, 6.0));
        for floor in 0..8 {
            let y = 12.2 * f64::from(floor);
            world.wall(0.0, y, 96.0, y);
            world.rooms(0.0, y, 18, floor as usize);
        }
        world
    }

    /// All worlds of a table.
    pub(crate) fn all() -> [Self; 5] {
        [Self::office(), Self::hall(), Self::house(), Self::store(), Self::cave()]
    }

    /// Map of the world: cells at walls are occupied, reachable cells are free.
    pub(crate) fn map(&self) -> OccupancyGrid {
        let origin = Pose2::new(-1.013, -1.027, 0.0);
        let side = |metres: f64| ((metres + 2.1) / CELL_M) as usize;
        let info = GridInfo::new(CELL_M, side(self.size.0), side(self.size.1), origin).unwrap();
        let mut map = Grid::new(info, occupancy::UNKNOWN);
        let cell_transform = info.finder();
        for &[x0, y0, x1, y1] in &self.walls {
            // Points along the walls as dense as ranges.
            let count = (libm::hypot(x1 - x0, y1 - y0) / 0.01) as usize + 1;
            for index in 0..=count {
                let part = index as f64 / count as f64;
                if let Some(cell) =
                    cell_transform.cell_of(x0 + part * (x1 - x0), y0 + part * (y1 - y0))
                {
                    map[cell] = occupancy::OCCUPIED;
                }
            }
        }
        let mut open: VecDeque<(usize, usize)> =
            cell_transform.cell_of(self.inside.0, self.inside.1).into_iter().collect();
        while let Some((column, row)) = open.pop_front() {
            if map[(column, row)] != occupancy::UNKNOWN {
                continue;
            }
            map[(column, row)] = occupancy::FREE;
            open.extend([
                (column + 1, row),
                (column - 1, row),
                (column, row + 1),
                (column, row - 1),
            ]);
        }
        map
    }

    /// Range to the first wall \[m\].
    fn range_m(&self, (x, y): (f64, f64), angle: f64) -> f64 {
        let (sine, cosine) = libm::sincos(angle);
        let mut range = f64::INFINITY;
        for &[x0, y0, x1, y1] in &self.walls {
            let (dx, dy) = (x1 - x0, y1 - y0);
            let cross = cosine * dy - sine * dx;
            let (ox, oy) = (x0 - x, y0 - y);
            let along = (ox * dy - oy * dx) / cross;
            let part = (ox * sine - oy * cosine) / cross;
            if along > 0.0 && (0.0..=1.0).contains(&part) {
                range = range.min(along);
            }
        }
        range
    }

    /// Simulates a scan, with people in front of some beams.
    pub(crate) fn scan(&self, map_from_base: Pose2, stream: &mut Stream) -> LaserScan2 {
        let place = (map_from_base.x_m, map_from_base.y_m);
        let mut ranges: Vec<f64> = (0..BEAMS)
            .map(|beam| {
                self.range_m(place, map_from_base.yaw_rad - PI + beam as f64 * TAU / BEAMS as f64)
            })
            .collect();
        let mut blocked = 0;
        while blocked < (PEOPLE_BEAM_RATIO * BEAMS as f64) as usize {
            let (bearing, far) = (TAU * stream.unit(), 0.8 + 2.5 * stream.unit());
            for (beam, range) in ranges.iter_mut().enumerate() {
                let off = normalize_angle(beam as f64 * TAU / BEAMS as f64 - bearing);
                let aside = far * libm::sin(off);
                // Radius of a person, seen from any side.
                if libm::cos(off) > 0.0 && aside.abs() < 0.2 {
                    let near = far * libm::cos(off) - (0.04 - aside * aside).sqrt();
                    if near < *range {
                        *range = near;
                        blocked += 1;
                    }
                }
            }
        }
        let measured = ranges.into_iter().map(|range| {
            let range = range + SIGMA_M * stream.normal();
            if range < RANGE_MAX_M { range as f32 } else { f32::INFINITY }
        });
        LaserScan2 {
            time_ns: 0,
            time_increment_s: 0.0,
            mounting: ScannerMounting::upright(Pose2::IDENTITY),
            angle_min_rad: -PI,
            angle_increment_rad: TAU / BEAMS as f64,
            range_min_m: 0.1,
            range_max_m: RANGE_MAX_M as f32,
            ranges_m: measured.collect(),
        }
    }

    /// Random pose with clearance.
    pub(crate) fn random_pose(&self, map: &OccupancyGrid, stream: &mut Stream) -> Pose2 {
        let free: Vec<usize> = (0..map.cells.len()).filter(|&it| map.cells[it] == 0).collect();
        loop {
            let cell = map.info.cell(free[(stream.unit() * free.len() as f64) as usize]);
            let (x, y) = map.info.point_at(cell.0 as f64 + 0.5, cell.1 as f64 + 0.5);
            let is_clear =
                (0..24).all(|step| self.range_m((x, y), f64::from(step) * TAU / 24.0) > CLEAR_M);
            if is_clear {
                return Pose2::new(x, y, TAU * stream.unit() - PI);
            }
        }
    }
}

/// Robot that wanders, with its odometry.
pub(crate) struct Wanderer {
    pub(crate) truth: Pose2,
    pub(crate) odom_from_base: Pose2,
    /// Systematic error of odometry.
    bias: (f64, f64),
    turning: f64,
}

impl Wanderer {
    pub(crate) fn new(truth: Pose2, stream: &mut Stream) -> Self {
        let mut slip = || SLIP_RATIO * (2.0 * stream.unit() - 1.0);
        let bias = (slip(), slip());
        Self { truth, odom_from_base: Pose2::new(-3.0, 5.0, 1.0), bias, turning: 0.0 }
    }

    /// Moves one step: forward while there is room, otherwise turning.
    pub(crate) fn step(&mut self, world: &World, stream: &mut Stream) {
        let place = (self.truth.x_m, self.truth.y_m);
        let room = |angle: f64| world.range_m(place, self.truth.yaw_rad + angle);
        let ahead =
            [-0.5, -0.25, 0.0, 0.25, 0.5].map(room).into_iter().fold(f64::INFINITY, f64::min);
        let aside = [-1.2, -0.8, 0.8, 1.2].map(room).into_iter().fold(f64::INFINITY, f64::min);
        let is_free = ahead > CLEAR_M + 0.25 && aside > 0.25;
        let moved = if is_free {
            self.turning = 0.0;
            Pose2::new(STEP_M, 0.0, 0.06 * stream.normal())
        } else {
            if self.turning == 0.0 {
                let (left, right) = (room(0.9), room(-0.9));
                self.turning = if left > right { 1.0 } else { -1.0 };
            }
            Pose2::new(0.0, 0.0, 0.2 * self.turning)
        };
        self.truth = (self.truth * moved).normalized();
        let mut slip = |bias: f64| 1.0 + bias + SLIP_RATIO * stream.normal();
        let counted =
            Pose2::new(slip(self.bias.0) * moved.x_m, 0.0, slip(self.bias.1) * moved.yaw_rad);
        self.odom_from_base = (self.odom_from_base * counted).normalized();
    }
}

/// Error of a pose \[m\], \[rad\].
pub(crate) fn off(truth: Pose2, found: Pose2) -> (f64, f64) {
    let error = truth.inverse() * found;
    (libm::hypot(error.x_m, error.y_m), normalize_angle(error.yaw_rad).abs())
}

/// CPU time of this thread \[s\]; 0 where the system does not provide it.
#[allow(clippy::disallowed_methods, reason = "it measures")]
pub(crate) fn cpu_s() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let ns: Option<f64> = text.split_whitespace().next().and_then(|it| it.parse().ok());
    1e-9 * ns.unwrap_or_default()
}

/// Initial pose with the accuracy of a user.
pub(crate) fn initial_pose_at(pose: Pose2) -> InitialPose {
    let mut covariance = [0.0; 36];
    (covariance[0], covariance[7], covariance[35]) = (0.04, 0.04, 0.02);
    InitialPose { frame: "map".into(), pose, covariance, then_from_now: Pose2::IDENTITY }
}
