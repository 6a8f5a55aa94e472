//! The world as its file has it, and what was changed since the start.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use periplus_geometry::Pose;
use periplus_loader::FileFormat;
use periplus_scene::{Light, Model};

use super::Simulation;
use crate::compose::{Composition, ModelInstance};

/// Smallest distance of a pose from that of the file that counts as a change \[m\], and smallest angle \[rad\]: half of the last
/// written decimal place.
const MIN_MOVE_M: f64 = 5e-7;
const MIN_TURN_RAD: f64 = 5e-7;

/// World at the start of a simulation.
#[derive(Debug)]
pub(crate) struct WorldFile {
    /// Path and text, of an SDF file with a world.
    pub(crate) source: Option<(PathBuf, Arc<str>)>,
    /// Models of the file.
    pub(crate) models: Vec<Arc<ModelInstance>>,
    /// Lights of the file.
    pub(crate) lights: Vec<Light>,
    /// Names of models that belong to the run and not to the world: robots of the command line or of a launch file.
    excluded: BTreeSet<String>,
}

/// Change of a model or light since the start.
#[derive(Clone, Debug)]
pub(crate) enum WorldChange {
    /// Model of the file at another pose.
    Moved { model: Arc<ModelInstance>, world_from_model: Pose },
    /// Model of the file that is no longer in the world.
    Removed { model: Arc<ModelInstance> },
    /// Model of the file under another name, and its pose.
    Renamed { model: Arc<ModelInstance>, name: String, world_from_model: Pose },
    /// Model that the file does not have.
    Inserted { model: Arc<ModelInstance>, world_from_model: Pose },
    /// Light that the file does not have.
    InsertedLight { light: Light },
    /// Light of the file that is no longer in the world.
    RemovedLight { light: Light },
}

impl WorldFile {
    pub(super) fn new(composition: &Composition) -> Self {
        let first = &composition.files[0];
        let root = first.document.as_ref().and_then(|document| document.root.origin.0);
        let is_own = !composition.is_default_world && first.language == FileFormat::Sdf;
        let source = root
            .filter(|_| is_own)
            .map(|root| (first.path.clone(), Arc::clone(&first.sources.file(root.file).text)));
        let (of_file, others): (Vec<_>, Vec<_>) =
            composition.members.iter().partition(|member| source.is_some() && member.file == 0);
        Self {
            source,
            models: of_file.into_iter().cloned().map(Arc::new).collect(),
            lights: composition.world.lights.clone(),
            excluded: others.into_iter().map(|member| member.name.clone()).collect(),
        }
    }
}

impl Simulation {
    /// Leaves a model out of the world's changes.
    pub(crate) fn exclude_from_changes(&mut self, name: &str) {
        self.world_file.excluded.insert(name.to_owned());
    }

    /// Returns the world as its file has it.
    pub(crate) fn world_file(&self) -> &WorldFile {
        &self.world_file
    }

    /// Returns the changes since the start. Motion is none: of a model that can move, the last requested pose counts.
    pub(crate) fn world_changes(&self) -> Vec<WorldChange> {
        let file = &self.world_file;
        let mut inserted: Vec<(Arc<ModelInstance>, Pose)> = Vec::new();
        let mut changes = Vec::new();
        for running in &self.running {
            let member = &running.member;
            let requested = self.requested_poses.get(&member.name).copied();
            let present = if member.model.is_static {
                self.motion.model_pose(running.model)
            } else {
                requested
            };
            let world_from_model = present.unwrap_or(member.world_from_model);
            match file.models.iter().find(|model| model.name == member.name) {
                Some(model) if is_same(&model.model, &member.model) => {
                    if is_moved(model.world_from_model, world_from_model) {
                        changes.push(WorldChange::Moved {
                            model: Arc::clone(model),
                            world_from_model,
                        });
                    }
                }
                _ if file.excluded.contains(&member.name) || member.description.is_some() => {}
                _ => inserted.push((Arc::clone(member), world_from_model)),
            }
        }
        for model in &file.models {
            let remains = self.running.iter().any(|running| {
                running.member.name == model.name && is_same(&running.member.model, &model.model)
            });
            if remains {
                continue;
            }
            let other = inserted.iter().position(|(other, _)| {
                other.name != model.name && is_same(&other.model, &model.model)
            });
            let model = Arc::clone(model);
            changes.push(match other.map(|index| inserted.remove(index)) {
                Some((other, world_from_model)) => {
                    WorldChange::Renamed { model, name: other.name.clone(), world_from_model }
                }
                None => WorldChange::Removed { model },
            });
        }
        changes.extend(
            inserted
                .into_iter()
                .map(|(model, world_from_model)| WorldChange::Inserted { model, world_from_model }),
        );
        let has = |lights: &[Light], name: &str| lights.iter().any(|light| light.name == name);
        for light in file.lights.iter().filter(|light| !has(&self.scene.lights, &light.name)) {
            changes.push(WorldChange::RemovedLight { light: light.clone() });
        }
        for light in self.scene.lights.iter().filter(|light| !has(&file.lights, &light.name)) {
            changes.push(WorldChange::InsertedLight { light: light.clone() });
        }
        changes
    }
}

/// Returns true if two models differ at most in name, pose and origin.
pub(crate) fn is_same(a: &Model, b: &Model) -> bool {
    let plain = |model: &Model| Model {
        name: String::new(),
        parent_from_model: Pose::IDENTITY,
        included_from: None,
        ..model.clone()
    };
    plain(a) == plain(b)
}

/// Returns true if two poses differ in what a file can express.
pub(crate) fn is_moved(from: Pose, to: Pose) -> bool {
    let (distance_m, angle_rad) = from.distance_to(to);
    distance_m > MIN_MOVE_M || angle_rad > MIN_TURN_RAD
}
