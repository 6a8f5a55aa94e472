//! Insertion and removal of models and lights.

use std::fmt;

use periplus_geometry::Pose;
use periplus_scene::Light;

use super::entity;
use super::reading::{Found, Reading, Search, Source, drop_namespaces, told};
use crate::{ModelInstance, Simulation};

/// A spawn request.
pub(super) struct SpawnRequest<'a> {
    pub(super) source: Source<'a>,
    /// Name; empty for that of the text, with a number appended when it is in use.
    pub(super) name: &'a str,
    /// True if a number may be appended to a requested name that is in use.
    pub(super) may_rename: bool,
    /// Namespace of all its topics; empty is none.
    pub(super) namespace: &'a str,
    pub(super) standing: SpawnPose,
    /// True if a URDF gets a `robot_state_publisher`.
    pub(super) with_frames: bool,
}

/// Pose of insertion.
pub(super) enum SpawnPose {
    /// The pose of the text, relative to this.
    AsSeenFrom(Pose),
    /// This pose, instead of that of the text.
    At(Pose),
}

/// Result of an insertion.
pub(super) struct Spawned {
    pub(super) name: String,
    /// Problems found.
    pub(super) notes: String,
}

/// Reason for which a model or light was not inserted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SpawnError {
    /// The description cannot be read.
    Unreadable(String),
    /// The name is in use or not valid.
    Name(String),
    /// The model cannot be simulated, with what was found.
    Rejected(String),
}

impl fmt::Display for SpawnError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Unreadable(reason) | Self::Name(reason) | Self::Rejected(reason)) = self;
        f.write_str(reason)
    }
}

impl std::error::Error for SpawnError {}

/// Inserts a model or light into the world.
///
/// # Errors
/// The reason of a failure.
pub(super) fn spawn(
    simulation: &mut Simulation,
    search: &Search,
    wish: &SpawnRequest<'_>,
) -> Result<Spawned, SpawnError> {
    let Reading { found, mut findings, sources } =
        search.read(&wish.source).map_err(SpawnError::Unreadable)?;
    let place = |own: Pose| match wish.standing {
        SpawnPose::AsSeenFrom(world_from_here) => world_from_here * own,
        SpawnPose::At(pose) => pose,
    };
    match found {
        Found::Light(light) => {
            let name = free_name(simulation, wish, &light.name).map_err(SpawnError::Name)?;
            let parent_from_light = place(light.parent_from_light);
            let light = Light { name: name.clone(), parent_from_light, ..*light };
            simulation.add_light(light);
            Ok(Spawned { name, notes: told(&findings, &sources) })
        }
        Found::Model { mut model, description } => {
            let name = free_name(simulation, wish, &model.name).map_err(SpawnError::Name)?;
            let namespace = wish.namespace.trim_matches('/');
            if !namespace.is_empty() {
                drop_namespaces(&mut model);
            }
            let world_from_model = place(model.parent_from_model);
            findings.append(simulation.spawn(ModelInstance {
                model: *model,
                name: name.clone(),
                namespace: format!("/{namespace}"),
                is_copy: false,
                world_from_model,
                description: description.filter(|_| wish.with_frames),
                file: 0,
            }));
            let notes = told(&findings, &sources);
            match simulation.place_of(&name) {
                Some(_) => Ok(Spawned { name, notes }),
                None => Err(SpawnError::Rejected(notes)),
            }
        }
    }
}

/// Inserts a copy of a model.
///
/// # Errors
/// The reason of a failure.
pub(super) fn copy(
    simulation: &mut Simulation,
    original: &str,
    wish: &SpawnRequest<'_>,
    world_from_model: Pose,
) -> Result<Spawned, String> {
    let place =
        simulation.place_of(original).ok_or_else(|| entity::unknown(simulation, original))?;
    let name = free_name(simulation, wish, original)?;
    let member = (*simulation.running[place].member).clone();
    let findings =
        simulation.spawn(ModelInstance { name: name.clone(), world_from_model, ..member });
    // Its positions refer to a file that is no longer available.
    let messages: Vec<&str> = findings.iter().map(|finding| finding.message.as_str()).collect();
    let notes = messages.join("\n");
    if simulation.place_of(&name).is_some() { Ok(Spawned { name, notes }) } else { Err(notes) }
}

/// Removes a model or light.
///
/// # Errors
/// The unknown name and the known ones.
pub(super) fn delete(simulation: &mut Simulation, name: &str) -> Result<(), String> {
    if simulation.delete(name) || simulation.delete_light(name) {
        return Ok(());
    }
    Err(match entity::find(simulation, name) {
        Ok(_) => {
            format!("`{name}` is a part of a model; only whole models and lights can be removed")
        }
        Err(_) => format!("{}; {}", entity::unknown(simulation, name), lights(simulation)),
    })
}

/// Lists the names of the lights.
pub(super) fn lights(simulation: &Simulation) -> String {
    let names: Vec<String> =
        simulation.scene.lights.iter().map(|light| light.name.clone()).collect();
    format!("lights: {}", entity::listed(&names))
}

/// Returns the name of a new entity: the requested one, or its own with a number as in Gazebo.
fn free_name(
    simulation: &Simulation,
    wish: &SpawnRequest<'_>,
    own: &str,
) -> Result<String, String> {
    let taken = |name: &str| {
        simulation.place_of(name).is_some()
            || simulation.scene.lights.iter().any(|light| light.name == name)
    };
    let wanted = if wish.name.is_empty() { own } else { wish.name };
    if wanted.contains("::") {
        return Err(format!("`{wanted}` is not a valid name: `::` separates scopes"));
    }
    if !taken(wanted) {
        return Ok(wanted.to_owned());
    }
    if !(wish.name.is_empty() || wish.may_rename) {
        return Err(format!("`{wanted}` exists already; delete it, or use another name"));
    }
    let numbered = (0_u64..).map(|number| format!("{wanted}_{number}"));
    numbered
        .take(usize::MAX)
        .find(|name| !taken(name))
        .ok_or_else(|| "no unused name is left".into())
}
