//! The node as others see it: wheels that drive a circle, and an IMU that hangs upside down.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

use std::f64::consts::PI;
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_ekf::Settings;
use periplus_geometry::{Pose, Rpy};
use periplus_graph::{
    Arguments, Graph, Mailbox, Node, NodeSettings, ParameterFileError, Publisher, Qos,
};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus};
use periplus_msgs::geometry_msgs::{AccelWithCovarianceStamped, PoseWithCovarianceStamped};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::rcl_interfaces::{
    Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_msgs::sensor_msgs::Imu;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_nav_nodes::ekf_node::EkfNode;
use periplus_params::Given;
use periplus_tf_ros::{pose, transform};

const TICK_NS: i64 = 20_000_000;
/// Half a metre in a second, one radian in five.
const SPEED_MPS: f64 = 0.5;
const RATE_RADPS: f64 = 0.2;

const VX: &str =
    "false false false false false false true true false false false false false false false";
const VYAW: &str =
    "false false false false false false false false false false false true false false false";
const XY: &str =
    "true true false false false false false false false false false false false false false";

struct Scene {
    graph: Graph,
    _ekf: EkfNode,
    wheels: Publisher<Odometry>,
    imu: Publisher<Imu>,
    tf: Publisher<TFMessage>,
    _fixed: Publisher<TFMessage>,
    odometry: Mailbox<Odometry>,
    heard: Mailbox<TFMessage>,
    health: Mailbox<DiagnosticArray>,
    start: Publisher<PoseWithCovarianceStamped>,
    acceleration: Mailbox<AccelWithCovarianceStamped>,
    node: Node,
}

fn scene(more: &[(&str, &str)], with_imu_frame: bool) -> Scene {
    scene_in(Graph::new(), more, with_imu_frame)
}

fn scene_in(graph: Graph, more: &[(&str, &str)], with_imu_frame: bool) -> Scene {
    let mut given = vec![
        ("odom0", "wheels"),
        ("odom0_config", VX),
        ("imu0", "imu"),
        ("imu0_config", VYAW),
        ("two_d_mode", "true"),
    ];
    given.extend(more);
    let mut findings = Diagnostics::new();
    let given = given.iter().map(|(name, text)| Given::new(name, *text));
    let (settings, values) = Settings::read(given, &mut findings);
    assert!(findings.is_empty(), "{findings:?}");
    let node = graph.node(NodeSettings::new("ekf_filter_node")).unwrap();
    let ekf = EkfNode::at(node, settings, values).unwrap();
    let node = graph.node(NodeSettings::new("robot")).unwrap();
    let fixed = node.publisher("/tf_static", Qos::latched(1)).unwrap();
    if with_imu_frame {
        let hangs = Pose::from_xyz_rpy([0.1, 0.0, 0.2], Rpy { roll: PI, pitch: 0.0, yaw: 0.0 });
        fixed.publish(transform("base_link", "imu_link", hangs, 0));
    }
    Scene {
        wheels: node.publisher("wheels", Qos::reliable(10)).unwrap(),
        imu: node.publisher("imu", Qos::sensor_data()).unwrap(),
        tf: node.publisher("/tf", Qos::reliable(100)).unwrap(),
        _fixed: fixed,
        odometry: node.mailbox("odometry/filtered", Qos::reliable(10)).unwrap(),
        heard: node.mailbox("/tf", Qos::reliable(100)).unwrap(),
        health: node.mailbox("/diagnostics", Qos::reliable(10)).unwrap(),
        start: node.publisher("set_pose", Qos::reliable(1)).unwrap(),
        acceleration: node.mailbox("accel/filtered", Qos::reliable(10)).unwrap(),
        node,
        graph,
        _ekf: ekf,
    }
}

impl Scene {
    fn drive(&self, seconds: f64) {
        for _ in 0..(seconds * 50.0) as i64 {
            let now_ns = self.graph.now_ns() + TICK_NS;
            self.graph.advance_to(now_ns);
            let mut wheels = Odometry {
                header: Header::at(now_ns, "odom"),
                child_frame_id: "base_link".into(),
                ..Odometry::default()
            };
            wheels.twist.twist.linear.x = SPEED_MPS;
            // Wheels that slip in turns: this component is not used.
            wheels.twist.twist.angular.z = 3.0 * RATE_RADPS;
            wheels.pose.pose.orientation.w = 1.0;
            (0..6).for_each(|row| wheels.twist.covariance[row * 7] = 1e-4);
            self.wheels.publish(wheels);
            let mut imu = Imu { header: Header::at(now_ns, "imu_link"), ..Imu::default() };
            imu.orientation_covariance[0] = -1.0;
            imu.angular_velocity.z = -RATE_RADPS;
            (0..3).for_each(|row| imu.angular_velocity_covariance[row * 4] = 1e-6);
            self.imu.publish(imu);
        }
        self.graph.advance_to(self.graph.now_ns() + TICK_NS);
    }

    fn latest(&self) -> Arc<Odometry> {
        self.odometry.latest().expect("an estimate")
    }
}

#[test]
fn wheels_and_imu_drive_a_circle() {
    let scene = scene(&[], true);
    scene.drive(5.0);
    let told = scene.latest();
    assert_eq!(
        (told.header.frame_id.as_str(), told.child_frame_id.as_str()),
        ("odom", "base_link")
    );
    // A radius of 2.5 m; from the first message on, so a hair less than five seconds.
    let time_s = (told.header.stamp.ns() - TICK_NS) as f64 * 1e-9;
    let angle = RATE_RADPS * time_s;
    let expected = (2.5 * libm::sin(angle), 2.5 * (1.0 - libm::cos(angle)));
    let place = &told.pose.pose.position;
    let off_m = libm::hypot(place.x - expected.0, place.y - expected.1);
    assert!(off_m < 0.02, "{place:?} instead of {expected:?}");
    assert!((told.twist.twist.angular.z - RATE_RADPS).abs() < 1e-3);
    assert!(place.z.abs() < 1e-9);
    let told_tf = scene.heard.latest().unwrap();
    let tf = &told_tf.transforms[0];
    assert_eq!((tf.header.frame_id.as_str(), tf.child_frame_id.as_str()), ("odom", "base_link"));
    assert_eq!(tf.transform.translation.x, place.x);
    assert_eq!(scene.health.latest().unwrap().status[0].level, DiagnosticStatus::OK);
}

#[test]
fn an_imu_without_a_frame_is_told_and_the_wheels_go_on() {
    let scene = scene(&[], false);
    scene.drive(2.0);
    assert!(scene.latest().pose.pose.position.x > 0.9);
    let health = scene.health.latest().unwrap();
    let status = &health.status[0];
    assert!(
        status.level == DiagnosticStatus::ERROR && status.message.contains("imu_link"),
        "{status:?}"
    );
}

#[test]
fn somebody_says_where_it_is() {
    let scene = scene(&[], true);
    scene.drive(1.0);
    let mut start = PoseWithCovarianceStamped {
        header: Header { stamp: Time::of_ns(scene.graph.now_ns()), frame_id: "odom".into() },
        ..PoseWithCovarianceStamped::default()
    };
    start.pose.pose = pose(Pose::from_xyz(10.0, 0.0, 0.0));
    scene.start.publish(start);
    scene.drive(0.2);
    assert!((scene.latest().pose.pose.position.x - 10.1).abs() < 0.1);
}

#[test]
fn in_the_map_it_tells_what_is_left_to_odometry() {
    let more = [("world_frame", "map"), ("odom0_config", XY)];
    let scene = scene(&more, true);
    // Odometry has 3 m ahead, the wheels' pose in the map 0: the map is 3 m behind.
    scene.tf.publish(transform("map", "nowhere", Pose::IDENTITY, TICK_NS));
    scene.tf.publish(transform("odom", "base_link", Pose::from_xyz(3.0, 0.0, 0.0), TICK_NS));
    let mut wheels = Odometry { header: Header::at(TICK_NS, "map"), ..Odometry::default() };
    wheels.pose.pose.orientation.w = 1.0;
    drop(scene.heard.drain());
    scene.graph.advance_to(TICK_NS);
    scene.wheels.publish(wheels);
    scene.graph.advance_to(5 * TICK_NS);
    let all = scene.heard.drain();
    let of_map = all.iter().flat_map(|it| &it.transforms).find(|it| it.child_frame_id == "odom");
    let tf = of_map.expect("map -> odom");
    assert_eq!((tf.header.frame_id.as_str(), tf.transform.translation.x), ("map", -3.0));
}

#[test]
fn parameters_that_are_read_at_startup_are_refused_later() {
    let scene = scene(&[], true);
    let double = |name: &str, double_value: f64| Parameter {
        name: name.into(),
        value: ParameterValue {
            r#type: ParameterType::PARAMETER_DOUBLE,
            double_value,
            ..ParameterValue::default()
        },
    };
    let flag = |name: &str, bool_value: bool| Parameter {
        name: name.into(),
        value: ParameterValue {
            r#type: ParameterType::PARAMETER_BOOL,
            bool_value,
            ..ParameterValue::default()
        },
    };
    let parameters = vec![
        double("frequency", 5.0),
        flag("publish_acceleration", true),
        double("frequency", 30.0),
        flag("publish_tf", false),
    ];
    let client = scene.node.client::<SetParameters>("/ekf_filter_node/set_parameters").unwrap();
    let pending = client.call(SetParametersRequest { parameters });
    scene.graph.settle();
    let response = pending.take().unwrap().unwrap();
    let reasons: Vec<&str> = response.results.iter().map(|it| it.reason.as_str()).collect();
    assert_eq!(
        reasons,
        [
            "`frequency` is read when the node starts; restart the node",
            "`publish_acceleration` is read when the node starts; restart the node",
            "",
            "",
        ]
    );
    drop(scene.heard.drain());
    scene.drive(1.0);
    assert!(scene.heard.drain().is_empty(), "`publish_tf` is false");
}

#[test]
fn arguments_apply_to_parameters_that_are_read_at_startup() {
    let words = "-p frequency:=5.0 -p publish_acceleration:=true".split(' ').map(str::to_owned);
    let words: Vec<String> = words.collect();
    let mut findings = Diagnostics::new();
    let no_file = &mut |_: &std::path::Path| Err(ParameterFileError::Missing);
    let arguments = Arguments::read(&words, &mut SourceMap::new(), &mut findings, no_file);
    assert!(findings.is_empty(), "{findings:?}");
    let graph = Graph::new();
    graph.set_arguments(arguments);
    let scene = scene_in(graph, &[], true);
    scene.drive(1.0);
    let estimates = scene.odometry.drain().len();
    assert!((4..=6).contains(&estimates), "{estimates} estimates in a second at 5 Hz");
    assert!(scene.acceleration.latest().is_some(), "accelerations on accel/filtered");
}
