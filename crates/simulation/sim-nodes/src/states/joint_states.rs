//! Joint states from the simulation's state.

use periplus_diagnostics::Diagnostics;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::sensor_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_params::ParamValue;
use periplus_physics::{JointId, PhysicsWorld};
use periplus_plugin_specs::Family;

use crate::drives::{BuildContext, RateTimer};
use crate::{
    Device, DeviceContext, DeviceState, SenseContext, device_node, gz_topic, publisher_qos,
};

/// Publishing rate of the joints of a robot without a publisher plugin \[Hz\].
const DEFAULT_RATE_HZ: f64 = 50.0;

/// Joints with their names and publisher.
pub(crate) struct JointStates {
    joints: Vec<(String, JointId)>,
    publisher: Publisher<sensor_msgs::JointState>,
    with_efforts: bool,
}

impl JointStates {
    /// Creates the publisher of a drive's wheels, on `joint_states`.
    pub(crate) fn of_wheels(
        context: &BuildContext<'_>,
        node: &Node,
        joints: &[JointId],
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let world = context.setting.world;
        let named = joints.iter().map(|&joint| {
            let name = world.joint_name(joint).unwrap_or_default();
            (context.inner_name(name), joint)
        });
        let qos = publisher_qos(&context.plugin.ros, "joint_states", Qos::reliable(1000));
        let publisher = context.accept(node.publisher("joint_states", qos), diagnostics)?;
        Some(Self { joints: named.collect(), publisher, with_efforts: false })
    }

    pub(crate) fn has_subscribers(&self) -> bool {
        self.publisher.is_heard()
    }

    pub(crate) fn publish(&self, world: &PhysicsWorld, time_ns: i64) {
        if !self.has_subscribers() {
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
/// `gz-sim-joint-state-publisher-system`, and the default of a robot without any of them.
pub struct JointStatePublisher {
    name: String,
    states: JointStates,
    publish_timer: RateTimer,
}

/// Builds the publisher of a plugin. Missing joints are errors, the others are published; without
/// names all movable joints are.
///
/// Source: `gazebo_ros_joint_state_publisher.cpp` of `gazebo_ros_pkgs`: position and velocity on
/// `joint_states`, QoS of depth 1000. gz-sim 8, `JointStatePublisher.cc`: effort too, on
/// `/world/<w>/model/<m>/joint_state`, each step.
pub(crate) fn plugin(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<JointStatePublisher> {
    let names = match context.plugin.known.family {
        Family::ClassicRos1 => context
            .text("jointName")
            .split(',')
            .map(|name| name.trim().to_owned())
            .filter(|name| !name.is_empty())
            .map(|name| (name, context.plugin.values.origin("jointName")))
            .collect(),
        _ => named(context, "joint_name"),
    };
    let mut joints = Vec::new();
    for (name, origin) in &names {
        if let Some(joint) = context.joint_named(name, *origin, diagnostics) {
            joints.push((name.clone(), joint));
        }
    }
    if names.is_empty() {
        joints = moving(context);
    }
    if joints.is_empty() {
        return None;
    }
    let node = context.node(diagnostics)?;
    let (topic, rate_hz, depth) = match context.plugin.known.family {
        Family::Gz => {
            let world = &context.setting.scene.name;
            let fallback = format!("/world/{world}/model/{}/joint_state", context.model_name());
            let topic = gz_topic(&context.given_text("topic").unwrap_or(fallback));
            (topic, context.number("update_rate"), 10)
        }
        Family::ClassicRos1 => ("joint_states".to_owned(), context.number("updateRate"), 1000),
        _ => ("joint_states".to_owned(), context.number("update_rate"), 1000),
    };
    let qos = publisher_qos(&context.plugin.ros, &topic, Qos::reliable(depth));
    let publisher = context.accept(node.publisher(&topic, qos), diagnostics)?;
    let with_efforts = context.plugin.known.family == Family::Gz;
    Some(JointStatePublisher {
        name: context.name(),
        states: JointStates { joints, publisher, with_efforts },
        publish_timer: RateTimer::for_publisher(rate_hz, context.setting.start_ns),
    })
}

fn named(
    context: &BuildContext<'_>,
    parameter: &str,
) -> Vec<(String, periplus_diagnostics::Origin)> {
    let values = context.plugin.values.all(parameter).into_iter();
    let names = values.filter_map(|(value, origin)| match value {
        ParamValue::Text(name) if !name.trim().is_empty() => Some((name.trim().to_owned(), origin)),
        _ => None,
    });
    names.collect()
}

/// Returns the movable joints of a plugin's model, by their names in it.
fn moving(context: &BuildContext<'_>) -> Vec<(String, JointId)> {
    let DeviceContext { world, model, .. } = *context.setting;
    let within = context.setting.scoped(context.site, "");
    let joints = world.joints(model).filter_map(|joint| {
        let name = world.joint_name(joint)?.strip_prefix(&within)?;
        world.axis_state(joint)?;
        Some((name.to_owned(), joint))
    });
    joints.collect()
}

impl JointStatePublisher {
    /// Creates the publisher of a robot with movable joints but no publisher plugin: all joints, at
    /// 50 Hz, on `joint_states` of its namespace. `None` if no joint is movable.
    ///
    /// # Errors
    /// When the node's names are invalid.
    pub fn fallback(setting: &DeviceContext<'_>) -> Result<Option<Self>, GraphError> {
        let world = setting.world;
        let joints: Vec<(String, JointId)> = world
            .joints(setting.model)
            .filter(|&joint| world.axis_state(joint).is_some())
            .filter_map(|joint| Some((world.joint_name(joint)?.to_owned(), joint)))
            .collect();
        if joints.is_empty() {
            return Ok(None);
        }
        let node = device_node(setting, &format!("{}_joint_states", setting.model_name))?;
        let publisher = node.publisher("joint_states", Qos::reliable(10))?;
        Ok(Some(Self {
            name: format!("{}::joint_states", setting.model_name),
            states: JointStates { joints, publisher, with_efforts: true },
            publish_timer: RateTimer::for_publisher(DEFAULT_RATE_HZ, setting.start_ns),
        }))
    }

    /// Returns the published topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        self.states.publisher.topic()
    }
}

impl Device for JointStatePublisher {
    fn name(&self) -> &str {
        &self.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let now_ns = moment.time_ns();
        if self.publish_timer.due(now_ns) {
            self.states.publish(moment.world, now_ns);
        }
    }

    fn next_ns(&self) -> Option<i64> {
        self.publish_timer.next_ns().filter(|_| self.states.has_subscribers())
    }

    fn reset(&mut self, time_ns: i64) {
        self.publish_timer.restart(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.publish_timer.clone())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.publish_timer)
    }
}
