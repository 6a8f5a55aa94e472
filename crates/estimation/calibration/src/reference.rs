//! Poses of a calibrated robot by its odometry and by SLAM.

use std::collections::BTreeMap;

use periplus_geometry::{LaserScan2, Pose2, ScannerMounting};
use periplus_slam::{Settings, Slam};

use crate::drive::{CalibrationError, DriveCalibration, recalibrate};
use crate::scans::ScannerDisplacement;
use crate::segments::ReferencedOdometry;
use crate::wheels::WheelTrack;

/// Number of displacements into which a path is divided, and the limits of their length \[m\]. Errors of a match do
/// not add up over a metre, and those of the heading hardly do.
const DISPLACEMENT_COUNT: f64 = 100.0;
const MIN_DISPLACEMENT_M: f64 = 0.05;
const MAX_DISPLACEMENT_M: f64 = 1.0;

/// Standard deviations of a displacement of SLAM, up to a common factor: x and y \[m\], yaw \[rad\].
const POSITION_STD_M: f64 = 0.02;
const HEADING_STD_RAD: f64 = 0.01;

/// Repeats a calibration with displacements of SLAM in place of those of successive scans: in corridors a match of two
/// scans is drawn to its start, while SLAM sees the ends of the corridor in other scans. The delay is kept, since
/// its effect on long displacements is small.
///
/// # Errors
/// When the displacements do not determine the other parameters.
pub fn refine_with_slam(
    found: &DriveCalibration,
    track: &WheelTrack,
    scans: &[LaserScan2],
) -> Result<DriveCalibration, CalibrationError> {
    let pairs = slam_poses(found, track, scans);
    let step = |it: &[ReferencedOdometry]| {
        let step = it[0].odom_from_base.inverse() * it[1].odom_from_base;
        libm::hypot(step.x_m, step.y_m)
    };
    let steps: Vec<f64> = pairs.windows(2).map(step).collect();
    let min_m = (steps.iter().sum::<f64>() / DISPLACEMENT_COUNT)
        .clamp(MIN_DISPLACEMENT_M, MAX_DISPLACEMENT_M);
    let [position, heading] = [POSITION_STD_M, HEADING_STD_RAD].map(|it| 1.0 / (it * it));
    let information = [[position, 0.0, 0.0], [0.0, position, 0.0], [0.0, 0.0, heading]];
    let mut displacements = Vec::new();
    let (mut from, mut length_m) = (0, 0.0);
    for (index, step_m) in steps.iter().enumerate() {
        length_m += step_m;
        if length_m >= min_m {
            let (first, last) = (pairs[from], pairs[index + 1]);
            let scanner = |it: ReferencedOdometry| it.map_from_base * found.base_from_scanner();
            displacements.push(ScannerDisplacement {
                from_s: first.stamp_s,
                to_s: last.stamp_s,
                from_from_to: (scanner(first).inverse() * scanner(last)).normalized(),
                information,
            });
            (from, length_m) = (index + 1, 0.0);
        }
    }
    recalibrate(track, &displacements, found)
}

/// Returns the poses of the point between the wheels at the stamps of scans by the calibrated wheels, from the first
/// that the wheels' track covers; none for the others and for stamps that are not in order.
#[must_use]
pub fn odometry_poses(
    found: &DriveCalibration,
    track: &WheelTrack,
    scans: &[LaserScan2],
) -> Vec<Option<Pose2>> {
    let drive = found.drive();
    let mut last: Option<(f64, Pose2)> = None;
    let pose = |scan: &LaserScan2| {
        let stamp_s = scan.time_ns as f64 * 1e-9 - found.delay_s.value;
        let pose = match last {
            Some((last_s, _)) if stamp_s <= last_s => return None,
            Some((last_s, pose)) => pose * track.motion(&drive, last_s, stamp_s)?,
            None => track.angles_at(stamp_s).map(|_| Pose2::IDENTITY)?,
        };
        last = Some((stamp_s, pose));
        Some(pose)
    };
    scans.iter().map(pose).collect()
}

/// Returns the poses of the point between the wheels at the stamps of scans, by the calibrated wheels and by
/// graph SLAM with its default parameters and the calibrated mount. Scans that the wheels' track does not cover or
/// that SLAM rejects are left out.
///
/// SLAM uses the odometry as a prior: in corridors without features, where only odometry measures the distance,
/// both agree.
#[must_use]
pub fn slam_poses(
    found: &DriveCalibration,
    track: &WheelTrack,
    scans: &[LaserScan2],
) -> Vec<ReferencedOdometry> {
    let mut slam = Slam::new(Settings::default());
    let mut odometry = BTreeMap::new();
    for (scan, pose) in scans.iter().zip(odometry_poses(found, track, scans)) {
        let Some(odom_from_base) = pose else { continue };
        let mounting =
            ScannerMounting { base_from_scanner: found.base_from_scanner(), ..scan.mounting };
        slam.add_scan(&LaserScan2 { mounting, ..scan.clone() }, Some(odom_from_base));
        odometry.insert(scan.time_ns, odom_from_base);
    }
    slam.finish();
    let pair = |(time_ns, map_from_base): (i64, Pose2)| {
        let odom_from_base = *odometry.get(&time_ns)?;
        Some(ReferencedOdometry { stamp_s: time_ns as f64 * 1e-9, odom_from_base, map_from_base })
    };
    slam.trajectory().into_iter().filter_map(pair).collect()
}
