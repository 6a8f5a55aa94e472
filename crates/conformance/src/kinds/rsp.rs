//! The rate of `robot_state_publisher`.

use periplus_graph::{Graph, GraphError, NodeSettings, Qos};
use periplus_msgs::sensor_msgs::JointState;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_nodes::states::{RobotStateOptions, RobotStatePublisher};
use periplus_scene::{Axis, Joint, JointKind, Link, Model};

use super::Setting;
use crate::{Case, Differences, Unreadable};

/// Which joint states lead to transforms: a robot with one joint, told its state at each stamp.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let options = RobotStateOptions {
        publish_frequency_hz: given.get("publish_frequency")?.number()?,
        ignore_timestamp: given.find("ignore_timestamp").map_or(Ok(false), |it| it.truth())?,
        ..RobotStateOptions::default()
    };
    let stamps_ns: Vec<i64> = given
        .get("stamps")?
        .numbers()?
        .iter()
        .map(|stamp_s| (stamp_s * 1e9).round() as i64)
        .collect();
    let expected = expect.get("published")?.each(|it| it.truth())?;
    match told(options, &stamps_ns) {
        Ok(told) => differences.same("told", &told, &expected),
        Err(error) => differences.push(error.to_string()),
    }
    Ok(())
}

fn told(options: RobotStateOptions, stamps_ns: &[i64]) -> Result<Vec<bool>, GraphError> {
    let mut robot = Model::new("robot");
    robot.links = vec![Link::new("base"), Link::new("wheel")];
    let mut joint = Joint::new("turn", JointKind::Continuous, "base", "wheel");
    joint.axis = Some(Axis::default());
    robot.joints.push(joint);
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("robot_state_publisher"))?;
    let _publisher = RobotStatePublisher::new(node, "<robot name='robot'/>", &robot, options)?;
    let user = graph.node(NodeSettings::new("user"))?;
    let states = user.publisher::<JointState>("/joint_states", Qos::reliable(10))?;
    let frames = user.mailbox::<TFMessage>("/tf", Qos::reliable(100))?;
    let one = |stamp_ns: i64| {
        graph.advance_to(stamp_ns);
        states.publish(JointState {
            header: Header::at(stamp_ns, ""),
            name: vec!["turn".into()],
            position: vec![0.5],
            ..JointState::default()
        });
        graph.settle();
        frames.drain().iter().any(|message| !message.transforms.is_empty())
    };
    Ok(stamps_ns.iter().map(|&stamp_ns| one(stamp_ns)).collect())
}
