//! Worlds of straight walls, and a robot that drives through them with a noisy scanner and wheels.
#![allow(dead_code, reason = "each user takes a part")]

pub(crate) mod campus;
pub(crate) mod crowd;
pub(crate) mod doors;
pub(crate) mod glass;
pub(crate) mod hall;
pub(crate) mod judge;
pub(crate) mod kinds;
pub(crate) mod office;
pub(crate) mod ramp;
pub(crate) mod rig;
pub(crate) mod solid;

use periplus_geometry::{LaserScan2, Pose2, ScannerMounting, Stream, normalize_angle};

/// From the middle of an aisle to the next \[m\].
const AISLE_M: f64 = 4.0;

/// Walls from (x, y) to (x, y) \[m\].
pub(crate) struct World {
    pub(crate) walls: Vec<[f64; 4]>,
}

/// Properties of the robot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Robot {
    pub(crate) beams: usize,
    pub(crate) field_rad: f64,
    pub(crate) range_max_m: f64,
    pub(crate) range_sigma_m: f64,
    /// Odometry noise: relative errors of distance and rotation, and heading drift per metre \[rad\].
    pub(crate) way_error: f64,
    pub(crate) turn_error: f64,
    pub(crate) bias_rad_per_m: f64,
}

pub(crate) const ROBOT: Robot = Robot {
    beams: 181,
    field_rad: std::f64::consts::PI,
    range_max_m: 20.0,
    range_sigma_m: 0.01,
    way_error: 0.05,
    turn_error: 0.08,
    bias_rad_per_m: 0.01,
};

/// One moment of a drive.
pub(crate) struct Moment {
    pub(crate) truth: Pose2,
    pub(crate) odometry: Pose2,
    pub(crate) scan: LaserScan2,
}

impl World {
    pub(crate) fn rectangle(&mut self, [x0, y0, x1, y1]: [f64; 4]) {
        self.walls.extend([[x0, y0, x1, y0], [x1, y0, x1, y1], [x1, y1, x0, y1], [x0, y1, x0, y0]]);
    }

    /// Length of all walls \[m\].
    pub(crate) fn walls_m(&self) -> f64 {
        self.walls.iter().map(|[x0, y0, x1, y1]| libm::hypot(x1 - x0, y1 - y0)).sum()
    }

    /// A square ring of corridors with niches that are not the same anywhere.
    pub(crate) fn ring(width_m: f64, height_m: f64, corridor_m: f64, seed: u64) -> Self {
        let mut world = Self { walls: Vec::new() };
        let half = 0.5 * corridor_m;
        world.rectangle([-half, -half, width_m + half, height_m + half]);
        world.rectangle([half, half, width_m - half, height_m - half]);
        let mut stream = Stream::keyed(seed, "niches", 0);
        let mut at = 3.0;
        while at < width_m - 3.0 {
            let depth = 0.2 + 0.3 * stream.unit();
            let long = 0.4 + 0.8 * stream.unit();
            world.rectangle([at, -half, at + long, -half + depth]);
            let depth = 0.2 + 0.3 * stream.unit();
            world.rectangle([at + 1.0, height_m + half - depth, at + 1.0 + long, height_m + half]);
            at += 2.0 + 3.0 * stream.unit();
        }
        let mut at = 3.0;
        while at < height_m - 3.0 {
            let depth = 0.2 + 0.3 * stream.unit();
            let long = 0.4 + 0.8 * stream.unit();
            world.rectangle([-half, at, -half + depth, at + long]);
            world.rectangle([width_m + half - depth, at + 0.7, width_m + half, at + 0.7 + long]);
            at += 2.0 + 3.0 * stream.unit();
        }
        world
    }

    /// Blocks in rows and columns, all the same, with corridors between: every crossing looks like
    /// every other, but for the outer wall.
    pub(crate) fn blocks(columns: usize, rows: usize, block_m: f64, corridor_m: f64) -> Self {
        let mut world = Self { walls: Vec::new() };
        let pitch = block_m + corridor_m;
        let (width, height) = (columns as f64 * pitch, rows as f64 * pitch);
        let half = 0.5 * corridor_m;
        world.rectangle([-half, -half, width + half, height + half]);
        for column in 0..columns {
            for row in 0..rows {
                let (x, y) = (column as f64 * pitch + half, row as f64 * pitch + half);
                world.rectangle([x, y, x + block_m, y + block_m]);
                // A door frame in the middle of two sides, the same for each.
                let middle = 0.5 * block_m;
                world.rectangle([x + middle, y - 0.15, x + middle + 0.9, y]);
                world.rectangle([x - 0.15, y + middle, x, y + middle + 0.9]);
            }
        }
        world
    }

    /// Rows of racks with pallets at random in a closed hall; aisles lead along `x` beside each row
    /// and along `y` at both ends.
    pub(crate) fn warehouse(rows: usize, long_m: f64, seed: u64) -> Self {
        let mut world = Self { walls: Vec::new() };
        let mut stream = Stream::keyed(seed, "pallets", 0);
        world.rectangle([-2.0, -2.0, long_m + 6.0, rows as f64 * AISLE_M + 2.0]);
        for row in 0..rows {
            let y = (row as f64 + 0.5) * AISLE_M;
            let bays = (long_m / 2.7) as usize;
            for bay in 0..=bays {
                let x = 2.0 + 2.7 * bay as f64;
                world.rectangle([x - 0.05, y - 0.55, x + 0.05, y - 0.45]);
                world.rectangle([x - 0.05, y + 0.45, x + 0.05, y + 0.55]);
                for place in 0..2 {
                    if bay < bays && stream.unit() < 0.6 {
                        let x = x + 0.3 + 1.2 * f64::from(place) + 0.1 * stream.unit();
                        let back = 0.1 * stream.unit();
                        world.rectangle([x, y - 0.5 + back, x + 0.8, y + 0.5 - back]);
                    }
                }
            }
        }
        world
    }

    /// Corners of a drive through the warehouse of at least this length \[m\], and its length.
    pub(crate) fn rounds(rows: usize, long_m: f64, way_m: f64, seed: u64) -> Vec<(f64, f64)> {
        let mut stream = Stream::keyed(seed, "rounds", 0);
        let mut corners = vec![(0.0, 0.0)];
        let (mut row, mut end, mut gone_m) = (0_usize, 0_usize, 0.0);
        while gone_m < way_m {
            let other = (stream.unit() * (rows + 1) as f64) as usize;
            let x = if end == 0 { 0.0 } else { long_m + 4.0 };
            if other != row {
                corners.push((x, other as f64 * AISLE_M));
                gone_m += row.abs_diff(other) as f64 * AISLE_M;
                row = other;
            }
            end = 1 - end;
            corners.push((if end == 0 { 0.0 } else { long_m + 4.0 }, row as f64 * AISLE_M));
            gone_m += long_m + 4.0;
        }
        corners
    }

    /// The walls that a scanner may see from there.
    fn around(&self, pose: Pose2, reach_m: f64) -> Self {
        let is_near = |[x0, y0, x1, y1]: &&[f64; 4]| {
            let (x, y) = (pose.x_m.clamp(x0.min(*x1), x0.max(*x1)), pose.y_m);
            let y = y.clamp(y0.min(*y1), y0.max(*y1));
            libm::hypot(x - pose.x_m, y - pose.y_m) < reach_m
        };
        Self { walls: self.walls.iter().filter(is_near).copied().collect() }
    }

    fn range(&self, x: f64, y: f64, angle: f64) -> f64 {
        let (s, c) = libm::sincos(angle);
        let mut nearest = f64::INFINITY;
        for [x0, y0, x1, y1] in &self.walls {
            let (ux, uy) = (x1 - x0, y1 - y0);
            let cross = c * uy - s * ux;
            if cross.abs() < 1e-12 {
                continue;
            }
            let (dx, dy) = (x0 - x, y0 - y);
            let range = (dx * uy - dy * ux) / cross;
            let along = (dx * s - dy * c) / cross;
            if range > 0.0 && (0.0..=1.0).contains(&along) && range < nearest {
                nearest = range;
            }
        }
        nearest
    }

    pub(crate) fn scan(
        &self,
        pose: Pose2,
        robot: &Robot,
        time_ns: i64,
        stream: &mut Stream,
    ) -> LaserScan2 {
        let step = robot.field_rad / (robot.beams - 1).max(1) as f64;
        let start = -0.5 * robot.field_rad;
        let near = self.around(pose, robot.range_max_m);
        let ranges = (0..robot.beams).map(|beam| {
            let range = near.range(pose.x_m, pose.y_m, pose.yaw_rad + start + beam as f64 * step);
            let noisy = range + robot.range_sigma_m * stream.normal();
            if range < robot.range_max_m { noisy as f32 } else { f32::INFINITY }
        });
        LaserScan2 {
            time_ns,
            mounting: ScannerMounting::upright(Pose2::IDENTITY),
            angle_min_rad: start,
            angle_increment_rad: step,
            time_increment_s: 0.0,
            range_min_m: 0.05,
            range_max_m: robot.range_max_m as f32,
            ranges_m: ranges.collect(),
        }
    }

    /// Drives from corner to corner, a scan every `step_m`, and every 20 degrees of a turn.
    pub(crate) fn drive(
        &self,
        corners: &[(f64, f64)],
        step_m: f64,
        robot: &Robot,
        seed: u64,
    ) -> Vec<Moment> {
        let mut moments = Vec::new();
        self.follow(corners, step_m, robot, seed, &mut |moment| moments.push(moment));
        moments
    }

    /// The same, moment by moment: long drives do not fit into memory.
    pub(crate) fn follow(
        &self,
        corners: &[(f64, f64)],
        step_m: f64,
        robot: &Robot,
        seed: u64,
        take: &mut dyn FnMut(Moment),
    ) {
        let mut stream = Stream::keyed(seed, "drive", 0);
        let poses = poses_along(corners, step_m, &mut stream);
        let mut odometry_monitor = OdometryMonitor::new(poses[0]);
        for (index, &truth) in poses.iter().enumerate() {
            let odometry = odometry_monitor.roll_to(truth, robot, 1.0, &mut stream);
            let scan = self.scan(truth, robot, index as i64 * 500_000_000, &mut stream);
            take(Moment { truth, odometry, scan });
        }
    }
}

/// Poses along the corners, one every `step_m`, and every 20 degrees of a rotation.
pub(crate) fn poses_along(corners: &[(f64, f64)], step_m: f64, stream: &mut Stream) -> Vec<Pose2> {
    let mut poses: Vec<Pose2> = Vec::new();
    let mut yaw = 0.0;
    for pair in corners.windows(2) {
        let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let (length, heading) = (libm::hypot(dx, dy), libm::atan2(dy, dx));
        if poses.is_empty() {
            yaw = heading;
        }
        let turn = normalize_angle(heading - yaw);
        let turns = (turn.abs() / 0.35).ceil() as usize;
        for step in 1..turns {
            let part = step as f64 / turns as f64;
            poses.push(Pose2::new(pair[0].0, pair[0].1, yaw + part * turn));
        }
        yaw = heading;
        let steps = (length / step_m).round().max(1.0) as usize;
        for step in 0..steps {
            let part = step as f64 / steps as f64;
            // A little off the middle.
            let aside = 0.1 * libm::sin(0.7 * part * length);
            let (s, c) = libm::sincos(heading);
            poses.push(Pose2::new(
                pair[0].0 + part * dx - aside * s,
                pair[0].1 + part * dy + aside * c,
                yaw + 0.05 * stream.normal(),
            ));
        }
    }
    poses
}

/// Wheels that are counted.
pub(crate) struct OdometryMonitor {
    odometry: Pose2,
    last: Pose2,
}

impl OdometryMonitor {
    pub(crate) fn new(start: Pose2) -> Self {
        Self { odometry: start, last: start }
    }

    /// Odometry pose after this motion; odometry reports the distance times a factor.
    pub(crate) fn roll_to(
        &mut self,
        truth: Pose2,
        robot: &Robot,
        scale: f64,
        stream: &mut Stream,
    ) -> Pose2 {
        let step = self.last.inverse() * truth;
        let way = libm::hypot(step.x_m, step.y_m);
        let turn = normalize_angle(step.yaw_rad);
        let noisy = Pose2::new(
            scale * step.x_m * (1.0 + robot.way_error * stream.normal()),
            step.y_m + robot.way_error * way * stream.normal(),
            turn * (1.0 + robot.turn_error * stream.normal())
                + robot.bias_rad_per_m * way
                + 0.3 * robot.turn_error * way * stream.normal(),
        );
        self.odometry = (self.odometry * noisy).normalized();
        self.last = truth;
        self.odometry
    }
}
