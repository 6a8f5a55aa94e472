//! `robot_state_publisher` and `joint_state_publisher` as separate nodes.

use std::sync::Arc;

use periplus_graph::{Graph, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rcl_interfaces::{
    Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_msgs::{sensor_msgs, std_msgs, tf2_msgs};
use periplus_scene::{Axis, Joint, JointKind, Link, Mimic, Model, Pose};
use periplus_sim_nodes::states::{
    JointStateOptions, JointStateParams, JointStateSource, RobotStateParams, RobotStatePublisher,
};

/// A gripper that slides, a finger that mimics it with a factor of -2, and a fixed light.
fn model() -> Model {
    let link = |name: &str, x: f64| Link {
        model_from_link: Pose::from_xyz(x, 0.0, 0.0),
        ..Link::new(name)
    };
    let mut model = Model::new("arm");
    model.links =
        vec![link("base", 0.0), link("hand", 1.0), link("finger", 2.0), link("lamp", 3.0)];
    let slide = |name: &str, parent: &str, child: &str, mimic: Option<Mimic>| Joint {
        axis: Some(Axis { lower: 0.2, upper: 0.6, mimic, ..Axis::default() }),
        ..Joint::new(name, JointKind::Prismatic, parent, child)
    };
    let follow = Mimic {
        joint: "reach".into(),
        axis: "axis".into(),
        multiplier: -2.0,
        offset: 0.1,
        reference: 0.0,
    };
    model.joints = vec![
        slide("reach", "base", "hand", None),
        slide("grip", "hand", "finger", Some(follow)),
        Joint::new("bolt", JointKind::Fixed, "base", "lamp"),
    ];
    model
}

struct Ears {
    graph: Graph,
    tf: Mailbox<tf2_msgs::TFMessage>,
    states: Publisher<sensor_msgs::JointState>,
    node: Node,
}

fn ears() -> Ears {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("ear")).unwrap();
    let tf = node.mailbox("/tf", Qos::reliable(100)).unwrap();
    let states = node.publisher("/joint_states", Qos::reliable(10)).unwrap();
    Ears { graph, tf, states, node }
}

fn state(time_ms: i64, reach: f64) -> sensor_msgs::JointState {
    let mut state = sensor_msgs::JointState::default();
    state.header.stamp = Time::of_ns(time_ms * 1_000_000);
    state.name = vec!["reach".into()];
    state.position = vec![reach];
    state
}

#[test]
fn frames_come_with_joint_states_at_20_hertz_at_most() {
    let Ears { graph, tf, states, node } = ears();
    let publisher = graph.node(NodeSettings::new("robot_state_publisher")).unwrap();
    let options = RobotStateParams { frame_prefix: "r1/".into(), ..Default::default() };
    let _publisher = RobotStatePublisher::new(publisher, "<robot/>", &model(), options).unwrap();
    // Late as we are, description and fixed frames are there.
    let fixed: Mailbox<tf2_msgs::TFMessage> = node.mailbox("/tf_static", Qos::latched(1)).unwrap();
    let fixed = fixed.latest().unwrap();
    assert_eq!(fixed.transforms.len(), 1);
    let lamp = &fixed.transforms[0];
    assert_eq!((&*lamp.header.frame_id, &*lamp.child_frame_id), ("r1/base", "r1/lamp"));
    assert_eq!(lamp.transform.translation.x, 3.0);
    let text: Mailbox<std_msgs::String> =
        node.mailbox("/robot_description", Qos::latched(1)).unwrap();
    assert_eq!(text.latest().unwrap().data, "<robot/>");

    let mut count = 0;
    for step in 1..=100 {
        graph.advance_to(step * 10_000_000);
        states.publish(state(step * 10, 0.3));
        graph.settle();
        count += tf.drain().len();
    }
    // Every 50 ms of a second.
    assert_eq!(count, 20);
    graph.advance_to(1_100_000_000);
    states.publish(state(1100, 0.5));
    graph.settle();
    let last = tf.latest().unwrap();
    let found: Vec<(&str, &str, f64)> = last
        .transforms
        .iter()
        .map(|one| {
            let at = &one.transform.translation;
            (&*one.header.frame_id, &*one.child_frame_id, at.z)
        })
        .collect();
    // The finger is 1 m ahead of the hand, and 2 * 0.5 - 0.1 m below.
    assert_eq!(found, [("r1/hand", "r1/finger", -0.9), ("r1/base", "r1/hand", 0.5)]);
    assert_eq!(last.transforms[0].header.stamp, Time::of_ns(1_100_000_000));
}

#[test]
fn states_that_make_no_sense_are_passed_over() {
    let Ears { graph, tf, states, .. } = ears();
    let publisher = graph.node(NodeSettings::new("robot_state_publisher")).unwrap();
    let options = RobotStateParams::default();
    let _publisher = RobotStatePublisher::new(publisher, "", &model(), options).unwrap();
    graph.advance_to(1_000_000_000);
    states.publish(sensor_msgs::JointState { position: Vec::new(), ..state(1000, 0.0) });
    graph.settle();
    assert!(tf.latest().is_none());
    states.publish(state(1000, f64::NAN));
    graph.settle();
    assert_eq!(tf.latest().unwrap().transforms.len(), 0);
    // Old states are passed over until time itself goes back.
    states.publish(state(900, 0.3));
    graph.settle();
    assert!(tf.latest().is_none());
    graph.jump_to(500_000_000);
    states.publish(state(500, 0.3));
    graph.settle();
    assert!(tf.latest().is_some());
}

const ARM: &str = r#"<robot name="arm">
  <link name="base"/><link name="upper"/><link name="plate"/>
  <joint name="turn" type="continuous">
    <parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="mount" type="fixed"><parent link="base"/><child link="plate"/></joint>
</robot>"#;

#[test]
fn links_need_no_inertia_and_another_description_is_taken_at_run_time() {
    let Ears { graph, tf, states, node } = ears();
    let publisher = graph.node(NodeSettings::new("robot_state_publisher")).unwrap();
    let options = RobotStateParams::default();
    let _publisher = RobotStatePublisher::of_urdf(publisher, ARM, options).unwrap();
    let frames = |tf: &Mailbox<tf2_msgs::TFMessage>| -> Vec<String> {
        let last = tf.latest().unwrap();
        last.transforms.iter().map(|one| one.child_frame_id.clone()).collect()
    };
    let fixed: Mailbox<tf2_msgs::TFMessage> = node.mailbox("/tf_static", Qos::latched(1)).unwrap();
    assert_eq!(frames(&fixed), ["plate"]);
    graph.advance_to(1_000_000_000);
    let turned = |time_ms: i64| sensor_msgs::JointState {
        name: vec!["turn".into()],
        position: vec![1.0],
        ..state(time_ms, 0.0)
    };
    states.publish(turned(1000));
    graph.settle();
    assert_eq!(frames(&tf), ["upper"]);

    let set = |name: &str, text: &str| {
        let value = ParameterValue {
            r#type: ParameterType::PARAMETER_STRING,
            string_value: text.to_owned(),
            ..ParameterValue::default()
        };
        let parameters = vec![Parameter { name: name.to_owned(), value }];
        let client = node.client::<SetParameters>("/robot_state_publisher/set_parameters").unwrap();
        let answer = client.call(SetParametersRequest { parameters });
        graph.settle();
        answer.take().unwrap().unwrap().results[0].clone()
    };
    assert!(!set("robot_description", "").successful);
    let refused = set("robot_description", "<robot name='r'/>");
    assert!(refused.reason.contains("is not a robot"), "{}", refused.reason);
    assert!(set("frame_prefix", "left/").successful);
    let other = ARM.replace("plate", "table").replace("upper", "lower");
    assert!(set("robot_description", &other).successful);
    assert_eq!(frames(&fixed), ["left/table"]);
    let text: Mailbox<std_msgs::String> =
        node.mailbox("/robot_description", Qos::latched(1)).unwrap();
    assert_eq!(text.latest().unwrap().data, other);
    graph.advance_to(2_000_000_000);
    states.publish(turned(2000));
    graph.settle();
    assert_eq!(frames(&tf), ["left/lower"]);
}

#[test]
fn default_joint_states_and_sources() {
    let Ears { graph, node, .. } = ears();
    let options = JointStateOptions {
        params: JointStateParams { source_list: vec!["gripper".into()], ..Default::default() },
        ..Default::default()
    };
    let source = graph.node(NodeSettings::new("joint_state_publisher")).unwrap();
    let _source = JointStateSource::new(source, &model(), options).unwrap();
    let heard: Mailbox<sensor_msgs::JointState> =
        node.mailbox("/joint_states", Qos::reliable(100)).unwrap();
    graph.advance_to(1_000_000_000);
    let messages = heard.drain();
    assert_eq!(messages.len(), 10);
    let last: &Arc<sensor_msgs::JointState> = &messages[9];
    assert_eq!(last.name, ["reach", "grip"]);
    // Zero is outside 0.2 to 0.6: the middle; and what follows it.
    let error: f64 = (last.position[0] - 0.4).abs() + (last.position[1] + 0.7).abs();
    assert!(error < 1e-12 && last.velocity.is_empty(), "{last:?}");
    let gripper = node.publisher("/gripper", Qos::reliable(10)).unwrap();
    gripper.publish(sensor_msgs::JointState { velocity: vec![0.25], ..state(0, 0.3) });
    graph.advance_to(1_100_000_000);
    let last = heard.latest().unwrap();
    let error = (last.position[0] - 0.3).abs() + (last.position[1] + 0.5).abs();
    assert!(error < 1e-12, "{last:?}");
    assert_eq!(last.velocity, [0.25, -0.5]);
    assert_eq!(last.header.stamp, Time::of_ns(1_100_000_000));
}
