//! `periplus convert --to harmonic` on robots, worlds and launch files of this project.
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files")]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::Folder;
use serde_json::Value;

fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().unwrap()
}

fn convert(words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.arg("convert").args(words).current_dir(top()).env("NO_COLOR", "1").output().unwrap()
}

fn report(output: &Output) -> Value {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_robot_of_macros_drives_as_before() {
    let folder = Folder::new("migrate-robot");
    let out = folder.0.display().to_string();
    let robot = "robots/sam_bot/urdf/sam_bot.urdf.xacro";
    let report = report(&convert(&[robot, "--to", "harmonic", "--out", &out, "--json"]));
    let topics = report["comparison"]["topics"].as_array().unwrap();
    let verdict = |name: &str| {
        topics.iter().find(|topic| topic["topic"] == name).map(|topic| topic["verdict"].clone())
    };
    assert_eq!(verdict("/scan").unwrap(), "equal");
    // The limits of acceleration differ, which a second run proves.
    assert_eq!(verdict("/demo/odom").unwrap(), "explained");
    assert_eq!(report["ok"], true);
    let drive = fs::read_to_string(folder.path("sam_bot/urdf/drive.xacro")).unwrap();
    assert!(drive.contains("<wheel_radius>${wheel_radius}</wheel_radius>"), "{drive}");
    assert!(drive.contains("<!-- Differential drive, and the wheel angles"), "{drive}");
    let bridge = fs::read_to_string(folder.path("ros_gz_bridge.yaml")).unwrap();
    assert!(bridge.contains("ros_topic_name: \"/depth_camera/image_raw\""), "{bridge}");
    let text = fs::read_to_string(folder.path("MIGRATION.md")).unwrap();
    assert!(text.contains("| drive.xacro:7 | plugin libgazebo_ros_diff_drive.so |"), "{text}");
}

#[test]
fn a_converted_world_has_nothing_left_to_convert() {
    let folder = Folder::new("migrate-world");
    let out = folder.0.display().to_string();
    let world = "worlds/closed_room.world";
    let report_of_old = report(&convert(&[world, "--to", "harmonic", "--out", &out, "--json"]));
    assert_eq!(report_of_old["comparison"]["verdict"], "equal");
    let new = report_of_old["files"][0]["path"].as_str().unwrap();
    let new = folder.path(new).display().to_string();
    let again = folder.path("again").display().to_string();
    let report_of_new = report(&convert(&[&new, "--to", "harmonic", "--out", &again, "--json"]));
    assert_eq!(report_of_new["is_current"], true);
    assert!(!folder.path("again").exists());
}

#[test]
fn a_launch_file_of_ros_1_comes_with_its_robot() {
    let folder = Folder::new("migrate-launch");
    let out = folder.0.display().to_string();
    let launch = "robots/kbot/launch/kbot.launch";
    let words = [launch, "--to", "harmonic", "--out", &out, "--json", "--no-compare"];
    let report = report(&convert(&words));
    let new = fs::read_to_string(folder.path("kbot/launch/kbot.launch.py")).unwrap();
    assert!(new.contains("def generate_launch_description():"), "{new}");
    assert!(folder.path("kbot/urdf/drive.xacro").exists(), "{report:#}");
    assert!(folder.path("kbot/launch/ros_gz_bridge.yaml").exists(), "{report:#}");
}

#[test]
fn wrong_usage_names_the_option() {
    let code = |words: &[&str]| {
        let output = convert(words);
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let robot = "robots/kbot/urdf/kbot.urdf.xacro";
    let (exit, message) = code(&[robot, "--to", "harmonic"]);
    assert_eq!(exit, Some(2), "{message}");
    assert!(message.contains("--out FOLDER"), "{message}");
    let (exit, message) = code(&[robot, "--to", "urdf", "--json"]);
    assert_eq!(exit, Some(2), "{message}");
    let (exit, message) = code(&["missing.world", "--to", "harmonic", "--out", "x"]);
    assert_eq!(exit, Some(1), "{message}");
    assert!(message.contains("missing.world"), "{message}");
}
