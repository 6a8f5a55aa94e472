//! Calibrations of logs of real robots: the first half predicts the errors of the second. Skipped with a message
//! where the logs are missing.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "the logs are beside the repository")]

use std::path::Path;

use periplus_calibration::{
    DifferentialDrive, OdometryErrorModel, RmsError, WheelSample, WheelTrack, calibrate_drive,
    match_scans,
};
use periplus_geometry::{LaserScan2, Pose2, ScannerMounting};

/// Odometry becomes the wheels of this drive, so that radii and distance are factors of the log's own.
const NOMINAL: DifferentialDrive =
    DifferentialDrive { left_radius_m: 1.0, right_radius_m: 1.0, wheel_distance_m: 1.0 };

/// Reads `FLASER n ranges... x y theta odom_x odom_y odom_theta t`.
fn read(text: &str) -> (WheelTrack, Vec<LaserScan2>) {
    let (mut samples, mut scans) = (Vec::new(), Vec::new());
    let (mut last, mut left_rad, mut right_rad) = (None::<Pose2>, 0.0, 0.0);
    for line in text.lines().filter(|it| it.starts_with("FLASER")) {
        let numbers: Vec<f64> =
            line.split_whitespace().skip(1).map(|it| it.parse().unwrap_or(f64::NAN)).collect();
        let count = numbers[0] as usize;
        let tail = &numbers[count + 1..];
        let (odom, stamp_s) = (Pose2::new(tail[3], tail[4], tail[5]), tail[6]);
        if let Some(last) = last.replace(odom) {
            let step = (last.inverse() * odom).normalized();
            let length_m = step.x_m.hypot(step.y_m).copysign(step.x_m);
            let (left, right) = NOMINAL.wheel_angles(length_m, step.yaw_rad);
            (left_rad, right_rad) = (left_rad + left, right_rad + right);
        }
        samples.push(WheelSample { stamp_s, left_rad, right_rad });
        scans.push(LaserScan2 {
            time_ns: (stamp_s * 1e9).round() as i64,
            mounting: ScannerMounting::upright(Pose2::IDENTITY),
            angle_min_rad: -std::f64::consts::FRAC_PI_2,
            angle_increment_rad: std::f64::consts::PI / (count - count % 2) as f64,
            time_increment_s: 0.0,
            range_min_m: 0.05,
            range_max_m: 40.0,
            ranges_m: numbers[1..=count].iter().map(|it| *it as f32).collect(),
        });
    }
    scans.sort_by_key(|it| it.time_ns);
    (WheelTrack::new(samples), scans)
}

/// Checks that the errors of the second half are within a part of the prediction from the first half.
fn check(log: &str, max_ratio: f64) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/datasets").join(log);
    let Ok(text) = std::fs::read_to_string(&path) else {
        eprintln!("SKIPPED: no {}", path.display());
        return;
    };
    let (track, scans) = read(&text);
    let start = |from_s: f64, to_s: f64| track.motion(&NOMINAL, from_s, to_s);
    let moving = |it: &periplus_calibration::ScannerDisplacement| {
        it.from_from_to.x_m.hypot(it.from_from_to.y_m) > 0.02
            || it.from_from_to.yaw_rad.abs() > 0.02
    };
    let mut displacements = match_scans(&scans, 0.8, start);
    displacements.retain(moving);
    let (first, second) = displacements.split_at(displacements.len() / 2);
    let found = calibrate_drive(&track, first, &NOMINAL, 0.5).unwrap();
    let model = OdometryErrorModel::fit(&found.errors(&track, first)).unwrap();
    let errors = found.errors(&track, second);
    let motions: Vec<Pose2> = errors.iter().map(|it| it.motion).collect();
    let (expected, measured) = (model.predict(&motions).unwrap(), RmsError::of(&errors).unwrap());
    for (expected, measured) in
        [(expected.rms_m, measured.rms_m), (expected.rms_rad, measured.rms_rad)]
    {
        assert!(
            (measured / expected - 1.0).abs() < max_ratio,
            "{log}: {measured}, predicted {expected}"
        );
    }
}

#[test]
fn aces() {
    check("aces-full/raw.clf", 0.2);
}

/// The position error of the second half is 25 % above that of the first: the robot slips more.
#[test]
fn intel() {
    check("intel-full/raw.clf", 0.3);
}

/// 219 displacements in each half, with 26 % more position error in the second.
#[test]
fn csail() {
    check("csail-full/raw.clf", 0.3);
}
