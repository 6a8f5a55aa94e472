//! A world that runs.

mod change;

use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose, Pose2};
use periplus_graph::{Arguments, Graph, Node, NodeSettings};
use periplus_os::Stopwatch;
use periplus_physics::limits::{MAX_GRAVITY_M_S2, STEP_RANGE_S, is_within};
use periplus_physics::{Diverged, ModelId, PhysicsMode};
use periplus_scene as scene;
use periplus_sensors::Quirks;
use periplus_sim_nodes::states::ClockPublisher;
use periplus_sim_nodes::{Device, DeviceContext, SenseContext, SensorMount, StepInterval, Views};

use crate::compose::{Composition, Member};
use crate::files::ShapeFiles;
use crate::shares::{Shares, Work};

/// Where motion needs no small steps, time still goes no further than this at once \[ns\]: drives
/// that listen at each step want to be asked.
const LONGEST_STEP_NS: i64 = 10_000_000;

/// Shortest step that is taken \[ns\].
const SHORTEST_STEP_NS: i64 = 1_000;

/// What a run is asked to be like.
#[derive(Clone, Debug)]
pub struct Options {
    /// Seed of all noise.
    pub seed: u64,
    /// How things move.
    pub mode: PhysicsMode,
    /// Step \[s\]; without one that of the world's physics.
    pub step_s: Option<f64>,
    /// Threads for rays.
    pub threads: usize,
    /// Which oddities of Gazebo are wanted.
    pub quirks: Quirks,
    /// Whether beams of a lidar are measured one after the other while the robot moves.
    pub rolling_scans: bool,
    /// `from:=to` for all nodes.
    pub remaps: Vec<String>,
    /// What `--ros-args` say to all nodes but those of the world itself.
    pub arguments: Arguments,
    /// Messages on `/clock` per simulated second \[Hz\].
    pub clock_rate_hz: f64,
    /// Whether the joints of robots are told where no plugin does so.
    pub publishes_joint_states: bool,
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
        }
    }
}

/// A model that is there, with what acts and measures on it.
pub(crate) struct Running {
    pub(crate) member: Member,
    pub(crate) model: ModelId,
    devices: Vec<Box<dyn Device>>,
}

/// A world with its robots, ready to run.
///
/// In each step first all messages are delivered, then devices act, then everything moves, then
/// devices measure and publish, always in the same order. Nothing depends on the wall clock or the
/// number of threads.
pub struct Simulation {
    pub(crate) graph: Graph,
    pub(crate) scene: scene::World,
    pub(crate) motion: periplus_physics::PhysicsWorld,
    pub(crate) running: Vec<Running>,
    world_devices: Vec<Box<dyn Device>>,
    pub(crate) views: Views,
    files: Arc<ShapeFiles>,
    options: Options,
    /// Whether the seed is another than that with which devices were made.
    has_new_seed: bool,
    /// How often models came or went.
    changes: u64,
    step_ns: i64,
    pub(crate) time_ns: i64,
    shares: Shares,
    /// Whose log says what is found wrong.
    journal: Option<Node>,
    found: Diagnostics,
    /// Models that were removed because their motion diverged.
    diverged: Vec<Diverged>,
}

impl Simulation {
    /// Puts a composition to work. Findings are added to its files; what cannot be simulated is
    /// left out.
    #[must_use]
    pub fn new(composition: &mut Composition, files: Arc<ShapeFiles>, options: Options) -> Self {
        let scene = composition.world.clone();
        let mut of_world = Diagnostics::new();
        let step_s = options.step_s.unwrap_or_else(|| step_of(&scene, &mut of_world));
        let gravity_m_s2 = gravity_of(&scene, &mut of_world);
        let motion = periplus_physics::PhysicsWorld::empty(gravity_m_s2, options.mode);
        let graph = Graph::new();
        graph.set_arguments(options.arguments.clone());
        let views = Views::new(Arc::clone(&files) as _, options.threads).with_lights_of(&scene);
        let mut simulation = Self {
            step_ns: nanoseconds(step_s).max(SHORTEST_STEP_NS),
            world_devices: Vec::new(),
            has_new_seed: false,
            running: Vec::new(),
            changes: 0,
            time_ns: 0,
            shares: Shares::default(),
            journal: graph.node(NodeSettings::new("periplus").keep_names()).ok(),
            found: Diagnostics::new(),
            diverged: Vec::new(),
            graph,
            scene,
            motion,
            views,
            files,
            options,
        };
        match ClockPublisher::new(&simulation.graph, simulation.options.clock_rate_hz, 0) {
            Ok(clock) => simulation.world_devices.push(Box::new(clock)),
            // Cannot be: the graph is new.
            Err(error) => composition.files[0]
                .diagnostics
                .push(Diagnostic::error("no-clock", error.to_string())),
        }
        let devices =
            periplus_sim_nodes::world_devices(&simulation.graph, &simulation.scene, &mut of_world);
        simulation.world_devices.extend(devices);
        // A world in its own file is the first; a plane for a robot has no plugins.
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

impl Simulation {
    /// The nodes and topics of this world.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// What moves.
    #[must_use]
    pub fn motion(&self) -> &periplus_physics::PhysicsWorld {
        &self.motion
    }

    /// Simulated time \[ns\].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.time_ns
    }

    /// The step of the simulation \[ns\].
    #[must_use]
    pub fn step_ns(&self) -> i64 {
        self.step_ns
    }

    /// Changes the step \[s\].
    pub fn set_step(&mut self, step_s: f64) {
        self.step_ns = nanoseconds(step_s).max(SHORTEST_STEP_NS);
    }

    /// Wall time by kind of work.
    #[must_use]
    pub fn shares(&self) -> &Shares {
        &self.shares
    }

    /// Wall time by kind of work, to be added to.
    pub(crate) fn shares_mut(&mut self) -> &mut Shares {
        &mut self.shares
    }

    /// What was found wrong on the way since this was last asked: connections that do not fit,
    /// shapes that cannot be seen. Models of many files are in one world, so no finding has a
    /// place.
    pub fn take_findings(&mut self) -> Diagnostics {
        self.collect_findings();
        std::mem::take(&mut self.found)
    }

    /// Keeps what was found wrong since the last time, and logs it.
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

    /// Says on `/rosout` what was found.
    fn log(&self, findings: &Diagnostics) {
        for finding in findings.iter() {
            if let Some(journal) = &self.journal {
                journal.log_finding(finding);
            }
        }
    }

    /// The names of the models that are there, in the order of coming.
    pub fn models(&self) -> impl Iterator<Item = &str> {
        self.running.iter().map(|running| running.member.name.as_str())
    }

    /// `from:=to` for all nodes.
    #[must_use]
    pub fn remaps(&self) -> &[String] {
        &self.options.remaps
    }

    /// Where the first robot is: the first model of a description, or else the first that can
    /// move.
    #[must_use]
    pub fn robot_pose(&self) -> Option<Pose> {
        self.motion.model_pose(self.robot()?.model)
    }

    /// The radius of the first robot around its frame, seen from above \[m\]; none where its
    /// collisions do not say.
    #[must_use]
    pub fn robot_radius_m(&self) -> Option<f64> {
        crate::ground::radius_m(&self.robot()?.member.model, Pose::IDENTITY)
    }

    pub(crate) fn robot(&self) -> Option<&Running> {
        let described = |running: &&Running| running.member.description.is_some();
        let moves = |running: &&Running| !running.member.model.is_static;
        self.running.iter().find(described).or(self.running.iter().find(moves))
    }

    /// Names of the first robot's links, and where they are on the plane of the world.
    pub(crate) fn robot_links(&self) -> Vec<(String, Pose2)> {
        let Some(robot) = self.robot() else { return Vec::new() };
        let links = self.motion.links(robot.model).filter_map(|link| {
            let name = self.motion.link_name(link)?.to_owned();
            Some((name, Pose2::from(self.motion.link_state(link)?.world_from_link)))
        });
        links.collect()
    }

    /// The names of all devices, in the order in which they act.
    pub fn devices(&self) -> impl Iterator<Item = &str> {
        let own = self.running.iter().flat_map(|running| &running.devices);
        self.world_devices.iter().chain(own).map(|device| device.name())
    }

    /// Puts a model into the world, with its drives and sensors.
    pub fn spawn(&mut self, mut member: Member) -> Diagnostics {
        member.model.name.clone_from(&member.name);
        let added = self.motion.add(&member.model, member.world_from_model, &*self.files);
        let mut findings = added.diagnostics;
        let Some(model) = added.model else { return findings };
        self.views.add(Arc::new(member.model.clone()), model, &self.motion);
        let devices = self.devices_of(&member, model, &mut findings);
        self.running.push(Running { member, model, devices });
        self.changes += 1;
        findings
    }

    /// Makes what acts and measures on a model.
    fn devices_of(
        &self,
        member: &Member,
        model: ModelId,
        findings: &mut Diagnostics,
    ) -> Vec<Box<dyn Device>> {
        let setting = DeviceContext {
            graph: &self.graph,
            world: &self.motion,
            scene: &self.scene,
            root: &member.model,
            model,
            model_name: &member.name,
            namespace: &member.namespace,
            remaps: &self.options.remaps,
            seed: self.options.seed,
            quirks: self.options.quirks,
            rolling_scans: self.options.rolling_scans,
            start_ns: self.time_ns,
            publishes_joint_states: self.options.publishes_joint_states,
        };
        periplus_sim_nodes::devices(&setting, member.description.as_deref(), findings)
    }

    /// Takes a model out. False if there is none of that name.
    pub fn delete(&mut self, name: &str) -> bool {
        let Some(place) = self.place_of(name) else { return false };
        let gone = self.running.remove(place);
        self.views.remove(gone.model, &self.motion);
        self.motion.remove(gone.model);
        self.changes += 1;
        true
    }

    /// Puts a model down somewhere, at rest. False if there is none of that name, or the pose is
    /// not finite.
    pub fn set_pose(&mut self, name: &str, world_from_model: Pose) -> bool {
        let Some(place) = self.place_of(name) else { return false };
        let model = self.running[place].model;
        let moved = self.motion.set_pose(model, world_from_model);
        if moved {
            self.views.invalidate();
        }
        moved
    }

    /// Everything back to where it came in, at time zero.
    pub fn reset(&mut self) {
        self.time_ns = 0;
        self.graph.jump_to(0);
        self.reset_models();
    }

    /// Models back to where they came in, at rest; time goes on.
    pub fn reset_models(&mut self) {
        self.motion.reset();
        self.views.invalidate();
        self.restart_devices();
    }

    /// Changes whenever a model comes or goes.
    pub(crate) fn changes(&self) -> u64 {
        self.changes
    }

    /// What reads the files of shapes.
    pub(crate) fn files(&self) -> &ShapeFiles {
        &self.files
    }

    pub(crate) fn place_of(&self, name: &str) -> Option<usize> {
        self.running.iter().position(|running| running.member.name == name)
    }

    /// One step.
    ///
    /// # Errors
    /// When the motion of a body that is no part of a model diverges. A model whose motion
    /// diverges is removed; see [`Simulation::diverged`].
    pub fn step(&mut self) -> Result<(), Diverged> {
        self.step_until(i64::MAX)
    }

    /// One step that ends at `end_ns` at the latest.
    ///
    /// # Errors
    /// When the motion of a body that is no part of a model diverges. A model whose motion
    /// diverges is removed; see [`Simulation::diverged`].
    pub fn step_until(&mut self, end_ns: i64) -> Result<(), Diverged> {
        let mut stopwatch = Stopwatch::start();
        self.graph.advance_to(self.time_ns);
        self.shares.lap(Work::Messages, &mut stopwatch);
        let span = StepInterval { start_ns: self.time_ns, length_ns: self.next_length_ns(end_ns) };
        for device in all(&mut self.world_devices, &mut self.running) {
            device.act(&mut self.motion, span);
        }
        if let Err(diverged) = self.motion.step(span.length_ns) {
            self.remove_diverged(diverged)?;
        }
        self.time_ns = span.end_ns();
        self.shares.lap(Work::Physics, &mut stopwatch);
        self.graph.advance_to(self.time_ns);
        self.shares.lap(Work::Messages, &mut stopwatch);
        let mut moment = SenseContext {
            span,
            world: &self.motion,
            views: &mut self.views,
            threads: self.options.threads,
        };
        for device in all(&mut self.world_devices, &mut self.running) {
            device.sense(&mut moment);
        }
        self.collect_findings();
        self.shares.lap(Work::Sensing, &mut stopwatch);
        Ok(())
    }

    /// Measures once for subscribers that came while time stands still.
    pub(crate) fn sense_paused(&mut self) {
        let mut moment = SenseContext {
            span: StepInterval { start_ns: self.time_ns, length_ns: 0 },
            world: &self.motion,
            views: &mut self.views,
            threads: self.options.threads,
        };
        for device in all(&mut self.world_devices, &mut self.running) {
            device.sense_paused(&mut moment);
        }
        self.collect_findings();
    }

    /// Mounting poses of the sensors' data, with the name of the model of each.
    pub(crate) fn sensor_mounts(&self) -> impl Iterator<Item = (&str, SensorMount)> {
        self.running.iter().flat_map(|running| {
            let name = running.member.name.as_str();
            let mounts = running.devices.iter().flat_map(|device| device.mounts());
            mounts.map(move |mount| (name, mount))
        })
    }

    /// Takes out a model whose motion diverged; everything else goes on.
    fn remove_diverged(&mut self, diverged: Diverged) -> Result<(), Diverged> {
        let place = self.running.iter().position(|it| Some(it.model) == diverged.model);
        let Some(name) = place.map(|place| self.running[place].member.name.clone()) else {
            return Err(diverged);
        };
        self.delete(&name);
        let message = format!("model `{name}` is removed: {diverged}");
        let mut findings = Diagnostics::new();
        findings.push(Diagnostic::error("model-diverged", message));
        self.log(&findings);
        self.found.append(findings);
        self.diverged.push(diverged);
        Ok(())
    }

    /// Models that were removed because their motion diverged, in the order of time. All else went
    /// on without them.
    #[must_use]
    pub fn diverged(&self) -> &[Diverged] {
        &self.diverged
    }

    /// One step of the world's size; where motion is exact for any step, straight to the time at
    /// which a device has something to do.
    fn next_length_ns(&mut self, end_ns: i64) -> i64 {
        let step_ns = self.step_ns;
        let left_ns = end_ns.saturating_sub(self.time_ns).max(1);
        if self.options.mode == PhysicsMode::Rigid {
            // Always whole: physics with another step is another physics.
            return step_ns;
        }
        let start_ns = self.time_ns;
        let longest_ns = LONGEST_STEP_NS.max(step_ns);
        let due_ns = all(&mut self.world_devices, &mut self.running)
            .filter_map(|device| device.next_ns())
            .map(|due_ns| due_ns - start_ns)
            .filter(|wait_ns| *wait_ns > 0)
            .fold(longest_ns, i64::min);
        // Only whole steps, so that both kinds of motion measure at the same times.
        let steps = (due_ns + step_ns - 1) / step_ns;
        (steps * step_ns).min(left_ns)
    }
}

/// All devices in the order in which they act.
fn all<'a>(
    world: &'a mut [Box<dyn Device>],
    running: &'a mut [Running],
) -> impl Iterator<Item = &'a mut Box<dyn Device>> {
    let own = running.iter_mut().flat_map(|running| &mut running.devices);
    world.iter_mut().chain(own)
}

/// The gravity that a world asks for, or none \[m/s²\].
fn gravity_of(world: &scene::World, findings: &mut Diagnostics) -> DVec3 {
    if is_within(world.gravity_m_s2, MAX_GRAVITY_M_S2) {
        return world.gravity_m_s2;
    }
    let message = format!("gravity is no number, or beyond {MAX_GRAVITY_M_S2} m/s²; there is none");
    findings.push(Diagnostic::error("gravity-out-of-range", message).at(world.origin));
    DVec3::ZERO
}

/// Step of a world that asks for none, or for one out of range \[s\].
const USUAL_STEP_S: f64 = 0.001;

/// The step that a world asks for \[s\].
fn step_of(world: &scene::World, findings: &mut Diagnostics) -> f64 {
    let physics = world.physics.iter().find(|physics| physics.default).or(world.physics.first());
    let asked_s = physics.map_or(USUAL_STEP_S, |physics| physics.max_step_size_s);
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
            .note(format!("steps of {USUAL_STEP_S} s are used")),
    );
    USUAL_STEP_S
}

#[expect(clippy::cast_possible_truncation, reason = "a step is a fraction of a second")]
fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}
