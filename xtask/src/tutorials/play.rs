//! Execution of the steps of a page, in a separate folder.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::step::{Failed, root, run};
use crate::tutorials::page::{Step, What, has};

/// Timeout of commands.
const COMMAND_TIMEOUT: Duration = Duration::from_secs(180);
/// Timeout of `await` and of expected output.
const TIMEOUT: Duration = Duration::from_secs(60);
/// Address of the page of the running program.
const PAGE: &str = "http://127.0.0.1:8765/";
/// Period of the checks for it.
const POLL_PERIOD: Duration = Duration::from_millis(250);

/// Folder with the files of a fresh clone, and the terminals of a reader.
pub(crate) struct Terminals {
    folder: PathBuf,
    /// Running programs by the name of their terminal.
    children: BTreeMap<String, Child>,
    /// Output file of the last block, and its state.
    last: Option<(PathBuf, Ended)>,
    blocks: usize,
    domain_id: u32,
    /// Python with the package, for the reader's own nodes.
    python: PathBuf,
    pictures: bool,
}

/// State of the last block: ended or running.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ended {
    Yes,
    No,
}

impl Terminals {
    pub(crate) fn new(name: &str, python: &Path, pictures: bool) -> Result<Self, Failed> {
        let folder = root().join("target/tutorials").join(name);
        if folder.exists() {
            std::fs::remove_dir_all(&folder)
                .map_err(|error| Failed(format!("cannot clear {}: {error}", folder.display())))?;
        }
        std::fs::create_dir_all(folder.join("logs"))
            .map_err(|error| Failed(format!("cannot make {}: {error}", folder.display())))?;
        for part in ["robots", "worlds"] {
            let mut copy = Command::new("cp");
            run(copy.arg("-r").arg(root().join(part)).arg(&folder), "see above")?;
        }
        // A domain that no other program uses.
        let domain_id = 20 + std::process::id() % 80;
        let children = BTreeMap::new();
        let python = python.to_owned();
        Ok(Self { folder, children, last: None, blocks: 0, domain_id, python, pictures })
    }

    fn log(&mut self) -> Result<(PathBuf, File), String> {
        self.blocks += 1;
        let path = self.folder.join("logs").join(format!("{:02}.txt", self.blocks));
        let file = File::create(&path).map_err(|error| error.to_string())?;
        Ok((path, file))
    }

    /// A shell in the folder; both streams go into a file.
    fn shell(&self, commands: &str, out: File) -> Result<Command, String> {
        let mut shell = Command::new("setsid");
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
        let programs = root().join(target).join("release");
        let path = std::env::var_os("PATH").unwrap_or_default();
        let paths = std::iter::once(programs).chain(std::env::split_paths(&path));
        let path = std::env::join_paths(paths).map_err(|error| error.to_string())?;
        shell
            .args(["bash", "-euo", "pipefail", "-c", commands])
            .current_dir(&self.folder)
            .env("PATH", path)
            .env("PERIPLUS_PYTHON", &self.python)
            .env("CHECKS", root().join("docs/tutorials/checks"))
            .env("ROS_DOMAIN_ID", self.domain_id.to_string())
            .env("IGN_PARTITION", format!("tutorials{}", self.domain_id))
            .env("GZ_PARTITION", format!("tutorials{}", self.domain_id))
            .stdin(Stdio::null())
            .stderr(out.try_clone().map_err(|error| error.to_string())?)
            .stdout(out);
        Ok(shell)
    }

    fn run(&mut self, commands: &str) -> Result<(), String> {
        let (path, out) = self.log()?;
        self.last = Some((path.clone(), Ended::Yes));
        let child = self.shell(commands, out)?.spawn().map_err(|error| error.to_string())?;
        let mut child = Running(child);
        let end = Instant::now() + COMMAND_TIMEOUT;
        while Instant::now() < end {
            if let Some(status) = child.0.try_wait().map_err(|error| error.to_string())? {
                return match status.success() {
                    true => Ok(()),
                    false => Err(format!("failed ({status}):\n{}", tail(&path))),
                };
            }
            std::thread::sleep(POLL_PERIOD / 5);
        }
        Err(format!("did not end within {COMMAND_TIMEOUT:?}:\n{}", tail(&path)))
    }

    fn open(&mut self, terminal: &str, commands: &str) -> Result<(), String> {
        self.close(terminal)?;
        let (path, out) = self.log()?;
        let child = self.shell(commands, out)?.spawn().map_err(|error| error.to_string())?;
        self.children.insert(terminal.to_owned(), child);
        self.last = Some((path, Ended::No));
        Ok(())
    }

    /// Ctrl-C, and a while later less politely.
    fn close(&mut self, terminal: &str) -> Result<(), String> {
        let Some(mut child) = self.children.remove(terminal) else { return Ok(()) };
        signal(&child, "INT");
        let end = Instant::now() + Duration::from_secs(10);
        while Instant::now() < end {
            if child.try_wait().map_err(|error| error.to_string())?.is_some() {
                return Ok(());
            }
            std::thread::sleep(POLL_PERIOD);
        }
        drop(Running(child));
        Err(format!("what runs in `{terminal}` does not end on Ctrl-C"))
    }

    fn prints(&self, expected: &[String]) -> Result<(), String> {
        let (path, ended) = self.last.as_ref().ok_or("nothing has run yet")?;
        let end = Instant::now() + TIMEOUT;
        loop {
            let text = std::fs::read(path).unwrap_or_default();
            let missing = match has(&String::from_utf8_lossy(&text), expected) {
                Ok(()) => return Ok(()),
                Err(missing) => missing,
            };
            if *ended == Ended::Yes || Instant::now() >= end {
                return Err(format!("nothing like `{missing}` is printed:\n{}", tail(path)));
            }
            std::thread::sleep(POLL_PERIOD);
        }
    }

    /// A picture of the page; files are named from the root of the tree.
    fn picture(&self, words: &str) -> Result<(), String> {
        let files = words.split_whitespace().map(|file| root().join(file));
        let status = Command::new("node")
            .args(["e2e/shot.mjs", PAGE])
            .args(files)
            .current_dir(root().join("viewer"))
            .status()
            .map_err(|error| format!("node cannot be started: {error}"))?;
        if status.success() { Ok(()) } else { Err("no picture was taken".to_owned()) }
    }

    fn wait_for(&mut self, command: &str) -> Result<(), String> {
        let end = Instant::now() + TIMEOUT;
        loop {
            match self.run(command) {
                Ok(()) => return Ok(()),
                Err(why) if Instant::now() >= end => return Err(why),
                Err(_) => std::thread::sleep(POLL_PERIOD),
            }
        }
    }
}

impl Drop for Terminals {
    fn drop(&mut self) {
        std::mem::take(&mut self.children).into_values().for_each(|child| drop(Running(child)));
    }
}

/// Ended with all that it has started when it is dropped.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        if !matches!(self.0.try_wait(), Ok(Some(_))) {
            signal(&self.0, "KILL");
            let _ = self.0.wait();
        }
    }
}

/// Each block leads its own process group.
fn signal(child: &Child, name: &str) {
    let group = format!("-{}", child.id());
    let _ = Command::new("kill").args(["-s", name, "--", &group]).stderr(Stdio::null()).status();
}

/// The end of what was printed.
fn tail(path: &Path) -> String {
    let text = std::fs::read(path).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let lines: Vec<&str> = text.lines().collect();
    lines[lines.len().saturating_sub(30)..].join("\n")
}

/// Does all steps; the line of the one that failed, and why.
pub(crate) fn play(steps: &[Step], mut terminals: Terminals) -> Result<(), String> {
    for Step { line, what } in steps {
        let done = match what {
            What::Run(commands) => terminals.run(commands),
            What::Open { terminal, commands } => terminals.open(terminal, commands),
            What::Prints(expected) => terminals.prints(expected),
            What::Save { path, text } => save(&terminals.folder.join(path), text),
            What::Check(command) => {
                let last = terminals.last.clone();
                terminals.run(command).inspect(|()| terminals.last = last)
            }
            What::Await(command) => {
                let last = terminals.last.clone();
                terminals.wait_for(command).inspect(|()| terminals.last = last)
            }
            What::Close(terminal) => terminals.close(terminal),
            What::Picture(_) if !terminals.pictures => Ok(()),
            What::Picture(words) => terminals.picture(words),
        };
        done.map_err(|why| format!("{line}: {why}"))?;
        println!("   line {line}: ok");
    }
    let open: Vec<String> = terminals.children.keys().cloned().collect();
    open.iter().try_for_each(|terminal| terminals.close(terminal))
}

fn save(path: &Path, text: &str) -> Result<(), String> {
    let folder = path.parent().unwrap_or(path);
    let saved = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(path, text));
    saved.map_err(|error| format!("cannot write {}: {error}", path.display()))
}
