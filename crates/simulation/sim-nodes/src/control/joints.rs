//! Joints of a model, as controllers see them.

use std::collections::BTreeMap;

use periplus_geometry::DVec3;
use periplus_physics::{JointId, LinkId, ModelId, PhysicsWorld};
use periplus_ros2_control::RollingWheel;
use periplus_scene::{Collision, Joint, JointKind, Model, Shape, carrying_link};

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
    /// True if the child link is a wheel: a round shape that turns about its own axis.
    pub(super) is_wheel: bool,
    /// Child link, and the direction of the axis in it.
    child: LinkId,
    axis_in_child: DVec3,
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
        let child = carrying_link(model, &joint.child)?;
        let axis = joint.axis.as_ref()?.direction_in_joint;
        let axis_in_child = joint.child_from_joint.rotation * axis;
        let found = ModelJoint {
            id,
            is_continuous: joint.kind == JointKind::Continuous,
            at_m: world.middle_of(context.setting.model, &[id]).unwrap_or_default(),
            wheel_radius_m: wheel_radius_m(model, &joint.child),
            child: context.setting.link(context.site, &child)?,
            is_wheel: is_wheel(model, joint, axis_in_child),
            axis_in_child,
        };
        Some((joint.name.clone(), found))
    });
    each.collect()
}

/// Returns the radius of the first cylinder or sphere of a link [m].
fn wheel_radius_m(model: &Model, link: &str) -> Option<f64> {
    let link = model.link(&carrying_link(model, link)?)?;
    link.collisions.iter().find_map(radius_m)
}

fn radius_m(collision: &Collision) -> Option<f64> {
    match collision.shape {
        Shape::Cylinder { radius_m, .. } | Shape::Sphere { radius_m } => Some(radius_m),
        _ => None,
    }
}

/// Largest distance of a wheel's shape from its axis, relative to its radius, and largest sine of the
/// angle between the axes.
const MAX_WHEEL_OFFSET_RATIO: f64 = 1e-3;

/// Returns true if the first round shape of a joint's child link turns about its own axis.
fn is_wheel(model: &Model, joint: &Joint, axis_in_child: DVec3) -> bool {
    let link = carrying_link(model, &joint.child).and_then(|link| model.link(&link).cloned());
    let round = |collision: &Collision| Some((collision.clone(), radius_m(collision)?));
    let found = link.and_then(|link| link.collisions.iter().find_map(round));
    let Some((collision, radius_m)) = found else { return false };
    let pose = collision.link_from_collision;
    let offset_m = pose.translation - joint.child_from_joint.translation;
    let is_centred = offset_m.cross(axis_in_child).length() <= MAX_WHEEL_OFFSET_RATIO * radius_m;
    let leaning = match collision.shape {
        Shape::Cylinder { .. } => (pose.rotation * DVec3::Z).cross(axis_in_child).length(),
        _ => 0.0,
    };
    is_centred && leaning <= MAX_WHEEL_OFFSET_RATIO
}

/// Maximum height of a wheel's axis direction: steeper axes are not those of wheels.
const MAX_AXIS_RISE_RATIO: f64 = 0.2;

impl ModelJoint {
    /// Returns the wheel on this joint that turns at a speed [rad/s], relative to a centre in the
    /// model [m]; `None` for a joint without a wheel, or with an axis that is not horizontal.
    pub(super) fn rolling_wheel(
        &self,
        world: &PhysicsWorld,
        model: ModelId,
        centre_m: DVec3,
        speed_rad_s: f64,
    ) -> Option<RollingWheel> {
        let radius_m = self.wheel_radius_m?;
        let model_from_world = world.model_pose(model)?.inverse();
        let world_from_child = world.link_state(self.child)?.world_from_link;
        let axis = model_from_world.rotation * (world_from_child.rotation * self.axis_in_child);
        if axis.z.abs() > MAX_AXIS_RISE_RATIO {
            return None;
        }
        let length = libm::hypot(axis.x, axis.y);
        let at = self.at_m - centre_m;
        Some(RollingWheel {
            at_m: [at.x, at.y],
            axis: [axis.x / length, axis.y / length],
            speed_m_s: speed_rad_s * radius_m,
        })
    }
}
