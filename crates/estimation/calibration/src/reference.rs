//! Poses of a calibrated robot by its odometry and by SLAM.

use std::collections::BTreeMap;

use periplus_geometry::{LaserScan2, Pose2, ScannerMounting};
use periplus_slam::{Settings, Slam};

use crate::drive::DriveCalibration;
use crate::segments::PosePair;
use crate::wheels::WheelTrack;

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
) -> Vec<PosePair> {
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
        Some(PosePair { stamp_s: time_ns as f64 * 1e-9, odom_from_base, map_from_base })
    };
    slam.trajectory().into_iter().filter_map(pair).collect()
}
