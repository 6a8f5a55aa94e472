//! Nodes that need a robot description from a topic.

use periplus_graph::{Mailbox, Node, Qos};
use periplus_loader::load_bytes;
use periplus_msgs::std_msgs;
use periplus_scene::Model;
use periplus_sim::Search;
use periplus_sim_nodes::states::{JointStateOptions, JointStateSource};

use super::{Done, Task, TaskContext};
use crate::bringup::report::LaunchLog;

/// `joint_state_publisher` that waits for `robot_description`.
pub(crate) struct JointStateTask {
    node: Node,
    options: JointStateOptions,
    descriptions: Mailbox<std_msgs::String>,
    made: Option<JointStateSource>,
}

impl JointStateTask {
    /// Waits for the first description.
    ///
    /// # Errors
    /// A message when it cannot start.
    pub(crate) fn new(node: Node, options: JointStateOptions) -> Result<Self, String> {
        let descriptions = node.mailbox("robot_description", Qos::latched(1));
        let descriptions = descriptions.map_err(|error| error.to_string())?;
        Ok(Self { node, options, descriptions, made: None })
    }
}

impl Task for JointStateTask {
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        let Some(description) = self.descriptions.latest() else { return Done::No };
        if self.made.is_some() {
            return Done::No;
        }
        let made = robot(&description.data, stage.search).and_then(|model| {
            JointStateSource::new(self.node.clone(), &model, self.options.clone())
                .map_err(|error| error.to_string())
        });
        match made {
            Ok(source) => self.made = Some(source),
            Err(why) => {
                let name = self.node.full_name();
                stage
                    .said
                    .push(LaunchLog::error(format!("{name}: the robot cannot be read: {why}")));
            }
        }
        Done::No
    }
}

/// Robot of a description.
///
/// # Errors
/// A message with the error of the description.
pub(crate) fn robot(text: &str, search: &Search) -> Result<Model, String> {
    if text.trim().is_empty() {
        return Err("`robot_description` is empty".into());
    }
    let mut loaded = search.with_context(false, |context| {
        load_bytes("robot_description.urdf".as_ref(), text.as_bytes(), context)
    });
    let scene = loaded.scene.take().unwrap_or_default();
    let models = scene.worlds.into_iter().flat_map(|world| world.models).chain(scene.models);
    models.into_iter().next().ok_or_else(|| {
        let finding = loaded.diagnostics.iter().next();
        finding.map_or_else(|| "it has no robot".into(), |finding| finding.message.clone())
    })
}
