//! `joint_state_publisher`.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_graph::{Actor, GraphError, Node, Publisher, Qos};
use periplus_msgs::sensor_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_params::params;
use periplus_scene::{JointKind, Mimic, Model};

params! {
    /// Publishes joint states from default positions and from other topics.
    #[table(JOINT_STATE_PUBLISHER, "joint_state_publisher")]
    pub struct JointStateParams {
        /// Messages per second.
        #[param("rate", unit("Hz"), within(1e-3, 1e6))]
        rate_hz: f64 = 10,
        /// Topics of joint states that are merged (default none).
        #[param("source_list")]
        source_list: Vec<String>,
        /// Compute the positions of mimic joints (default true).
        #[param("use_mimic_tags")]
        use_mimic_tags: bool = true,
        /// Publish positions (default true).
        #[param("publish_default_positions")]
        publish_default_positions: bool = true,
        /// Publish zero velocities (default false).
        #[param("publish_default_velocities")]
        publish_default_velocities: bool = false,
        /// Publish zero efforts (default false).
        #[param("publish_default_efforts")]
        publish_default_efforts: bool = false,
    }
}

/// Options of a [`JointStateSource`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointStateOptions {
    /// Parameters.
    pub params: JointStateParams,
    /// Initial positions by joint, instead of zero \[rad or m\].
    pub zeros: BTreeMap<String, f64>,
}

/// Publishes the states of all joints of a robot on `joint_states` at a rate: zero (or the middle of
/// the limits if they exclude zero) until a source publishes a value.
///
/// Source: `joint_state_publisher.py` of ROS 2.
pub struct JointStateSource {
    actor: Actor<PublisherState>,
}

struct PublisherState {
    joints: Vec<JointEntry>,
    has_velocities: bool,
    has_efforts: bool,
    options: JointStateOptions,
    publisher: Publisher<sensor_msgs::JointState>,
}

#[derive(Clone, Debug)]
struct JointEntry {
    name: String,
    mimic: Option<Mimic>,
    position: f64,
    velocity: f64,
    effort: f64,
}

impl JointStateSource {
    /// Creates the publisher as a node of a graph, for the joints of a model.
    ///
    /// # Errors
    /// When a topic of that name has another type, or the rate is not positive.
    pub fn new(node: Node, model: &Model, options: JointStateOptions) -> Result<Self, GraphError> {
        let mut joints = Vec::new();
        collect(model, "", &options, &mut joints);
        let publisher = node.publisher("joint_states", Qos::reliable(10))?;
        let (sources, rate_hz) = (options.params.source_list.clone(), options.params.rate_hz);
        let (has_velocities, has_efforts) =
            (options.params.publish_default_velocities, options.params.publish_default_efforts);
        let state = PublisherState { joints, has_velocities, has_efforts, options, publisher };
        let mut actor = node.actor(state);
        for source in &sources {
            actor.subscribe::<sensor_msgs::JointState>(
                source,
                Qos::reliable(10),
                |state, message, _| state.on_joint_states(&message),
            )?;
        }
        #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
        let period_ns = (1e9 / rate_hz) as i64;
        actor.timer(period_ns, |state, io| state.publish(io.now_ns()))?;
        Ok(Self { actor })
    }

    /// Returns the node.
    #[must_use]
    pub fn node(&self) -> &Node {
        self.actor.node()
    }
}

/// Collects the joints with one coordinate of a model and its nested models, in order.
fn collect(model: &Model, scope: &str, options: &JointStateOptions, joints: &mut Vec<JointEntry>) {
    for joint in &model.joints {
        let kinds = [JointKind::Revolute, JointKind::Continuous, JointKind::Prismatic];
        let Some(axis) = joint.axis.as_ref().filter(|_| kinds.contains(&joint.kind)) else {
            continue;
        };
        let name = format!("{scope}{}", joint.name);
        let is_free = joint.kind == JointKind::Continuous;
        let fallback = if is_free || (axis.lower <= 0.0 && 0.0 <= axis.upper) {
            0.0
        } else {
            (axis.lower + axis.upper) / 2.0
        };
        let position = options.zeros.get(&name).copied().unwrap_or(fallback);
        let mimic = axis.mimic.clone().filter(|_| options.params.use_mimic_tags);
        joints.push(JointEntry { name, mimic, position, velocity: 0.0, effort: 0.0 });
    }
    for inner in &model.models {
        collect(inner, &format!("{scope}{}::", inner.name), options, joints);
    }
}

impl PublisherState {
    fn on_joint_states(&mut self, message: &Arc<sensor_msgs::JointState>) {
        for (index, name) in message.name.iter().enumerate() {
            let joint = self.joints.iter_mut().find(|joint| joint.name == *name);
            let Some(joint) = joint.filter(|joint| joint.mimic.is_none()) else { continue };
            if let Some(&position) = message.position.get(index) {
                joint.position = position;
            }
            if let Some(&velocity) = message.velocity.get(index) {
                joint.velocity = velocity;
                self.has_velocities = true;
            }
            if let Some(&effort) = message.effort.get(index) {
                joint.effort = effort;
                self.has_efforts = true;
            }
        }
    }

    fn publish(&self, now_ns: i64) {
        let mut message =
            sensor_msgs::JointState { header: Header::at(now_ns, ""), ..Default::default() };
        for joint in &self.joints {
            let Some((position, velocity)) = self.state_of(joint, self.joints.len()) else {
                continue;
            };
            message.name.push(joint.name.clone());
            let params = &self.options.params;
            if params.publish_default_positions || !params.source_list.is_empty() {
                message.position.push(position);
            }
            if self.has_velocities {
                message.velocity.push(velocity);
            }
            if self.has_efforts {
                message.effort.push(joint.effort);
            }
        }
        if !message.name.is_empty() {
            self.publisher.publish(message);
        }
    }

    /// Returns position and velocity; for mimic joints those derived from the leader. `None` for a
    /// cycle of mimic joints, which is longer than the number of joints.
    fn state_of(&self, joint: &JointEntry, most: usize) -> Option<(f64, f64)> {
        let Some(mimic) = &joint.mimic else { return Some((joint.position, joint.velocity)) };
        let leader = self.joints.iter().find(|other| other.name == mimic.joint)?;
        let (position, velocity) = self.state_of(leader, most.checked_sub(1)?)?;
        let Mimic { multiplier, offset, reference, .. } = mimic;
        Some((multiplier * (position - reference) + offset, multiplier * velocity))
    }
}
