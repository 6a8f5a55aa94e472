//! Changes of the world as edits of its file.

use std::path::Path;

use periplus_diagnostics::{Diagnostics, unified_diff};
use periplus_geometry::Pose;
use periplus_scene::{Light, Model, Scene};
use periplus_sdf::{WorldEdit, edit_world};
use periplus_xml::Element;
use serde_json::json;

use super::super::reading::Search;
use super::save;
use crate::Simulation;
use crate::compose::{ModelInstance, compose_text};
use crate::simulation::{WorldChange, is_moved, is_same};

/// World with its changes.
#[derive(Debug)]
pub(in crate::services) struct ChangedWorld {
    /// Path of the world's file; `None` if the text is all of the world as SDF, because it has no file that can be edited.
    pub(in crate::services) file: Option<String>,
    /// Text of the file with the changes.
    pub(in crate::services) text: String,
    diff: String,
    /// Kind and name of each change.
    changes: Vec<(&'static str, String)>,
    /// Reason for which the file cannot be edited.
    pub(in crate::services) note: Option<String>,
}

impl ChangedWorld {
    pub(in crate::services) fn to_json(&self) -> String {
        let changes: Vec<_> = self
            .changes
            .iter()
            .map(|(kind, model)| json!({ "kind": kind, "model": model }))
            .collect();
        let mut all = json!({
            "file": self.file,
            "text": self.text,
            "diff": self.diff,
            "changes": changes,
        });
        if let Some(note) = &self.note {
            all["note"] = json!(note);
        }
        all.to_string()
    }
}

/// Returns the changes of the world. A world whose file cannot be edited is written as a whole. `written` is the text that this
/// program has written to the file since.
///
/// # Errors
/// The part of the world that SDF cannot represent.
pub(in crate::services) fn of(
    simulation: &Simulation,
    search: &Search,
    written: Option<&str>,
) -> Result<ChangedWorld, String> {
    let found = simulation.world_changes();
    let changes = found.iter().flat_map(named).collect();
    let note = match &simulation.world_file().source {
        None => "the world was not read from an SDF file with a world".to_owned(),
        Some((path, text)) => match edited(simulation, search, (path, text, written), &found) {
            Ok(new) => {
                let file = search.working_folder.join(path);
                return Ok(ChangedWorld {
                    file: Some(file.display().to_string()),
                    diff: unified_diff(&path.display().to_string(), text, &new),
                    text: new,
                    changes,
                    note: None,
                });
            }
            Err(why) => format!("{} cannot be edited: {why}", path.display()),
        },
    };
    let text = save::text(simulation)?;
    Ok(ChangedWorld { file: None, text, diff: String::new(), changes, note: Some(note) })
}

/// Returns kinds and names of a change, as clients get them.
fn named(change: &WorldChange) -> Vec<(&'static str, String)> {
    match change {
        WorldChange::Moved { model, .. } => vec![("moved", model.name.clone())],
        WorldChange::Removed { model } => vec![("removed", model.name.clone())],
        WorldChange::Renamed { model, name, world_from_model } => {
            let mut both = vec![("renamed", name.clone())];
            if is_moved(model.world_from_model, *world_from_model) {
                both.push(("moved", name.clone()));
            }
            both
        }
        WorldChange::Inserted { model, .. } => vec![("inserted", model.name.clone())],
        WorldChange::InsertedLight { light } => vec![("inserted", light.name.clone())],
        WorldChange::RemovedLight { light } => vec![("removed", light.name.clone())],
    }
}

/// Returns the edited text of the world's file. It is read again: it must have the models of the running world.
fn edited(
    simulation: &Simulation,
    search: &Search,
    (path, text, written): (&Path, &str, Option<&str>),
    changes: &[WorldChange],
) -> Result<String, String> {
    let file = search.working_folder.join(path);
    let on_disk = search.with_context(false, |context| context.host.read(&file));
    let on_disk = on_disk.map_err(|error| error.to_string())?;
    if on_disk != text.as_bytes() && Some(on_disk.as_slice()) != written.map(str::as_bytes) {
        return Err("it was changed since the start, or is not in UTF-8".to_owned());
    }
    if changes.is_empty() {
        return Ok(text.to_owned());
    }
    let attempt = |may_include: bool| {
        let edits = edits(changes, may_include)?;
        let new = edit_world(text, &edits).map_err(|error| error.to_string())?;
        verify(simulation, search, path, &new, changes)?;
        Ok::<String, String>(new)
    };
    attempt(true).or_else(|_| attempt(false))
}

fn edits(changes: &[WorldChange], may_include: bool) -> Result<Vec<WorldEdit>, String> {
    let mut edits = Vec::new();
    for change in changes {
        match change {
            WorldChange::Moved { model, world_from_model } => edits.push(WorldEdit::Move {
                origin: model.model.origin,
                from: model.world_from_model,
                to: *world_from_model,
            }),
            WorldChange::Removed { model } => {
                edits.push(WorldEdit::Remove { origin: model.model.origin });
            }
            WorldChange::Renamed { model, name, world_from_model } => {
                let (origin, from) = (model.model.origin, model.world_from_model);
                edits.push(WorldEdit::Rename { origin, name: name.clone() });
                if is_moved(from, *world_from_model) {
                    edits.push(WorldEdit::Move { origin, from, to: *world_from_model });
                }
            }
            WorldChange::Inserted { model, world_from_model } => {
                let include = model.model.included_from.as_deref().filter(|_| may_include);
                edits.push(WorldEdit::Insert(match include {
                    Some(uri) => include_element(uri, &model.name, *world_from_model),
                    None => model_element(model, *world_from_model)?,
                }));
            }
            WorldChange::InsertedLight { light } => {
                edits.push(WorldEdit::Insert(light_element(light)?));
            }
            WorldChange::RemovedLight { light } => {
                edits.push(WorldEdit::Remove { origin: light.origin });
            }
        }
    }
    Ok(edits)
}

fn include_element(uri: &str, name: &str, pose: Pose) -> Element {
    let mut placed = Model::new(name);
    placed.parent_from_model = pose;
    // The writer's own spelling of a pose.
    let pose = written(Scene { models: vec![placed], ..Scene::default() }, "model")
        .ok()
        .and_then(|element| element.child("pose").cloned());
    let leaf = |name: &str, text: &str| Element::new(name).with_text(text);
    let include =
        Element::new("include").with_child(leaf("uri", uri)).with_child(leaf("name", name));
    let pose = pose.unwrap_or_else(|| leaf("pose", "0 0 0 0 0 0"));
    include.with_child(pose)
}

fn model_element(member: &ModelInstance, pose: Pose) -> Result<Element, String> {
    let model = Model {
        name: member.name.clone(),
        parent_from_model: pose,
        included_from: None,
        ..member.model.clone()
    };
    written(Scene { models: vec![model], ..Scene::default() }, "model")
}

fn light_element(light: &Light) -> Result<Element, String> {
    written(Scene { lights: vec![light.clone()], ..Scene::default() }, "light")
}

/// Returns the only element of a written scene.
fn written(scene: Scene, name: &str) -> Result<Element, String> {
    let mut findings = Diagnostics::new();
    let document = periplus_sdf::write(&scene, &mut findings);
    let messages: Vec<&str> = findings.iter().map(|finding| finding.message.as_str()).collect();
    match document.root.child(name) {
        Some(element) if !findings.has_errors() => Ok(element.clone()),
        _ => Err(messages.join("; ")),
    }
}

/// Reads an edited text.
///
/// # Errors
/// The first difference from the running world.
fn verify(
    simulation: &Simulation,
    search: &Search,
    path: &Path,
    text: &str,
    changes: &[WorldChange],
) -> Result<(), String> {
    let read = search.with_context(false, |context| compose_text(path, text, context));
    if read.has_errors() {
        return Err("the edited text has errors".to_owned());
    }
    let mut expected: Vec<(String, &ModelInstance, Pose)> = Vec::new();
    for model in &simulation.world_file().models {
        expected.push((model.name.clone(), model, model.world_from_model));
    }
    for change in changes {
        match change {
            WorldChange::Moved { model, world_from_model } => {
                for one in expected.iter_mut().filter(|one| one.0 == model.name) {
                    one.2 = *world_from_model;
                }
            }
            WorldChange::Removed { model } => expected.retain(|one| one.0 != model.name),
            WorldChange::Renamed { model, name, world_from_model } => {
                for one in expected.iter_mut().filter(|one| one.0 == model.name) {
                    (one.0, one.2) = (name.clone(), *world_from_model);
                }
            }
            WorldChange::Inserted { .. }
            | WorldChange::InsertedLight { .. }
            | WorldChange::RemovedLight { .. } => {}
        }
    }
    for change in changes {
        if let WorldChange::Inserted { model, world_from_model } = change {
            expected.push((model.name.clone(), model, *world_from_model));
        }
    }
    for (name, model, pose) in &expected {
        let Some(member) = read.members.iter().find(|member| member.name == *name) else {
            return Err(format!("the edited text has no model `{name}`"));
        };
        if is_far(member.world_from_model, *pose) {
            return Err(format!("the pose of `{name}` does not follow from its `<pose>`"));
        }
        if !is_same(&member.model, &model.model) {
            return Err(format!("the edited text has another model `{name}`"));
        }
    }
    let names = |lights: &[Light]| {
        let mut names: Vec<String> = lights.iter().map(|light| light.name.clone()).collect();
        names.sort();
        names
    };
    if read.members.len() != expected.len()
        || names(&read.world.lights) != names(&simulation.scene.lights)
    {
        return Err("the edited text has other models or lights".to_owned());
    }
    Ok(())
}

/// Returns true if two poses differ by more than the rounding of a written one.
fn is_far(a: Pose, b: Pose) -> bool {
    let (distance_m, angle_rad) = a.distance_to(b);
    distance_m > 2e-6 || angle_rad > 2e-6
}
