//! `periplus calibrate`.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

mod common;

use std::path::Path;
use std::process::{Command, Output};

use common::Folder;
use serde_json::Value;

fn periplus(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_periplus")).args(arguments).output().unwrap()
}

/// Curves to both sides, backward, and on the spot.
const DRIVE: &str = "
- {at: 0, until: 5, rate: 20, linear: 0.2, angular: 0.7}
- {at: 5, until: 10, rate: 20, linear: 0.2, angular: -0.7}
- {at: 10, until: 14, rate: 20, linear: -0.2, angular: 0.5}
- {at: 14, until: 18, rate: 20, angular: 0.8}
- {at: 18, until: 22, rate: 20, linear: 0.25, angular: -0.8}
- {at: 22}
";

/// Records a robot with wheels of 0.1 m, whose plugin has a distance of 0.4 m.
fn record(folder: &Folder, name: &str, script: &str, duration: &str) -> (String, String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let at = |path: &str| root.join(path).display().to_string();
    let path = |name: &str| folder.path(name).display().to_string();
    let (drive, bag) = (path(&format!("{name}.yaml")), path(&format!("{name}.mcap")));
    std::fs::write(&drive, script).unwrap();
    let robot = at("robots/sam_bot/urdf/sam_bot.urdf.xacro");
    let topics = "--topics=/(tf|tf_static|scan|odom|joint_states|demo/imu)$";
    let world = at("worlds/demo_room.sdf");
    let common = ["sim", &world, "--robot", &robot, "--cmd", &drive, "--pose=0,0.8,0", topics];
    let more =
        [duration, "--dynamics=kinematic", "--ros2=off", "--rtf=max", "--quiet", "--record", &bag];
    let done = periplus(&[&common[..], &more].concat());
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    (bag, robot)
}

/// The nominal radius is 4 % too small; wheels, scanner and delay are those of the simulation.
#[test]
fn wheels_of_a_simulated_robot_are_recovered() {
    let folder = Folder::new("calibrate");
    let (bag, robot) = record(&folder, "drive", DRIVE, "--duration=22");
    let plot = folder.path("residuals.png").display().to_string();
    let arguments =
        ["calibrate", &bag, "--robot", &robot, "--wheel-radius=0.096", "--plot", &plot, "--json"];
    let done = periplus(&arguments);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let report: Value = serde_json::from_slice(&done.stdout).unwrap();
    let check = |name: &str, expected: f64, max_error: f64| {
        let value = report["values"][name]["value"].as_f64().unwrap();
        assert!((value - expected).abs() < max_error, "{name}: {report}");
    };
    assert_eq!(report["values"]["left_wheel_radius"]["nominal"], 0.096);
    check("left_wheel_radius", 0.1, 3e-4);
    check("right_wheel_radius", 0.1, 3e-4);
    // Without physics the base follows the `wheel_separation` of the drive's plugin, not the wheels' positions.
    check("wheel_distance", 0.4, 1.2e-3);
    assert!((report["values"]["wheel_distance"]["nominal"].as_f64().unwrap() - 0.36).abs() < 1e-6);
    check("scanner_x", 0.0, 5e-3);
    check("scanner_y", 0.0, 5e-3);
    check("scanner_yaw", 0.0, 5e-3);
    check("scan_delay", 0.0, 5e-3);
    assert!(std::fs::read(&plot).unwrap().starts_with(b"\x89PNG"));
    // 22 s are too short for a prediction, and the robot never stopped.
    assert!(report["second_half"]["missing"].is_string(), "{report}");
    let reasons = report["not_observable"].to_string();
    assert!(reasons.contains("at rest"), "{report}");
    check("imu_delay", 0.0, 0.02);
    check("gyro_z_scale", 1.0, 0.01);
    values_are_written(&folder, &bag);
}

/// The wheels are 0.36 m apart in the file, and 0.4 m for the robot that was recorded.
fn values_are_written(folder: &Folder, bag: &str) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../robots/sam_bot/urdf");
    for entry in std::fs::read_dir(root).unwrap() {
        let path = entry.unwrap().path();
        std::fs::copy(&path, folder.path(path.file_name().unwrap().to_str().unwrap())).unwrap();
    }
    let robot = folder.path("sam_bot.urdf.xacro").display().to_string();
    let chassis = || std::fs::read_to_string(folder.path("chassis.xacro")).unwrap();
    let before = chassis();
    let done = periplus(&["calibrate", bag, "--robot", &robot]);
    let shown = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(
        shown.contains("\n-  <xacro:property name=\"wheel_aside\" value=\"0.025\"/>"),
        "{shown}"
    );
    assert_eq!(chassis(), before);
    let done = periplus(&["calibrate", bag, "--robot", &robot, "--write", "--json"]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let changed: Vec<(String, String)> = before
        .lines()
        .zip(chassis().lines())
        .filter(|(a, b)| a != b)
        .map(|(a, b)| (a.to_owned(), b.to_owned()))
        .collect();
    let [(_, line)] = &changed[..] else { panic!("{changed:?}") };
    assert!(line.ends_with("<!-- body side to wheel centre -->"), "{line}");
    // The file now has the distance that the recording has.
    let done = periplus(&["calibrate", bag, "--robot", &robot, "--json"]);
    let report: Value = serde_json::from_slice(&done.stdout).unwrap();
    let nominal = report["values"]["wheel_distance"]["nominal"].as_f64().unwrap();
    assert!((nominal - 0.4).abs() < 1.5e-3, "{report}");
    let outcomes = report["file"].as_array().unwrap();
    assert!(outcomes.iter().all(|it| it["outcome"] == "agrees"), "{report}");
}

#[test]
fn a_straight_drive_and_missing_wheels_are_refused() {
    let folder = Folder::new("calibrate-refused");
    let script = "- {at: 0, until: 14, rate: 20, linear: 0.1}\n- {at: 14}\n";
    let (bag, robot) = record(&folder, "straight", script, "--duration=14");
    let check = |arguments: &[&str], code: i32, expected: &str| {
        let done = periplus(&[&["calibrate", &bag, "--robot", &robot], arguments].concat());
        let message = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(code), "{message}");
        assert!(message.contains(expected), "{message}");
    };
    check(&[], 1, "turn on the spot");
    check(&["--left-joint", "one", "--right-joint", "two"], 1, "no joint `one`");
    check(&["--left-joint", "one"], 2, "--right-joint");
}
