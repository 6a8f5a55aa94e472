//! Joints of a model, as controllers see them.

use std::collections::BTreeMap;

use periplus_geometry::DVec3;
use periplus_physics::JointId;
use periplus_scene::{Collision, JointKind, Model, Shape, carrying_link};

use crate::drives::BuildContext;

/// A joint of the plugin's model.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModelJoint {
    pub(super) id: JointId,
    /// True if it turns without limits.
    pub(super) is_continuous: bool,
    /// Position in the model [m].
    pub(super) at_m: DVec3,
    /// Radius of the wheel on it [m]; `None` if its child link has no round collision.
    pub(super) wheel_radius_m: Option<f64>,
}

/// The movable joints of the plugin's model, by name.
pub(super) fn joints_of(context: &BuildContext<'_>) -> BTreeMap<String, ModelJoint> {
    let (world, model) = (context.setting.world, context.model());
    let each = model.joints.iter().filter_map(|joint| {
        let id = world.find_joint(
            context.setting.model,
            &context.setting.scoped(context.site, &joint.name),
        )?;
        world.axis_state(id)?;
        let found = ModelJoint {
            id,
            is_continuous: joint.kind == JointKind::Continuous,
            at_m: world.middle_of(context.setting.model, &[id]).unwrap_or_default(),
            wheel_radius_m: wheel_radius_m(model, &joint.child),
        };
        Some((joint.name.clone(), found))
    });
    each.collect()
}

/// Returns the radius of the first cylinder or sphere of a link [m].
fn wheel_radius_m(model: &Model, link: &str) -> Option<f64> {
    let link = model.link(&carrying_link(model, link)?)?;
    link.collisions.iter().find_map(|collision: &Collision| match collision.shape {
        Shape::Cylinder { radius_m, .. } | Shape::Sphere { radius_m } => Some(radius_m),
        _ => None,
    })
}
