//! `periplus launch` runs a file: contents of the bag afterwards.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

mod common;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::Folder;
use expect_test::{Expect, expect};

/// Root of the source tree.
fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().unwrap()
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

/// A run with its bag and its output.
struct Ran {
    bag: PathBuf,
    told: String,
    is_success: bool,
    _folder: Folder,
}

fn run(name: &str, words: &[&str]) -> Ran {
    let folder = Folder::new(name);
    // The metadata of a bag contain its file name.
    let bag = folder.path("run.mcap");
    let path = bag.display().to_string();
    let own = "crates/apps/cli/tests/launch";
    let mut all = vec!["launch", "--resource-path", "robots", "--resource-path", own];
    all.extend(["--record", &path]);
    all.extend(words);
    let output = periplus(&all);
    let told = String::from_utf8_lossy(&output.stderr).replace(&top().display().to_string(), "TOP");
    Ran { bag, told, is_success: output.status.success(), _folder: folder }
}

impl Ran {
    /// Topics with their types and numbers of messages.
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

    /// Number of messages on these topics.
    fn has_of(&self, wanted: &[&str], topics: Expect) {
        assert!(self.is_success, "{}", self.told);
        let all = self.topics();
        let is_wanted =
            |line: &&str| line.split(' ').next().is_some_and(|topic| wanted.contains(&topic));
        let lines: Vec<&str> = all.lines().filter(is_wanted).collect();
        topics.assert_eq(&(lines.join("\n") + "\n"));
    }

    /// Outcome of each step.
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
        + robot_localization ekf_node: /ekf_filter_node: the built-in extended Kalman filter
        = rviz2 rviz2: the page (`--page`), which opens files of RViz
    "#]].assert_eq(&ran.became());
}

/// The first tutorial: a map is built while the robot stands in its room.
#[test]
fn gazebo_and_gmapping_of_ros_1() {
    let ran = run("kbot_maps", &["launch_tutorials", "kbot_maps.launch", "--duration", "1"]);
    let wanted = [
        "/clock",
        "/kbot/base_controller/odom",
        "/kbot/sensor_laser/scan",
        "/map",
        "/robot_description",
        "/tf",
        "/tf_static",
    ];
    ran.has_of(
        &wanted,
        expect![[r#"
        /clock rosgraph_msgs/msg/Clock 100
        /kbot/base_controller/odom nav_msgs/msg/Odometry 20
        /kbot/sensor_laser/scan sensor_msgs/msg/LaserScan 21
        /map nav_msgs/msg/OccupancyGrid 1
        /robot_description std_msgs/msg/String 1
        /tf tf2_msgs/msg/TFMessage 69
        /tf_static tf2_msgs/msg/TFMessage 1
    "#]],
    );
    expect![[r#"
        + package://gazebo_ros/launch/empty_world.launch: the simulation of TOP/worlds/closed_room.world
        + gazebo_ros spawn_model: /spawn_kbot: `kbot` from its parameter at (0, 0, 0)
        + robot_state_publisher robot_state_publisher: /robot_state_publisher: the built-in node: `/tf`, `/tf_static`, `robot_description`
        = rviz rviz: the page (`--page`), which opens files of RViz
        + gmapping slam_gmapping: /slam_gmapping: the built-in SLAM node with a particle filter
        + tf static_transform_publisher: /laser_to_nowhere: `nowhere` in `base_link`
    "#]].assert_eq(&ran.became());
}

/// Second part: the robot is localized on that map.
#[test]
fn a_map_server_and_amcl_of_ros_1() {
    let folder = Folder::new("room");
    let (picture, map) = (folder.path("room.pgm"), folder.path("room.yaml"));
    std::fs::write(picture, "P2\n4 4\n255\n0 0 0 0 0 254 254 0 0 254 254 0 0 0 0 0\n").unwrap();
    let text = "image: room.pgm\nresolution: 1.0\norigin: [-2.0, -2.0, 0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    std::fs::write(&map, text).unwrap();
    let map = format!("map:={}", map.display());
    let words = ["launch_tutorials", "kbot_localizes.launch", &map, "--duration", "1"];
    let ran = run("kbot_localizes", &words);
    let wanted = ["/map", "/map_server/transition_event", "/amcl/transition_event"];
    ran.has_of(
        &wanted,
        expect![[r#"
        /amcl/transition_event lifecycle_msgs/msg/TransitionEvent 4
        /map nav_msgs/msg/OccupancyGrid 1
        /map_server/transition_event lifecycle_msgs/msg/TransitionEvent 4
    "#]],
    );
    expect![[r#"
        + package://gazebo_ros/launch/empty_world.launch: the simulation of TOP/worlds/closed_room.world
        + gazebo_ros spawn_model: /spawn_kbot: `kbot` from its parameter at (0, 0, 0)
        + robot_state_publisher robot_state_publisher: /robot_state_publisher: the built-in node: `/tf`, `/tf_static`, `robot_description`
        + map_server map_server: /map_server: the built-in node; `-f NAME` saves the map, as `map_saver` does
        + amcl amcl: /amcl: the built-in node
        + move_base move_base: /move_base: the built-in node with its costmaps: NavfnROS, GlobalPlanner; TrajectoryPlannerROS, DWAPlannerROS, and a controller in place of TebLocalPlannerROS
    "#]].assert_eq(&ran.became());
}

/// The second tutorial's three terminals in one: robot, map, costmaps, voxels as markers.
#[test]
fn the_robot_maps_and_has_costmaps() {
    if !has_python() {
        return;
    }
    let words = ["launch_tutorials", "sam_bot_navigates.launch.py", "--duration", "1"];
    let ran = run("sam_bot_navigates", &[&words[..], &["--exclude", "camera"]].concat());
    let wanted = [
        "/scan",
        "/odometry/filtered",
        "/map",
        "/global_costmap/costmap",
        "/local_costmap/costmap",
        "/local_costmap/voxel_grid",
        "/my_marker",
    ];
    ran.has_of(
        &wanted,
        expect![[r#"
        /global_costmap/costmap nav_msgs/msg/OccupancyGrid 1
        /local_costmap/costmap nav_msgs/msg/OccupancyGrid 2
        /local_costmap/voxel_grid nav2_msgs/msg/VoxelGrid 5
        /map nav_msgs/msg/OccupancyGrid 1
        /my_marker visualization_msgs/msg/Marker 5
        /odometry/filtered nav_msgs/msg/Odometry 30
        /scan sensor_msgs/msg/LaserScan 6
    "#]],
    );
    expect![[r#"
        + robot_state_publisher robot_state_publisher: /robot_state_publisher: the built-in node: `/tf`, `/tf_static`, `robot_description`
        + gazebo ...: the simulation of TOP/worlds/cube_and_sphere.sdf
        + gazebo_ros spawn_entity.py: /spawn_entity: `sam_bot` from /robot_description at (0, 0, 0.15)
        + robot_localization ekf_node: /ekf_filter_node: the built-in extended Kalman filter
        = rviz2 rviz2: the page (`--page`), which opens files of RViz
        + slam_toolbox async_slam_toolbox_node: /slam_toolbox: the built-in SLAM node
        + nav2_controller controller_server: /controller_server: the built-in server with its `local_costmap`: MPPI, DWB, RegulatedPurePursuit, Graceful, RotationShim
        + nav2_smoother smoother_server: /smoother_server: the built-in server
        + nav2_planner planner_server: /planner_server: the built-in server with its `global_costmap`: NavFn, Smac, Theta*
        + nav2_behaviors behavior_server: /behavior_server: the built-in server: spin, back up, drive on heading, wait, assisted teleoperation
        + nav2_velocity_smoother velocity_smoother: /velocity_smoother: the built-in smoother
        + nav2_bt_navigator bt_navigator: /bt_navigator: the built-in navigator: behavior trees with all nodes of Nav2's default trees
        + nav2_waypoint_follower waypoint_follower: /waypoint_follower: the built-in follower
        + nav2_lifecycle_manager lifecycle_manager: /lifecycle_manager_navigation: manages controller_server, smoother_server, planner_server, behavior_server, velocity_smoother, bt_navigator, waypoint_follower
        + nav2_costmap_2d nav2_costmap_2d_markers: /costmap_2d_marker: voxels as cubes on `visualization_marker`
        + tf2_ros static_transform_publisher: /static_transform_publisher: `table` in `map`
    "#]].assert_eq(&ran.became());
}

/// The third tutorial: the lidar of a world of Harmonic on another topic.
#[test]
fn a_world_of_harmonic_and_its_bridge() {
    if !has_python() {
        return;
    }
    let ran = run("pong", &["launch_tutorials", "pong.launch.py", "--duration", "1"]);
    let wanted = ["/clock", "/lidar", "/laser_scan", "/odometry", "/model/pong_bot/odometry"];
    ran.has_of(
        &wanted,
        expect![[r#"
        /clock rosgraph_msgs/msg/Clock 100
        /laser_scan sensor_msgs/msg/LaserScan 10
        /lidar sensor_msgs/msg/LaserScan 11
        /model/pong_bot/odometry nav_msgs/msg/Odometry 10
        /odometry nav_msgs/msg/Odometry 9
    "#]],
    );
    expect![[r#"
        + package://ros_gz_sim/launch/gz_sim.launch.py: the simulation of TOP/worlds/pong.sdf
        + ros_gz_bridge parameter_bridge: /ros_gz_bridge: /lidar to /laser_scan
        + ros_gz_bridge parameter_bridge: /ros_gz_bridge_2: /model/pong_bot/odometry to /odometry
    "#]]
    .assert_eq(&ran.became());
}

/// A missing program is reported once, and the others run; a required program ends the launch.
#[test]
fn programs_of_the_machine_and_what_is_missing() {
    let folder = Folder::new("programs");
    let file = folder.path("programs.launch.xml");
    std::fs::write(
        &file,
        r#"<launch>
  <executable cmd="echo hello from a program" name="hello"/>
  <executable cmd="periplus_has_no_such_program"/>
  <node pkg="nobody_has_this" exec="driver"/>
  <node pkg="tf2_ros" exec="static_transform_publisher" args="0 0 1 0 0 0 map lamp"/>
  <timer period="0.25"><log message="a quarter is over"/></timer>
  <timer period="0.5"><shutdown reason="half is over"/></timer>
</launch>"#,
    )
    .unwrap();
    let ran = run("programs", &[&file.display().to_string(), "--duration", "3"]);
    assert!(!ran.is_success);
    assert!(ran.topics().contains("/tf_static tf2_msgs/msg/TFMessage 1"), "{}", ran.told);
    for words in [
        "program `periplus_has_no_such_program` is not on the PATH",
        "`driver` of the package `nobody_has_this` has no built-in replacement, and there is no such package",
        "a quarter is over",
        "shutdown: half is over",
        "0.500 s simulated",
    ] {
        assert!(ran.told.contains(words), "no `{words}` in\n{}", ran.told);
    }
}

/// Unchanged launch files of other projects, with the minimum that each of them starts.
#[test]
fn launch_files_of_others_run() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/corpus");
    if !corpus.exists() {
        eprintln!("SKIPPED: the corpus of launch files is not here ({})", corpus.display());
        return;
    }
    let noetic = "gazebo_ros_pkgs@noetic/gazebo_plugins/test";
    let files = [
        ("urdf_sim_tutorial/launch/13-diffdrive.launch", "/urdf_spawner: `robot`"),
        ("urdf_sim_tutorial/launch/gazebo.launch", "/robot_state_publisher: "),
        ("urdf_tutorial/launch/display.launch", "/joint_state_publisher: "),
        ("gazebo_ros_demos/rrbot_gazebo/launch/rrbot_world.launch", "/urdf_spawner: `rrbot`"),
        (&format!("{noetic}/multi_robot_scenario/launch/multi_robot_scenario.launch"), "`r2`"),
        (&format!("{noetic}2/spawn_model/spawn_box_param.launch"), "/spawn_box: `box`"),
        ("jackal/jackal_navigation/launch/gmapping_demo.launch", "/slam_gmapping: "),
        ("jackal/jackal_navigation/launch/amcl_demo.launch", "/amcl: "),
        ("leo_common-ros2/leo_description/launch/state_publisher.launch.xml", "/tf_static"),
    ];
    for (file, wanted) in files {
        let path = corpus.join(file).display().to_string();
        let folders = corpus.display().to_string();
        let ran = run("corpus", &[&path, "--resource-path", &folders, "--duration", "0.1"]);
        // The corpus has this map without its picture: the server ends, as in ROS 1, and the rest runs.
        let has_map = !file.ends_with("amcl_demo.launch");
        assert_eq!(ran.is_success, has_map, "{file}:\n{}", ran.told);
        assert!(ran.became().contains(wanted), "{file}: no `{wanted}` in\n{}", ran.told);
    }
}
