//! `robot_state_publisher`.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, Severity, SourceMap};
use periplus_graph::{
    Actor, GraphError, Node, ParameterRejection, Parameters, Publisher, Qos, Sample,
};
use periplus_msgs::{sensor_msgs, std_msgs, tf2_msgs};
use periplus_params::{ParamValues, params};
use periplus_scene::Model;

use super::frame_tree::FrameTree;
use super::geometry::transform;
use super::odometry::TF_QOS;
use crate::{Device, DeviceContext, DeviceState, device_node};

params! {
    /// Publishes the frames of a robot from its description and its joint states.
    #[table(ROBOT_STATE_PUBLISHER, "robot_state_publisher")]
    pub struct RobotStateParams {
        /// Robot description as URDF (required).
        #[param("robot_description")]
        robot_description: Option<String>,
        /// Maximum rate of `/tf` for movable joints (default 20 Hz).
        #[param("publish_frequency", unit("Hz"), within(1e-3, 1000.0))]
        publish_frequency_hz: f64 = 20,
        /// Prefix of all frame names (default empty).
        #[param("frame_prefix")]
        frame_prefix: String = "",
        /// Accept joint states of any time stamp (default false).
        #[param("ignore_timestamp")]
        ignore_timestamp: bool = false,
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
    parameters: Parameters,
}

struct PublisherState {
    robot: Arc<PublishedRobot>,
    progress: PublishProgress,
    tf: Publisher<tf2_msgs::TFMessage>,
    description: Publisher<std_msgs::String>,
    tf_static: Publisher<tf2_msgs::TFMessage>,
}

/// Robot and parameters; replaced as a whole by a change.
struct PublishedRobot {
    tree: FrameTree,
    params: RobotStateParams,
    /// Description that was published last.
    described: Option<String>,
    /// Prefix and time of the fixed frames that were published last [ns].
    fixed: (String, i64),
}

#[derive(Clone, Debug, Default)]
struct PublishProgress {
    /// Times of the last published states by joint [ns].
    published_ns: BTreeMap<String, i64>,
    last_ns: i64,
}

/// Saved state of a [`RobotStatePublisher`].
struct SavedPublisher {
    robot: Arc<PublishedRobot>,
    progress: PublishProgress,
    values: ParamValues,
    pending: Vec<Vec<Sample>>,
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
        params: RobotStateParams,
    ) -> Result<Self, GraphError> {
        Self::of_tree(node, description.into(), FrameTree::of(model), params)
    }

    /// Creates the publisher with the frames of the URDF itself: links without inertia can move.
    ///
    /// # Errors
    /// When the text is not a URDF, or a topic of that name has another type.
    pub fn of_urdf(
        node: Node,
        description: impl Into<String>,
        params: RobotStateParams,
    ) -> Result<Self, RobotStateError> {
        let description = description.into();
        let tree = tree_of(&description).map_err(RobotStateError::Description)?;
        Self::of_tree(node, description, tree, params).map_err(RobotStateError::Graph)
    }

    fn of_tree(
        node: Node,
        description: String,
        tree: FrameTree,
        params: RobotStateParams,
    ) -> Result<Self, GraphError> {
        let described = node.publisher("robot_description", Qos::latched(1))?;
        let tf_static = node.publisher("/tf_static", Qos::latched(1))?;
        let tf = node.publisher("/tf", TF_QOS)?;
        let params = RobotStateParams { robot_description: Some(description.clone()), ..params };
        let values = params.to_values();
        described.publish(std_msgs::String { data: description });
        let now_ns = node.now_ns();
        let robot = PublishedRobot {
            tree,
            described: params.robot_description.clone(),
            fixed: (params.frame_prefix.clone(), now_ns),
            params,
        };
        let state = PublisherState {
            robot: Arc::new(robot),
            progress: PublishProgress { published_ns: BTreeMap::new(), last_ns: now_ns },
            tf,
            description: described,
            tf_static,
        };
        let mut actor = node.actor(state);
        let parameters =
            actor.parameters(values, |state, values, io| state.change(values, io.now_ns()))?;
        actor.with(|state| {
            if let Some(robot) = Arc::get_mut(&mut state.robot) {
                robot.params = RobotStateParams::from_values(&parameters.values());
                robot.fixed = (robot.params.frame_prefix.clone(), now_ns);
            }
            state.publish_fixed();
        });
        actor.subscribe::<sensor_msgs::JointState>(
            "joint_states",
            Qos::sensor_data(),
            |state, message, io| state.on_joint_states(&message, io.now_ns()),
        )?;
        Ok(Self { actor, parameters })
    }

    /// Returns the node.
    #[must_use]
    pub fn node(&self) -> &Node {
        self.actor.node()
    }

    fn save(&self) -> SavedPublisher {
        let (robot, progress) =
            self.actor.with(|state| (Arc::clone(&state.robot), state.progress.clone()));
        let (values, pending) = (self.parameters.values(), self.actor.pending());
        SavedPublisher { robot, progress, values, pending }
    }

    /// Restores a state. Description and fixed frames are published again if they differ, for late
    /// subscribers.
    fn restore(&self, saved: &SavedPublisher) {
        let has_changed = self.actor.with(|state| {
            state.progress = saved.progress.clone();
            let has_changed = !Arc::ptr_eq(&state.robot, &saved.robot);
            if has_changed {
                state.robot = Arc::clone(&saved.robot);
                state.publish_description();
                state.publish_fixed();
            }
            has_changed
        });
        if has_changed {
            for name in saved.values.names() {
                if let Some(value) = saved.values.get(&name) {
                    // The value was valid before.
                    let _ = self.parameters.set(&name, value);
                }
            }
        }
        self.actor.set_pending(&saved.pending);
    }
}

/// Reason for which a text is not a robot description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DescriptionError {
    /// The text is empty.
    Empty,
    /// The text is not a URDF with links, with the first error.
    NotRobot(String),
}

impl fmt::Display for DescriptionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "`robot_description` must not be empty"),
            Self::NotRobot(why) => write!(f, "`robot_description` is not a robot: {why}"),
        }
    }
}

impl std::error::Error for DescriptionError {}

/// Reason for which a publisher was not created.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RobotStateError {
    /// The description is not a URDF.
    Description(DescriptionError),
    /// A topic or parameter of the node has another type.
    Graph(GraphError),
}

impl fmt::Display for RobotStateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Description(error) => error.fmt(f),
            Self::Graph(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RobotStateError {}

/// Returns the frames of a URDF.
fn tree_of(description: &str) -> Result<FrameTree, DescriptionError> {
    if description.trim().is_empty() {
        return Err(DescriptionError::Empty);
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
            Err(DescriptionError::NotRobot(why.to_owned()))
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
    fn change(&mut self, values: &ParamValues, now_ns: i64) -> Result<(), ParameterRejection> {
        let params = RobotStateParams::from_values(values);
        let description = params.robot_description.clone();
        let tree = match &description {
            Some(text) if description != self.robot.described => {
                Some(tree_of(text).map_err(ParameterRejection::new)?)
            }
            Some(_) => None,
            None => return Err(ParameterRejection::new(DescriptionError::Empty)),
        };
        let has_new_tree = tree.is_some();
        let (fixed, tree) = match tree {
            Some(tree) => ((params.frame_prefix.clone(), now_ns), tree),
            None => (self.robot.fixed.clone(), self.robot.tree.clone()),
        };
        self.robot = Arc::new(PublishedRobot { tree, params, described: description, fixed });
        if has_new_tree {
            self.publish_description();
            self.publish_fixed();
        }
        Ok(())
    }

    fn publish_description(&self) {
        let data = self.robot.described.clone().unwrap_or_default();
        self.description.publish(std_msgs::String { data });
    }

    fn publish_fixed(&self) {
        let (prefix, time_ns) = &self.robot.fixed;
        self.tf_static.publish(fixed_transforms(&self.robot.tree, prefix, *time_ns));
    }

    fn on_joint_states(&mut self, message: &Arc<sensor_msgs::JointState>, now_ns: i64) {
        let sensor_msgs::JointState { header, name, position, .. } = &**message;
        if name.len() != position.len() {
            return;
        }
        let PublishedRobot { tree, params, .. } = &*self.robot;
        let PublishProgress { published_ns, last_ns } = &mut self.progress;
        if now_ns < *last_ns {
            published_ns.clear();
        }
        *last_ns = now_ns;
        let stamp_ns = header.stamp.ns();
        let oldest_ns = name.iter().map(|name| published_ns.get(name).copied().unwrap_or(0)).min();
        let Some(oldest_ns) = oldest_ns.map(|oldest_ns| oldest_ns.min(now_ns)) else { return };
        // In whole milliseconds, as in the original.
        #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
        let interval_ms = (1000.0 / params.publish_frequency_hz) as i64;
        let due_ns = oldest_ns.saturating_add(interval_ms.saturating_mul(1_000_000));
        if !params.ignore_timestamp && stamp_ns < due_ns {
            return;
        }
        let mut positions = BTreeMap::new();
        for (name, position) in name.iter().zip(position) {
            // The first position of a duplicated joint counts.
            positions.entry(name.clone()).or_insert(*position);
        }
        tree.complete(&mut positions);
        let prefix = &params.frame_prefix;
        let transforms = positions.iter().filter(|(_, position)| position.is_finite());
        let transforms = transforms.filter_map(|(joint, position)| {
            let moving = tree.moving.get(joint)?;
            let (parent, child) = (
                format!("{prefix}{}", moving.edge.parent),
                format!("{prefix}{}", moving.edge.child),
            );
            Some(transform(stamp_ns, &parent, &child, moving.parent_from_child(*position)))
        });
        self.tf.publish(tf2_msgs::TFMessage { transforms: transforms.collect() });
        for name in name {
            published_ns.insert(name.clone(), stamp_ns);
        }
    }
}

/// A [`RobotStatePublisher`] of a simulated robot, in its namespace.
pub(crate) struct RobotFrames {
    name: String,
    publisher: RobotStatePublisher,
}

impl RobotFrames {
    pub(crate) fn new(setting: &DeviceContext<'_>, description: &str) -> Result<Self, GraphError> {
        let node = device_node(setting, "robot_state_publisher")?;
        let params = RobotStateParams::default();
        let publisher = RobotStatePublisher::new(node, description, setting.root, params)?;
        let name = format!("{}::robot_state_publisher", setting.model_name);
        Ok(Self { name, publisher })
    }
}

impl Device for RobotFrames {
    fn name(&self) -> &str {
        &self.name
    }

    /// The publisher itself detects a jump back in time.
    fn reset(&mut self, _time_ns: i64) {}

    fn save(&self) -> DeviceState {
        DeviceState::new(self.publisher.save())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(saved) = saved.get() else { return false };
        self.publisher.restore(saved);
        true
    }
}
