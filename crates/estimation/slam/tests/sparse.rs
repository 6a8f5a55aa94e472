//! Logs with few beams: doubled walls of different passes are joined, or there is a warning.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files")]

#[path = "../examples/logs/perturb.rs"]
#[allow(dead_code, reason = "one perturbation of many")]
mod perturb;

use periplus_geometry::LaserScan2;
use std::fs;
use std::path::Path;

use periplus_bags::{CarmenScan, read_carmen};
use periplus_slam::{Remark, Settings, Slam, Stamped, read_relations, score};
use perturb::perturbed;

/// Maps a log with every fourth beam: its loops are right.
fn check(name: &str) {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/datasets").join(name);
    let Ok(text) = fs::read(folder.join("raw.clf")) else {
        eprintln!("SKIPPED: there is no ../shared/datasets/{name} to map");
        return;
    };
    let relations = fs::read_to_string(folder.join("agreement.relations")).unwrap();
    let log = read_carmen(&text);
    let mut slam = Slam::new(Settings::default());
    for scan in &perturbed(&log, "thin4").scans {
        let _ = slam.add_scan(&LaserScan2::from(scan.clone()), scan.odom_from_base);
    }
    slam.finish();
    let stamps = log.scans.iter().map(|it| it.time_s);
    let found: Vec<Stamped> =
        stamps.zip(slam.trajectory()).map(|(time_s, (_, pose))| (time_s, pose)).collect();
    let told = |it: &CarmenScan| Some((it.time_s, it.odom_from_base?));
    let scans: Vec<Stamped> = log.scans.iter().filter_map(told).collect();
    let between: Vec<Stamped> =
        log.odometry.iter().map(|it| (it.time_s, it.odom_from_base)).collect();
    let loops_m =
        score(&found, &scans, &between, &read_relations(&relations).unwrap()).loops.mean_m;
    let is_told = slam.remarks().iter().any(Remark::is_warning);
    assert!(loops_m < 0.12, "{name}: {loops_m} m, told: {is_told}");
}

/// 45 beams find few partners among eight scans, and fewer than 600 points are seen from both passes.
#[test]
fn corridors_by_45_beams_close() {
    check("aces");
}
