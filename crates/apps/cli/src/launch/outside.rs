//! Programs and files used while a launch file is evaluated.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use periplus_launch::bringup::xacro;
use periplus_launch::{Interpreter, Outside, OutsideError, Printed};
use periplus_loader::LoadContext;
use periplus_os::{Machine, Stopwatch};
use periplus_resources::{Resolver, Store as _};

use super::python::Python;
use super::tools::Tools;

/// Access to the machine for launch files.
pub(super) struct Programs<'a> {
    resolver: &'a Resolver<'a>,
    working_folder: PathBuf,
    /// Temporary folder of this launch, once a file is in it.
    scratch: Option<PathBuf>,
    files: usize,
    limits: Limits,
    tools: Option<&'a Tools>,
}

/// Permissions and limits of the evaluation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// True to keep generated files: a printed plan refers to them.
    pub(super) is_kept: bool,
    /// True to run Python and programs.
    pub(super) runs_code: bool,
    /// Time limit of Python and of each program.
    pub(super) longest: Duration,
}

impl Limits {
    /// Limits of a launch file that is only examined.
    pub(super) const EXAMINED: Self =
        Self { is_kept: false, runs_code: true, longest: Duration::from_secs(60) };
}

/// Maximum output that is read from a program \[bytes\].
const MAX_OUTPUT_BYTES: u64 = 64 << 20;

impl Drop for Programs<'_> {
    fn drop(&mut self) {
        if let Some(folder) = self.scratch.take().filter(|_| !self.limits.is_kept) {
            let _ = std::fs::remove_dir_all(folder);
        }
    }
}

impl<'a> Programs<'a> {
    pub(super) fn new(
        resolver: &'a Resolver<'a>,
        working_folder: &Path,
        limits: Limits,
        tools: Option<&'a Tools>,
    ) -> Self {
        let working_folder = working_folder.to_path_buf();
        Self { resolver, working_folder, scratch: None, files: 0, limits, tools }
    }

    /// Runs the built-in `xacro FILE name:=value`.
    fn xacro(&self, words: &[String]) -> Result<Printed, OutsideError> {
        let setting = LoadContext {
            host: &Machine,
            resolver: self.resolver,
            working_folder: self.working_folder.clone(),
            arguments: Vec::new(),
            open_meshes: false,
        };
        Ok(xacro(words, &setting)?.printed)
    }
}

impl Outside for Programs<'_> {
    fn run(&mut self, words: &[String]) -> Result<Printed, OutsideError> {
        let [program, rest @ ..] = words else {
            return Err(OutsideError::InvalidCommand("the command is empty".into()));
        };
        let name = program.rsplit('/').next().unwrap_or_default();
        if matches!(name, "xacro" | "xacro.py") {
            return self.xacro(rest);
        }
        if !self.limits.runs_code {
            return Err(OutsideError::Forbidden("`--no-code` forbids programs of the launch file"));
        }
        bounded(program, rest, self.limits.longest, self.tools)
    }

    fn scratch(&mut self, name: &str, text: &str) -> Result<PathBuf, OutsideError> {
        let folder = match &self.scratch {
            Some(folder) => folder.clone(),
            None => {
                let folder =
                    std::env::temp_dir().join(format!("periplus_launch_{}", std::process::id()));
                std::fs::create_dir_all(&folder)
                    .map_err(|error| unavailable(periplus_diagnostics::plain_words(&error)))?;
                self.scratch.insert(folder).clone()
            }
        };
        self.files += 1;
        let path = folder.join(format!("{}_{name}", self.files));
        Machine.replace(&path, text.as_bytes()).map_err(unavailable)?;
        Ok(path)
    }

    fn python(&mut self) -> Result<Box<dyn Interpreter>, OutsideError> {
        if !self.limits.runs_code {
            return Err(OutsideError::Forbidden(
                "this launch file is written in Python, and with `--no-code` none of its code is run; \
                 launch it without if you trust it",
            ));
        }
        Ok(Box::new(Python::start(self.limits.longest, self.tools)?))
    }
}

/// Error of the operating system.
fn unavailable(why: impl std::fmt::Display) -> OutsideError {
    OutsideError::Unavailable(why.to_string())
}

/// Runs a program to its end, with a time limit.
fn bounded(
    program: &str,
    words: &[String],
    longest: Duration,
    tools: Option<&Tools>,
) -> Result<Printed, OutsideError> {
    let mut child = Command::new(program)
        .args(words)
        .envs(tools.map(|tools| ("PATH", tools.path())))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(unavailable)?;
    let (send, texts) = channel();
    let pipes: [Option<Box<dyn Read + Send>>; 2] = [
        child.stdout.take().map(|pipe| Box::new(pipe) as _),
        child.stderr.take().map(|pipe| Box::new(pipe) as _),
    ];
    for (place, pipe) in pipes.into_iter().enumerate() {
        let Some(pipe) = pipe else { continue };
        let send = send.clone();
        std::thread::spawn(move || {
            let mut bytes = Vec::new();
            let _ = pipe.take(MAX_OUTPUT_BYTES).read_to_end(&mut bytes);
            let _ = send.send((place, String::from_utf8_lossy(&bytes).into_owned()));
        });
    }
    drop(send);
    let mut printed = Printed::default();
    let start = Stopwatch::start();
    loop {
        let rest = longest.saturating_sub(start.elapsed());
        match texts.recv_timeout(rest) {
            Ok((0, text)) => printed.output = text,
            Ok((_, text)) => printed.errors = text,
            Err(RecvTimeoutError::Disconnected) => break,
            Err(RecvTimeoutError::Timeout) => {
                let _ = child.kill();
                let _ = child.wait();
                return Err(OutsideError::TimedOut(longest));
            }
        }
    }
    printed.is_success = child.wait().map_err(unavailable)?.success();
    Ok(printed)
}
