//! `robot_state_publisher`.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, Severity, SourceMap};
use periplus_graph::{Actor, GraphError, Node, Publisher, Qos};
use periplus_msgs::{sensor_msgs, std_msgs, tf2_msgs};
use periplus_params::{ParamValue, ParamValues, Table, flag, number, text};
use periplus_scene::Model;

use super::frame_tree::FrameTree;
use super::geometry::transform;
use super::odometry::TF_QOS;
use crate::{Device, DeviceContext, device_node};

/// Parameters of [`RobotStatePublisher`].
pub static ROBOT_STATE_PUBLISHER: Table = Table {
    name: "robot_state_publisher",
    doc: "Publishes the frames of a robot from its description and its joint states.",
    parameters: &[
        text("robot_description", "Robot description as URDF (required)."),
        number(
            "publish_frequency",
            "Hz",
            "Maximum rate of `/tf` for movable joints (default 20 Hz).",
        )
        .or("20")
        .within(1e-3, 1000.0),
        text("frame_prefix", "Prefix of all frame names (default empty).").or(""),
        flag("ignore_timestamp", "Accept joint states of any time stamp (default false).")
            .or("false"),
    ],
};

/// Options of a [`RobotStatePublisher`].
#[derive(Clone, Debug, PartialEq)]
pub struct RobotStateOptions {
    /// Maximum rate of messages on `/tf`, above 0 \[Hz\].
    pub publish_frequency_hz: f64,
    /// Prefix of all frame names.
    pub frame_prefix: String,
    /// True if joint states of any time stamp are accepted.
    pub ignore_timestamp: bool,
}

impl Default for RobotStateOptions {
    fn default() -> Self {
        Self { publish_frequency_hz: 20.0, frame_prefix: String::new(), ignore_timestamp: false }
    }
}

impl RobotStateOptions {
    /// Converts to parameters of [`ROBOT_STATE_PUBLISHER`].
    fn values(&self, description: &str) -> ParamValues {
        let mut values = ROBOT_STATE_PUBLISHER.check([], None, &mut Diagnostics::new());
        values.set("robot_description", ParamValue::Text(description.to_owned()));
        values.set("publish_frequency", ParamValue::Number(self.publish_frequency_hz));
        values.set("frame_prefix", ParamValue::Text(self.frame_prefix.clone()));
        values.set("ignore_timestamp", ParamValue::Bool(self.ignore_timestamp));
        values
    }

    /// Reads parameters of [`ROBOT_STATE_PUBLISHER`].
    #[must_use]
    pub fn read(values: &ParamValues) -> Self {
        let fallback = Self::default();
        Self {
            publish_frequency_hz: values
                .number("publish_frequency")
                .unwrap_or(fallback.publish_frequency_hz),
            frame_prefix: values.text("frame_prefix").unwrap_or_default(),
            ignore_timestamp: values.flag("ignore_timestamp").unwrap_or_default(),
        }
    }
}

/// Publishes the frames of a robot: fixed ones latched on `/tf_static`, those on joints on `/tf`
/// when `joint_states` arrive, with a maximum rate. The description is latched on
/// `robot_description`.
///
/// Source: `robot_state_publisher.cpp` of ROS 2. As there, joints missing from a message are not
/// published, mimic joints are computed, and a jump back in time resets the state.
pub struct RobotStatePublisher {
    actor: Actor<PublisherState>,
}

struct PublisherState {
    tree: FrameTree,
    options: RobotStateOptions,
    described: Option<String>,
    tf: Publisher<tf2_msgs::TFMessage>,
    description: Publisher<std_msgs::String>,
    tf_static: Publisher<tf2_msgs::TFMessage>,
    /// Times of the last published states by joint [ns].
    told_ns: BTreeMap<String, i64>,
    last_ns: i64,
}

impl RobotStatePublisher {
    /// Creates the publisher as a node of a graph. `description` is the URDF. The frames are those
    /// of `model`, which was made from it: links that a simulator lumps are fixed frames.
    ///
    /// # Errors
    /// When a topic of that name has another type.
    pub fn new(
        node: Node,
        description: impl Into<String>,
        model: &Model,
        options: RobotStateOptions,
    ) -> Result<Self, GraphError> {
        Self::of_tree(node, description.into(), FrameTree::of(model), options)
    }

    /// Creates the publisher with the frames of the URDF itself: links without inertia can move.
    ///
    /// # Errors
    /// When the text is not a URDF, or a topic of that name has another type.
    pub fn of_urdf(
        node: Node,
        description: impl Into<String>,
        options: RobotStateOptions,
    ) -> Result<Self, String> {
        let description = description.into();
        let tree = tree_of(&description)?;
        Self::of_tree(node, description, tree, options).map_err(|error| error.to_string())
    }

    fn of_tree(
        node: Node,
        description: String,
        tree: FrameTree,
        options: RobotStateOptions,
    ) -> Result<Self, GraphError> {
        let described = node.publisher("robot_description", Qos::latched(1))?;
        let tf_static = node.publisher("/tf_static", Qos::latched(1))?;
        let tf = node.publisher("/tf", TF_QOS)?;
        let values = options.values(&description);
        described.publish(std_msgs::String { data: description });
        let now_ns = node.now_ns();
        let state = PublisherState {
            tree,
            options,
            described: values.text("robot_description"),
            tf,
            description: described,
            tf_static,
            told_ns: BTreeMap::new(),
            last_ns: now_ns,
        };
        let mut actor = node.actor(state);
        let parameters =
            actor.parameters(values, |state, values, io| state.change(values, io.now_ns()))?;
        actor.with(|state| {
            state.options = RobotStateOptions::read(&parameters.values());
            let prefix = &state.options.frame_prefix;
            state.tf_static.publish(fixed_transforms(&state.tree, prefix, now_ns));
        });
        actor.subscribe::<sensor_msgs::JointState>(
            "joint_states",
            Qos::sensor_data(),
            |state, message, io| state.on_joint_states(&message, io.now_ns()),
        )?;
        Ok(Self { actor })
    }

    /// Returns the node.
    #[must_use]
    pub fn node(&self) -> &Node {
        self.actor.node()
    }
}

/// Returns the frames of a URDF, or the problem.
fn tree_of(description: &str) -> Result<FrameTree, String> {
    if description.trim().is_empty() {
        return Err("`robot_description` must not be empty".into());
    }
    let mut sources = SourceMap::new();
    let file = sources.add("robot_description", description);
    let mut diagnostics = Diagnostics::new();
    let document = periplus_xml::parse(file, &sources, &mut diagnostics);
    let robot = document.and_then(|document| periplus_urdf::read(&document, &mut diagnostics));
    match robot.filter(|robot| !robot.links.is_empty()) {
        Some(robot) => Ok(FrameTree::of_robot(&robot)),
        None => {
            let wrong = diagnostics.iter().find(|it| it.severity == Severity::Error);
            let why = wrong.map_or("it has no links", |wrong| wrong.message.as_str());
            Err(format!("`robot_description` is not a robot: {why}"))
        }
    }
}

fn fixed_transforms(tree: &FrameTree, prefix: &str, now_ns: i64) -> tf2_msgs::TFMessage {
    let transforms = tree.fixed.iter().map(|edge| {
        let (parent, child) =
            (format!("{prefix}{}", edge.parent), format!("{prefix}{}", edge.child));
        transform(now_ns, &parent, &child, edge.parent_from_child)
    });
    tf2_msgs::TFMessage { transforms: transforms.collect() }
}

impl PublisherState {
    /// Applies other parameters. A changed description is published again, with its fixed frames.
    fn change(&mut self, values: &ParamValues, now_ns: i64) -> Result<(), String> {
        let description = values.text("robot_description");
        let tree = match &description {
            Some(text) if description != self.described => Some(tree_of(text)?),
            Some(_) => None,
            None => return Err("`robot_description` must not be empty".into()),
        };
        self.options = RobotStateOptions::read(values);
        if let Some(tree) = tree {
            self.tree = tree;
            self.description
                .publish(std_msgs::String { data: description.clone().unwrap_or_default() });
            self.described = description;
            let prefix = &self.options.frame_prefix;
            self.tf_static.publish(fixed_transforms(&self.tree, prefix, now_ns));
        }
        Ok(())
    }

    fn on_joint_states(&mut self, message: &Arc<sensor_msgs::JointState>, now_ns: i64) {
        let sensor_msgs::JointState { header, name, position, .. } = &**message;
        if name.len() != position.len() {
            return;
        }
        if now_ns < self.last_ns {
            self.told_ns.clear();
        }
        self.last_ns = now_ns;
        let stamp_ns = header.stamp.ns();
        let oldest_ns = name.iter().map(|name| self.told_ns.get(name).copied().unwrap_or(0)).min();
        let Some(oldest_ns) = oldest_ns.map(|oldest_ns| oldest_ns.min(now_ns)) else { return };
        // In whole milliseconds, as in the original.
        #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
        let interval_ms = (1000.0 / self.options.publish_frequency_hz) as i64;
        let due_ns = oldest_ns.saturating_add(interval_ms.saturating_mul(1_000_000));
        if !self.options.ignore_timestamp && stamp_ns < due_ns {
            return;
        }
        let mut positions = BTreeMap::new();
        for (name, position) in name.iter().zip(position) {
            // The first position of a duplicated joint counts.
            positions.entry(name.clone()).or_insert(*position);
        }
        self.tree.complete(&mut positions);
        let prefix = &self.options.frame_prefix;
        let transforms = positions.iter().filter(|(_, position)| position.is_finite());
        let transforms = transforms.filter_map(|(joint, position)| {
            let moving = self.tree.moving.get(joint)?;
            let (parent, child) = (
                format!("{prefix}{}", moving.edge.parent),
                format!("{prefix}{}", moving.edge.child),
            );
            Some(transform(stamp_ns, &parent, &child, moving.parent_from_child(*position)))
        });
        self.tf.publish(tf2_msgs::TFMessage { transforms: transforms.collect() });
        for name in name {
            self.told_ns.insert(name.clone(), stamp_ns);
        }
    }
}

/// A [`RobotStatePublisher`] of a simulated robot, in its namespace.
pub(crate) struct RobotFrames {
    name: String,
    /// Keeps the node alive.
    _publisher: RobotStatePublisher,
}

impl RobotFrames {
    pub(crate) fn new(setting: &DeviceContext<'_>, description: &str) -> Result<Self, GraphError> {
        let node = device_node(setting, "robot_state_publisher")?;
        let options = RobotStateOptions::default();
        let publisher = RobotStatePublisher::new(node, description, setting.root, options)?;
        let name = format!("{}::robot_state_publisher", setting.model_name);
        Ok(Self { name, _publisher: publisher })
    }
}

impl Device for RobotFrames {
    fn name(&self) -> &str {
        &self.name
    }

    /// The publisher itself detects a jump back in time.
    fn reset(&mut self, _time_ns: i64) {}
}
