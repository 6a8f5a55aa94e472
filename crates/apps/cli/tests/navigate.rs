//! `periplus navigate` with default parameters.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

mod common;

use std::path::Path;
use std::process::Command;

use common::Folder;
use serde_json::Value;

/// Runs `navigate` in the demo room with `sam_bot`, and returns its report.
fn navigate(arguments: &[&str]) -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let robot = root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro");
    let pose = ["--pose=0,0.8,0.5"];
    navigate_in(&root.join("worlds/demo_room.sdf"), &robot, &[&pose[..], arguments].concat())
}

/// Runs `navigate` in a world with a robot, and returns its report.
fn navigate_in(world: &Path, robot: &Path, arguments: &[&str]) -> Value {
    let done = Command::new(env!("CARGO_BIN_EXE_periplus"))
        .arg("navigate")
        .arg(world)
        .arg("--robot")
        .arg(robot)
        .args(["--timeout=60", "--json", "--quiet"])
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

/// Regression test: goals were converted as if the odometry frame began at the robot, also for odometry in the frame of the
/// world. The robot drove elsewhere, and the goal was reported as reached.
#[test]
fn goals_of_a_robot_with_odometry_in_the_world_are_where_the_user_put_them() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let world = root.join("worlds/demo_room.sdf");
    let robot = root.join("benches/fleet_robot.urdf");
    // 0.7 m ahead: relative to the start, and in the world.
    for goal in [&["--no-map", "--goal=0.7,0,0"][..], &["--goal=0.614,1.136,0.5"]] {
        let report = navigate_in(&world, &robot, &[&["--pose=0,0.8,0.5"], goal].concat());
        let at = |index: usize| report["truth"]["end_pose"][index].as_f64().unwrap();
        assert!((at(0) - 0.614).hypot(at(1) - 1.136) < 0.4, "{report}");
    }
}

/// A robot of 0.5 m that moves in all directions.
const SLIDER: &str = r#"<robot name="slider">
  <link name="base_link">
    <inertial><origin xyz="0 0 0.15"/><mass value="10"/><inertia ixx="0.3" ixy="0" ixz="0" iyy="0.3" iyz="0" izz="0.4"/></inertial>
    <collision><origin xyz="0 0 0.15"/><geometry><box size="0.5 0.5 0.3"/></geometry></collision>
  </link>
  <link name="lidar">
    <inertial><mass value="0.1"/><inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial>
  </link>
  <joint name="lidar_joint" type="fixed"><parent link="base_link"/><child link="lidar"/><origin xyz="0 0 0.35"/></joint>
  <gazebo><plugin name="slide" filename="libgazebo_ros_planar_move.so">
    <robot_base_frame>base_link</robot_base_frame><update_rate>100</update_rate><publish_rate>50</publish_rate>
  </plugin></gazebo>
  <gazebo reference="lidar"><sensor name="lidar" type="gpu_lidar">
    <topic>scan</topic><gz_frame_id>lidar</gz_frame_id><update_rate>10</update_rate>
    <lidar>
      <scan><horizontal><samples>360</samples><min_angle>-3.1416</min_angle><max_angle>3.1416</max_angle></horizontal></scan>
      <range><min>0.1</min><max>10</max></range>
    </lidar>
  </sensor></gazebo>
</robot>"#;

/// Regression test: the path of an omnidirectional robot led through a gap in which it fits in some headings only, and
/// the controller stopped before it with another heading.
#[test]
fn an_omnidirectional_robot_drives_through_gaps_in_which_it_fits_with_any_heading() {
    let wall = |[x, y]: [f64; 2], [length_x, length_y]: [f64; 2]| {
        let shape = format!("<geometry><box><size>{length_x} {length_y} 1</size></box></geometry>");
        format!(
            "<collision name=\"{x} {y}\"><pose>{x} {y} 0.5 0 0 0</pose>{shape}</collision>\n\
             <visual name=\"{x} {y}\"><pose>{x} {y} 0.5 0 0 0</pose>{shape}</visual>\n"
        )
    };
    // A wall across the room with gaps of 0.65 m straight ahead and 1.2 m aside.
    let walls = [
        wall([1.5, -0.9125], [0.2, 1.175]),
        wall([1.5, 0.8625], [0.2, 1.075]),
        wall([1.5, 3.05], [0.2, 0.9]),
        wall([1.5, -1.5], [5.0, 0.1]),
        wall([1.5, 3.5], [5.0, 0.1]),
        wall([-1.0, 1.0], [0.1, 5.0]),
        wall([4.0, 1.0], [0.1, 5.0]),
    ];
    let floor = "<collision name=\"floor\"><geometry><plane><size>20 20</size></plane></geometry></collision>";
    let text = format!(
        "<sdf version=\"1.9\"><world name=\"gap\"><model name=\"walls\"><static>true</static>\n\
         <link name=\"walls\">{floor}\n{}</link></model></world></sdf>",
        walls.concat()
    );
    let folder = Folder::new("navigate-gap");
    let (world, robot) = (folder.path("gap.sdf"), folder.path("slider.urdf"));
    std::fs::write(&world, text).unwrap();
    std::fs::write(&robot, SLIDER).unwrap();
    let report = navigate_in(&world, &robot, &["--base=omni", "--no-map", "--goal=3,0,0"]);
    assert_eq!(report["goals"][0]["recoveries"], 0, "{report}");
    assert!(report["truth"]["length_m"].as_f64().unwrap() > 4.5, "{report}");
}

/// Draws the map of the demo room into a folder, and returns its path.
fn drawn_map(folder: &Folder) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let name = folder.path("room");
    let drawn = Command::new(env!("CARGO_BIN_EXE_periplus"))
        .args(["map", "draw"])
        .arg(root.join("worlds/demo_room.sdf"))
        .args(["--start=0,0.8", "-f"])
        .arg(&name)
        .output()
        .unwrap();
    assert!(drawn.status.success(), "{}", String::from_utf8_lossy(&drawn.stderr));
    format!("{}.yaml", name.display())
}

#[test]
fn each_of_several_robots_localizes_and_reaches_its_own_goals() {
    let folder = Folder::new("navigate-fleet");
    let map = drawn_map(&folder);
    let bag = folder.path("fleet.mcap").display().to_string();
    let run = |threads: &str| {
        let words = ["--map", &map, "--robots=3", "--random-goals=1", "--dynamics=kinematic"];
        let topics = "--topics=/(scan|odom|tf|cmd_vel|amcl_pose|particle_cloud|plan|rosout)$";
        let more = [threads, "--seed=3", "--record", &bag, topics];
        let mut report = navigate(&[&words[..], &more].concat());
        let recorded = std::fs::read(&bag).unwrap();
        std::fs::remove_file(&bag).unwrap();
        // Wall times differ.
        (report["robots"].take(), recorded)
    };
    let (robots, recorded) = run("--threads=1");
    assert_eq!(robots.as_array().unwrap().len(), 3);
    for robot in robots.as_array().unwrap() {
        assert_eq!(robot["goals"][0]["is_reached"], true, "{robot:#}");
        assert_eq!(robot["wall_contacts"], 0, "{robot:#}");
        assert!(robot["length_m"].as_f64().unwrap() > 0.3, "{robot:#}");
        assert!(robot["localization_error_mean_m"].as_f64().unwrap() < 0.1, "{robot:#}");
    }
    assert_ne!(robots[0]["goals"][0]["goal"], robots[1]["goals"][0]["goal"]);
    let (same_robots, same_recorded) = run("--threads=8");
    assert_eq!(robots, same_robots);
    assert!(recorded == same_recorded, "other bytes are recorded");
}

#[test]
fn what_several_robots_need_is_said() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let refusal = |words: &[&str]| {
        let robot = root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro");
        let done = Command::new(env!("CARGO_BIN_EXE_periplus"))
            .arg("navigate")
            .arg(root.join("worlds/demo_room.sdf"))
            .arg("--robot")
            .arg(&robot)
            .args(words)
            .output()
            .unwrap();
        assert_eq!(done.status.code(), Some(2));
        String::from_utf8_lossy(&done.stderr).into_owned()
    };
    let robot = root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro");
    let second = robot.to_str().unwrap();
    assert!(refusal(&["--robot", second, "--goal=1,0"]).contains("periplus map draw WORLD"));
    let goal = ["--robots=2", "--map=m.yaml", "--random-goals=1", "--goal=1,0"];
    assert!(refusal(&goal).contains("`--goal` is for one robot"));
}
