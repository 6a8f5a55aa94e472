//! Models and lights come and go.

use periplus_geometry::Pose;
use periplus_scene::Light;

use super::entity;
use super::reading::{Found, Reading, Search, Source, drop_namespaces, told};
use crate::{Member, Simulation};

/// What is to come.
pub(super) struct Wish<'a> {
    pub(super) source: Source<'a>,
    /// Empty: as in the text, with a number when that is taken.
    pub(super) name: &'a str,
    /// Whether a number may be put behind a wanted name that is taken.
    pub(super) may_rename: bool,
    /// Of all its topics; empty is none.
    pub(super) namespace: &'a str,
    pub(super) standing: Standing,
    /// Whether a robot of a URDF tells where its links are.
    pub(super) with_frames: bool,
}

/// Where it is to stand.
pub(super) enum Standing {
    /// At the pose of the text, as seen from here.
    AsSeenFrom(Pose),
    /// Here, whatever the text says.
    At(Pose),
}

/// What came.
pub(super) struct Spawned {
    pub(super) name: String,
    /// What was found wrong with it.
    pub(super) notes: String,
}

/// Puts a model or light into the world.
///
/// # Errors
/// Why it is not there.
pub(super) fn spawn(
    simulation: &mut Simulation,
    search: &Search,
    wish: &Wish<'_>,
) -> Result<Spawned, String> {
    let Reading { found, mut findings, sources } = search.read(&wish.source)?;
    let place = |own: Pose| match wish.standing {
        Standing::AsSeenFrom(world_from_here) => world_from_here * own,
        Standing::At(pose) => pose,
    };
    match found {
        Found::Light(light) => {
            let name = free_name(simulation, wish, &light.name)?;
            let parent_from_light = place(light.parent_from_light);
            let light = Light { name: name.clone(), parent_from_light, ..*light };
            simulation.add_light(light);
            Ok(Spawned { name, notes: told(&findings, &sources) })
        }
        Found::Model { mut model, description } => {
            let name = free_name(simulation, wish, &model.name)?;
            let namespace = wish.namespace.trim_matches('/');
            if !namespace.is_empty() {
                drop_namespaces(&mut model);
            }
            let world_from_model = place(model.parent_from_model);
            findings.append(simulation.spawn(Member {
                model: *model,
                name: name.clone(),
                namespace: format!("/{namespace}"),
                world_from_model,
                description: description.filter(|_| wish.with_frames),
                file: 0,
            }));
            let notes = told(&findings, &sources);
            match simulation.place_of(&name) {
                Some(_) => Ok(Spawned { name, notes }),
                None => Err(notes),
            }
        }
    }
}

/// Puts a copy of a model into the world.
///
/// # Errors
/// Why it is not there.
pub(super) fn copy(
    simulation: &mut Simulation,
    original: &str,
    wish: &Wish<'_>,
    world_from_model: Pose,
) -> Result<Spawned, String> {
    let place =
        simulation.place_of(original).ok_or_else(|| entity::unknown(simulation, original))?;
    let name = free_name(simulation, wish, original)?;
    let member = simulation.running[place].member.clone();
    let findings = simulation.spawn(Member { name: name.clone(), world_from_model, ..member });
    // Its places are in a file that is no longer at hand.
    let messages: Vec<&str> = findings.iter().map(|finding| finding.message.as_str()).collect();
    let notes = messages.join("\n");
    if simulation.place_of(&name).is_some() { Ok(Spawned { name, notes }) } else { Err(notes) }
}

/// Takes a model or light out of the world.
///
/// # Errors
/// What to name instead.
pub(super) fn delete(simulation: &mut Simulation, name: &str) -> Result<(), String> {
    if simulation.delete(name) || simulation.delete_light(name) {
        return Ok(());
    }
    Err(match entity::find(simulation, name) {
        Ok(_) => format!("`{name}` is a part of a model; only whole models and lights can go"),
        Err(_) => format!("{}; {}", entity::unknown(simulation, name), lights(simulation)),
    })
}

/// The names of the lights, to be told.
pub(super) fn lights(simulation: &Simulation) -> String {
    let names: Vec<String> =
        simulation.scene.lights.iter().map(|light| light.name.clone()).collect();
    format!("lights: {}", entity::listed(&names))
}

/// The name that a new thing gets: the wanted one; or its own, with a number as Gazebo has it.
fn free_name(simulation: &Simulation, wish: &Wish<'_>, own: &str) -> Result<String, String> {
    let taken = |name: &str| {
        simulation.place_of(name).is_some()
            || simulation.scene.lights.iter().any(|light| light.name == name)
    };
    let wanted = if wish.name.is_empty() { own } else { wish.name };
    if wanted.contains("::") {
        return Err(format!("`{wanted}` cannot be a name: `::` divides names"));
    }
    if !taken(wanted) {
        return Ok(wanted.to_owned());
    }
    if !(wish.name.is_empty() || wish.may_rename) {
        return Err(format!("`{wanted}` is there already; delete it, or take another name"));
    }
    let numbered = (0_u64..).map(|number| format!("{wanted}_{number}"));
    numbered.take(usize::MAX).find(|name| !taken(name)).ok_or_else(|| "no name is free".into())
}
