//! Lookup of entities by name.

use periplus_diagnostics::closest;
use periplus_geometry::{DVec3, Pose};
use periplus_physics::{LinkId, ModelId, PhysicsWorld};

use crate::Simulation;

/// Maximum number of names listed in an error.
const MAX_NAME_COUNT: usize = 12;

/// Names of the world frame.
pub(super) const WORLD_FRAMES: [&str; 4] = ["", "world", "map", "/map"];

/// A model or link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Entity {
    Model(ModelId),
    Link(LinkId),
}

/// Pose and velocity in the world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Motion {
    /// `world_from_entity`.
    pub(super) pose: Pose,
    /// Linear velocity of the frame's origin \[m/s\].
    pub(super) linear_m_s: DVec3,
    /// Angular velocity \[rad/s\].
    pub(super) angular_rad_s: DVec3,
}

/// Finds a model, or a link by `model::link`.
///
/// # Errors
/// The unknown name and the known ones.
pub(super) fn find(simulation: &Simulation, name: &str) -> Result<Entity, String> {
    let motion = simulation.motion();
    let model = motion.find_model(name).map(Entity::Model);
    let link = name.split_once("::").and_then(|(model, link)| {
        motion.find_link(motion.find_model(model)?, link).map(Entity::Link)
    });
    model.or(link).ok_or_else(|| unknown(simulation, name))
}

/// Finds a link by `model::link`.
///
/// # Errors
/// The unknown name and the known ones.
pub(super) fn find_link(simulation: &Simulation, name: &str) -> Result<LinkId, String> {
    match find(simulation, name)? {
        Entity::Link(link) => Ok(link),
        Entity::Model(model) => {
            let motion = simulation.motion();
            let links = motion.links(model).filter_map(|link| motion.link_name(link));
            let links: Vec<String> = links.map(|link| format!("{name}::{link}")).collect();
            Err(format!("`{name}` is a model; use one of its links: {}", listed(&links)))
        }
    }
}

/// Returns the reference frame of a request: an entity's, or the world's.
///
/// # Errors
/// The unknown name and the known ones.
pub(super) fn frame(simulation: &Simulation, name: &str) -> Result<Motion, String> {
    if WORLD_FRAMES.contains(&name) {
        return Ok(Motion::default());
    }
    let wrong = |why| format!("unknown reference frame: {why}; the world's is \"world\"");
    let entity = find(simulation, name).map_err(wrong)?;
    motion_of(simulation.motion(), entity).ok_or_else(|| unknown(simulation, name))
}

/// Returns pose and velocity of an entity.
pub(super) fn motion_of(motion: &PhysicsWorld, entity: Entity) -> Option<Motion> {
    match entity {
        Entity::Link(link) => {
            let state = motion.link_state(link)?;
            Some(Motion {
                pose: state.world_from_link,
                linear_m_s: state.linear_m_s,
                angular_rad_s: state.angular_rad_s,
            })
        }
        Entity::Model(model) => {
            let pose = motion.model_pose(model)?;
            let Some(state) = motion.links(model).next().and_then(|link| motion.link_state(link))
            else {
                return Some(Motion { pose, ..Motion::default() });
            };
            let arm_m = pose.translation - state.world_from_link.translation;
            Some(Motion {
                pose,
                linear_m_s: state.linear_m_s + state.angular_rad_s.cross(arm_m),
                angular_rad_s: state.angular_rad_s,
            })
        }
    }
}

/// Returns the error for an unknown name, with the known ones.
pub(super) fn unknown(simulation: &Simulation, name: &str) -> String {
    let motion = simulation.motion();
    let models: Vec<String> = motion.models().map(|(_, name)| name.to_owned()).collect();
    let links = motion.models().flat_map(|(model, name)| {
        let links = motion.links(model).filter_map(|link| motion.link_name(link));
        links.map(move |link| format!("{name}::{link}"))
    });
    let links: Vec<String> = links.collect();
    let near = closest(name, models.iter().chain(&links).map(String::as_str));
    let near = near.map(|near| format!(", did you mean `{near}`?")).unwrap_or_default();
    format!(
        "there is no model or link `{name}`{near} (models: {}; a link is written model::link)",
        listed(&models)
    )
}

/// Lists some names, and the number of omitted ones.
pub(super) fn listed(names: &[String]) -> String {
    if names.is_empty() {
        return "none".into();
    }
    let shown = names[..names.len().min(MAX_NAME_COUNT)].join(", ");
    match names.len().checked_sub(MAX_NAME_COUNT) {
        Some(more) if more > 0 => format!("{shown} and {more} more"),
        _ => shown,
    }
}
