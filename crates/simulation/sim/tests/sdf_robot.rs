//! Robots described in SDF or URDF, in a plain world.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use std::sync::Arc;

use periplus_graph::{NodeSettings, Qos};
use periplus_loader::LoadContext;
use periplus_msgs::{std_msgs, tf2_msgs};
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{AssetFiles, Options, RobotPlacement, Simulation, compose_plain};

/// Robot whose arm reaches 0.5 m below its frame, and that hangs 2 m above it.
const CRANE: &str = r#"<robot name="crane">
  <link name="world"/>
  <link name="arm">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.1 0.1 1"/></geometry></collision>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="world"/><child link="arm"/><origin xyz="0 0 2"/><axis xyz="1 0 0"/>
    <limit effort="1" velocity="1" lower="-1" upper="1"/>
  </joint>
</robot>"#;

const ROBOT: &str = r#"<sdf version="1.9"><model name="bot">
  <link name="base"><inertial><mass>1</mass></inertial></link>
  <link name="lidar"><pose>0.2 0 0.3 0 0 0</pose><inertial><mass>0.1</mass></inertial></link>
  <joint name="lidar_joint" type="fixed"><parent>base</parent><child>lidar</child></joint>
</model></sdf>"#;

/// Robot whose odometry is on `/tf` of Gazebo.
const DRIVEN: &str = r#"<sdf version="1.9"><model name="bot">
  <link name="base"/><link name="left"/><link name="right"/>
  <joint name="l" type="revolute"><parent>base</parent><child>left</child><axis/></joint>
  <joint name="r" type="revolute"><parent>base</parent><child>right</child><axis/></joint>
  <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
    <left_joint>l</left_joint><right_joint>r</right_joint><tf_topic>tf</tf_topic>
  </plugin>
</model></sdf>"#;

fn simulate(file: &str, text: &str) -> Simulation {
    simulate_with(file, text, Options::default()).0
}

/// Also returns the findings.
fn simulate_with(file: &str, text: &str, options: Options) -> (Simulation, Vec<&'static str>) {
    let host = MemoryHost::new().with_file(file, text);
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: "/".into(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    let robot = RobotPlacement { file: file.into(), ..RobotPlacement::default() };
    let mut composition = compose_plain(&[robot], &setting);
    let simulation = Simulation::new(&mut composition, Arc::new(AssetFiles::default()), options);
    assert!(!composition.has_errors());
    let files = composition.files.iter();
    let found = files.flat_map(|file| file.diagnostics.iter().map(|finding| finding.code));
    (simulation, found.collect())
}

/// Two nodes published the pose of the base: the robot and the odometry filter of a launch file whose bridge
/// leaves out `/tf`.
#[test]
fn transforms_that_no_bridge_passes_on_stay_in_gazebo() {
    for bridges_transforms in [true, false] {
        let options = Options { bridges_transforms, ..Options::default() };
        let (simulation, found) = simulate_with("/driven.sdf", DRIVEN, options);
        let topics = simulation.graph().topics();
        let publishers = |name: &str| {
            let topic = topics.iter().find(|topic| topic.name == name);
            topic.map_or(0, |topic| topic.publishers.len())
        };
        assert_eq!(publishers("/model/bot/odometry"), 1);
        // The other publisher is that of the joints.
        assert_eq!(publishers("/tf"), 1 + usize::from(bridges_transforms));
        assert_eq!(found.contains(&"tf-not-bridged"), !bridges_transforms, "{found:?}");
    }
}

/// Regression test: such a robot was put on the floor like a robot with wheels, and its arm dragged along the floor.
#[test]
fn a_robot_that_the_world_holds_keeps_its_height() {
    let simulation = simulate("/crane.urdf", CRANE);
    let motion = simulation.motion();
    let (id, _) = motion.models().find(|(_, name)| *name == "crane").unwrap();
    let heights_m: Vec<f64> = motion
        .links(id)
        .filter_map(|link| Some(motion.link_state(link)?.world_from_link.translation.z))
        .collect();
    assert_eq!(heights_m, [2.0]);
}

/// Regression test: a robot given as SDF had no frames, so that its scans could not be used.
#[test]
fn the_frames_of_a_robot_in_sdf_are_published() {
    let simulation = simulate("/bot.sdf", ROBOT);
    let node = simulation.graph().node(NodeSettings::new("user")).unwrap();
    let frames = node.mailbox::<tf2_msgs::TFMessage>("/tf_static", Qos::latched(1)).unwrap();
    let heard = frames.latest().expect("fixed frames");
    let [edge] = heard.transforms.as_slice() else { panic!("{:?}", heard.transforms) };
    assert_eq!((&*edge.header.frame_id, &*edge.child_frame_id), ("base", "lidar"));
    let at = &edge.transform.translation;
    assert_eq!((at.x, at.y, at.z), (0.2, 0.0, 0.3));
    let description =
        node.mailbox::<std_msgs::String>("/robot_description", Qos::latched(1)).unwrap();
    assert!(description.latest().expect("a description").data.contains("<model name=\"bot\">"));
}
