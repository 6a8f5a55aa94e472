//! Joint states from the truth.

use periplus_diagnostics::Diagnostics;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::sensor_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_params::Value;
use periplus_physics::{JointId, World};
use periplus_plugin_specs::Family;

use crate::drives::{Beat, Order};
use crate::{Device, Moment, Setting, gz_topic, plain_node, publisher_qos};

/// How often a robot without a publisher of its own tells its joints \[Hz\].
const USUAL_RATE_HZ: f64 = 50.0;

/// Joints, their names, and where they are told.
pub(crate) struct JointStates {
    joints: Vec<(String, JointId)>,
    publisher: Publisher<sensor_msgs::JointState>,
    with_efforts: bool,
}

impl JointStates {
    /// Those of a drive's wheels, on `joint_states`.
    pub(crate) fn of_wheels(
        order: &Order<'_>,
        node: &Node,
        joints: &[JointId],
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let world = order.setting.world;
        let named = joints.iter().map(|&joint| {
            let name = world.joint_name(joint).unwrap_or_default();
            (order.inner_name(name), joint)
        });
        let qos = publisher_qos(&order.plugin.ros, "joint_states", Qos::reliable(1000));
        let publisher = order.accept(node.publisher("joint_states", qos), diagnostics)?;
        Some(Self { joints: named.collect(), publisher, with_efforts: false })
    }

    pub(crate) fn is_heard(&self) -> bool {
        self.publisher.is_heard()
    }

    pub(crate) fn tell(&self, world: &World, time_ns: i64) {
        if !self.is_heard() {
            return;
        }
        let mut message =
            sensor_msgs::JointState { header: Header::at(time_ns, ""), ..Default::default() };
        for (name, joint) in &self.joints {
            let state = world.axis_state(*joint).unwrap_or_default();
            message.name.push(name.clone());
            message.position.push(state.position);
            message.velocity.push(state.velocity);
            if self.with_efforts {
                message.effort.push(state.effort);
            }
        }
        self.publisher.publish(message);
    }
}

/// Publishes joint states at a rate: `gazebo_ros_joint_state_publisher` of ROS 1 and ROS 2,
/// `gz-sim-joint-state-publisher-system`, and what a robot without any of them gets.
pub struct JointStatePublisher {
    name: String,
    states: JointStates,
    tells: Beat,
}

/// A plugin's publisher. Joints that are not there are errors, and the others are told; without
/// names all joints that move are.
///
/// Source: `gazebo_ros_joint_state_publisher.cpp` of `gazebo_ros_pkgs`: position and velocity on
/// `joint_states`, QoS of depth 1000. gz-sim 8, `JointStatePublisher.cc`: effort too, on
/// `/world/<w>/model/<m>/joint_state`, each step.
pub(crate) fn plugin(
    order: &Order<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<JointStatePublisher> {
    let names = match order.plugin.known.family {
        Family::ClassicRos1 => order
            .text("jointName")
            .split(',')
            .map(|name| name.trim().to_owned())
            .filter(|name| !name.is_empty())
            .map(|name| (name, order.plugin.values.origin("jointName")))
            .collect(),
        _ => named(order, "joint_name"),
    };
    let mut joints = Vec::new();
    for (name, origin) in &names {
        if let Some(joint) = order.joint_named(name, *origin, diagnostics) {
            joints.push((name.clone(), joint));
        }
    }
    if names.is_empty() {
        joints = moving(order);
    }
    if joints.is_empty() {
        return None;
    }
    let node = order.node(diagnostics)?;
    let (topic, rate_hz, depth) = match order.plugin.known.family {
        Family::Gz => {
            let world = &order.setting.scene.name;
            let usual = format!("/world/{world}/model/{}/joint_state", order.model_name());
            let topic = gz_topic(&order.given_text("topic").unwrap_or(usual));
            (topic, order.number("update_rate"), 10)
        }
        Family::ClassicRos1 => ("joint_states".to_owned(), order.number("updateRate"), 1000),
        _ => ("joint_states".to_owned(), order.number("update_rate"), 1000),
    };
    let qos = publisher_qos(&order.plugin.ros, &topic, Qos::reliable(depth));
    let publisher = order.accept(node.publisher(&topic, qos), diagnostics)?;
    let with_efforts = order.plugin.known.family == Family::Gz;
    Some(JointStatePublisher {
        name: order.name(),
        states: JointStates { joints, publisher, with_efforts },
        tells: Beat::telling(rate_hz, order.setting.start_ns),
    })
}

fn named(order: &Order<'_>, parameter: &str) -> Vec<(String, periplus_diagnostics::Origin)> {
    let values = order.plugin.values.all(parameter).into_iter();
    let names = values.filter_map(|(value, origin)| match value {
        Value::Text(name) if !name.trim().is_empty() => Some((name.trim().to_owned(), origin)),
        _ => None,
    });
    names.collect()
}

/// The joints with an axis in the model of a plugin, by their names there.
fn moving(order: &Order<'_>) -> Vec<(String, JointId)> {
    let Setting { world, model, .. } = *order.setting;
    let within = order.setting.scoped(order.site, "");
    let joints = world.joints(model).filter_map(|joint| {
        let name = world.joint_name(joint)?.strip_prefix(&within)?;
        world.axis_state(joint)?;
        Some((name.to_owned(), joint))
    });
    joints.collect()
}

impl JointStatePublisher {
    /// For a robot that moves joints and has no plugin that tells of them: all of them, 50 times a
    /// second, on `joint_states` of its namespace. None if no joint moves.
    ///
    /// # Errors
    /// When the names do not fit into the graph.
    pub fn usual(setting: &Setting<'_>) -> Result<Option<Self>, GraphError> {
        let world = setting.world;
        let joints: Vec<(String, JointId)> = world
            .joints(setting.model)
            .filter(|&joint| world.axis_state(joint).is_some())
            .filter_map(|joint| Some((world.joint_name(joint)?.to_owned(), joint)))
            .collect();
        if joints.is_empty() {
            return Ok(None);
        }
        let node = plain_node(setting, &format!("{}_joint_states", setting.model_name))?;
        let publisher = node.publisher("joint_states", Qos::reliable(10))?;
        Ok(Some(Self {
            name: format!("{}::joint_states", setting.model_name),
            states: JointStates { joints, publisher, with_efforts: true },
            tells: Beat::telling(USUAL_RATE_HZ, setting.start_ns),
        }))
    }

    /// The topic that it publishes.
    #[must_use]
    pub fn topic(&self) -> &str {
        self.states.publisher.topic()
    }
}

impl Device for JointStatePublisher {
    fn name(&self) -> &str {
        &self.name
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let now_ns = moment.time_ns();
        if self.tells.due(now_ns) {
            self.states.tell(moment.world, now_ns);
        }
    }

    fn next_ns(&self) -> Option<i64> {
        self.tells.next_ns().filter(|_| self.states.is_heard())
    }

    fn reset(&mut self, time_ns: i64) {
        self.tells.restart(time_ns);
    }
}
