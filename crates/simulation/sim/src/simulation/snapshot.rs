//! Snapshots of a simulation.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose;
use periplus_physics::{Diverged, ModelId, PhysicsWorld};
use periplus_scene as scene;
use periplus_sim_nodes::{Device, DeviceState, ViewsState};

use super::{RunningModel, Simulation};
use crate::compose::ModelInstance;
use crate::people::{People, PeopleState};

/// State of a [`Simulation`] at one time, from which it can continue any number of times.
///
/// It has all bodies, joints and contacts, the state of all devices with the commands that wait,
/// models, lights, seed, step and time. Meshes, descriptions and messages are shared with the
/// simulation, not copied.
pub struct Snapshot {
    owner: Arc<()>,
    time_ns: i64,
    step_ns: i64,
    seed: u64,
    has_new_seed: bool,
    motion: PhysicsWorld,
    scene: Arc<scene::World>,
    views: ViewsState,
    people: Option<PeopleState>,
    world_devices: Vec<DeviceState>,
    models: Vec<SavedModel>,
    requested_poses: BTreeMap<String, Pose>,
    diverged: Vec<Diverged>,
}

/// A model with the states of its devices.
struct SavedModel {
    member: Arc<ModelInstance>,
    model: ModelId,
    build: u64,
    seed: u64,
    devices: Vec<DeviceState>,
}

impl Snapshot {
    /// Returns the simulated time of the snapshot \[ns\].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.time_ns
    }
}

impl fmt::Debug for Snapshot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let models: Vec<&str> = self.models.iter().map(|saved| &*saved.member.name).collect();
        f.debug_struct("Snapshot")
            .field("time_ns", &self.time_ns)
            .field("models", &models)
            .finish_non_exhaustive()
    }
}

/// Reason for which a snapshot was not restored.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SnapshotError {
    /// Another simulation made the snapshot. Nothing was changed.
    OtherSimulation,
    /// A removed model was inserted again, and its devices differ from those of the snapshot, since
    /// nodes outside of the simulation use their names or topics. All else was restored.
    DevicesDiffer {
        /// Name of the model.
        model: String,
    },
}

impl fmt::Display for SnapshotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OtherSimulation => write!(
                f,
                "the snapshot is of another simulation; restore it into the simulation that made it"
            ),
            Self::DevicesDiffer { model } => write!(
                f,
                "the drives and sensors of `{model}` could not be built again as they were; stop the \
                 nodes that use its names, and restore the snapshot again"
            ),
        }
    }
}

impl std::error::Error for SnapshotError {}

impl Simulation {
    /// Saves the state. [`Simulation::restore`] continues from it.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot {
        let models = self.running.iter().map(|running| SavedModel {
            member: Arc::clone(&running.member),
            model: running.model,
            build: running.build,
            seed: running.seed,
            devices: saved(&running.devices),
        });
        Snapshot {
            owner: Arc::clone(&self.identity),
            time_ns: self.time_ns,
            step_ns: self.step_ns,
            seed: self.options.seed,
            has_new_seed: self.has_new_seed,
            motion: self.motion.clone(),
            scene: Arc::clone(&self.scene),
            views: self.views.save(),
            people: self.people.as_ref().map(People::state).cloned(),
            world_devices: saved(&self.world_devices),
            models: models.collect(),
            requested_poses: self.requested_poses.clone(),
            diverged: self.diverged.clone(),
        }
    }

    /// Returns to a snapshot of this simulation. From here the same steps and commands give the same
    /// messages, to the byte, and the same poses, to the bit, as they did after the snapshot,
    /// except sequence numbers. Models that were inserted since then are removed, with their nodes;
    /// removed ones are inserted again.
    ///
    /// Everything outside of the simulation keeps its state: nodes and timers of other programs on
    /// the graph, bags, networks, a [`Driver`](crate::Driver), a [`Run`](crate::Run). It sees a jump
    /// in time, as by a reset. Before the jump the nodes process the messages that are due.
    /// [`Services`](crate::Services) have a [snapshot](crate::Services::snapshot) for forces and pause
    /// state; without it, forces end when time jumps back.
    ///
    /// # Errors
    /// When another simulation made the snapshot, or the devices of a model that was inserted again
    /// differ.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), SnapshotError> {
        if !Arc::ptr_eq(&self.identity, &snapshot.owner) {
            return Err(SnapshotError::OtherSimulation);
        }
        self.graph.jump_to(snapshot.time_ns);
        self.time_ns = snapshot.time_ns;
        self.step_ns = snapshot.step_ns;
        self.options.seed = snapshot.seed;
        self.has_new_seed = snapshot.has_new_seed;
        self.motion = snapshot.motion.clone();
        self.scene = Arc::clone(&snapshot.scene);
        self.requested_poses.clone_from(&snapshot.requested_poses);
        self.diverged.clone_from(&snapshot.diverged);
        self.views.restore(&snapshot.views);
        self.place_actors();
        if let (Some(people), Some(state)) = (&mut self.people, &snapshot.people) {
            people.restore(state);
        }
        self.place_people();
        self.restore_models(&snapshot.models);
        // The devices of the world are built once.
        restored(&mut self.world_devices, &snapshot.world_devices);
        let mut outcome = Ok(());
        for (running, saved) in self.running.iter_mut().zip(&snapshot.models) {
            if !restored(&mut running.devices, &saved.devices) {
                let model = saved.member.name.clone();
                outcome = outcome.and(Err(SnapshotError::DevicesDiffer { model }));
            }
        }
        outcome
    }

    /// Removes models that are not in the snapshot, and builds the devices of missing ones.
    fn restore_models(&mut self, saved: &[SavedModel]) {
        let mut known = std::mem::take(&mut self.running);
        let count = known.len();
        // The nodes of the others are removed first, so that their names are unused.
        known.retain(|running| saved.iter().any(|saved| saved.build == running.build));
        let has_changed = known.len() != count || known.len() != saved.len();
        // Devices measure their model at its first pose when they are built.
        let mut initial = None;
        for saved in saved {
            let member = Arc::clone(&saved.member);
            let place = known.iter().position(|running| running.build == saved.build);
            let devices = if let Some(place) = place {
                known.swap_remove(place).devices
            } else {
                let world = initial.get_or_insert_with(|| {
                    let mut world = self.motion.clone();
                    world.reset();
                    world
                });
                // Their problems were reported when they were built first.
                let mut findings = Diagnostics::new();
                self.devices_of(&member, saved.model, world, saved.seed, &mut findings)
            };
            let SavedModel { model, build, seed, .. } = *saved;
            self.running.push(RunningModel { member, model, devices, build, seed });
        }
        if has_changed {
            self.changes += 1;
        }
    }
}

fn saved(devices: &[Box<dyn Device>]) -> Vec<DeviceState> {
    devices.iter().map(|device| device.save()).collect()
}

/// Restores the states of devices; returns false if the devices are others.
fn restored(devices: &mut [Box<dyn Device>], saved: &[DeviceState]) -> bool {
    let mut is_same = devices.len() == saved.len();
    for (device, saved) in devices.iter_mut().zip(saved) {
        is_same &= device.restore(saved);
    }
    is_same
}
