//! Parts of a plan: each step with its built-in replacement.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::{Component, Identity, LaunchPlan, PlanNode, PlanStep, Process, Running, Trigger, What};
use periplus_sim::Search;
use serde_json::{Value, json};

use crate::bringup::catalogue::{Entry, Role, of_plugin, of_program};
use crate::bringup::environment;
use crate::bringup::includes;
use crate::bringup::python::{self, PythonNode, is_python_file};
use crate::bringup::words::{self, ProgramArguments};
use crate::bringup::world::{self, WorldRequest};

/// Part of a plan.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Step of the plan.
    pub(crate) step: usize,
    /// Triggers that must have occurred before, one after another.
    pub(crate) after: Vec<Trigger>,
    /// Task.
    pub(crate) work: Work,
    /// Name in the launch file: `gazebo_ros spawn_entity.py`.
    pub(crate) asked: String,
    /// True if its end shuts the launch down.
    pub(crate) is_required: bool,
}

/// Task of a part.
#[derive(Clone, Debug)]
pub(crate) enum Work {
    /// Simulation.
    World(WorldRequest),
    /// Built-in replacement of a program.
    Ours(Box<BuiltInRequest>),
    /// External program.
    Program(Box<Program>),
    /// Built-in `xacro`.
    Xacro(Box<Program>),
    /// Transition of a lifecycle node.
    Transition { step: Option<usize>, transition: String },
    /// Log message.
    Log { level: String, text: String },
    /// Shutdown.
    Shutdown { reason: String },
    /// Nothing, with the reason.
    Nothing(String),
}

/// Request for a built-in replacement.
#[derive(Clone, Debug)]
pub(crate) struct BuiltInRequest {
    pub(crate) entry: &'static Entry,
    pub(crate) identity: Identity,
    pub(crate) told: ProgramArguments,
    /// True if it waits for a lifecycle manager.
    pub(crate) is_managed: bool,
    /// ROS 1 parameter server.
    pub(crate) server: BTreeMap<String, Value>,
    /// Process settings of the program.
    pub(crate) running: Running,
    /// Launch file line: `FILE:LINE`.
    pub(crate) written: Option<String>,
}

impl BuiltInRequest {
    /// Resolves a path relative to the working folder of the program.
    pub(crate) fn path(&self, launch_folder: &Path, path: &str) -> String {
        match own_folder(&self.running) {
            Some(folder) if !path.contains("://") => {
                launch_folder.join(folder).join(path).display().to_string()
            }
            _ => path.to_owned(),
        }
    }

    /// Full name of its node.
    pub(crate) fn full_name(&self) -> String {
        words::full_name(&self.identity, &self.told, self.entry.node)
    }
}

/// External program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    /// Package; `None` for a command and for a node given by its path.
    pub(crate) package: Option<String>,
    /// Command line, starting with the program.
    pub(crate) words: Vec<String>,
    pub(crate) is_shell: bool,
    /// True for a node, false for a command.
    pub(crate) is_node: bool,
    /// True if its command line is complete: that of `ros2 run`, which adds no `--ros-args`.
    pub(crate) is_complete: bool,
    pub(crate) is_lifecycle: bool,
    /// Name, parameters and remappings, if it is a node.
    pub(crate) identity: Identity,
    /// Arguments after `--ros-args` other than names and parameters.
    pub(crate) ros_arguments: Vec<String>,
    pub(crate) running: Running,
    /// ROS 1 parameter server.
    pub(crate) server: BTreeMap<String, Value>,
    /// Launch file line: `FILE:LINE`.
    pub(crate) written: Option<String>,
    /// Node in Python, which the interpreter runs.
    pub(crate) python: Option<PythonNode>,
    /// Number of words that name the program; the others are its arguments.
    pub(crate) program_words: usize,
}

impl Program {
    /// Full name of its node; `None` if only the program knows it.
    pub(crate) fn full_name(&self) -> Option<String> {
        let told = words::read(&[], &self.ros_arguments);
        let name = told.name.as_deref().or(self.identity.name.as_deref())?;
        Some(words::full_name(&self.identity, &told, name))
    }

    /// Name in messages: that of its node, or of the program.
    pub(crate) fn label(&self) -> String {
        self.full_name().unwrap_or_else(|| {
            let program = self.words.get(self.program_words.saturating_sub(1));
            let program = program.map(String::as_str).unwrap_or_default();
            program.rsplit('/').next().unwrap_or_default().to_owned()
        })
    }

    /// Finds its node in Python: in the package around the launch file, or around the working folder.
    pub(crate) fn find_python(&mut self, search: &Search) {
        let environment = environment::of_running(&self.running);
        if let Some(package) = &self.package {
            let program = self.words.first().map(String::as_str).unwrap_or_default();
            self.python = self.package_search_starts(search).iter().find_map(|from| {
                PythonNode::of_package(package, program, search, from, &environment)
            });
            return;
        }
        if self.is_shell {
            return;
        }
        let folder = own_folder(&self.running)
            .map_or_else(|| search.working_folder.clone(), |own| search.working_folder.join(own));
        if self.is_node {
            let path = folder.join(self.words.first().map(String::as_str).unwrap_or_default());
            self.python = is_python_file(&path).then(|| PythonNode::of_file(path));
        } else if let Some((node, words)) = python::of_command(&self.words, &folder) {
            (self.python, self.program_words) = (Some(node), words);
        }
    }

    /// Files around which its package is searched: the launch file, and one in the working folder.
    pub(crate) fn package_search_starts(&self, search: &Search) -> Vec<PathBuf> {
        let written = self.written.as_deref().and_then(|written| written.rsplit_once(':'));
        let launch_file = written.map(|(file, _line)| PathBuf::from(file));
        launch_file.into_iter().chain([search.working_folder.join("launch")]).collect()
    }
}

/// Parts of a plan, in its order.
pub(crate) fn parts_of_plan(plan: &LaunchPlan) -> Vec<Part> {
    let mut parts = Vec::new();
    for step in &plan.steps {
        of_step(step, &step.what, &plan.parameters, &mut parts);
    }
    parts
}

/// Working folder in the launch file. `node`, `ROS_HOME` and `ros-root` of ROS 1 are ignored.
pub(crate) fn own_folder(running: &Running) -> Option<&str> {
    let folder = running.folder.as_deref()?;
    let is_named = !matches!(folder, "" | "node" | "ROS_HOME" | "ros-root");
    is_named.then_some(folder)
}

/// World with the environment and folder of its program.
fn placed(work: Work, running: &Running) -> Work {
    match work {
        Work::World(wish) => Work::World(WorldRequest {
            environment: environment::of_running(running),
            folder: own_folder(running).map(str::to_owned),
            ..wish
        }),
        work => work,
    }
}

fn of_step(step: &PlanStep, what: &What, server: &BTreeMap<String, Value>, parts: &mut Vec<Part>) {
    let mut add = |asked: String, is_required: bool, work: Work| {
        let after = step.after.clone();
        let work = match work {
            Work::World(wish) => {
                Work::World(WorldRequest { step: step.id, written: step.written.clone(), ..wish })
            }
            Work::Ours(ask) => {
                Work::Ours(Box::new(BuiltInRequest { written: step.written.clone(), ..*ask }))
            }
            Work::Program(program) => {
                Work::Program(Box::new(Program { written: step.written.clone(), ..*program }))
            }
            work => work,
        };
        parts.push(Part { step: step.id, after, work, asked, is_required });
    };
    match what {
        What::Node(node) => {
            let asked = match &node.package {
                Some(package) => format!("{package} {}", node.executable),
                None => node.executable.clone(),
            };
            add(asked, node.running.is_required, placed(of_node(node, server), &node.running));
            for component in &node.components {
                let work = of_component(component, server, &node.running);
                add(component.plugin.clone(), false, placed(work, &node.running));
            }
            let is_program = parts.last().is_some_and(|part| matches!(part.work, Work::Program(_)));
            if is_program && node.is_lifecycle && activates_itself(node) {
                parts.extend(activation(step));
            }
        }
        What::Load { components, .. } => {
            for component in components {
                let work = of_component(component, server, &Running::default());
                add(component.plugin.clone(), false, work);
            }
        }
        What::Process(process) => {
            let is_required = process.running.is_required;
            let work = placed(of_process(process), &process.running);
            add(shortly(&process.command), is_required, work);
        }
        What::Transition { step, transition } => add(
            transition.clone(),
            false,
            Work::Transition { step: *step, transition: transition.clone() },
        ),
        What::Log { level, text } => {
            add(text.clone(), false, Work::Log { level: level.clone(), text: text.clone() });
        }
        What::Shutdown { reason } => {
            add(reason.clone(), false, Work::Shutdown { reason: reason.clone() });
        }
        What::Include { file, arguments } => match includes::replacement(file, arguments) {
            Some(includes::Replacement::World(wish)) => {
                let environment = environment::of_step(step);
                add(file.clone(), false, Work::World(WorldRequest { environment, ..wish }));
            }
            Some(includes::Replacement::Steps(steps)) => {
                for what in &steps {
                    of_step(step, what, server, parts);
                }
            }
            None => add(
                file.clone(),
                false,
                Work::Nothing(format!(
                    "{file} is in a package that is not on this machine, and there is no built-in replacement for \
                     it; `--resource-path FOLDER` names where the package is"
                )),
            ),
        },
    }
}

fn of_node(node: &PlanNode, server: &BTreeMap<String, Value>) -> Work {
    let told = words::read(&node.arguments, &node.ros_arguments);
    let Some(entry) = of_program(node.package.as_deref(), &node.executable) else {
        let mut words = vec![node.executable.clone()];
        words.extend(node.arguments.iter().cloned());
        let program = Box::new(Program {
            package: node.package.clone(),
            words,
            is_node: true,
            is_lifecycle: node.is_lifecycle,
            identity: node.identity.clone(),
            ros_arguments: node.ros_arguments.clone(),
            running: node.running.clone(),
            server: server.clone(),
            program_words: 1,
            ..Program::default()
        });
        return match node.package.as_deref() {
            Some("xacro") => Work::Xacro(program),
            _ => Work::Program(program),
        };
    };
    if entry.role == Role::Gazebo {
        let is_gz = node.package.as_deref().is_some_and(|package| package.starts_with("ros_"));
        let wish = if is_gz { server_wish(&node.identity) } else { world::classic(&told.own) };
        let has_window = wish.has_window && !node.executable.contains("server");
        return Work::World(WorldRequest { has_window, ..wish });
    }
    let is_lifecycle = node.is_lifecycle && !activates_itself(node);
    ours(entry, &node.identity, told, is_lifecycle, server, &node.running)
}

/// Returns true for a node that `autostart` configures and activates.
fn activates_itself(node: &PlanNode) -> bool {
    node.arguments.iter().chain(&node.ros_arguments).any(|word| word == "--autostart")
}

/// Transitions of a lifecycle node in another process that is to activate itself.
fn activation(step: &PlanStep) -> [Part; 2] {
    let part = |trigger: Trigger, transition: &str| Part {
        step: step.id,
        after: step.after.iter().cloned().chain([trigger]).collect(),
        work: Work::Transition { step: Some(step.id), transition: transition.to_owned() },
        asked: transition.to_owned(),
        is_required: false,
    };
    let to = Some("inactive".to_owned());
    let inactive = Trigger::Reached { step: Some(step.id), from: None, to };
    [part(Trigger::Started(Some(step.id)), "configure"), part(inactive, "activate")]
}

fn of_component(
    component: &Component,
    server: &BTreeMap<String, Value>,
    running: &Running,
) -> Work {
    match of_plugin(&component.package, &component.plugin) {
        Some(entry) if entry.role == Role::Gazebo => Work::World(server_wish(&component.identity)),
        Some(entry) => {
            ours(entry, &component.identity, ProgramArguments::default(), false, server, running)
        }
        None => Work::Nothing(format!(
            "the component {} of the package {} is compiled code for ROS without a built-in replacement",
            component.plugin, component.package
        )),
    }
}

fn ours(
    entry: &'static Entry,
    identity: &Identity,
    told: ProgramArguments,
    is_lifecycle: bool,
    server: &BTreeMap<String, Value>,
    running: &Running,
) -> Work {
    let is_managed = is_lifecycle
        || matches!(
            entry.role,
            Role::MapServer { is_managed: true }
                | Role::Amcl { is_managed: true }
                | Role::MapSaverServer
                | Role::Navigation(_)
                | Role::Costmap
        );
    Work::Ours(Box::new(BuiltInRequest {
        entry,
        identity: identity.clone(),
        told,
        is_managed,
        server: server.clone(),
        running: running.clone(),
        written: None,
    }))
}

/// World of `gzserver` of `ros_gz_sim`, from its parameters.
fn server_wish(identity: &Identity) -> WorldRequest {
    let mut wish = WorldRequest::default();
    for values in &identity.parameters {
        if let crate::PlanParameters::Values(values) = values
            && let Some(Value::String(file)) = values.get("world_sdf_file")
        {
            wish.file = Some(file.clone()).filter(|file| !file.is_empty());
        }
    }
    wish
}

fn of_process(process: &Process) -> Work {
    let split;
    let words = if process.is_shell {
        split = process.command.join(" ").split_whitespace().map(str::to_owned).collect();
        &split
    } else {
        &process.command
    };
    if let Some(wish) = world::of_command(words) {
        return Work::World(wish);
    }
    if let [ros, control, load, rest @ ..] = words.as_slice()
        && is_program(ros, "ros2")
        && control == "control"
        && load == "load_controller"
        && let Some(entry) = of_program(Some("ros2controlcli"), load)
    {
        let told = words::read(rest, &[]);
        return ours(entry, &Identity::default(), told, false, &BTreeMap::new(), &process.running);
    }
    let run = match words.as_slice() {
        [ros, run, package, program, rest @ ..] if (is_program(ros, "ros2") && run == "run") => {
            Some((package, program, rest))
        }
        [rosrun, package, program, rest @ ..] if is_program(rosrun, "rosrun") => {
            Some((package, program, rest))
        }
        _ => None,
    };
    // Shell syntax (pipes, redirections) is left to the shell.
    let is_plain = |word: &String| !word.contains(['|', '>', '<', '&', ';', '$', '`']);
    let is_plain = !process.is_shell || words.iter().all(is_plain);
    if let Some((package, program, rest)) = run
        && (is_plain || of_program(Some(package), program).is_some())
    {
        let node = PlanNode {
            package: Some(package.clone()),
            executable: program.clone(),
            arguments: rest.to_vec(),
            running: process.running.clone(),
            ..PlanNode::default()
        };
        let mut work = of_node(&node, &BTreeMap::new());
        if let Work::Program(program) = &mut work {
            program.is_complete = true;
        }
        return work;
    }
    let window =
        if world::is_window(words) { of_program(Some("gazebo_ros"), "gzclient") } else { None };
    // A program by its path or command line, such as `rviz2 -d a.rviz`.
    let named = window.or_else(|| {
        let program = words.first()?;
        let entry = of_program(None, program)?;
        matches!(entry.role, Role::Viewer | Role::RobotStatePublisher).then_some(entry)
    });
    if let Some(entry) = named {
        let told = words::read(&words[1..], &[]);
        let identity = Identity::default();
        return ours(entry, &identity, told, false, &BTreeMap::new(), &process.running);
    }
    let is_xacro = words
        .first()
        .is_some_and(|program| is_program(program, "xacro") || is_program(program, "xacro.py"));
    let is_ours = is_xacro && is_plain;
    let program = Box::new(Program {
        package: None,
        words: if is_ours { words.clone() } else { process.command.clone() },
        is_shell: process.is_shell,
        identity: Identity { name: process.name.clone(), ..Identity::default() },
        running: process.running.clone(),
        program_words: 1,
        ..Program::default()
    });
    if is_ours { Work::Xacro(program) } else { Work::Program(program) }
}

/// Abbreviated command: its program and first argument.
fn shortly(command: &[String]) -> String {
    let mut words = command.iter().flat_map(|word| word.split_whitespace());
    let program = words.next().unwrap_or_default();
    let rest: Vec<&str> = words.collect();
    let is_deed = |word: &&&str| word.chars().all(|letter| letter.is_ascii_lowercase());
    match rest.first().filter(is_deed) {
        Some(deed) if rest.len() > 1 => format!("{program} {deed} ..."),
        Some(deed) => format!("{program} {deed}"),
        None if rest.is_empty() => program.to_owned(),
        None => format!("{program} ..."),
    }
}

/// Returns true if a word is a program name, with or without its path.
fn is_program(word: &str, name: &str) -> bool {
    word.rsplit('/').next() == Some(name)
}

/// Value of the ROS 1 parameter server by relative name: in the namespace of the node, or an
/// enclosing one.
pub(crate) fn searched<'a>(
    server: &'a BTreeMap<String, Value>,
    namespace: &str,
    name: &str,
) -> Option<&'a Value> {
    if name.starts_with('/') {
        return server.get(name);
    }
    let mut namespace = namespace.trim_end_matches('/');
    loop {
        if let Some(value) = server.get(&format!("{namespace}/{name}")) {
            return Some(value);
        }
        namespace = &namespace[..namespace.rfind('/')?];
    }
}

/// Parameters of one node, for replacements.
pub(crate) fn values(value: &Value) -> crate::PlanParameters {
    let values = value.as_object().into_iter().flatten();
    crate::PlanParameters::Values(
        values.map(|(name, value)| (name.clone(), value.clone())).collect(),
    )
}

/// Boolean in launch file syntax.
pub(crate) fn truth(text: &str) -> Value {
    json!(matches!(text.trim().to_lowercase().as_str(), "true" | "1"))
}
