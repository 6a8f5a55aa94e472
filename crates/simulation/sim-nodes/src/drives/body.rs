//! Body frames of models.

use periplus_geometry::{DVec3, Pose};
use periplus_physics::{LinkId, LinkState, PhysicsWorld};
use periplus_scene::Model;

use super::build_context::BuildContext;
use crate::DeviceContext;

/// A frame fixed to a link, such as that of a model or of a lumped link.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body {
    pub(crate) link: LinkId,
    pub(crate) link_from_body: Pose,
}

impl Body {
    /// Returns the frame of a plugin's model, carried by its canonical link; `None` for a model
    /// without links.
    pub(crate) fn of_model(context: &BuildContext<'_>) -> Option<Self> {
        Self::of(context.setting, context.model(), &context.setting.scoped(context.site, ""))
    }

    /// Returns the frame of a model with a scope in the outermost model.
    pub(crate) fn of(setting: &DeviceContext<'_>, model: &Model, scope: &str) -> Option<Self> {
        let (name, model_from_link) = canonical(model)?;
        let link = setting.world.find_link(setting.model, &format!("{scope}{name}"))?;
        Some(Self { link, link_from_body: model_from_link.inverse() })
    }

    /// Returns pose and velocity of the frame's origin, in world axes.
    pub(crate) fn state(&self, world: &PhysicsWorld) -> Option<LinkState> {
        let LinkState { world_from_link, linear_m_s, angular_rad_s } =
            world.link_state(self.link)?;
        let world_from_body = world_from_link * self.link_from_body;
        let arm: DVec3 = world_from_body.translation - world_from_link.translation;
        Some(LinkState {
            world_from_link: world_from_body,
            linear_m_s: linear_m_s + angular_rad_s.cross(arm),
            angular_rad_s,
        })
    }
}

/// Returns the canonical link of a model with its scoped name, and its pose in the model.
pub(crate) fn canonical(model: &Model) -> Option<(String, Pose)> {
    if let Some(name) = &model.canonical_link {
        return link_pose(model, name).map(|pose| (name.clone(), pose));
    }
    if let Some(link) = model.links.first() {
        return Some((link.name.clone(), link.model_from_link));
    }
    model.models.iter().find_map(|inner| {
        let (name, inner_from_link) = canonical(inner)?;
        Some((format!("{}::{name}", inner.name), inner.parent_from_model * inner_from_link))
    })
}

/// Returns the pose of a link in a model that contains it, directly or nested.
pub(crate) fn link_pose(model: &Model, scoped: &str) -> Option<Pose> {
    if let Some(link) = model.link(scoped) {
        return Some(link.model_from_link);
    }
    let (first, rest) = scoped.split_once("::")?;
    let inner = model.models.iter().find(|inner| inner.name == first)?;
    Some(inner.parent_from_model * link_pose(inner, rest)?)
}
