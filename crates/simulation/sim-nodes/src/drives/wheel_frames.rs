//! Transforms of wheels.

use periplus_diagnostics::Diagnostics;
use periplus_graph::{Node, Publisher};
use periplus_msgs::tf2_msgs;
use periplus_params::ParamValue;
use periplus_physics::{LinkId, PhysicsWorld};
use periplus_scene::carrying_link;

use super::build_context::{BuildContext, unscoped};
use crate::states::{TF_QOS, transform};

/// Publishes the poses of wheels relative to their parent links.
///
/// Gazebo's plugins publish the wheel's pose in the model with the parent link as frame; here it is
/// the pose in that link.
pub(crate) struct WheelFrames {
    tf: Publisher<tf2_msgs::TFMessage>,
    wheels: Vec<WheelFrame>,
}

struct WheelFrame {
    parent_frame: String,
    child_frame: String,
    parent: LinkId,
    child: LinkId,
}

impl WheelFrames {
    /// Creates the frames of the joints in some parameters. Joints on the world have no parent link
    /// and are skipped.
    pub(crate) fn new(
        context: &BuildContext<'_>,
        node: &Node,
        parameters: &[&str],
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let tf = context.accept(node.publisher("/tf", TF_QOS), diagnostics)?;
        let mut wheels = Vec::new();
        for parameter in parameters {
            for (value, _) in context.plugin.values.all(parameter) {
                if let ParamValue::Text(joint) = value {
                    wheels.extend(frame_of(context, joint.trim()));
                }
            }
        }
        Some(Self { tf, wheels })
    }

    pub(crate) fn has_subscribers(&self) -> bool {
        self.tf.is_heard()
    }

    pub(crate) fn publish(&self, world: &PhysicsWorld, time_ns: i64) {
        if !self.has_subscribers() {
            return;
        }
        let transforms = self.wheels.iter().filter_map(|wheel| {
            let parent = world.link_state(wheel.parent)?.world_from_link;
            let child = world.link_state(wheel.child)?.world_from_link;
            let parent_from_child = parent.inverse() * child;
            Some(transform(time_ns, &wheel.parent_frame, &wheel.child_frame, parent_from_child))
        });
        self.tf.publish(tf2_msgs::TFMessage { transforms: transforms.collect() });
    }
}

fn frame_of(context: &BuildContext<'_>, joint: &str) -> Option<WheelFrame> {
    let model = context.model();
    let joint = model.joint(joint)?;
    let parent = carrying_link(model, &joint.parent)?;
    let child = carrying_link(model, &joint.child)?;
    Some(WheelFrame {
        parent: context.setting.link(context.site, &parent)?,
        child: context.setting.link(context.site, &child)?,
        parent_frame: unscoped(&parent).to_owned(),
        child_frame: unscoped(&child).to_owned(),
    })
}
