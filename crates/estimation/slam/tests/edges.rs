//! The reported edges are those of the graph.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files")]

mod worlds;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use periplus_bags::{CarmenScan, read_carmen};
use periplus_geometry::{LaserScan2, Pose2};
use periplus_slam::{ConstraintKind, Settings, Slam};
use worlds::{ROBOT, World};

/// Edges of a graph as g2o reads it, by the scans that they tie.
fn written(slam: &Slam) -> Vec<(usize, usize)> {
    let text = slam.to_g2o();
    let edges = text.lines().filter_map(|line| line.strip_prefix("EDGE_SE2 "));
    let mut keyframes: Vec<(usize, usize)> = edges
        .map(|line| {
            let mut words = line.split(' ').map(|word| word.parse::<usize>().unwrap_or_default());
            (words.next().unwrap(), words.next().unwrap())
        })
        .collect();
    keyframes.sort_unstable();
    keyframes
}

/// The reported edges are those of the graph; closures reported as accepted are among them, each with a
/// small residual where the map is right.
fn check(slam: &Slam, name: &str) {
    let mut told: Vec<(usize, usize)> = slam.edges().map(|edge| edge.keyframes).collect();
    told.sort_unstable();
    assert_eq!(told, written(slam), "{name}");
    let in_graph: BTreeSet<(usize, usize)> = slam
        .edges()
        .filter(|edge| edge.link == ConstraintKind::LoopClosure)
        .map(|edge| edge.keyframes)
        .collect();
    let accepted: BTreeSet<(usize, usize)> =
        slam.closures().iter().filter(|it| it.is_accepted).map(|it| it.keyframes).collect();
    assert_eq!(accepted, in_graph, "{name}");
}

#[test]
fn the_edges_of_a_ring_are_told() {
    let world = World::ring(16.0, 10.0, 2.4, 1);
    let corners = [(6.0, 0.0), (16.0, 0.0), (16.0, 10.0), (0.0, 10.0), (0.0, 0.0), (16.0, 0.0)];
    let mut slam = Slam::new(Settings::default());
    for moment in world.drive(&corners, 0.3, &ROBOT, 1) {
        let _ = slam.add_scan(&moment.scan, Some(moment.odometry));
    }
    slam.finish();
    check(&slam, "ring");
    let closures: Vec<_> =
        slam.edges().filter(|edge| edge.link != ConstraintKind::Sequential).collect();
    assert!(!closures.is_empty());
    assert!(closures.iter().all(|edge| edge.residual_m < 0.1), "{closures:?}");
}

/// Longer logs are reduced to one scan per motion and to this number of scans; `cargo xtask bench slam`
/// compares report and graph for the whole logs.
const MAX_SCANS: usize = 450;
const SHIFT_M: f64 = 0.5;
const TURN_RAD: f64 = 0.5;

/// A log, short enough for a test.
fn shortened(scans: Vec<CarmenScan>) -> Vec<CarmenScan> {
    if scans.len() <= MAX_SCANS {
        return scans;
    }
    let mut last: Option<Pose2> = None;
    let is_far = |scan: &CarmenScan| {
        let Some(odometry) = scan.odom_from_base else { return true };
        let is_far = last.is_none_or(|last| {
            let step = (last.inverse() * odometry).normalized();
            libm::hypot(step.x_m, step.y_m) >= SHIFT_M || step.yaw_rad.abs() >= TURN_RAD
        });
        if is_far {
            last = Some(odometry);
        }
        is_far
    };
    scans.into_iter().filter(is_far).take(MAX_SCANS).collect()
}

#[test]
fn the_edges_of_all_real_logs_are_told() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/datasets");
    let Ok(entries) = fs::read_dir(&folder) else {
        eprintln!("SKIPPED: the laser logs are not beside the project ({})", folder.display());
        return;
    };
    let mut logs: Vec<PathBuf> = entries.map(|it| it.unwrap().path()).collect();
    logs.retain(|it| it.join("raw.clf").is_file());
    logs.sort();
    assert!(!logs.is_empty(), "no log in {}", folder.display());
    let (next, proximity) = (AtomicUsize::new(0), AtomicUsize::new(0));
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some(log) = logs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let text = fs::read(log.join("raw.clf")).unwrap();
                    let mut slam = Slam::new(Settings::default());
                    for scan in &shortened(read_carmen(&text).scans) {
                        let _ = slam.add_scan(&LaserScan2::from(scan.clone()), scan.odom_from_base);
                    }
                    slam.finish();
                    check(&slam, &log.display().to_string());
                    let returns =
                        slam.edges().filter(|edge| edge.link != ConstraintKind::Sequential);
                    proximity.fetch_add(returns.count(), Ordering::Relaxed);
                }
            });
        }
    });
    // Most logs come back to where they were.
    assert!(proximity.into_inner() > 10 * logs.len());
}
