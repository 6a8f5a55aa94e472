//! What a name in a call means.

use periplus_diagnostics::closest;
use periplus_geometry::{DVec3, Pose};
use periplus_physics::{LinkId, ModelId, PhysicsWorld};

use crate::Simulation;

/// So many names are told to who named nothing that is there.
const MOST_NAMES: usize = 12;

/// Frames that are the world's.
pub(super) const WORLD_FRAMES: [&str; 4] = ["", "world", "map", "/map"];

/// What has a place and moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Entity {
    Model(ModelId),
    Link(LinkId),
}

/// Where something is and how it moves, in the world's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Motion {
    /// `world_from_entity`.
    pub(super) pose: Pose,
    /// Of the frame's origin \[m/s\].
    pub(super) linear_m_s: DVec3,
    /// \[rad/s\]
    pub(super) angular_rad_s: DVec3,
}

/// A model, or a link as `model::link`.
///
/// # Errors
/// What to name instead.
pub(super) fn find(simulation: &Simulation, name: &str) -> Result<Entity, String> {
    let motion = simulation.motion();
    let model = motion.find_model(name).map(Entity::Model);
    let link = name.split_once("::").and_then(|(model, link)| {
        motion.find_link(motion.find_model(model)?, link).map(Entity::Link)
    });
    model.or(link).ok_or_else(|| unknown(simulation, name))
}

/// A link as `model::link`.
///
/// # Errors
/// What to name instead.
pub(super) fn find_link(simulation: &Simulation, name: &str) -> Result<LinkId, String> {
    match find(simulation, name)? {
        Entity::Link(link) => Ok(link),
        Entity::Model(model) => {
            let motion = simulation.motion();
            let links = motion.links(model).filter_map(|link| motion.link_name(link));
            let links: Vec<String> = links.map(|link| format!("{name}::{link}")).collect();
            Err(format!("`{name}` is a model; name one of its links: {}", listed(&links)))
        }
    }
}

/// Where the frame of a call is: an entity's, or the world's.
///
/// # Errors
/// What to name instead.
pub(super) fn frame(simulation: &Simulation, name: &str) -> Result<Motion, String> {
    if WORLD_FRAMES.contains(&name) {
        return Ok(Motion::default());
    }
    let wrong = |why| format!("the reference frame is not there: {why}; the world's is \"world\"");
    let entity = find(simulation, name).map_err(wrong)?;
    motion_of(simulation.motion(), entity).ok_or_else(|| unknown(simulation, name))
}

/// Where an entity is.
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

/// Tells that nothing has this name, and what has.
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

/// Some names, and how many more there are.
pub(super) fn listed(names: &[String]) -> String {
    if names.is_empty() {
        return "none".into();
    }
    let shown = names[..names.len().min(MOST_NAMES)].join(", ");
    match names.len().checked_sub(MOST_NAMES) {
        Some(more) if more > 0 => format!("{shown} and {more} more"),
        _ => shown,
    }
}
