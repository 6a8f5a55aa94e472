//! Programs and files for launch files that are evaluated.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use periplus_bringup::xacro;
use periplus_launch::{Interpreter, Outside, Printed};
use periplus_loader::Setting;
use periplus_os::{Machine, Stopwatch};
use periplus_resources::{Resolver, Store as _};

use super::python::Python;
use super::tools::Tools;

/// The machine as launch files see it.
pub(super) struct Programs<'a> {
    resolver: &'a Resolver<'a>,
    working_folder: PathBuf,
    /// A folder of this launch's own, once a file is in it.
    scratch: Option<PathBuf>,
    files: usize,
    limits: Limits,
    tools: Option<&'a Tools>,
}

/// What a launch file may do while it is evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Whether files that were made stay: a plan that was printed names them.
    pub(super) is_kept: bool,
    /// Whether Python and programs run.
    pub(super) runs_code: bool,
    /// How long Python and each program may take.
    pub(super) longest: Duration,
}

impl Limits {
    /// Those of a launch file that is only looked at.
    pub(super) const EXAMINED: Self =
        Self { is_kept: false, runs_code: true, longest: Duration::from_secs(60) };
}

/// What is read of a program's output [bytes]; more is no text for a launch file.
const MOST_OUTPUT: u64 = 64 << 20;

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

    /// What `xacro FILE name:=value` prints: it is built in.
    fn xacro(&self, words: &[String]) -> Result<Printed, String> {
        let setting = Setting {
            host: &Machine,
            resolver: self.resolver,
            working_folder: self.working_folder.clone(),
            arguments: Vec::new(),
            open_meshes: false,
        };
        Ok(xacro(words, &setting)?.into())
    }
}

impl Outside for Programs<'_> {
    fn run(&mut self, words: &[String]) -> Result<Printed, String> {
        let [program, rest @ ..] = words else { return Err("no program is named".into()) };
        let name = program.rsplit('/').next().unwrap_or_default();
        if matches!(name, "xacro" | "xacro.py") {
            return self.xacro(rest);
        }
        if !self.limits.runs_code {
            return Err("with `--no-code` programs that a launch file names are not run".into());
        }
        bounded(program, rest, self.limits.longest, self.tools)
    }

    fn scratch(&mut self, name: &str, text: &str) -> Result<PathBuf, String> {
        let folder = match &self.scratch {
            Some(folder) => folder.clone(),
            None => {
                let folder =
                    std::env::temp_dir().join(format!("periplus_launch_{}", std::process::id()));
                std::fs::create_dir_all(&folder)
                    .map_err(|error| periplus_diagnostics::plain_words(&error))?;
                self.scratch.insert(folder).clone()
            }
        };
        self.files += 1;
        let path = folder.join(format!("{}_{name}", self.files));
        Machine.replace(&path, text.as_bytes())?;
        Ok(path)
    }

    fn python(&mut self) -> Result<Box<dyn Interpreter>, String> {
        if !self.limits.runs_code {
            return Err(
                "this launch file is written in Python, and with `--no-code` none of its code \
                        is run; launch it without if you trust it"
                    .into(),
            );
        }
        Ok(Box::new(Python::start(self.limits.longest, self.tools)?))
    }
}

/// Runs a program to its end, within a time.
fn bounded(
    program: &str,
    words: &[String],
    longest: Duration,
    tools: Option<&Tools>,
) -> Result<Printed, String> {
    let mut child = Command::new(program)
        .args(words)
        .envs(tools.map(|tools| ("PATH", tools.path())))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| error.to_string())?;
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
            let _ = pipe.take(MOST_OUTPUT).read_to_end(&mut bytes);
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
                return Err(format!(
                    "it has not ended after {} s; `--evaluation-limit SECONDS` allows more",
                    longest.as_secs_f64()
                ));
            }
        }
    }
    printed.is_success = child.wait().map_err(|error| error.to_string())?.success();
    Ok(printed)
}
