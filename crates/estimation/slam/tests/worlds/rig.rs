//! A robot in a scene: a scanner at a height, which tilts with the floor, and wheels.

use periplus_geometry::{LaserScan2, Pose2, ScannerMounting, Stream};

use super::solid::{Scene, Surface};
use super::{Moment, OdometryMonitor, ROBOT, Robot, poses_along};

/// Properties of the robot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rig {
    /// Beams, field, range and wheels.
    pub(crate) robot: Robot,
    /// Height of the scanner above the floor \[m\].
    pub(crate) height_m: f64,
    /// Standard deviation of pitch and roll on level floor \[rad\].
    pub(crate) bounce_rad: f64,
    /// Noise of a reading beside that of the robot, as a part of the range.
    pub(crate) range_part: f64,
    /// Part of the readings that are lost.
    pub(crate) lost: f64,
    /// Standard deviation of the beam angle \[rad\].
    pub(crate) jitter_rad: f64,
    /// Gaps of 4 degrees in each scan.
    pub(crate) gaps: usize,
    /// Ratio of the distance by odometry to the true distance.
    pub(crate) way_scale: f64,
    /// From scan to scan \[m\].
    pub(crate) step_m: f64,
}

pub(crate) const RIG: Rig = Rig {
    robot: ROBOT,
    height_m: 0.3,
    bounce_rad: 0.0,
    range_part: 0.0,
    lost: 0.0,
    jitter_rad: 0.0,
    gaps: 0,
    way_scale: 1.0,
    step_m: 0.5,
};

/// From scan to scan \[s\].
pub(crate) const PERIOD_S: f64 = 0.5;
/// From the middle of the robot to where its wheels stand \[m\].
const WHEELS_M: f64 = 0.3;
const GAP_RAD: f64 = 0.07;

impl Rig {
    /// With wheels as good robots have them, or bad ones.
    pub(crate) fn with_wheels(self, is_bad: bool) -> Self {
        let robot = if is_bad {
            Robot { way_error: 0.12, turn_error: 0.15, bias_rad_per_m: 0.02, ..self.robot }
        } else {
            Robot { way_error: 0.05, turn_error: 0.08, bias_rad_per_m: 0.004, ..self.robot }
        };
        Self { robot, way_scale: if is_bad { 1.03 } else { 1.0 }, ..self }
    }

    /// A scanner with this field of view in degrees, beams half a degree apart, and this range.
    pub(crate) fn with_scanner(self, degrees: usize, range_max_m: f64) -> Self {
        let beams = 2 * degrees + usize::from(degrees < 360);
        let field_rad = (beams - 1) as f64 * 0.5_f64.to_radians();
        Self { robot: Robot { beams, field_rad, range_max_m, ..self.robot }, ..self }
    }

    /// All around at a degree, out of true, with readings lost one by one and in gaps.
    pub(crate) fn low_cost(self) -> Self {
        let field_rad = 359.0_f64.to_radians();
        let robot = Robot { beams: 360, field_rad, range_max_m: 8.0, ..self.robot };
        let jitter_rad = 0.3_f64.to_radians();
        Self { robot, range_part: 0.01, lost: 0.1, jitter_rad, gaps: 4, ..self }
    }

    /// Returns the scan from a pose.
    pub(crate) fn scan(
        &self,
        scene: &Scene,
        truth: Pose2,
        time_s: f64,
        stream: &mut Stream,
    ) -> LaserScan2 {
        let robot = &self.robot;
        let near = scene.around(time_s, truth, robot.range_max_m);
        let height = |forward: f64, left: f64| {
            let (x, y) = truth.transform_point(forward, left);
            scene.height_m(x, y)
        };
        let (front, rear) = (height(WHEELS_M, 0.0), height(-WHEELS_M, 0.0));
        let (left, right) = (height(0.0, WHEELS_M), height(0.0, -WHEELS_M));
        let mut slope = [(front - rear) / (2.0 * WHEELS_M), (left - right) / (2.0 * WHEELS_M)];
        if self.bounce_rad > 0.0 {
            slope = slope.map(|it| it + self.bounce_rad * stream.normal());
        }
        let from = [truth.x_m, truth.y_m, 0.5 * (front + rear) + self.height_m];
        let long = slope.map(|it| libm::hypot(1.0, it));
        let gaps: Vec<f64> = (0..self.gaps).map(|_| robot.field_rad * stream.unit()).collect();
        let step = robot.field_rad / (robot.beams - 1).max(1) as f64;
        let start = -0.5 * robot.field_rad;
        let mut range = |beam: usize| {
            let turn = beam as f64 * step;
            let mut angle = start + turn;
            if self.jitter_rad > 0.0 {
                angle += self.jitter_rad * stream.normal();
            }
            let is_lost = (self.lost > 0.0 && stream.unit() < self.lost)
                || gaps.iter().any(|gap| (gap - turn).abs() < 0.5 * GAP_RAD);
            let noise = stream.normal();
            // Along and across the robot, on its slope.
            let (s, c) = libm::sincos(angle);
            let (ahead, aside) = (c / long[0], s / long[1]);
            let (sy, cy) = libm::sincos(truth.yaw_rad);
            let to = [
                ahead * cy - aside * sy,
                ahead * sy + aside * cy,
                ahead * slope[0] + aside * slope[1],
            ];
            let hit = near.cast(from, to).filter(|_| !is_lost);
            let range = hit.map_or(f64::INFINITY, |hit| {
                let rough = if let Surface::Rough(sigma_m) = hit.surface { sigma_m } else { 0.0 };
                let sigma = robot.range_sigma_m + self.range_part * hit.range_m + rough;
                hit.range_m + sigma * noise
            });
            if range < robot.range_max_m { range as f32 } else { f32::INFINITY }
        };
        let ranges_m = (0..robot.beams).map(&mut range).collect();
        LaserScan2 {
            time_ns: (time_s * 1e9) as i64,
            mounting: ScannerMounting::upright(Pose2::IDENTITY),
            angle_min_rad: start,
            angle_increment_rad: step,
            time_increment_s: 0.0,
            range_min_m: 0.05,
            range_max_m: robot.range_max_m as f32,
            ranges_m,
        }
    }

    /// Drives from corner to corner.
    pub(crate) fn drive(&self, scene: Scene, corners: &[(f64, f64)], seed: u64) -> Vec<Moment> {
        let mut stream = Stream::keyed(seed, "drive", 0);
        let poses = poses_along(corners, self.step_m, &mut stream);
        let scene = scene.cleared(&poses);
        let mut odometry_monitor = OdometryMonitor::new(poses[0]);
        let mut moments = Vec::with_capacity(poses.len());
        for (index, &truth) in poses.iter().enumerate() {
            let odometry =
                odometry_monitor.roll_to(truth, &self.robot, self.way_scale, &mut stream);
            let scan = self.scan(&scene, truth, index as f64 * PERIOD_S, &mut stream);
            moments.push(Moment { truth, odometry, scan });
        }
        moments
    }
}
