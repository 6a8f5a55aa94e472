//! `periplus navigate` with a map whose frame is not that of the world.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

mod common;

use std::path::Path;
use std::process::Command;

use common::Folder;
use serde_json::Value;

/// Runs `navigate` in the demo room with `sam_bot`, and returns its report.
fn navigate(arguments: &[&str]) -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let done = Command::new(env!("CARGO_BIN_EXE_periplus"))
        .arg("navigate")
        .arg(root.join("worlds/demo_room.sdf"))
        .arg("--robot")
        .arg(root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro"))
        .args(["--pose=0,0.8,0.5", "--timeout=60", "--json", "--quiet"])
        .args(arguments)
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    serde_json::from_slice(&done.stdout).unwrap()
}

/// Regression test: on a map that SLAM had begun elsewhere than at the origin of the world, AMCL started at the
/// pose in the world.
#[test]
fn a_map_of_slam_begins_where_the_robot_stood() {
    let folder = Folder::new("navigate-map");
    let out = folder.path("map");
    navigate(&["--goal=0.6,1.128,0.5", "--slam-out", out.to_str().unwrap()]);
    let map = folder.path("map/map.yaml");
    let map = map.to_str().unwrap();
    let report = navigate(&["--map", map, "--initial-pose=0,0,0", "--goal=0.7,0,0"]);
    assert_eq!(report["goals"][0]["is_reached"], true);
    let at = |index: usize| report["truth"]["end_pose"][index].as_f64().unwrap();
    // 0.7 m along a heading of 0.5 rad from (0, 0.8), within the tolerance of the goal and of AMCL.
    let (dx_m, dy_m) = (at(0) - 0.7 * 0.5_f64.cos(), at(1) - 0.8 - 0.7 * 0.5_f64.sin());
    assert!(dx_m.hypot(dy_m) < 0.4, "{report}");
}
