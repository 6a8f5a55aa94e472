//! Doing what a page says, in a folder of its own.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::step::{Failed, root, run};
use crate::tutorials::page::{Step, What, has};

/// Commands that end do so within this.
const LONGEST: Duration = Duration::from_secs(180);
/// What is waited for comes within this.
const PATIENCE: Duration = Duration::from_secs(60);
/// Where the page of what runs is.
const PAGE: &str = "http://127.0.0.1:8765/";
/// How often it is looked for.
const LOOK: Duration = Duration::from_millis(250);

/// A folder with what a fresh clone has for a reader, and terminals.
pub(crate) struct Desk {
    folder: PathBuf,
    /// What runs, by the name of its terminal.
    terminals: BTreeMap<String, Child>,
    /// What the last block prints into.
    last: Option<(PathBuf, Ended)>,
    blocks: usize,
    domain_id: u32,
    pictures: bool,
}

/// Whether the last block has ended.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ended {
    Yes,
    No,
}

impl Desk {
    pub(crate) fn new(name: &str, pictures: bool) -> Result<Self, Failed> {
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
        // A network where nobody else is.
        let domain_id = 20 + std::process::id() % 80;
        let terminals = BTreeMap::new();
        Ok(Self { folder, terminals, last: None, blocks: 0, domain_id, pictures })
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
        let end = Instant::now() + LONGEST;
        while Instant::now() < end {
            if let Some(status) = child.0.try_wait().map_err(|error| error.to_string())? {
                return match status.success() {
                    true => Ok(()),
                    false => Err(format!("failed ({status}):\n{}", tail(&path))),
                };
            }
            std::thread::sleep(LOOK / 5);
        }
        Err(format!("did not end within {LONGEST:?}:\n{}", tail(&path)))
    }

    fn open(&mut self, terminal: &str, commands: &str) -> Result<(), String> {
        self.close(terminal)?;
        let (path, out) = self.log()?;
        let child = self.shell(commands, out)?.spawn().map_err(|error| error.to_string())?;
        self.terminals.insert(terminal.to_owned(), child);
        self.last = Some((path, Ended::No));
        Ok(())
    }

    /// Ctrl-C, and a while later less politely.
    fn close(&mut self, terminal: &str) -> Result<(), String> {
        let Some(mut child) = self.terminals.remove(terminal) else { return Ok(()) };
        signal(&child, "INT");
        let end = Instant::now() + Duration::from_secs(10);
        while Instant::now() < end {
            if child.try_wait().map_err(|error| error.to_string())?.is_some() {
                return Ok(());
            }
            std::thread::sleep(LOOK);
        }
        drop(Running(child));
        Err(format!("what runs in `{terminal}` does not end on Ctrl-C"))
    }

    fn prints(&self, expected: &[String]) -> Result<(), String> {
        let (path, ended) = self.last.as_ref().ok_or("nothing has run yet")?;
        let end = Instant::now() + PATIENCE;
        loop {
            let text = std::fs::read(path).unwrap_or_default();
            let missing = match has(&String::from_utf8_lossy(&text), expected) {
                Ok(()) => return Ok(()),
                Err(missing) => missing,
            };
            if *ended == Ended::Yes || Instant::now() >= end {
                return Err(format!("nothing like `{missing}` is printed:\n{}", tail(path)));
            }
            std::thread::sleep(LOOK);
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
        let end = Instant::now() + PATIENCE;
        loop {
            match self.run(command) {
                Ok(()) => return Ok(()),
                Err(why) if Instant::now() >= end => return Err(why),
                Err(_) => std::thread::sleep(LOOK),
            }
        }
    }
}

impl Drop for Desk {
    fn drop(&mut self) {
        std::mem::take(&mut self.terminals).into_values().for_each(|child| drop(Running(child)));
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

/// Each block leads a group of its own.
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
pub(crate) fn play(steps: &[Step], mut desk: Desk) -> Result<(), String> {
    for Step { line, what } in steps {
        let done = match what {
            What::Run(commands) => desk.run(commands),
            What::Open { terminal, commands } => desk.open(terminal, commands),
            What::Prints(expected) => desk.prints(expected),
            What::Save { path, text } => save(&desk.folder.join(path), text),
            What::Check(command) => {
                let last = desk.last.clone();
                desk.run(command).inspect(|()| desk.last = last)
            }
            What::Await(command) => {
                let last = desk.last.clone();
                desk.wait_for(command).inspect(|()| desk.last = last)
            }
            What::Close(terminal) => desk.close(terminal),
            What::Picture(_) if !desk.pictures => Ok(()),
            What::Picture(words) => desk.picture(words),
        };
        done.map_err(|why| format!("{line}: {why}"))?;
        println!("   line {line}: ok");
    }
    let open: Vec<String> = desk.terminals.keys().cloned().collect();
    open.iter().try_for_each(|terminal| desk.close(terminal))
}

fn save(path: &Path, text: &str) -> Result<(), String> {
    let folder = path.parent().unwrap_or(path);
    let saved = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(path, text));
    saved.map_err(|error| format!("cannot write {}: {error}", path.display()))
}
