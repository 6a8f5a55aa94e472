//! `tf`.

use std::time::Duration;

use expect_test::expect;
use periplus_graph::Qos;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Quaternion, Transform, TransformStamped, Vector3};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_verbs::tf::{Echo, Monitor, echo, monitor};

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
    let options = Echo {
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
