//! Where the model of a plugin is.

use periplus_geometry::{DVec3, Pose};
use periplus_physics::{LinkId, LinkState, World};
use periplus_scene::Model;

use super::order::Order;
use crate::Setting;

/// A place fixed to a link: the frame of a model, of a merged link.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body {
    pub(crate) link: LinkId,
    pub(crate) link_from_body: Pose,
}

impl Body {
    /// The frame of the model that a plugin stands in, carried by its canonical link. None of a
    /// model without links.
    pub(crate) fn of_model(order: &Order<'_>) -> Option<Self> {
        Self::of(order.setting, order.model(), &order.setting.scoped(order.site, ""))
    }

    /// The frame of a model whose names have a scope before them in the outermost model.
    pub(crate) fn of(setting: &Setting<'_>, model: &Model, scope: &str) -> Option<Self> {
        let (name, model_from_link) = canonical(model)?;
        let link = setting.world.find_link(setting.model, &format!("{scope}{name}"))?;
        Some(Self { link, link_from_body: model_from_link.inverse() })
    }

    /// Where it is, and how it moves: its own origin, in world axes.
    pub(crate) fn state(&self, world: &World) -> Option<LinkState> {
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

/// The canonical link of a model, its name scoped in it, and where it is in the model.
pub(crate) fn canonical(model: &Model) -> Option<(String, Pose)> {
    if let Some(name) = &model.canonical_link {
        return place_of(model, name).map(|pose| (name.clone(), pose));
    }
    if let Some(link) = model.links.first() {
        return Some((link.name.clone(), link.model_from_link));
    }
    model.models.iter().find_map(|inner| {
        let (name, inner_from_link) = canonical(inner)?;
        Some((format!("{}::{name}", inner.name), inner.parent_from_model * inner_from_link))
    })
}

/// Where a link is in a model that has it, itself or inside.
pub(crate) fn place_of(model: &Model, scoped: &str) -> Option<Pose> {
    if let Some(link) = model.link(scoped) {
        return Some(link.model_from_link);
    }
    let (first, rest) = scoped.split_once("::")?;
    let inner = model.models.iter().find(|inner| inner.name == first)?;
    Some(inner.parent_from_model * place_of(inner, rest)?)
}
