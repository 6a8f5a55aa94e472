//! Perturbed copies of a log: what loggers, drivers and mountings do to data.

use periplus_bags::{CarmenLog, CarmenScan};
use periplus_geometry::{Pose2, Stream, normalize_angle};

/// The kinds of perturbation, the log as it is first.
pub(crate) const RUNS: [&str; 27] = [
    "plain", "rotate", "drop", "thin", "jitter", "scale", "awful", "zero", "blind", "kidnap1",
    "kidnap2", "kidnap3", "cut1", "cut2", "cut3", "thin4", "third", "gaps", "flipped", "turned90",
    "swapped", "reversed", "spurious", "x0.9", "x1.1", "heading", "reset",
];

/// A log and the stamp of each scan in the log as it was \[s\].
pub(crate) struct Copy {
    pub(crate) scans: Vec<CarmenScan>,
    pub(crate) stamps: Vec<f64>,
}

impl Copy {
    /// Time to the nearest scan \[s\].
    pub(crate) fn beside_s(&self, time_s: f64) -> f64 {
        let distances = self.stamps.iter().map(|it| (it - time_s).abs());
        distances.fold(f64::INFINITY, f64::min)
    }
}

/// A copy, perturbed; the first five as `perturb.py` does it.
pub(crate) fn perturbed(log: &CarmenLog, how: &str) -> Copy {
    let mut scans = log.scans.clone();
    let stamps: Vec<f64> = scans.iter().map(|it| it.time_s).collect();
    let keep = kept(&scans, how);
    let mut stream = Stream::keyed(0, "perturbed", 0);
    for scan in &mut scans {
        spoil(scan, how, &mut stream);
    }
    drive(&mut scans, &keep, how, &mut stream);
    let is_kept = |index: &usize| keep[*index];
    Copy {
        stamps: (0..scans.len()).filter(is_kept).map(|it| stamps[it]).collect(),
        scans: (0..scans.len()).filter(is_kept).map(|it| scans[it].clone()).collect(),
    }
}

/// Scans that are left.
fn kept(scans: &[CarmenScan], how: &str) -> Vec<bool> {
    let count = scans.len();
    let begin_s = scans.first().map_or(0.0, |it| it.time_s);
    let is_kept = |index: usize| match how {
        "drop" => !(index + 1).is_multiple_of(10),
        "third" => index.is_multiple_of(3),
        "kidnap1" | "cut1" => !(count / 5..2 * count / 5).contains(&index),
        "kidnap2" | "cut2" => !(2 * count / 5..3 * count / 5).contains(&index),
        "kidnap3" | "cut3" => !(3 * count / 5..4 * count / 5).contains(&index),
        // Half a minute in every three.
        "gaps" => (scans[index].time_s - begin_s) % 180.0 < 150.0,
        _ => true,
    };
    (0..count).map(is_kept).collect()
}

/// Perturbs a scan and its odometry.
fn spoil(scan: &mut CarmenScan, how: &str, stream: &mut Stream) {
    let odometry = scan.odom_from_base;
    match how {
        "rotate" => {
            let turn = Pose2::new(0.0, 0.0, 1.0);
            scan.odom_from_base = odometry.map(|it| (turn * it).normalized());
        }
        "thin" | "thin4" => {
            let every = if how == "thin" { 2 } else { 4 };
            scan.ranges_m = scan.ranges_m.iter().copied().step_by(every).collect();
            scan.angle_increment_rad *= every as f64;
        }
        "jitter" => scan.time_s += 0.02 * (stream.unit() - 0.5),
        "zero" => scan.odom_from_base = odometry.map(|_| Pose2::IDENTITY),
        "blind" => scan.odom_from_base = None,
        "flipped" => scan.ranges_m.reverse(),
        "turned90" => scan.angle_min_rad += std::f64::consts::FRAC_PI_2,
        "swapped" => {
            scan.odom_from_base = odometry.map(|it| Pose2::new(it.y_m, it.x_m, it.yaw_rad));
        }
        "spurious" => {
            for range in &mut scan.ranges_m {
                if stream.unit() < 0.05 {
                    *range = (stream.unit() * 0.9 * f64::from(scan.range_max_m)) as f32;
                }
            }
        }
        _ => {}
    }
}

/// Spoils the steps of odometry.
fn drive(scans: &mut [CarmenScan], keep: &[bool], how: &str, stream: &mut Stream) {
    let is_of_steps = ["scale", "awful", "reversed", "x0.9", "x1.1", "heading", "reset"]
        .contains(&how)
        || how.starts_with("kidnap");
    if !is_of_steps {
        return;
    }
    let mut last: Option<Pose2> = None;
    let mut pose = Pose2::IDENTITY;
    let middle = scans.len() / 2;
    for (index, scan) in scans.iter_mut().enumerate() {
        let Some(now) = scan.odom_from_base else { continue };
        let Some(before) = last.replace(now) else {
            pose = now;
            continue;
        };
        let step = (before.inverse() * now).normalized();
        let way_m = libm::hypot(step.x_m, step.y_m);
        let (mut times, mut turn) = (1.0, normalize_angle(step.yaw_rad));
        match how {
            "scale" => times = 1.03,
            "x0.9" => times = 0.9,
            "x1.1" => times = 1.1,
            "heading" => turn += 2f64.to_radians() * way_m * stream.normal(),
            "reversed" => (times, turn) = (-1.0, -turn),
            // Wheels that slip at random, and a robot that pulls to one side.
            "awful" => {
                times = 1.03 + 0.12 * stream.normal();
                turn += 0.2 * turn * stream.normal();
                turn += way_m * (0.03 + 0.05 * stream.normal());
            }
            // Carried, so that wheels do not turn.
            _ if how.starts_with("kidnap") && !keep[index] => (times, turn) = (0.0, 0.0),
            _ => {}
        }
        let step = Pose2::new(times * step.x_m, times * step.y_m, turn);
        pose = (pose * step).normalized();
        if how == "reset" && index == middle {
            pose = Pose2::IDENTITY;
        }
        scan.odom_from_base = Some(pose);
    }
}
