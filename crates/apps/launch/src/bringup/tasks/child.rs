//! Child processes.

use std::io::{BufRead as _, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child as Running_, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use crate::{Dialect, PlanParameters, Running};
use periplus_os::{Machine, Overlay, Stopwatch, sleep};
use periplus_resources::{EntryKind, Host as _, Resolver};

use super::{Done, Task, TaskContext};
use crate::bringup::environment;
use crate::bringup::guard::{self, EndSignal, Guard, own_group};
use crate::bringup::parameters::parameter;
use crate::bringup::parts::{Program, own_folder};
use crate::bringup::report::LaunchLog;
use crate::bringup::runner::Settings;

/// Time that a program has to end after SIGINT.
const SHUTDOWN_TIMEOUT: Duration = Duration::from_secs(5);

/// Folders of a package's sources that may contain programs.
const FOLDERS: [&str; 5] = ["scripts", "nodes", "bin", "src", ""];

/// Running program.
pub(crate) struct Child {
    name: String,
    words: Vec<String>,
    running: Running,
    process: Option<Running_>,
    printed: Option<Receiver<String>>,
    respawn_ns: Option<i64>,
    /// Base folder of relative paths.
    launch_folder: PathBuf,
    guard: Guard,
    guarding_command: Vec<String>,
    tools: Option<PathBuf>,
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
    ) -> Result<Self, String> {
        let running = &program.running;
        let is_node = program.package.is_some();
        let mut words = if program.is_shell {
            vec!["sh".to_owned(), "-c".into(), program.words.join(" ")]
        } else {
            program.words.clone()
        };
        if is_node {
            if settings.dialect == Dialect::Ros1 {
                return Err("it is a ROS 1 program, which needs a master; \
                            there is no built-in replacement"
                    .into());
            }
            if !settings.is_wired {
                return Err("it is a ROS 2 program, and this run is not on a network; \
                            use `--ros2 loopback`"
                    .into());
            }
            let package = program.package.as_deref().unwrap_or_default();
            let (first, rest) = words.split_first().ok_or("it has no name")?;
            let path = find(package, first, settings, running)?;
            let mut found = by_path(&path);
            found.extend(rest.iter().cloned());
            found.extend(ros_words(program));
            words = found;
        }
        if let Some(prefix) = running.prefix.as_deref() {
            let mut before: Vec<String> = prefix.split_whitespace().map(str::to_owned).collect();
            before.append(&mut words);
            words = before;
        }
        let name = program.identity.name.clone().unwrap_or_else(|| program.words[0].clone());
        let mut child = Self {
            name,
            words,
            running: running.clone(),
            process: None,
            printed: None,
            respawn_ns: None,
            launch_folder: settings.search.working_folder.clone(),
            guard: guard.clone(),
            guarding_command: settings.guarding_command.clone(),
            tools: settings.tools.clone(),
        };
        child.spawn()?;
        Ok(child)
    }

    /// Description.
    pub(crate) fn told(&self) -> String {
        format!("the program {}", self.words[0])
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
        let (send, printed) = channel();
        let pipes: [Option<Box<dyn Read + Send>>; 2] = [
            process.stdout.take().map(|pipe| Box::new(pipe) as _),
            process.stderr.take().map(|pipe| Box::new(pipe) as _),
        ];
        for pipe in pipes.into_iter().flatten() {
            let send = send.clone();
            // The thread ends with the pipe.
            std::thread::spawn(move || {
                for line in BufReader::new(pipe).lines().map_while(Result::ok) {
                    if send.send(line).is_err() {
                        break;
                    }
                }
            });
        }
        self.process = Some(process);
        self.printed = Some(printed);
        Ok(())
    }

    /// Forwards new output.
    fn pass_on(&self, stage: &mut TaskContext<'_>) {
        let Some(printed) = &self.printed else { return };
        for line in printed.try_iter() {
            stage.has_printed = true;
            stage.said.push(LaunchLog::info(format!("[{}] {line}", self.name)));
        }
    }
}

impl Task for Child {
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        self.pass_on(stage);
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
        let status = match process.try_wait() {
            Ok(None) => return Done::No,
            Ok(Some(status)) => status,
            Err(error) => {
                stage.said.push(LaunchLog::error(format!("[{}] {error}", self.name)));
                return Done::Yes;
            }
        };
        // Its last output is still in the pipe.
        self.guard.forget(process.id());
        sleep(Duration::from_millis(5));
        self.pass_on(stage);
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
        if let Some(process) = &self.process {
            guard::send(process.id(), EndSignal::Interrupt);
        }
    }

    fn stop(&mut self) {
        let Some(process) = &mut self.process else { return };
        let group = process.id();
        // SIGINT was sent already; now stronger signals to the whole process group.
        for ending in [None, Some(EndSignal::Terminate), Some(EndSignal::Kill)] {
            if let Some(ending) = ending {
                guard::send(group, ending);
            }
            let since = Stopwatch::start();
            while since.elapsed() < SHUTDOWN_TIMEOUT {
                let has_ended = !matches!(process.try_wait(), Ok(None));
                if has_ended && ending.is_none() && guard::has_members(group) {
                    // A shell ends on SIGINT, its background processes do not.
                    break;
                }
                if has_ended && !guard::has_members(group) {
                    self.guard.forget(group);
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
            self.guard.forget(process.id());
        }
    }
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
    running: &Running,
) -> Result<PathBuf, String> {
    let host = Overlay { variables: environment::of_running(running) };
    let resolver = Resolver::new(&host, &settings.search.folders);
    let from = settings.search.working_folder.join("launch");
    let mut tried = Vec::new();
    if let Ok(folder) = resolver.find_package(package, &from) {
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
    found.ok_or_else(|| {
        format!(
            "`{name}` of the package `{package}` has no built-in replacement, and the package has no \
             such program on this machine"
        )
    })
}

/// Arguments of a ROS 2 node.
fn ros_words(program: &Program) -> Vec<String> {
    let identity = &program.identity;
    let mut words = vec!["--ros-args".to_owned()];
    let mut add = |flag: &str, word: String| words.extend([flag.to_owned(), word]);
    if let Some(name) = &identity.name {
        add("-r", format!("__node:={name}"));
    }
    if let Some(namespace) = &identity.namespace {
        add("-r", format!("__ns:={namespace}"));
    }
    for (from, to) in &identity.remaps {
        add("-r", format!("{from}:={to}"));
    }
    for parameters in &identity.parameters {
        match parameters {
            PlanParameters::File(file) => add("--params-file", file.clone()),
            PlanParameters::Values(values) => {
                for (name, value) in values.iter().filter(|(_, value)| parameter(value).is_some()) {
                    // JSON is valid YAML.
                    add("-p", format!("{name}:={value}"));
                }
            }
        }
    }
    words
}
