//! Calibrations of logs of real robots: the first half and the odometry of the second predict the errors of the second.
//! Skipped with a message where the logs are missing. `cargo test --release -p periplus-calibration --test real_logs --
//! --ignored --nocapture` prints all figures.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "the logs are beside the repository")]

use std::path::Path;

use periplus_bags::read_carmen;
use periplus_calibration::{
    DifferentialDrive, Estimated, RelativeError, WheelTrack, lidar_noise, match_scans,
    predict_second_half, range_bias,
};
use periplus_geometry::{LaserScan2, Pose2};

/// Odometry becomes the wheels of this drive, so that radii and distance are factors of the log's own.
const NOMINAL: DifferentialDrive =
    DifferentialDrive { left_radius_m: 1.0, right_radius_m: 1.0, wheel_distance_m: 1.0 };

/// Maximum difference of the errors of the second half to their prediction, relative to it.
const MAX_DIFFERENCE_RATIO: f64 = 0.2;

fn read(log: &str) -> Option<(WheelTrack, Vec<LaserScan2>)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/datasets").join(log);
    let Ok(bytes) = std::fs::read(&path) else {
        eprintln!("SKIPPED: no {}", path.display());
        return None;
    };
    let log = read_carmen(&bytes);
    let poses: Vec<(f64, Pose2)> =
        log.scans.iter().filter_map(|it| Some((it.time_s, it.odom_from_base?))).collect();
    let (_, scans) = log.scans_of_first_kind();
    let mut scans: Vec<LaserScan2> = scans.into_iter().map(LaserScan2::from).collect();
    scans.sort_by_key(|it| it.time_ns);
    Some((WheelTrack::from_odometry(poses, &NOMINAL), scans))
}

/// Errors of the second half, predicted and measured.
fn halves(log: &str) -> Option<Vec<(RelativeError, RelativeError)>> {
    let (track, scans) = read(log)?;
    let start = |from_s: f64, to_s: f64| track.motion(&NOMINAL, from_s, to_s);
    let displacements = match_scans(&scans, 0.4, start);
    let half = match predict_second_half(&track, &scans, &displacements, &NOMINAL, 0.5) {
        Ok(half) => half,
        Err(why) => {
            eprintln!("{log}: {why}");
            return Some(Vec::new());
        }
    };
    eprintln!("{log}: {:?} delay {:?}", half.calibration.drive(), half.calibration.delay_s);
    eprintln!("  {:?}", half.model.coefficients);
    let bias = lidar_noise(&scans).map(|it| (it.std_m, range_bias(&scans, &it)));
    eprintln!("  range noise and bias {bias:?}");
    let (expected, measured) = (half.predicted, half.measured);
    for (expected, measured) in expected.iter().zip(&measured) {
        let length_m = expected.length_m;
        let print = |name: &str, unit: &str, measured: Estimated, expected: Estimated| {
            eprintln!(
                "  {:4} m {name:11} {:.4} {unit}, predicted {:.4} ± {:.4}: {:+.0} %",
                length_m,
                measured.value,
                expected.value,
                expected.standard_error,
                100.0 * (measured.value / expected.value - 1.0),
            );
        };
        print("trimmed rms", "m", measured.trimmed_rms_m, expected.trimmed_rms_m);
        print("trimmed rms", "rad", measured.trimmed_rms_rad, expected.trimmed_rms_rad);
        print("rms", "m", measured.rms_m, expected.rms_m);
        print("rms", "rad", measured.rms_rad, expected.rms_rad);
    }
    Some(expected.into_iter().zip(measured).collect())
}

fn check(log: &str, has_trimmed: bool, has_all: bool) {
    let Some(halves) = halves(log) else { return };
    assert!(!halves.is_empty(), "{log}");
    for (expected, measured) in halves {
        let trimmed = [
            (expected.trimmed_rms_m, measured.trimmed_rms_m),
            (expected.trimmed_rms_rad, measured.trimmed_rms_rad),
        ];
        let all = [(expected.rms_m, measured.rms_m), (expected.rms_rad, measured.rms_rad)];
        let trimmed = trimmed.into_iter().filter(|_| has_trimmed);
        for (expected, measured) in trimmed.chain(all.into_iter().filter(|_| has_all)) {
            let ratio = measured.value / expected.value;
            assert!((ratio - 1.0).abs() < MAX_DIFFERENCE_RATIO, "{log}: {measured:?} {expected:?}");
        }
    }
}

#[test]
#[ignore = "SLAM of a whole log: a minute in a release build"]
fn intel() {
    check("intel-full/raw.clf", true, true);
}

/// Over 1 m, 1 % of the errors has half of the squares in the first half.
#[test]
#[ignore = "SLAM of a whole log: a minute in a release build"]
fn csail() {
    check("csail-full/raw.clf", true, false);
}

/// Over 5 m, the trimmed error of the position is 20 % below the prediction, with a standard error of 18 %.
#[test]
#[ignore = "SLAM of a whole log: a minute in a release build"]
fn aces() {
    check("aces-full/raw.clf", false, true);
}

/// The other logs, most of them with few scans: their figures without a limit.
#[test]
#[ignore = "SLAM of whole logs: a minute in a release build"]
fn others() {
    for log in [
        "intel",
        "aces",
        "edmonton",
        "fr101",
        "seattle",
        "hospital",
        "car",
        "broken-odometry",
        "ydlidar",
    ] {
        halves(&format!("{log}/raw.clf"));
    }
}
