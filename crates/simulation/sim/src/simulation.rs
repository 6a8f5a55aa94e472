//! A running world.

mod change;
mod faults;
mod people;
mod robots;
mod snapshot;
mod view;
mod world_file;

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_graph::{Arguments, Graph, Node, NodeSettings};
use periplus_os::Stopwatch;
use periplus_physics::limits::{MAX_GRAVITY_M_S2, STEP_RANGE_S, is_within};
use periplus_physics::{Diverged, ModelId, PhysicsMode, PhysicsWorld};
use periplus_scene as scene;
use periplus_sensors::Quirks;
use periplus_sim_nodes::states::ClockPublisher;
use periplus_sim_nodes::{
    BuildingFloor, Device, DeviceContext, ParameterFiles, SenseContext, SensorMount, StepInterval,
    Views, floors_of, world_devices,
};

use crate::actors::RunningActor;
use crate::compose::{Composition, ModelInstance};
use crate::files::AssetFiles;
use crate::people::People;
use crate::profile::{Work, WorkProfile};

pub use people::PeopleReport;
pub use robots::SimulatedRobot;
pub use snapshot::{Snapshot, SnapshotError};
pub(crate) use world_file::{WorldChange, WorldFile, is_moved, is_same};

/// Maximum step if motion needs no small steps \[ns\]: drives that check commands in each step must
/// be called.
const MAX_STEP_NS: i64 = 10_000_000;

/// Minimum number of robots whose devices measure at the same time on several threads: starting threads takes as long
/// as the measurements of some.
const MIN_PARALLEL_ROBOT_COUNT: usize = 4;

/// Minimum step \[ns\].
const MIN_STEP_NS: i64 = 1_000;

/// Options of a simulation.
#[derive(Clone, Debug)]
pub struct Options {
    /// Seed of all noise.
    pub seed: u64,
    /// Kind of motion.
    pub mode: PhysicsMode,
    /// Step \[s\]; `None` for that of the world's physics.
    pub step_s: Option<f64>,
    /// Number of threads for ray casting, and for nodes in the namespaces of several robots. Results do not depend on it.
    pub threads: usize,
    /// Deviations of Gazebo to reproduce.
    pub quirks: Quirks,
    /// True if the beams of a lidar are measured one after the other while the robot moves.
    pub rolling_scans: bool,
    /// Remappings `from:=to` of all nodes.
    pub remaps: Vec<String>,
    /// Arguments of `--ros-args` for all nodes except those of the world itself.
    pub arguments: Arguments,
    /// Rate of `/clock` in simulated time \[Hz\].
    pub clock_rate_hz: f64,
    /// True if joint states of robots are published when no plugin does.
    pub publishes_joint_states: bool,
    /// True if controllers of `ros2_control` start as their parameter files declare them, without a
    /// spawner.
    pub starts_controllers: bool,
    /// True if `/tf` of Gazebo's plugins is that of ROS; false where the bridges of a launch file leave it out.
    pub bridges_transforms: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 0,
            mode: PhysicsMode::Rigid,
            step_s: None,
            threads: 1,
            quirks: Quirks::default(),
            rolling_scans: false,
            remaps: Vec::new(),
            arguments: Arguments::default(),
            clock_rate_hz: 100.0,
            publishes_joint_states: true,
            starts_controllers: true,
            bridges_transforms: true,
        }
    }
}

/// A model with its devices.
pub(crate) struct RunningModel {
    pub(crate) member: Arc<ModelInstance>,
    pub(crate) model: ModelId,
    devices: Vec<Box<dyn Device>>,
    /// Number of the build of its devices, unique in the simulation.
    build: u64,
    /// Seed of its devices.
    seed: u64,
}

/// A world with its robots, ready to run.
///
/// In each step first all messages are delivered, then devices act, then physics advances, then
/// devices measure and publish, always in the same order. Nothing depends on the wall clock or the
/// number of threads.
pub struct Simulation {
    pub(crate) graph: Graph,
    pub(crate) scene: Arc<scene::World>,
    pub(crate) motion: PhysicsWorld,
    pub(crate) running: Vec<RunningModel>,
    world_devices: Vec<Box<dyn Device>>,
    /// Floors of the building.
    floors: Vec<BuildingFloor>,
    pub(crate) views: Views,
    /// Actors of the world, which move by their scripts.
    actors: Vec<RunningActor>,
    /// People of a crowd.
    people: Option<People>,
    files: Arc<AssetFiles>,
    options: Options,
    /// True if the seed has changed since the devices were created.
    has_new_seed: bool,
    /// World as its file has it.
    world_file: WorldFile,
    /// Requested poses of models since the start or reset, by name.
    requested_poses: BTreeMap<String, Pose>,
    /// Number of insertions and removals of models.
    changes: u64,
    /// Number of builds of a model's devices.
    builds: u64,
    /// Token that its snapshots share.
    identity: Arc<()>,
    step_ns: i64,
    pub(crate) time_ns: i64,
    shares: WorkProfile,
    /// Node whose log reports findings.
    journal: Option<Node>,
    found: Diagnostics,
    /// Models that were removed after their motion diverged.
    diverged: Vec<Diverged>,
}

impl Simulation {
    /// Creates the simulation of a composition. Findings are added to its files; invalid parts are
    /// omitted.
    #[must_use]
    pub fn new(composition: &mut Composition, files: Arc<AssetFiles>, options: Options) -> Self {
        let scene = composition.world.clone();
        let mut of_world = Diagnostics::new();
        let step_s = options.step_s.unwrap_or_else(|| step_of(&scene, &mut of_world));
        let gravity_m_s2 = gravity_of(&scene, &mut of_world);
        let motion = PhysicsWorld::empty(gravity_m_s2, options.mode);
        let graph = Graph::new();
        graph.set_arguments(options.arguments.clone());
        graph.run_in_parallel(&namespaces_of_robots(composition), options.threads);
        let views = Views::new(Arc::clone(&files) as _, options.threads).with_lights_of(&scene);
        let mut simulation = Self {
            step_ns: nanoseconds(step_s).max(MIN_STEP_NS),
            world_devices: Vec::new(),
            floors: Vec::new(),
            has_new_seed: false,
            running: Vec::new(),
            world_file: WorldFile::new(composition),
            requested_poses: BTreeMap::new(),
            changes: 0,
            builds: 0,
            identity: Arc::new(()),
            time_ns: 0,
            shares: WorkProfile::default(),
            journal: graph.node(NodeSettings::new("periplus").keep_names()).ok(),
            found: Diagnostics::new(),
            diverged: Vec::new(),
            graph,
            scene: Arc::new(scene),
            motion,
            views,
            actors: Vec::new(),
            people: None,
            files,
            options,
        };
        match ClockPublisher::new(&simulation.graph, simulation.options.clock_rate_hz, 0) {
            Ok(clock) => simulation.world_devices.push(Box::new(clock)),
            // Impossible: the graph is new.
            Err(error) => composition.files[0]
                .diagnostics
                .push(Diagnostic::error("no-clock", error.to_string())),
        }
        let models: Vec<&scene::Model> =
            composition.members.iter().map(|member| &member.model).collect();
        simulation.floors = floors_of(&simulation.scene, &models);
        let devices = world_devices(&simulation.graph, &simulation.scene, &models, &mut of_world);
        simulation.world_devices.extend(devices);
        for actor in &simulation.scene.actors {
            simulation.actors.push(RunningActor::new(actor, &mut simulation.views, &mut of_world));
        }
        simulation.place_actors();
        // Plugins of a world file are in the first file; the default plane has none.
        composition.files[0].diagnostics.append(of_world);
        for member in composition.members.clone() {
            let file = member.file;
            let findings = simulation.spawn(member);
            composition.files[file].diagnostics.append(findings);
        }
        for file in &composition.files {
            simulation.log(&file.diagnostics);
        }
        simulation
    }
}

/// Namespaces of robots, if there are several: what runs in one does not touch what runs in another.
fn namespaces_of_robots(composition: &Composition) -> Vec<String> {
    let own = composition.members.iter().map(|member| member.namespace.as_str());
    let mut namespaces: Vec<String> =
        own.filter(|it| !it.trim_matches('/').is_empty()).map(str::to_owned).collect();
    namespaces.sort();
    namespaces.dedup();
    if namespaces.len() < 2 { Vec::new() } else { namespaces }
}

impl Simulation {
    /// Number of threads for rays.
    pub(crate) fn threads(&self) -> usize {
        self.options.threads
    }

    /// Seed of all noise.
    pub(crate) fn seed(&self) -> u64 {
        self.options.seed
    }

    /// Returns the graph with all nodes and topics.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Returns the physics world.
    #[must_use]
    pub fn motion(&self) -> &PhysicsWorld {
        &self.motion
    }

    /// Returns the simulated time \[ns\].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.time_ns
    }

    /// Returns the step \[ns\].
    #[must_use]
    pub fn step_ns(&self) -> i64 {
        self.step_ns
    }

    /// Changes the step \[s\].
    pub fn set_step(&mut self, step_s: f64) {
        self.step_ns = nanoseconds(step_s).max(MIN_STEP_NS);
    }

    /// Returns wall time by kind of work.
    #[must_use]
    pub fn shares(&self) -> &WorkProfile {
        &self.shares
    }

    /// Returns wall time by kind of work, mutably.
    pub(crate) fn shares_mut(&mut self) -> &mut WorkProfile {
        &mut self.shares
    }

    /// Returns and clears findings during the run: mismatched connections, unsupported shapes.
    /// Models of several files share the world, so findings have no positions.
    pub fn take_findings(&mut self) -> Diagnostics {
        self.collect_findings();
        std::mem::take(&mut self.found)
    }

    /// Collects and logs new findings.
    fn collect_findings(&mut self) {
        for found in [self.graph.take_findings(), self.views.take_findings()] {
            for diagnostic in found.iter() {
                self.found.push(Diagnostic {
                    span: None,
                    related: Vec::new(),
                    replacement: None,
                    ..diagnostic.clone()
                });
            }
            self.log(&found);
        }
    }

    /// Logs findings on `/rosout`.
    fn log(&self, findings: &Diagnostics) {
        for finding in findings.iter() {
            if let Some(journal) = &self.journal {
                journal.log_finding(finding);
            }
        }
    }

    /// Returns the names of the models, in the order of insertion.
    pub fn models(&self) -> impl Iterator<Item = &str> {
        self.running.iter().map(|running| running.member.name.as_str())
    }

    /// Returns the remappings of all nodes.
    #[must_use]
    pub fn remaps(&self) -> &[String] {
        &self.options.remaps
    }

    /// Returns the pose of the first robot: the first model with a description, or else the first
    /// movable one.
    #[must_use]
    pub fn robot_pose(&self) -> Option<Pose> {
        self.motion.model_pose(self.robot()?.model)
    }

    /// Returns the radius of the first robot about its frame, seen from above \[m\]; `None` if its
    /// collisions do not define one.
    #[must_use]
    pub fn robot_radius_m(&self) -> Option<f64> {
        crate::default_world::radius_m(&self.robot()?.member.model, Pose::IDENTITY)
    }

    /// Returns the convex polygon around the first robot's collisions, seen from above, in its frame \[m\]; `None` if
    /// they do not define one.
    #[must_use]
    pub fn robot_footprint_m(&self) -> Option<Vec<[f64; 2]>> {
        crate::footprint::footprint_m(&self.robot()?.member.model, &*self.files)
    }

    /// Returns the convex polygon around the collisions of a model, seen from above, in its frame \[m\]; `None` if there is
    /// no such model or its collisions do not define one.
    #[must_use]
    pub fn model_footprint_m(&self, name: &str) -> Option<Vec<[f64; 2]>> {
        let running = self.running.iter().find(|running| running.member.name == name)?;
        crate::footprint::footprint_m(&running.member.model, &*self.files)
    }

    pub(crate) fn robot(&self) -> Option<&RunningModel> {
        let described = |running: &&RunningModel| running.member.description.is_some();
        let moves = |running: &&RunningModel| !running.member.model.is_static;
        self.running.iter().find(described).or(self.running.iter().find(moves))
    }

    /// Returns the names of the first robot's links, and their planar poses.
    pub(crate) fn robot_links(&self) -> Vec<(String, Pose2)> {
        let Some(robot) = self.robot() else { return Vec::new() };
        let links = self.motion.links(robot.model).filter_map(|link| {
            let name = self.motion.link_name(link)?.to_owned();
            Some((name, Pose2::from(self.motion.link_state(link)?.world_from_link)))
        });
        links.collect()
    }

    /// Returns the names of all devices, in their order.
    pub fn devices(&self) -> impl Iterator<Item = &str> {
        let own = self.running.iter().flat_map(|running| &running.devices);
        self.world_devices.iter().chain(own).map(|device| device.name())
    }

    /// Inserts a model with its drives and sensors.
    pub fn spawn(&mut self, mut member: ModelInstance) -> Diagnostics {
        member.model.name.clone_from(&member.name);
        let added = self.motion.add(&member.model, member.world_from_model, &*self.files);
        let mut findings = added.diagnostics;
        let Some(model) = added.model else { return findings };
        self.views.add(Arc::new(member.model.clone()), model, &self.motion);
        let seed = self.options.seed;
        let devices = self.devices_of(&member, model, &self.motion, seed, &mut findings);
        let (member, build) = (Arc::new(member), self.next_build());
        self.running.push(RunningModel { member, model, devices, build, seed });
        self.changes += 1;
        findings
    }

    fn next_build(&mut self) -> u64 {
        self.builds += 1;
        self.builds
    }

    /// Builds the devices of a model in the state of `world`.
    fn devices_of(
        &self,
        member: &ModelInstance,
        model: ModelId,
        world: &PhysicsWorld,
        seed: u64,
        findings: &mut Diagnostics,
    ) -> Vec<Box<dyn Device>> {
        let parameter_files: Arc<dyn ParameterFiles> = Arc::clone(&self.files) as _;
        let setting = DeviceContext {
            graph: &self.graph,
            world,
            scene: &self.scene,
            root: &member.model,
            model,
            model_name: &member.name,
            namespace: &member.namespace,
            is_confined: member.is_copy,
            remaps: &self.options.remaps,
            seed,
            quirks: self.options.quirks,
            rolling_scans: self.options.rolling_scans,
            start_ns: self.time_ns,
            publishes_joint_states: self.options.publishes_joint_states,
            starts_controllers: self.options.starts_controllers,
            bridges_transforms: self.options.bridges_transforms,
            floors: &self.floors,
            parameter_files: &parameter_files,
        };
        periplus_sim_nodes::devices(&setting, member.description.as_deref(), findings)
    }

    /// Removes a model. Returns false for an unknown name.
    pub fn delete(&mut self, name: &str) -> bool {
        let Some(place) = self.place_of(name) else { return false };
        let gone = self.running.remove(place);
        self.views.remove(gone.model, &self.motion);
        self.motion.remove(gone.model);
        self.requested_poses.remove(name);
        self.changes += 1;
        true
    }

    /// Sets the pose of a model, at rest. Returns false for an unknown name or a non-finite pose.
    pub fn set_pose(&mut self, name: &str, world_from_model: Pose) -> bool {
        let Some(place) = self.place_of(name) else { return false };
        let model = self.running[place].model;
        let moved = self.motion.set_pose(model, world_from_model);
        if moved {
            self.requested_poses.insert(name.to_owned(), world_from_model);
            self.views.invalidate();
        }
        moved
    }

    /// Resets all models to their initial poses, and time to zero.
    pub fn reset(&mut self) {
        self.time_ns = 0;
        self.graph.jump_to(0);
        self.place_actors();
        self.reset_models();
    }

    /// Resets models to their initial poses, at rest; time continues.
    pub fn reset_models(&mut self) {
        self.motion.reset();
        self.requested_poses.clear();
        self.views.invalidate();
        self.restart_devices();
        self.restart_people();
    }

    /// Returns a counter that changes with each insertion and removal.
    pub(crate) fn changes(&self) -> u64 {
        self.changes
    }

    /// Returns the reader of shape files.
    pub(crate) fn files(&self) -> &AssetFiles {
        &self.files
    }

    pub(crate) fn place_of(&self, name: &str) -> Option<usize> {
        self.running.iter().position(|running| running.member.name == name)
    }

    /// Takes one step.
    ///
    /// # Errors
    /// When the motion of a body outside of all models diverges. A diverging model is removed; see
    /// [`Simulation::diverged`].
    pub fn step(&mut self) -> Result<(), Diverged> {
        self.step_until(i64::MAX)
    }

    /// Takes one step that ends at `end_ns` at the latest.
    ///
    /// # Errors
    /// When the motion of a body outside of all models diverges. A diverging model is removed; see
    /// [`Simulation::diverged`].
    pub fn step_until(&mut self, end_ns: i64) -> Result<(), Diverged> {
        let mut stopwatch = Stopwatch::start();
        self.graph.advance_to(self.time_ns);
        self.shares.lap(Work::Messages, &mut stopwatch);
        let span = StepInterval { start_ns: self.time_ns, length_ns: self.next_length_ns(end_ns) };
        for device in all(&mut self.world_devices, &mut self.running) {
            device.act(&mut self.motion, span);
        }
        let poses_before = self.poses_before();
        if let Err(diverged) = self.motion.step(span.length_ns) {
            self.remove_diverged(diverged)?;
        }
        self.time_ns = span.end_ns();
        self.hold_robots(&poses_before);
        self.step_people();
        self.shares.lap(Work::Physics, &mut stopwatch);
        self.graph.advance_to(self.time_ns);
        self.shares.lap(Work::Messages, &mut stopwatch);
        self.place_actors();
        self.place_people();
        self.sense(span);
        self.collect_findings();
        self.shares.lap(Work::Sensing, &mut stopwatch);
        Ok(())
    }

    /// Lets the devices measure: those of robots in different namespaces at the same time.
    fn sense(&mut self, span: StepInterval) {
        let due = |running: &&RunningModel| {
            let mut next_ns = running.devices.iter().filter_map(|device| device.next_ns());
            next_ns.any(|due_ns| due_ns <= span.end_ns())
        };
        let robots_due = self.running.iter().filter(due).take(MIN_PARALLEL_ROBOT_COUNT).count();
        let is_short = robots_due < MIN_PARALLEL_ROBOT_COUNT;
        let threads = self.options.threads;
        let (world, views) = (&self.motion, &self.views);
        let moment = SenseContext { span, world, views, threads };
        for device in &mut self.world_devices {
            device.sense(&mut moment.clone());
        }
        // Other robots need the threads, too.
        let threads = if is_short { threads } else { (threads / MIN_PARALLEL_ROBOT_COUNT).max(1) };
        let moment = SenseContext { threads, ..moment };
        let work = self.running.iter_mut().map(|running| {
            let RunningModel { member, devices, .. } = running;
            (member.namespace.as_str(), devices)
        });
        self.graph.run_beside(work.collect(), is_short, |devices: &mut Vec<Box<dyn Device>>| {
            devices.iter_mut().for_each(|device| device.sense(&mut moment.clone()));
        });
    }

    /// Measures once for subscribers that joined during a pause.
    pub(crate) fn sense_paused(&mut self) {
        let mut moment = SenseContext {
            span: StepInterval { start_ns: self.time_ns, length_ns: 0 },
            world: &self.motion,
            views: &self.views,
            threads: self.options.threads,
        };
        for device in all(&mut self.world_devices, &mut self.running) {
            device.sense_paused(&mut moment);
        }
        self.collect_findings();
    }

    /// Returns mounting poses of the sensors' data, with the names of their models.
    pub(crate) fn sensor_mounts(&self) -> impl Iterator<Item = (&str, SensorMount)> {
        self.running.iter().flat_map(|running| {
            let name = running.member.name.as_str();
            let mounts = running.devices.iter().flat_map(|device| device.mounts());
            mounts.map(move |mount| (name, mount))
        })
    }

    /// Moves the actors to their poses at the current time.
    fn place_actors(&mut self) {
        for actor in &self.actors {
            actor.place(self.time_ns, &mut self.views);
        }
    }

    /// Returns the names of the actors of the world with their poses, which are those of their scripts at the current
    /// time.
    pub fn actors(&self) -> impl Iterator<Item = (&str, Pose)> {
        self.actors.iter().map(|actor| (actor.name(), actor.world_from_actor(self.time_ns)))
    }

    /// Removes a model whose motion diverged; the rest continues.
    fn remove_diverged(&mut self, diverged: Diverged) -> Result<(), Diverged> {
        let place = self.running.iter().position(|it| Some(it.model) == diverged.model);
        let Some(name) = place.map(|place| self.running[place].member.name.clone()) else {
            return Err(diverged);
        };
        self.delete(&name);
        let message = format!("model `{name}` was removed: {diverged}");
        let mut findings = Diagnostics::new();
        findings.push(Diagnostic::error("model-diverged", message));
        self.log(&findings);
        self.found.append(findings);
        self.diverged.push(diverged);
        Ok(())
    }

    /// Returns models that were removed after their motion diverged, by time.
    #[must_use]
    pub fn diverged(&self) -> &[Diverged] {
        &self.diverged
    }

    /// Returns the length of the next step: the world's step, or if motion is exact for any step,
    /// the time to the next action of a device.
    fn next_length_ns(&mut self, end_ns: i64) -> i64 {
        let step_ns = self.step_ns;
        let left_ns = end_ns.saturating_sub(self.time_ns).max(1);
        if self.options.mode == PhysicsMode::Rigid {
            // Always a whole step: results depend on the step.
            return step_ns;
        }
        let start_ns = self.time_ns;
        let longest_ns = MAX_STEP_NS.max(step_ns);
        let people_ns = self.people.as_ref().map(People::next_ns);
        let due_ns = all(&mut self.world_devices, &mut self.running)
            .filter_map(|device| device.next_ns())
            .chain(people_ns)
            .map(|due_ns| due_ns - start_ns)
            .filter(|wait_ns| *wait_ns > 0)
            .fold(longest_ns, i64::min);
        // Only multiples of the step, so that both modes measure at the same times.
        let steps = (due_ns + step_ns - 1) / step_ns;
        (steps * step_ns).min(left_ns)
    }
}

/// Returns all devices in their order.
fn all<'a>(
    world: &'a mut [Box<dyn Device>],
    running: &'a mut [RunningModel],
) -> impl Iterator<Item = &'a mut Box<dyn Device>> {
    let own = running.iter_mut().flat_map(|running| &mut running.devices);
    world.iter_mut().chain(own)
}

/// Returns the gravity of a world, or zero \[m/s²\].
fn gravity_of(world: &scene::World, findings: &mut Diagnostics) -> DVec3 {
    if is_within(world.gravity_m_s2, MAX_GRAVITY_M_S2) {
        return world.gravity_m_s2;
    }
    let message =
        format!("gravity is not finite, or beyond {MAX_GRAVITY_M_S2} m/s²; it is set to zero");
    findings.push(Diagnostic::error("gravity-out-of-range", message).at(world.origin));
    DVec3::ZERO
}

/// Step of a world without a valid one \[s\].
const DEFAULT_STEP_S: f64 = 0.001;

/// Returns the step of a world \[s\].
fn step_of(world: &scene::World, findings: &mut Diagnostics) -> f64 {
    let physics = world.physics.iter().find(|physics| physics.default).or(world.physics.first());
    let asked_s = physics.map_or(DEFAULT_STEP_S, |physics| physics.max_step_size_s);
    let [shortest_s, longest_s] = STEP_RANGE_S;
    if (shortest_s..=longest_s).contains(&asked_s) {
        return asked_s;
    }
    let message = format!(
        "the world asks for steps of {asked_s} s; they must be from {shortest_s} s to {longest_s} s"
    );
    findings.push(
        Diagnostic::warning("step-out-of-range", message)
            .at(world.origin)
            .note(format!("steps of {DEFAULT_STEP_S} s are used")),
    );
    DEFAULT_STEP_S
}

#[expect(clippy::cast_possible_truncation, reason = "a step is a fraction of a second")]
fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}
