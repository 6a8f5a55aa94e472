//! A long log over sloping floors: scans of floor contradict earlier ones, and the loop closes all the same.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files")]

use std::fs;
use std::path::Path;

use periplus_bags::read_carmen;
use periplus_geometry::LaserScan2;
use periplus_slam::{RemarkKind, Settings, Slam};

/// Distance between the first and the last pose, by an exhaustive search of the last scan \[m\].
const TRUE_END_M: f64 = 2.0;

/// Correspondences that a registration reused while the pose moved by less than 2 mm and 1 mrad left the
/// robot in three components.
#[test]
fn a_loop_over_sloping_floors_closes() {
    let log =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/datasets/hospital/raw.clf");
    let Ok(text) = fs::read(log) else {
        eprintln!("SKIPPED: there is no ../shared/datasets/hospital to map");
        return;
    };
    let mut slam = Slam::new(Settings::default());
    for scan in read_carmen(&text).scans {
        let odom_from_base = scan.odom_from_base;
        let _ = slam.add_scan(&LaserScan2::from(scan), odom_from_base);
    }
    slam.finish();
    let is_torn = |kind: &RemarkKind| matches!(kind, RemarkKind::Disconnected { .. });
    let torn: Vec<_> = slam.remarks().iter().filter(|it| is_torn(&it.kind)).collect();
    let trajectory = slam.trajectory();
    let (first, last) = (trajectory[0].1, trajectory[trajectory.len() - 1].1);
    let end_m = libm::hypot(last.x_m - first.x_m, last.y_m - first.y_m);
    assert!(
        (end_m - TRUE_END_M).abs() < 0.3 && torn.is_empty(),
        "{end_m} m from its start, {torn:?}"
    );
}
