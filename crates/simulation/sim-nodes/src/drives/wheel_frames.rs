//! Transforms of wheels.

use periplus_diagnostics::Diagnostics;
use periplus_graph::{Node, Publisher};
use periplus_msgs::tf2_msgs;
use periplus_params::Value;
use periplus_physics::{LinkId, World};
use periplus_scene::carrying_link;

use super::order::{Order, unscoped};
use crate::states::{TF_QOS, transform};

/// Tells where wheels are on the links that carry them.
///
/// Gazebo's plugins give the wheel's place in the model but name the parent link as its frame; here
/// it is the place on that link.
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
    /// Those of the joints that parameters name. Joints on the world have no parent link and do not
    /// show.
    pub(crate) fn new(
        order: &Order<'_>,
        node: &Node,
        parameters: &[&str],
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let tf = order.accept(node.publisher("/tf", TF_QOS), diagnostics)?;
        let mut wheels = Vec::new();
        for parameter in parameters {
            for (value, _) in order.plugin.values.all(parameter) {
                if let Value::Text(joint) = value {
                    wheels.extend(frame_of(order, joint.trim()));
                }
            }
        }
        Some(Self { tf, wheels })
    }

    pub(crate) fn is_heard(&self) -> bool {
        self.tf.is_heard()
    }

    pub(crate) fn tell(&self, world: &World, time_ns: i64) {
        if !self.is_heard() {
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

fn frame_of(order: &Order<'_>, joint: &str) -> Option<WheelFrame> {
    let model = order.model();
    let joint = model.joint(joint)?;
    let parent = carrying_link(model, &joint.parent)?;
    let child = carrying_link(model, &joint.child)?;
    Some(WheelFrame {
        parent: order.setting.link(order.site, &parent)?,
        child: order.setting.link(order.site, &child)?,
        parent_frame: unscoped(&parent).to_owned(),
        child_frame: unscoped(&child).to_owned(),
    })
}
