//! `tf`.
#![allow(clippy::disallowed_methods, reason = "reads written files")]

use std::time::Duration;

use expect_test::expect;
use periplus_geometry::Pose;
use periplus_graph::Qos;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Quaternion, Transform, TransformStamped, Vector3};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_ros2cli::frames::Forest;
use periplus_ros2cli::tf::{Monitor, Pictures, TfEchoOptions, Tree, echo, monitor, put_tree, tree};
use periplus_tf::{StampedTransform, TransformKind, TransformMonitor};

use crate::bench::Bench;

fn transform(parent: &str, child: &str, x: f64) -> TFMessage {
    TFMessage {
        transforms: vec![TransformStamped {
            header: Header { stamp: Time { sec: 7, nanosec: 5 }, frame_id: parent.into() },
            child_frame_id: child.into(),
            transform: Transform {
                translation: Vector3 { x, y: 0.0, z: 0.0 },
                rotation: Quaternion { x: 0.0, y: 0.0, z: 1.0, w: 0.0 },
            },
        }],
    }
}

#[test]
fn a_pose_is_shown() {
    let bench = Bench::new();
    let node = bench.node("robot_state_publisher");
    let publisher = node.publisher("/tf_static", Qos::latched(1)).unwrap();
    publisher.publish(transform("base_link", "laser", 0.25));
    let options = TfEchoOptions {
        source: "base_link".into(),
        target: "laser".into(),
        period: Duration::from_secs(1),
        once: true,
    };
    bench.check(
        |session| echo(session, &options),
        expect![[r#"
            At time 0.000000000
            - Translation: [0.250, 0.000, 0.000]
            - Rotation: in Quaternion [0.000, 0.000, 1.000, 0.000]
            - Rotation: in RPY (radian) [0.000, 0.000, 3.142]
            - Rotation: in RPY (degree) [0.000, 0.000, 180.000]
            - Matrix:
             -1.000  0.000  0.000  0.250
              0.000 -1.000  0.000  0.000
              0.000  0.000  1.000  0.000
              0.000  0.000  0.000  1.000
        "#]],
    );
}

#[test]
fn a_chain_is_watched() {
    let bench = Bench::new();
    let node = bench.node("robot_state_publisher");
    let publisher = node.publisher("/tf_static", Qos::latched(1)).unwrap();
    publisher.publish(transform("base_link", "laser", 0.25));
    let options = Monitor {
        between: Some(("base_link".into(), "laser".into())),
        gather: Duration::from_millis(100),
        once: true,
    };
    bench.check(
        |session| monitor(session, &options),
        expect![[r#"

            RESULTS: for base_link to laser
            Chain is: base_link -> laser
            Net delay     avg = 0.000000: max = 0.000000

            Frames:
            Frame: laser, published by Authority undetectable, Average Delay: 0.000000, Max Delay: 0.000000

            All Broadcasters:
            Node: Authority undetectable 10.000 Hz, Average Delay: 0.000000 Max Delay: 0.000000
        "#]],
    );
}

/// A folder that is removed when the test ends.
struct Folder(std::path::PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("periplus_{name}_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn viewed(folder: &Folder) -> Tree {
    Tree {
        wait: Duration::from_millis(50),
        moving: "/tf".into(),
        fixed: "/tf_static".into(),
        pictures: Pictures { stem: folder.0.join("frames_12.30"), svg: true },
    }
}

#[test]
fn a_tree_is_drawn_and_told() {
    let bench = Bench::new();
    let node = bench.node("robot_state_publisher");
    let fixed = node.publisher("/tf_static", Qos::latched(1)).unwrap();
    fixed.publish(transform("base_link", "laser", 0.25));
    let folder = Folder::new("tree");
    let said = bench.run(|session| tree(session, &viewed(&folder)));
    expect![[r#"
        base_link
        └─ laser  (static, /robot_state_publisher)
        | Listening to tf data for 0.05 seconds...
        | written: DIR/frames_12.30.gv, DIR/frames_12.30.pdf, DIR/frames_12.30.svg
    "#]]
    .assert_eq(&said.replace(&folder.0.display().to_string(), "DIR"));
}

#[test]
fn what_is_wrong_with_a_tree_is_told() {
    let mut survey = TransformMonitor::default();
    let mut hear = |parent: &str, child: &str, stamp_ns: i64, kind| {
        let it = StampedTransform::new(parent, child, stamp_ns, Pose::IDENTITY);
        survey.insert(&it, "Authority undetectable", kind).unwrap();
    };
    for tick in 0..=20 {
        hear("odom", "base_link", tick * 50_000_000, TransformKind::Moving);
    }
    hear("map", "base_link", 1_010_000_000, TransformKind::Moving);
    hear("base_link", "laser", 0, TransformKind::Fixed);
    let folder = Folder::new("wrong_tree");
    let forest = Forest::new(&survey);
    let pictures = viewed(&folder).pictures;
    let said =
        Bench::new().run(|session| put_tree(session, &forest, &survey, 1_500_000_000, &pictures));
    let said = said.replace(&folder.0.display().to_string(), "DIR");
    let path = |ending| folder.0.join(format!("frames_12.30.{ending}"));
    expect![[r#"
        map
        └─ base_link  (21.8 Hz, Authority undetectable)
           └─ laser  (static, Authority undetectable)
        odom
        | WARNING: 2 disconnected trees with the roots `map`, `odom`
        | WARNING: `base_link` has more than one parent: `map`, `odom`
        | written: DIR/frames_12.30.gv, DIR/frames_12.30.pdf, DIR/frames_12.30.svg
    "#]]
    .assert_eq(&said);
    let dot = std::fs::read_to_string(path("gv")).unwrap();
    expect![[r#"
        digraph G {
        "map" -> "base_link"[label=" Broadcaster: Authority undetectable\nAverage rate: 21.782\nBuffer length: 1.010\nMost recent transform: 1.010000\nOldest transform: 0.000000\n"];
        "odom" -> "base_link"[color=red, style=dotted];
        "base_link" -> "laser"[label=" Broadcaster: Authority undetectable\nAverage rate: 10000.000\nBuffer length: 0.000\nMost recent transform: 0.000000\nOldest transform: 0.000000\n", style=dashed];
        "map";
        "odom";
        edge [style=invis];
         subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";
        "Recorded at time: 1.500000"[ shape=plaintext ] ;
         }
        "Recorded at time: 1.500000"->"map";
        "Recorded at time: 1.500000"->"odom";
        }
    "#]].assert_eq(&dot);
    assert!(std::fs::read(path("pdf")).unwrap().starts_with(b"%PDF-1."));
    assert!(std::fs::read_to_string(path("svg")).unwrap().ends_with("</svg>\n"));
}

#[test]
fn silence_is_no_tree() {
    let folder = Folder::new("no_tree");
    let said = Bench::new().run(|session| tree(session, &viewed(&folder)));
    assert!(
        said.contains("! no transform was received in 0.05 s: publishers of /tf: 0, of"),
        "{said}"
    );
    let dot = std::fs::read_to_string(folder.0.join("frames_12.30.gv")).unwrap();
    assert_eq!(dot, "digraph G { \"No tf data received\" }");
}
