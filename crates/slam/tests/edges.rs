//! What is told of edges is what is in the graph, and nothing else.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files")]

mod carmen;
mod worlds;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use carmen::scan_of;
use periplus_bags::read_carmen;
use periplus_slam::{Link, Settings, Slam};
use worlds::{ROBOT, World};

/// Edges of a graph as g2o reads it, by the scans that they tie.
fn written(slam: &Slam) -> Vec<(usize, usize)> {
    let text = slam.to_g2o();
    let edges = text.lines().filter_map(|line| line.strip_prefix("EDGE_SE2 "));
    let mut keys: Vec<(usize, usize)> = edges
        .map(|line| {
            let mut words = line.split(' ').map(|word| word.parse::<usize>().unwrap_or_default());
            (words.next().unwrap(), words.next().unwrap())
        })
        .collect();
    keys.sort_unstable();
    keys
}

/// The edges that are told are those of the graph; and closures that are told as accepted are those among
/// them, each with a residual that is small where the map is right.
fn check(slam: &Slam, name: &str) {
    let mut told: Vec<(usize, usize)> = slam.edges().map(|edge| edge.keys).collect();
    told.sort_unstable();
    assert_eq!(told, written(slam), "{name}");
    let in_graph: BTreeSet<(usize, usize)> =
        slam.edges().filter(|edge| edge.link == Link::Closure).map(|edge| edge.keys).collect();
    let accepted: BTreeSet<(usize, usize)> =
        slam.closures().iter().filter(|it| it.is_accepted).map(|it| it.keys).collect();
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
    let closures: Vec<_> = slam.edges().filter(|edge| edge.link != Link::Chain).collect();
    assert!(!closures.is_empty());
    assert!(closures.iter().all(|edge| edge.residual_m < 0.1), "{closures:?}");
}

#[test]
fn the_edges_of_real_logs_are_told() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/datasets");
    if !folder.is_dir() {
        eprintln!("SKIPPED: the laser logs are not beside the project");
        return;
    }
    for name in ["aces", "edmonton", "fr101", "seattle"] {
        let Ok(text) = fs::read(folder.join(name).join("raw.clf")) else {
            eprintln!("SKIPPED: there is no log {name}");
            continue;
        };
        let mut slam = Slam::new(Settings::default());
        for scan in &read_carmen(&text).scans {
            let _ = slam.add_scan(&scan_of(scan), scan.odom_from_base);
        }
        slam.finish();
        check(&slam, name);
    }
}
