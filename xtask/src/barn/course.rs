//! Worlds, robot and parameters.

use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};

use flate2::read::GzDecoder;
use serde_json::Value;

use crate::step::Failed;

/// Packages that the robot's xacro includes for sensors that it does not have here.
pub(super) const EMPTY_PACKAGES: [(&str, &[&str]); 5] = [
    ("sick_tim", &["sick_tim.urdf.xacro"]),
    ("lms1xx", &["sick_lms1xx.urdf.xacro"]),
    ("velodyne_description", &["VLP-16.urdf.xacro", "HDL-32E.urdf.xacro"]),
    (
        "pointgrey_camera_description",
        &["pointgrey_flea3.urdf.xacro", "pointgrey_bumblebee2.urdf.xacro"],
    ),
    ("flir_camera_description", &["flir_blackflys.urdf.xacro"]),
];

pub(super) const EMPTY_XACRO: &str = "<robot xmlns:xacro=\"http://ros.org/wiki/xacro\"/>\n";

/// `jackal_control/config/control.yaml` in the form of ROS 2.
pub(super) const CONTROLLERS: &str = "\
jackal_joint_publisher:
  ros__parameters:
    type: joint_state_controller/JointStateController
    publish_rate: 50.0
jackal_velocity_controller:
  ros__parameters:
    type: diff_drive_controller/DiffDriveController
    left_wheel: [front_left_wheel, rear_left_wheel]
    right_wheel: [front_right_wheel, rear_right_wheel]
    publish_rate: 50.0
    pose_covariance_diagonal: [0.001, 0.001, 1000000.0, 1000000.0, 1000000.0, 0.03]
    twist_covariance_diagonal: [0.001, 0.001, 0.001, 1000000.0, 1000000.0, 0.03]
    cmd_vel_timeout: 0.25
    enable_odom_tf: false
    wheel_separation_multiplier: 1.5
    linear.x.has_velocity_limits: true
    linear.x.max_velocity: 2.0
    linear.x.has_acceleration_limits: true
    linear.x.max_acceleration: 20.0
    angular.z.has_velocity_limits: true
    angular.z.max_velocity: 4.0
    angular.z.has_acceleration_limits: true
    angular.z.max_acceleration: 25.0
";

pub(super) fn manifest(package: &str) -> String {
    format!("<package format=\"2\"><name>{package}</name><version>0.0.0</version></package>\n")
}

/// A world of the challenge.
pub(super) struct Course {
    pub(super) world: u64,
    pub(super) file: PathBuf,
    /// Time of the reference path at 2 m/s \[s\].
    pub(super) optimal_s: f64,
}

/// Reads the index and unpacks the worlds into a folder.
pub(super) fn read(worlds: &Path, folder: &Path, every: usize) -> Result<Vec<Course>, Failed> {
    let index = worlds.join("index.json");
    let failed = |error: &dyn std::fmt::Display| Failed(format!("{}: {error}", index.display()));
    let text = fs::read_to_string(&index).map_err(|error| failed(&error))?;
    let entries: Vec<Value> = serde_json::from_str(&text).map_err(|error| failed(&error))?;
    let mut courses = Vec::new();
    for entry in entries.iter().step_by(every) {
        let world = entry["world"].as_u64();
        let optimal_s = entry["optimal_time_run"].as_f64();
        let (Some(world), Some(optimal_s)) = (world, optimal_s) else {
            return Err(failed(&"an entry lacks `world` or `optimal_time_run`"));
        };
        let packed = worlds.join(format!("worlds/world_{world}.world.gz"));
        let file = folder.join(format!("world_{world}.world"));
        let unpacked = File::open(&packed).and_then(|packed| {
            let mut text = String::new();
            GzDecoder::new(packed).read_to_string(&mut text)?;
            fs::write(&file, text)
        });
        unpacked.map_err(|error| Failed(format!("{}: {error}", packed.display())))?;
        courses.push(Course { world, file, optimal_s });
    }
    courses.sort_by_key(|course| course.world);
    Ok(courses)
}
