//! `periplus launch` runs what it has read: what is in the bag afterwards.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

mod common;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::Folder;
use expect_test::{Expect, expect};

/// The top of the tree.
fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn periplus(words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.args(words).current_dir(top());
    command.env("NO_COLOR", "1").env_remove("AMENT_PREFIX_PATH").env_remove("ROS_PACKAGE_PATH");
    command.output().unwrap()
}

fn has_python() -> bool {
    let has = Command::new("python3").arg("--version").output().is_ok();
    if !has {
        eprintln!("SKIPPED: launch files in Python need a python3");
    }
    has
}

/// A run of its own: its bag, and what it has told.
struct Ran {
    bag: PathBuf,
    told: String,
    is_success: bool,
    _folder: Folder,
}

fn run(name: &str, words: &[&str]) -> Ran {
    let folder = Folder::new(name);
    // A bag says what its file is called.
    let bag = folder.path("run.mcap");
    let path = bag.display().to_string();
    let mut all = vec!["launch", "--resource-path", "robots", "--record", &path];
    all.extend(words);
    let output = periplus(&all);
    let told = String::from_utf8_lossy(&output.stderr).replace(&top().display().to_string(), "TOP");
    Ran { bag, told, is_success: output.status.success(), _folder: folder }
}

impl Ran {
    /// Topics with their types and how many messages they have.
    fn topics(&self) -> String {
        let output = periplus(&["bag", "info", &self.bag.display().to_string()]);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let lines = text.lines().filter_map(|line| {
            let line = line.split_once("Topic: ")?.1;
            let (topic, rest) = line.split_once(" | Type: ")?;
            let (type_name, rest) = rest.split_once(" | Count: ")?;
            let count = rest.split(' ').next()?;
            Some(format!("{topic} {type_name} {count}\n"))
        });
        lines.collect()
    }

    fn has(&self, topics: Expect) {
        assert!(self.is_success, "{}", self.told);
        topics.assert_eq(&self.topics());
    }

    /// What became of each step.
    fn became(&self) -> String {
        let is_step = |line: &&str| ["+ ", "- ", "= "].iter().any(|sign| line.starts_with(sign));
        self.told.lines().filter(is_step).map(|line| line.to_owned() + "\n").collect()
    }
}

#[test]
fn the_robot_of_the_second_tutorial_in_its_world() {
    if !has_python() {
        return;
    }
    let words = ["sam_bot", "display.launch.py", "--duration", "1", "--exclude", "camera"];
    let ran = run("sam_bot", &words);
    ran.has(expect![[r#"
        /clock rosgraph_msgs/msg/Clock 100
        /demo/imu sensor_msgs/msg/Imu 101
        /demo/odom nav_msgs/msg/Odometry 100
        /diagnostics diagnostic_msgs/msg/DiagnosticArray 1
        /joint_states sensor_msgs/msg/JointState 30
        /odometry/filtered nav_msgs/msg/Odometry 30
        /parameter_events rcl_interfaces/msg/ParameterEvent 11
        /robot_description std_msgs/msg/String 1
        /scan sensor_msgs/msg/LaserScan 6
        /tf tf2_msgs/msg/TFMessage 45
        /tf_static tf2_msgs/msg/TFMessage 1
    "#]]);
    let again = run("sam_bot_again", &words);
    assert_eq!(std::fs::read(&ran.bag).unwrap(), std::fs::read(&again.bag).unwrap());
    expect![[r#"
        + robot_state_publisher robot_state_publisher: /robot_state_publisher: the built-in node: `/tf`, `/tf_static`, `robot_description`
        + gazebo ...: the simulation of TOP/worlds/cube_and_sphere.sdf
        + gazebo_ros spawn_entity.py: /spawn_entity: `sam_bot` from /robot_description at (0, 0, 0.15)
        + robot_localization ekf_node: /ekf_filter_node: the built-in filter of wheels, IMU and poses
        = rviz2 rviz2: the page (`--page`), which opens files of RViz
    "#]].assert_eq(&ran.became());
}
