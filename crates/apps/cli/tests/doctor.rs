//! `periplus doctor` on files: faults that are found before a run.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, reason = "files are written for the command")]

mod common;

use std::path::Path;
use std::process::Command;

use common::Folder;

/// Codes of the findings, and the exit code.
fn doctor(file: &Path) -> (Vec<String>, Option<i32>) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    let output = command.arg("doctor").arg(file).arg("--json").output().unwrap();
    let report: serde_json::Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {output:?}"));
    let findings = report["findings"].as_array().unwrap();
    let codes = findings.iter().map(|it| it["code"].as_str().unwrap().to_owned());
    (codes.collect(), output.status.code())
}

#[test]
fn nodes_of_one_file_that_live_by_different_clocks() {
    let folder = Folder::new("doctor-clocks");
    let file = folder.path("params.yaml");
    let text = |amcl: &str| {
        format!(
            "map_server:\n  ros__parameters:\n    use_sim_time: true\n\
             amcl:\n  ros__parameters:\n    use_sim_time: {amcl}\n"
        )
    };
    std::fs::write(&file, text("false")).unwrap();
    assert_eq!(doctor(&file), (vec!["wall-time".to_owned()], Some(1)));
    std::fs::write(&file, text("true")).unwrap();
    assert_eq!(doctor(&file), (Vec::new(), Some(0)));
}

/// Regression test: the lidar of this world is inside a housing that is a separate link; all its readings
/// were "too near".
#[test]
fn a_lidar_in_a_housing_sees_the_world() {
    let world = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../worlds/pong.sdf");
    // A hint: its model publishes no frames.
    assert_eq!(doctor(&world), (vec!["no-frames".to_owned()], Some(0)));
}

#[test]
fn a_scan_in_a_frame_that_the_robot_does_not_have() {
    let folder = Folder::new("doctor-frame");
    let file = folder.path("robot.urdf");
    let robot = |frame: &str| {
        format!(
            r#"<robot name="bot">
  <link name="base_link">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="lidar_link"/>
  <joint name="lidar_joint" type="fixed">
    <parent link="base_link"/><child link="lidar_link"/><origin xyz="0 0 1"/>
  </joint>
  <link name="post">
    <visual><geometry><box size="0.1 0.1 4"/></geometry></visual>
    <collision><geometry><box size="0.1 0.1 4"/></geometry></collision>
  </link>
  <joint name="post_joint" type="fixed">
    <parent link="base_link"/><child link="post"/><origin xyz="1 0 2"/>
  </joint>
  <gazebo reference="lidar_link">
    <sensor name="lidar" type="ray">
      <update_rate>10</update_rate>
      <ray>
        <scan><horizontal><samples>36</samples><min_angle>-3.1</min_angle><max_angle>3.1</max_angle></horizontal></scan>
        <range><min>0.1</min><max>5</max></range>
      </ray>
      <plugin name="scan" filename="libgazebo_ros_ray_sensor.so">
        <ros><remapping>~/out:=scan</remapping></ros>
        <output_type>sensor_msgs/LaserScan</output_type>
        <frame_name>{frame}</frame_name>
      </plugin>
    </sensor>
  </gazebo>
</robot>"#
        )
    };
    std::fs::write(&file, robot("lidar_lnk")).unwrap();
    let (codes, code) = doctor(&file);
    assert!(codes.iter().any(|code| code == "frame-unknown"), "{codes:?}");
    assert_eq!(code, Some(1));
    std::fs::write(&file, robot("lidar_link")).unwrap();
    let (codes, _) = doctor(&file);
    assert!(!codes.iter().any(|code| code == "frame-unknown"), "{codes:?}");
}
