//! Execution of a plan.

use std::any::Any;
use std::path::PathBuf;
use std::sync::Arc;

use crate::{Dialect, LaunchPlan, Trigger};
use periplus_graph::{Graph, Mailbox, Node, NodeSettings, Qos};
use periplus_msgs::lifecycle_msgs::TransitionEvent;
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_sim::{Search, Simulation};
use periplus_sim_nodes::gz_topic;

use crate::bringup::environment;
use crate::bringup::guard::Guard;
use crate::bringup::lockstep::{Lockstep, LockstepNodes};
use crate::bringup::make::{self, BuiltIn, make, pairs_of_bridge};
use crate::bringup::node_logs::NodeLogs;
use crate::bringup::parts::{self, BuiltInRequest, Part, Program, Work, own_folder};
use crate::bringup::preparation::{self, MAX_WAIT_NS};
use crate::bringup::processes::LaunchProcesses;
use crate::bringup::python::PythonInterpreter;
use crate::bringup::report::{LaunchLog, PartOutcome, PartOutcomeKind, PartReport};
use crate::bringup::tasks::{Child, Done, Task, TaskContext, TransitionTask};
use crate::bringup::world::WorldRequest;
use crate::bringup::xacro::xacro;

/// Settings of an execution.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Search paths of packages, models and files.
    pub search: Search,
    /// ROS version of the launch file.
    pub dialect: Dialect,
    /// True if ROS programs can reach the graph.
    pub is_wired: bool,
    /// True if the run is in ROS 1, so that compiled programs of ROS 1 can reach the graph.
    pub has_ros1_master: bool,
    /// True if the run keeps pace with real time.
    pub is_paced: bool,
    /// Words that start a program which ends remaining processes when this one is killed: this program
    /// itself, which runs [`crate::bringup::guard`] with [`crate::bringup::GUARD_VERB`]. Empty for none.
    pub guarding_command: Vec<String>,
    /// Folder of built-in programs that its processes find at the end of the PATH.
    pub tools: Option<PathBuf>,
    /// Interpreter of nodes in Python.
    pub python: PythonInterpreter,
    /// True if nodes in Python use the ROS that is installed.
    pub uses_real_ros: bool,
    /// Environment variables of nodes in Python, which join the network of this run.
    pub node_environment: Vec<(String, String)>,
}

/// Event.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Event {
    Started(usize),
    Ended(usize),
    Printed(usize),
    Reached { step: usize, from: String, to: String },
    Shutdown,
}

/// State of a part.
struct PartState {
    part: Part,
    /// Number of triggers that have occurred.
    come: usize,
    /// Index of the first event to check for the next trigger.
    cursor: usize,
    /// Time of the last trigger \[ns\].
    since_ns: i64,
    is_begun: bool,
}

/// Node of a plan with a lifecycle.
struct LifecycleNodeOfPlan {
    step: usize,
    /// Full name.
    name: String,
    /// True if it waits for transitions.
    is_managed: bool,
}

/// Execution of a plan on a graph. The caller calls [`LaunchRunner::work`] periodically.
pub struct LaunchRunner {
    waiting: Vec<PartState>,
    events: Vec<Event>,
    tasks: Vec<(usize, Box<dyn Task>)>,
    kept: Vec<Box<dyn Any + Send>>,
    watched: Vec<(usize, Mailbox<TransitionEvent>)>,
    lines: Vec<PartReport>,
    said: Vec<LaunchLog>,
    settings: Settings,
    /// Names of nodes without a built-in replacement.
    lacking: Vec<String>,
    /// Search paths of files that the world and spawned models refer to.
    world_search: Search,
    guard: Guard,
    lockstep: LockstepNodes,
    processes: LaunchProcesses,
    node_logs: NodeLogs,
    is_over: bool,
    /// Time of the last call \[ns\].
    last_ns: i64,
}

impl LaunchRunner {
    /// Prepares a plan.
    #[must_use]
    pub fn new(plan: &LaunchPlan, settings: Settings) -> Self {
        let waiting = parts::parts_of_plan(plan).into_iter().map(|mut part| {
            if let Work::Program(program) = &mut part.work {
                program.find_python(&settings.search);
            }
            PartState { part, come: 0, cursor: 0, since_ns: 0, is_begun: false }
        });
        let waiting = waiting.collect();
        let mut bringup = Self {
            waiting,
            events: Vec::new(),
            tasks: Vec::new(),
            kept: Vec::new(),
            watched: Vec::new(),
            lines: Vec::new(),
            said: Vec::new(),
            settings,
            lacking: Vec::new(),
            world_search: Search::default(),
            guard: Guard::default(),
            lockstep: LockstepNodes::default(),
            processes: LaunchProcesses::default(),
            node_logs: NodeLogs::default(),
            is_over: false,
            last_ns: 0,
        };
        bringup.world_search = bringup.search_of_world(plan);
        bringup.lacking = bringup
            .asks()
            .filter(|(_, ask)| ask.entry.role == crate::bringup::catalogue::Role::Lacking)
            .map(|(_, ask)| ask.full_name())
            .collect();
        bringup
    }

    /// Sets whether ROS programs can reach the graph, once that is known.
    pub fn set_wired(&mut self, is_wired: bool) {
        self.settings.is_wired = is_wired;
    }

    /// Runs nodes in Python in step with the simulation, unless ROS programs can reach the graph.
    pub fn set_lockstep(&mut self, host: Arc<dyn Lockstep>) {
        self.lockstep = LockstepNodes::new(host);
    }

    /// Processes of the launch, for a thread that watches them while the run waits.
    #[must_use]
    pub fn processes(&self) -> LaunchProcesses {
        self.processes.clone()
    }

    /// World to simulate, if any; of several the first with a file.
    #[must_use]
    pub fn world(&self) -> Option<&WorldRequest> {
        match &self.waiting[self.world_part()?].part.work {
            Work::World(wish) => Some(wish),
            _ => None,
        }
    }

    /// Part that starts the world.
    fn world_part(&self) -> Option<usize> {
        let worlds = || {
            self.waiting.iter().enumerate().filter_map(|(index, waiting)| {
                match &waiting.part.work {
                    Work::World(wish) => Some((index, wish)),
                    _ => None,
                }
            })
        };
        let named = worlds().find(|(_, wish)| wish.file.is_some());
        named.or_else(|| worlds().next()).map(|(index, _)| index)
    }

    /// Search paths of files that the world and spawned models refer to: the environment and the
    /// working folder of the step that starts it.
    #[must_use]
    pub fn search(&self) -> &Search {
        &self.world_search
    }

    fn search_of_world(&self, plan: &LaunchPlan) -> Search {
        let mut search = self.settings.search.clone();
        let Some(wish) = self.world() else { return search };
        search.variables.extend(wish.environment.clone());
        if let Some(folder) = &wish.folder {
            search.working_folder = search.working_folder.join(folder);
        }
        search.advice = Some(environment::advice(&environment::settings(&plan.steps), wish));
        search
    }

    /// Runs the processes that must end before the world can be loaded: those that it waits for,
    /// and those that write its file. Call it until it returns true; the time is wall time \[ns\].
    pub fn prepare(&mut self, graph: &Graph, wall_ns: i64) -> bool {
        let Some(world) = self.world_part() else { return true };
        let wanted = preparation::of_world(&self.waiting_parts(), world);
        if wanted.is_empty() {
            return true;
        }
        let is_wanted = |index: usize| wanted.contains(&index);
        while self.begin_some(graph, wall_ns, &is_wanted) {}
        self.work_hands(graph, wall_ns, None);
        while self.begin_some(graph, wall_ns, &is_wanted) {}
        let runs = self.tasks.iter().any(|(part, _)| is_wanted(*part));
        let may_come = wanted.iter().any(|index| {
            let waiting = &self.waiting[*index];
            let next = waiting.part.after.get(waiting.come);
            !waiting.is_begun && matches!(next, Some(Trigger::Seconds(_)))
        });
        let has_file = self.world_file().is_some_and(|file| Machine.kind(&file).is_some());
        let is_ready = !(runs || may_come) || (has_file && wall_ns > MAX_WAIT_NS);
        if is_ready {
            // From here on the time is simulated.
            self.waiting.iter_mut().for_each(|waiting| waiting.since_ns = 0);
        }
        is_ready
    }

    fn waiting_parts(&self) -> Vec<&Part> {
        self.parts().collect()
    }

    /// Parts of the plan, in its order.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &Part> {
        self.waiting.iter().map(|waiting| &waiting.part)
    }

    pub(crate) fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Path of the world file.
    fn world_file(&self) -> Option<PathBuf> {
        let file = self.world()?.file.as_deref()?;
        Some(self.world_search.working_folder.join(file))
    }

    /// Returns true if a node of the plan publishes joint states, so that no default publisher is
    /// needed.
    #[must_use]
    pub fn publishes_joint_states(&self) -> bool {
        self.has(crate::bringup::catalogue::Role::JointStatePublisher)
    }

    /// Returns true if the plan starts controllers of `ros2_control`, so that the simulation leaves
    /// that to it.
    #[must_use]
    pub fn spawns_controllers(&self) -> bool {
        use crate::bringup::catalogue::Role;
        self.has(Role::Controllers { unloads: false }) || self.has(Role::ControlCommand)
    }

    /// Returns false if the plan bridges topics of Gazebo to ROS, but not `/tf`. Bridges whose arguments cannot be
    /// read count as bridges of all topics.
    #[must_use]
    pub fn bridges_transforms(&self) -> bool {
        let mut is_partial = false;
        for (_, ask) in self.asks().filter(|(_, ask)| ask.entry.is_bridge_of_topics()) {
            match pairs_of_bridge(ask, &make::parameters(ask, &mut Vec::new())) {
                Ok(pairs) if pairs.iter().all(|pair| gz_topic(&pair.gz) != "/tf") => {
                    is_partial |= !pairs.is_empty();
                }
                _ => return true,
            }
        }
        !is_partial
    }

    /// Returns true if the plan starts RViz or a Gazebo window.
    #[must_use]
    pub fn wants_page(&self) -> bool {
        self.has(crate::bringup::catalogue::Role::Viewer)
            || self.world().is_some_and(|wish| wish.has_window)
    }

    /// RViz files of the plan.
    #[must_use]
    pub fn views(&self) -> Vec<PathBuf> {
        let path = |ask: &BuiltInRequest| {
            let file = option_of_viewer(ask, "d", "display-config")?;
            let folder = &self.settings.search.working_folder;
            Some(folder.join(ask.path(folder, file)))
        };
        self.asks().filter_map(|(_, ask)| path(ask)).collect()
    }

    /// Fixed frame that the first RViz of the plan is started with (`-f`).
    #[must_use]
    pub fn fixed_frame(&self) -> Option<String> {
        let mut viewers = self.asks();
        let frame = viewers.find_map(|(_, ask)| option_of_viewer(ask, "f", "fixed-frame"));
        frame.map(str::to_owned)
    }

    /// Returns true if a node of the plan uses `/clock`.
    #[must_use]
    pub fn follows_clock(&self) -> bool {
        let mut notes = Vec::new();
        let wants = |ask: &BuiltInRequest, notes: &mut Vec<String>| {
            let named = crate::bringup::make::parameters(ask, notes);
            crate::bringup::parameters::truth_of(&named, "use_sim_time") == Some(true)
        };
        self.asks().any(|(_, ask)| wants(ask, &mut notes))
    }

    fn has(&self, role: crate::bringup::catalogue::Role) -> bool {
        self.asks().any(|(_, ask)| ask.entry.role == role)
    }

    fn asks(&self) -> impl Iterator<Item = (usize, &BuiltInRequest)> {
        self.waiting.iter().filter_map(|waiting| match &waiting.part.work {
            Work::Ours(ask) => Some((waiting.part.step, &**ask)),
            _ => None,
        })
    }

    /// Lifecycle nodes, and built-in nodes that may be one.
    fn lifecycle_nodes(&self) -> impl Iterator<Item = LifecycleNodeOfPlan> {
        self.waiting.iter().filter_map(|waiting| {
            let (name, is_managed) = match &waiting.part.work {
                Work::Ours(ask) => (ask.full_name(), ask.is_managed),
                Work::Program(program) if program.is_lifecycle => (program.full_name()?, true),
                _ => return None,
            };
            Some(LifecycleNodeOfPlan { step: waiting.part.step, name, is_managed })
        })
    }

    /// Outcomes of the parts that were started, in their order.
    #[must_use]
    pub fn lines(&self) -> &[PartReport] {
        &self.lines
    }

    /// Returns the log messages since the last call.
    pub fn take_log(&mut self) -> Vec<LaunchLog> {
        std::mem::take(&mut self.said)
    }

    /// Returns true after a shutdown action.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// Returns true if nothing runs, and nothing will start.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        let waits = |waiting: &PartState| {
            let timed = |trigger: &Trigger| matches!(trigger, Trigger::Seconds(_));
            !waiting.is_begun && waiting.part.after.get(waiting.come).is_none_or(timed)
        };
        self.tasks.is_empty() && self.kept.is_empty() && !self.waiting.iter().any(waits)
    }

    /// Processes everything due at this time \[ns\].
    pub fn work(&mut self, graph: &Graph, now_ns: i64, simulation: Option<&mut Simulation>) {
        if now_ns < self.last_ns {
            // After a reset of the world, timers of the launch continue.
            let back_ns = self.last_ns - now_ns;
            self.waiting.iter_mut().for_each(|waiting| waiting.since_ns -= back_ns);
            self.tasks.iter_mut().for_each(|(_, hand)| hand.time_went_back(back_ns));
        }
        self.last_ns = now_ns;
        self.hear();
        // Starting a part may trigger others; a plan is finite, so this loop ends.
        while self.begin(graph, now_ns) {}
        self.work_hands(graph, now_ns, simulation);
        while self.begin(graph, now_ns) {}
        self.said.extend(self.node_logs.take(graph, &self.lines));
        self.lockstep.admit();
    }

    fn work_hands(&mut self, graph: &Graph, now_ns: i64, mut simulation: Option<&mut Simulation>) {
        let mut ended = Vec::new();
        for (part, hand) in &mut self.tasks {
            let mut stage = TaskContext {
                graph,
                now_ns,
                simulation: simulation.as_deref_mut(),
                search: &self.world_search,
                said: &mut self.said,
                has_printed: false,
            };
            let done = hand.work(&mut stage);
            let step = self.waiting[*part].part.step;
            if stage.has_printed {
                self.events.push(Event::Printed(step));
            }
            if done == Done::Yes {
                ended.push(*part);
            }
        }
        self.tasks.retain(|(part, _)| !ended.contains(part));
        for part in ended {
            self.end(part);
        }
    }

    /// Ends all programs; shutdown messages of the plan are logged.
    pub fn end_all(&mut self, graph: &Graph, now_ns: i64) {
        self.events.push(Event::Shutdown);
        while self.begin(graph, now_ns) {}
        self.lockstep.close();
        // All are asked first, so that they end in parallel.
        self.tasks.iter_mut().for_each(|(_, hand)| hand.ask_to_stop());
        self.tasks.iter_mut().for_each(|(_, hand)| hand.stop(&mut self.said));
        self.tasks.clear();
    }

    fn end(&mut self, part: usize) {
        let part = &self.waiting[part].part;
        self.events.push(Event::Ended(part.step));
        if part.is_required {
            let text = format!("`{}` has ended and is required: shutting down", part.asked);
            self.said.push(LaunchLog::warning(text));
            self.is_over = true;
        }
    }

    /// Processes state changes of lifecycle nodes.
    fn hear(&mut self) {
        for (step, mailbox) in &self.watched {
            for event in mailbox.drain() {
                let (from, to) = (event.start_state.label.clone(), event.goal_state.label.clone());
                self.events.push(Event::Reached { step: *step, from, to });
            }
        }
    }

    /// Starts all parts that are due; returns true if there was one.
    fn begin(&mut self, graph: &Graph, now_ns: i64) -> bool {
        if self.watched.is_empty() {
            self.watch(graph);
        }
        self.begin_some(graph, now_ns, &|_| true)
    }

    fn begin_some(&mut self, graph: &Graph, now_ns: i64, wanted: &dyn Fn(usize) -> bool) -> bool {
        let mut has_begun = false;
        for index in (0..self.waiting.len()).filter(|index| wanted(*index)) {
            let waiting = &mut self.waiting[index];
            if waiting.is_begun || !waiting.is_due(&self.events, now_ns) {
                continue;
            }
            waiting.is_begun = true;
            has_begun = true;
            self.start(index, graph, now_ns);
        }
        has_begun
    }

    /// Subscribes to the lifecycle nodes that triggers refer to.
    fn watch(&mut self, graph: &Graph) {
        let waits_for = |step: usize| {
            self.waiting.iter().flat_map(|waiting| &waiting.part.after).any(|trigger| {
                matches!(trigger, Trigger::Reached { step: of, .. } if of.is_none_or(|of| of == step))
            })
        };
        let wanted: Vec<(usize, String)> = self
            .lifecycle_nodes()
            .filter(|node| waits_for(node.step))
            .map(|node| (node.step, node.name))
            .collect();
        if wanted.is_empty() {
            return;
        }
        let Ok(node) = listener(graph) else { return };
        for (step, name) in wanted {
            let topic = format!("{name}/transition_event");
            if let Ok(mailbox) = node.mailbox(&topic, Qos::reliable(100)) {
                self.watched.push((step, mailbox));
            }
        }
        self.kept.push(Box::new(node));
    }

    fn start(&mut self, index: usize, graph: &Graph, now_ns: i64) {
        let part = self.waiting[index].part.clone();
        self.events.push(Event::Started(part.step));
        match &part.work {
            Work::World(wish) => {
                let file = wish.file.as_deref().unwrap_or("an empty plane");
                self.record_outcome(
                    &part,
                    PartOutcomeKind::World,
                    None,
                    format!("the simulation of {file}"),
                );
                self.kept.push(Box::new(()));
            }
            Work::Ours(ask) => {
                let made = make(ask, graph, now_ns, &self.settings, &self.lacking);
                self.take(index, &part, ask, made);
            }
            Work::Xacro(program) => self.xacro(index, &part, program),
            Work::Program(program) => self.program(index, &part, program),
            Work::Transition { step, transition } => {
                let targets: Vec<String> = self
                    .lifecycle_nodes()
                    .filter(|node| step.map_or(node.is_managed, |step| step == node.step))
                    .map(|node| node.name)
                    .collect();
                for name in targets {
                    match TransitionTask::new(graph, &name, transition) {
                        Ok(changer) => self.tasks.push((index, Box::new(changer))),
                        Err(why) => self.said.push(LaunchLog::error(why)),
                    }
                }
            }
            Work::Log { level, text } => {
                let level = periplus_graph::Level::named(level);
                let level = level.unwrap_or(periplus_graph::Level::Info);
                self.said.push(LaunchLog::of_launch(level, text));
            }
            Work::Shutdown { reason } => {
                let reason =
                    if reason.is_empty() { "requested by the launch file" } else { reason };
                self.said.push(LaunchLog::info(format!("shutdown: {reason}")));
                self.is_over = true;
            }
            Work::Nothing(why) => {
                self.said.push(LaunchLog::warning(why.clone()));
                self.record_outcome(&part, PartOutcomeKind::Missing, None, why.clone());
            }
        }
    }

    /// Starts a program.
    fn program(&mut self, index: usize, part: &Part, program: &Program) {
        let kind = match program.python {
            Some(_) => PartOutcomeKind::Python,
            None => PartOutcomeKind::Program,
        };
        let (settings, processes) = (&self.settings, &self.processes);
        match Child::start(program, settings, &self.guard, &self.lockstep, processes) {
            Ok(child) => {
                self.record_outcome(part, kind, program.full_name(), child.told());
                self.tasks.push((index, Box::new(child)));
            }
            Err(why) => {
                self.said.push(LaunchLog::error(format!("`{}` does not run: {why}", part.asked)));
                self.record_outcome(part, PartOutcomeKind::Missing, None, why);
                self.end(index);
            }
        }
    }

    /// Runs the built-in `xacro`; it ends immediately.
    fn xacro(&mut self, index: usize, part: &Part, program: &Program) {
        let mut search = self.settings.search.clone();
        search.variables.extend(environment::of_running(&program.running));
        if let Some(folder) = own_folder(&program.running) {
            search.working_folder = search.working_folder.join(folder);
        }
        let ran = search.with_context(false, |context| xacro(&program.words[1..], context));
        let (kind, told) = match ran {
            Ok(ran) if ran.printed.is_success => {
                if let Some(text) = Some(ran.printed.output).filter(|text| !text.is_empty()) {
                    self.said.push(LaunchLog::info(text));
                    self.events.push(Event::Printed(part.step));
                }
                let file = ran.file.map(|file| format!(" writes {}", file.display()));
                (
                    PartOutcomeKind::BuiltIn,
                    format!("the built-in xacro{}", file.unwrap_or_default()),
                )
            }
            Ok(ran) => {
                let why = ran.printed.errors.trim_end();
                self.said.push(LaunchLog::error(format!("`{}` failed: {why}", part.asked)));
                (PartOutcomeKind::Missing, "xacro could not expand its file".to_owned())
            }
            Err(why) => {
                self.said.push(LaunchLog::error(format!("`{}` failed: {why}", part.asked)));
                (PartOutcomeKind::Missing, why.to_string())
            }
        };
        self.record_outcome(part, kind, None, told);
        self.end(index);
    }

    fn take(
        &mut self,
        index: usize,
        part: &Part,
        ask: &BuiltInRequest,
        made: Result<BuiltIn, String>,
    ) {
        match made {
            Ok(made) => {
                for note in made.notes {
                    self.said.push(LaunchLog::warning(format!("`{}`: {note}", part.asked)));
                }
                self.record_outcome(part, made.kind, made.node, made.told);
                self.kept.extend(made.kept);
                for hand in made.tasks {
                    self.tasks.push((index, hand));
                }
            }
            Err(why) => {
                let told = format!("`{}` cannot run: {why}", part.asked);
                self.said.push(LaunchLog::error(told));
                self.record_outcome(part, PartOutcomeKind::Missing, Some(ask.full_name()), why);
                self.end(index);
            }
        }
    }

    fn record_outcome(
        &mut self,
        part: &Part,
        kind: PartOutcomeKind,
        node: Option<String>,
        told: String,
    ) {
        let outcome = PartOutcome { kind, node, told };
        self.lines.push(PartReport { step: part.step, asked: part.asked.clone(), outcome });
    }
}

/// Node for the subscriptions of the plan.
fn listener(graph: &Graph) -> Result<Node, periplus_graph::GraphError> {
    graph.node(NodeSettings::new("launch_ros").bare().keep_names())
}

impl PartState {
    /// Returns true if all its triggers have occurred.
    fn is_due(&mut self, events: &[Event], now_ns: i64) -> bool {
        while let Some(trigger) = self.part.after.get(self.come) {
            let has_come = match trigger {
                Trigger::Seconds(seconds) => now_ns - self.since_ns >= nanoseconds(*seconds),
                trigger => match events[self.cursor..].iter().position(|one| one.is(trigger)) {
                    Some(place) => {
                        self.cursor += place + 1;
                        true
                    }
                    None => false,
                },
            };
            if !has_come {
                return false;
            }
            self.come += 1;
            self.since_ns = now_ns;
        }
        true
    }
}

impl Event {
    fn is(&self, trigger: &Trigger) -> bool {
        let same = |wanted: &Option<usize>, step: &usize| wanted.is_none_or(|it| it == *step);
        let same_state = |wanted: &Option<String>, state: &str| {
            wanted.as_deref().is_none_or(|wanted| wanted == state)
        };
        match (self, trigger) {
            (Self::Started(step), Trigger::Started(of))
            | (Self::Ended(step), Trigger::Ended(of))
            | (Self::Printed(step), Trigger::Printed(of)) => same(of, step),
            (
                Self::Reached { step, from, to },
                Trigger::Reached { step: of, from: wanted_from, to: wanted_to },
            ) => same(of, step) && same_state(wanted_from, from) && same_state(wanted_to, to),
            (Self::Shutdown, Trigger::Shutdown) => true,
            _ => false,
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "it saturates")]
fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

/// Value of an RViz option, by its short or long name.
fn option_of_viewer<'a>(ask: &'a BuiltInRequest, short: &str, long: &str) -> Option<&'a str> {
    let words = &ask.told.own;
    let value = || {
        crate::bringup::words::option(words, short)
            .or_else(|| crate::bringup::words::option(words, long))
    };
    if ask.entry.role == crate::bringup::catalogue::Role::Viewer { value() } else { None }
}
