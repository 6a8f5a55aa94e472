//! A robot described in SDF.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use std::sync::Arc;

use periplus_graph::{NodeSettings, Qos};
use periplus_loader::LoadContext;
use periplus_msgs::{std_msgs, tf2_msgs};
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{AssetFiles, Options, RobotPlacement, Simulation, compose_plain};

const ROBOT: &str = r#"<sdf version="1.9"><model name="bot">
  <link name="base"><inertial><mass>1</mass></inertial></link>
  <link name="lidar"><pose>0.2 0 0.3 0 0 0</pose><inertial><mass>0.1</mass></inertial></link>
  <joint name="lidar_joint" type="fixed"><parent>base</parent><child>lidar</child></joint>
</model></sdf>"#;

/// Regression test: a robot given as SDF had no frames, so that its scans could not be used.
#[test]
fn the_frames_of_a_robot_in_sdf_are_published() {
    let host = MemoryHost::new().with_file("/bot.sdf", ROBOT);
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: "/".into(),
        arguments: Vec::new(),
        open_meshes: true,
    };
    let robot = RobotPlacement { file: "/bot.sdf".into(), ..RobotPlacement::default() };
    let mut composition = compose_plain(&[robot], &setting);
    let simulation =
        Simulation::new(&mut composition, Arc::new(AssetFiles::default()), Options::default());
    assert!(!composition.has_errors());
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
