//! Child processes.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child as Running_, Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use crate::{Dialect, Running};
use periplus_os::{Machine, Overlay, Stopwatch, sleep};
use periplus_resources::{EntryKind, Host as _, Resolver};

use super::node_arguments::{NodeArguments, node_arguments};
use super::{Done, Task, TaskContext};
use crate::bringup::environment;
use crate::bringup::guard::{self, EndSignal, Guard, own_group};
use crate::bringup::lockstep::{LockstepNodes, Membership, MembershipWatch};
use crate::bringup::parts::{Program, own_folder};
use crate::bringup::processes::{LaunchProcesses, ProcessOutput};
use crate::bringup::python::PythonNode;
use crate::bringup::report::LaunchLog;
use crate::bringup::runner::Settings;

/// Time that a program has to end after SIGINT.
const SHUTDOWN_TIMEOUT: Duration = Duration::from_secs(5);

/// Time that a process has to end after it has left the simulation.
const LEAVING_TIMEOUT: Duration = Duration::from_secs(2);

/// Folders of a package's sources that may contain programs.
const FOLDERS: [&str; 5] = ["scripts", "nodes", "bin", "src", ""];

/// Running program.
pub(crate) struct Child {
    name: String,
    words: Vec<String>,
    running: Running,
    process: Option<Running_>,
    output: Arc<ProcessOutput>,
    processes: LaunchProcesses,
    respawn_ns: Option<i64>,
    /// Base folder of relative paths.
    launch_folder: PathBuf,
    guard: Guard,
    guarding_command: Vec<String>,
    tools: Option<PathBuf>,
    /// Environment variables besides those of the launch file.
    variables: Vec<(String, String)>,
    /// Files with its parameters, which exist as long as it runs.
    _arguments: NodeArguments,
    description: String,
    /// Label in lockstep, before its start number.
    label: String,
    lockstep: LockstepNodes,
    /// Its membership in the simulation; `None` for other processes.
    member: Option<MembershipWatch>,
}

/// Connection of a program with the graph.
enum Connection {
    /// None: a command, not a node.
    None,
    /// The ROS 2 network.
    Network,
    /// In step with the simulation.
    Lockstep,
}

impl Child {
    /// Starts a program.
    ///
    /// # Errors
    /// A message with the reason and the correction.
    pub(crate) fn start(
        program: &Program,
        settings: &Settings,
        guard: &Guard,
        lockstep: &LockstepNodes,
        processes: &LaunchProcesses,
    ) -> Result<Self, String> {
        let running = &program.running;
        let connection = connection(program, settings, lockstep)?;
        let mut variables = match &program.python {
            Some(python) => python.environment(&settings.search, settings.uses_real_ros),
            None => Vec::new(),
        };
        let mut arguments = NodeArguments::default();
        let mut words = match &program.python {
            Some(python) => {
                variables.extend(settings.node_environment.iter().cloned());
                let mut words =
                    python.command(settings.python.command().map_err(|why| why.to_string())?);
                words.extend(program.words[program.program_words..].iter().cloned());
                words
            }
            None if program.is_shell => {
                vec!["sh".to_owned(), "-c".into(), program.words.join(" ")]
            }
            None => program.words.clone(),
        };
        if let (None, Some(package)) = (&program.python, program.package.as_deref()) {
            let (first, rest) = words.split_first().ok_or("it has no name")?;
            let path = find(package, first, settings, program)?;
            let mut found = by_path(&path);
            found.extend(rest.iter().cloned());
            words = found;
        }
        if program.is_node && !program.is_complete {
            arguments = node_arguments(program, settings.dialect)?;
            words.extend(arguments.words.iter().cloned());
            variables.extend(arguments.variables.iter().cloned());
        }
        if let Some(prefix) = running.prefix.as_deref() {
            let mut before: Vec<String> = prefix.split_whitespace().map(str::to_owned).collect();
            before.append(&mut words);
            words = before;
        }
        let description = match (&program.python, &connection) {
            (Some(python), Connection::Lockstep) => {
                format!("{}, in step with the simulation", described(python))
            }
            (Some(python), _) => described(python),
            (None, _) => format!("the program {}", words[0]),
        };
        let is_in_step = matches!(connection, Connection::Lockstep);
        let name = program.identity.name.clone().unwrap_or_else(|| program.words[0].clone());
        let output = processes.add(&name);
        let mut child = Self {
            name,
            words,
            running: running.clone(),
            process: None,
            output,
            processes: processes.clone(),
            respawn_ns: None,
            launch_folder: settings.search.working_folder.clone(),
            guard: guard.clone(),
            guarding_command: settings.guarding_command.clone(),
            tools: settings.tools.clone(),
            variables,
            _arguments: arguments,
            description,
            label: program.label(),
            lockstep: if is_in_step { lockstep.clone() } else { LockstepNodes::default() },
            member: None,
        };
        child.spawn()?;
        Ok(child)
    }

    /// Description.
    pub(crate) fn told(&self) -> String {
        self.description.clone()
    }

    /// PATH of the program, with the built-in tools at its end.
    fn path(&self) -> Option<String> {
        let tools = self.tools.as_ref()?.display().to_string();
        let set = match self.running.environment.get("PATH") {
            Some(set) => set.clone(),
            None if self.running.replaces_environment => return None,
            None => Machine.variable("PATH"),
        };
        let set = set.unwrap_or_default();
        if set.split(':').any(|folder| folder == tools) {
            return None;
        }
        Some(if set.is_empty() { tools } else { format!("{set}:{tools}") })
    }

    fn spawn(&mut self) -> Result<(), String> {
        let mut command = Command::new(&self.words[0]);
        command.args(&self.words[1..]).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        own_group(&mut command);
        if let Some(folder) = own_folder(&self.running) {
            let folder = self.launch_folder.join(folder);
            if Machine.kind(&folder) != Some(EntryKind::Folder) {
                let program = &self.words[0];
                return Err(format!(
                    "the working folder (`cwd`) of `{program}` does not exist: {}",
                    folder.display()
                ));
            }
            command.current_dir(folder);
        }
        if self.running.replaces_environment {
            command.env_clear();
        }
        for (name, value) in &self.running.environment {
            match value {
                Some(value) => command.env(name, value),
                None => command.env_remove(name),
            };
        }
        if let Some(path) = self.path() {
            command.env("PATH", path);
        }
        command.envs(self.variables.iter().map(|(name, value)| (name, value)));
        let membership = self.lockstep.expect(&self.label);
        let variables = membership.iter().flat_map(|membership| membership.variables());
        command.envs(variables.map(|(name, value)| (name, value)));
        let mut process = command.spawn().map_err(|error| {
            let missing = error.kind() == std::io::ErrorKind::NotFound;
            let program = &self.words[0];
            if missing {
                format!("program `{program}` is not on the PATH and has no built-in replacement")
            } else {
                format!(
                    "`{program}` cannot be started: {}",
                    periplus_diagnostics::plain_words(&error)
                )
            }
        })?;
        self.guard.watch(&self.guarding_command, process.id());
        let pipes: [Option<Box<dyn Read + Send>>; 2] = [
            process.stdout.take().map(|pipe| Box::new(pipe) as _),
            process.stderr.take().map(|pipe| Box::new(pipe) as _),
        ];
        for pipe in pipes.into_iter().flatten() {
            self.output.read(pipe, membership.clone());
        }
        if membership.is_some() {
            self.processes.add_group(process.id());
        }
        self.process = Some(process);
        self.member = membership.as_ref().map(Membership::watch);
        Ok(())
    }

    /// Forwards new output.
    fn pass_on(&self, said: &mut Vec<LaunchLog>) {
        said.extend(self.output.take(Duration::ZERO).into_iter().map(LaunchLog::info));
    }

    /// Removes a process that has ended from the lists of those that run.
    fn forget(&self, group: u32) {
        self.guard.forget(group);
        self.processes.remove_group(group);
    }
}

impl Task for Child {
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        self.pass_on(stage.said);
        stage.has_printed |= self.output.take_has_printed();
        let Some(process) = &mut self.process else {
            if self.respawn_ns.is_some_and(|at_ns| stage.now_ns >= at_ns) {
                self.respawn_ns = None;
                if let Err(why) = self.spawn() {
                    stage.said.push(LaunchLog::error(why));
                    return Done::Yes;
                }
            }
            return Done::No;
        };
        // In lockstep, simulated time does not depend on how long a process takes to end.
        let mut timeout = Duration::ZERO;
        if let Some(member) = &self.member {
            if !member.is_gone() {
                return Done::No;
            }
            timeout = LEAVING_TIMEOUT;
            self.member = None;
        }
        let since = Stopwatch::start();
        while timeout > since.elapsed() && matches!(process.try_wait(), Ok(None)) {
            sleep(Duration::from_millis(1));
        }
        let status = match process.try_wait() {
            Ok(None) => return Done::No,
            Ok(Some(status)) => status,
            Err(error) => {
                stage.said.push(LaunchLog::error(format!("[{}] {error}", self.name)));
                return Done::Yes;
            }
        };
        // Its last output is still in the pipe.
        let group = process.id();
        self.forget(group);
        self.output.wait_for_end();
        self.pass_on(stage.said);
        let text = format!("[{}] has ended: {status}", self.name);
        stage.said.push(if status.success() {
            LaunchLog::info(text)
        } else {
            LaunchLog::error(text)
        });
        self.process = None;
        match self.running.respawn_after_s {
            Some(delay_s) => {
                #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
                let delay_ns = (delay_s * 1e9) as i64;
                self.respawn_ns = Some(stage.now_ns.saturating_add(delay_ns));
                Done::No
            }
            None => Done::Yes,
        }
    }

    fn time_went_back(&mut self, by_ns: i64) {
        self.respawn_ns = self.respawn_ns.map(|at_ns| at_ns.saturating_sub(by_ns));
    }

    fn ask_to_stop(&mut self) {
        // The end of its connection interrupts a process in lockstep; a second interrupt would disturb its
        // shutdown.
        if let Some(process) = &self.process
            && self.member.is_none()
        {
            guard::send(process.id(), EndSignal::Interrupt);
        }
    }

    fn stop(&mut self, said: &mut Vec<LaunchLog>) {
        self.end();
        self.output.wait_for_end();
        self.pass_on(said);
    }
}

impl Child {
    /// Waits for the end of the process, with stronger signals.
    fn end(&mut self) {
        let Some(process) = &mut self.process else { return };
        let group = process.id();
        // SIGINT was sent already, or the connection was closed; now stronger signals to the whole process
        // group.
        let interrupt = self.member.as_ref().map(|_| Some(EndSignal::Interrupt));
        let stronger = [Some(EndSignal::Terminate), Some(EndSignal::Kill)];
        for ending in [None].into_iter().chain(interrupt).chain(stronger) {
            if let Some(ending) = ending {
                guard::send(group, ending);
            }
            let is_leaving = ending.is_none() && self.member.is_some();
            let timeout = if is_leaving { LEAVING_TIMEOUT } else { SHUTDOWN_TIMEOUT };
            let since = Stopwatch::start();
            while since.elapsed() < timeout {
                let has_ended = !matches!(process.try_wait(), Ok(None));
                if has_ended && ending.is_none() && guard::has_members(group) {
                    // A shell ends on SIGINT, its background processes do not.
                    break;
                }
                if has_ended && !guard::has_members(group) {
                    self.forget(group);
                    self.process = None;
                    return;
                }
                sleep(Duration::from_millis(10));
            }
        }
        let _ = process.kill();
        let _ = process.wait();
        self.process = None;
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        if let Some(process) = &mut self.process {
            guard::send(process.id(), EndSignal::Kill);
            let _ = process.kill();
            let _ = process.wait();
            let group = process.id();
            self.forget(group);
        }
    }
}

/// Connection of a program with the graph of this run.
///
/// # Errors
/// A message with the remedy if a node has none.
fn connection(
    program: &Program,
    settings: &Settings,
    lockstep: &LockstepNodes,
) -> Result<Connection, String> {
    let is_python = program.python.is_some();
    if !is_python && program.package.is_none() {
        return Ok(Connection::None);
    }
    if !is_python && settings.dialect == Dialect::Ros1 {
        if settings.has_ros1_master {
            return Ok(Connection::Network);
        }
        return Err("no built-in program replaces it, no package in the sources has it as a Python program, and \
             compiled ROS 1 programs need a master: run with `--ros1`, or name the folder of the package with \
             `--resource-path`"
            .into());
    }
    if settings.is_wired {
        return Ok(Connection::Network);
    }
    if is_python && lockstep.is_active() && !settings.uses_real_ros {
        return Ok(Connection::Lockstep);
    }
    if !is_python && let (Some(package), Some(name)) = (&program.package, program.words.first()) {
        // A program that is missing needs no network.
        find(package, name, settings, program)?;
    }
    let kind = match (is_python, settings.uses_real_ros) {
        (false, _) => "ROS 2 program",
        (true, false) => "node in Python",
        (true, true) => "node of the installed ROS (`--real-ros`)",
    };
    Err(format!("it is a {kind}, and this run is not on a network; use `--ros2 loopback`"))
}

fn described(python: &PythonNode) -> String {
    format!("the Python node of {}", python.path().display())
}

/// Path of a program on this machine, or its name on the PATH.
///
/// # Errors
/// A message when it is missing.
pub(crate) fn installed_program(program: &Program, settings: &Settings) -> Result<String, String> {
    let name = program.words.first().map(String::as_str).unwrap_or_default();
    if let Some(package) = program.package.as_deref() {
        let path = find(package, name, settings, program)?;
        return Ok(path.display().to_string());
    }
    let name = name.split_whitespace().next().unwrap_or_default();
    let folder = own_folder(&program.running).unwrap_or_default();
    let folder = settings.search.working_folder.join(folder);
    let host =
        Overlay { variables: environment::of_running(&program.running), ..Overlay::default() };
    let path = host.variable("PATH").unwrap_or_default();
    let is_file = |path: &Path| Machine.kind(path) == Some(EntryKind::File);
    let is_found = program.is_shell
        || if name.contains('/') {
            is_file(&folder.join(name))
        } else {
            path.split(':').any(|folder| is_file(&Path::new(folder).join(name)))
        };
    if is_found {
        return Ok(name.to_owned());
    }
    Err(format!("program `{name}` is not on the PATH and has no built-in replacement"))
}

/// Command of a file: Python files that are not executable need the interpreter.
fn by_path(path: &Path) -> Vec<String> {
    let is_python = path.extension().is_some_and(|extension| extension == "py");
    let word = path.display().to_string();
    if is_python { vec!["python3".into(), word] } else { vec![word] }
}

/// Program of a package: installed, or in its sources.
fn find(
    package: &str,
    name: &str,
    settings: &Settings,
    program: &Program,
) -> Result<PathBuf, String> {
    let host =
        Overlay { variables: environment::of_running(&program.running), ..Overlay::default() };
    let resolver = Resolver::new(&host, &settings.search.folders);
    let (mut tried, mut is_there) = (Vec::new(), false);
    for from in program.package_search_starts(&settings.search) {
        let Ok(folder) = resolver.find_package(package, &from) else { continue };
        is_there = true;
        let prefix = folder.parent().filter(|above| above.ends_with("share"));
        if let Some(prefix) = prefix.and_then(Path::parent) {
            tried.push(prefix.join("lib").join(package).join(name));
        }
        let inner = [package];
        for inside in FOLDERS.iter().chain(&inner) {
            tried.push(folder.join(inside).join(name));
            tried.push(folder.join(inside).join(format!("{name}.py")));
        }
    }
    for prefix in host.variable("AMENT_PREFIX_PATH").unwrap_or_default().split(':') {
        tried.push(Path::new(prefix).join("lib").join(package).join(name));
    }
    let found = tried.into_iter().find(|path| Machine.kind(path) == Some(EntryKind::File));
    let lacks = if is_there {
        "the package has no such program on this machine"
    } else {
        "there is no such package around the launch file and the working folder, in `--resource-path` or in a sourced \
         workspace"
    };
    found.ok_or_else(|| {
        format!("`{name}` of the package `{package}` has no built-in replacement, and {lacks}")
    })
}
