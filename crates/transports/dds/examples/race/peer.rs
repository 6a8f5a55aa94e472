//! Programs that send and receive.
//!
//! ```text
//! DOMAIN pub TOPIC TYPE DEPTH TEMPLATE COUNT PERIOD_US
//! DOMAIN sub TOPIC TYPE DEPTH
//! ```
//!
//! A publisher prints `begin` when it has a subscriber and `done` when everything is published. A
//! subscriber prints `ready`; when its input ends it prints `got`, the time from the first message
//! to the last \[s\], and the age of each message on arrival \[us\].

use std::collections::BTreeMap;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};

use serde_json::{Map, Value};

/// Implementation of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Periplus.
    Ours,
    /// Fast DDS with its defaults: shared memory between its own programs.
    Fast,
    /// Fast DDS, UDP only.
    FastByUdp,
    /// Cyclone DDS with its defaults.
    Cyclone,
    /// Cyclone DDS with the fragment size of this transport.
    CycloneAsOurs,
}

impl Side {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Ours => "Periplus",
            Self::Fast => "Fast DDS",
            Self::FastByUdp => "Fast DDS, UDP",
            Self::Cyclone => "Cyclone DDS",
            Self::CycloneAsOurs => "Cyclone DDS, our fragments",
        }
    }
}

/// Paths of the programs.
pub(super) struct Peers {
    own: PathBuf,
    fast: Option<PathBuf>,
    cyclone: Option<(PathBuf, PathBuf)>,
}

impl Peers {
    pub(super) fn find(fast: &Path, python: &Path, script: &Path) -> Result<Self, String> {
        let own = std::env::current_exe().map_err(|error| error.to_string())?;
        let fast = fast.exists().then(|| fast.to_path_buf());
        if fast.is_none() {
            println!("MISSING PEER Fast DDS: apt-get install g++ libfastrtps-dev libfastcdr-dev");
        }
        let mut asked = Command::new(python);
        asked.args(["-c", "import cyclonedds"]).stderr(Stdio::null());
        let has_cyclone = asked.status().is_ok_and(|status| status.success());
        if !has_cyclone {
            println!("MISSING PEER Cyclone DDS: pip install cyclonedds==11.0.1, PERIPLUS_PYTHON");
        }
        let cyclone = has_cyclone.then(|| (python.to_path_buf(), script.to_path_buf()));
        Ok(Self { own, fast, cyclone })
    }

    pub(super) fn has(&self, side: Side) -> bool {
        match side {
            Side::Ours => true,
            Side::Fast | Side::FastByUdp => self.fast.is_some(),
            Side::Cyclone | Side::CycloneAsOurs => self.cyclone.is_some(),
        }
    }

    pub(super) fn start(
        &self,
        side: Side,
        buffer: Option<u32>,
        words: &[String],
    ) -> Result<Running, String> {
        let mut command = match side {
            Side::Ours => {
                let mut own = Command::new(&self.own);
                own.arg("peer");
                own
            }
            Side::Fast | Side::FastByUdp => {
                Command::new(self.fast.as_ref().ok_or("there is no Fast DDS")?)
            }
            Side::Cyclone | Side::CycloneAsOurs => {
                let (python, script) = self.cyclone.as_ref().ok_or("there is no Cyclone DDS")?;
                let mut python = Command::new(python);
                python.arg(script);
                python.env("CYCLONEDDS_URI", cyclone(side == Side::CycloneAsOurs, buffer));
                python
            }
        };
        if let (Side::Fast | Side::FastByUdp, Some(buffer)) = (side, buffer) {
            command.env("PEER_BUFFER", buffer.to_string());
        }
        if side == Side::FastByUdp {
            command.env("PEER_TRANSPORT", "udp");
        }
        let failed = |error: std::io::Error| format!("{}: {error}", side.name());
        let mut child = command
            .args(words)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(failed)?;
        let output = child.stdout.take().ok_or("no output")?;
        Ok(Running { child, output: BufReader::new(output), name: side.name() })
    }
}

/// Cyclone DDS settings for the loopback interface.
fn cyclone(as_ours: bool, buffer: Option<u32>) -> String {
    let fragments = if as_ours {
        "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>65000B</FragmentSize>"
    } else {
        ""
    };
    let buffer = buffer.map_or_else(String::new, |bytes| {
        format!("<Internal><SocketReceiveBufferSize min=\"{bytes}B\" max=\"{bytes}B\"/></Internal>")
    });
    format!(
        "<General><Interfaces><NetworkInterface address=\"127.0.0.1\" multicast=\"true\"/>\
         </Interfaces><AllowMulticast>spdp</AllowMulticast>{fragments}</General>{buffer}"
    )
}

/// CPU time of each thread so far \[ns\], by thread id.
pub(super) type Cpu = BTreeMap<String, (String, u64)>;

/// A running program; it is killed when this is dropped.
pub(super) struct Running {
    child: Child,
    output: BufReader<ChildStdout>,
    name: &'static str,
}

impl Running {
    /// Waits for a line that begins with this word; returns the rest of the line.
    pub(super) fn expect(&mut self, word: &str) -> Result<String, String> {
        let mut line = String::new();
        let read = self.output.read_line(&mut line);
        let rest = read.ok().and_then(|_| line.trim_end().strip_prefix(word));
        let unexpected = || format!("{} printed `{}`, not `{word}`", self.name, line.trim_end());
        Ok(rest.ok_or_else(unexpected)?.trim_start().to_owned())
    }

    /// Closes the input and waits for the last line.
    pub(super) fn end(&mut self, word: &str) -> Result<String, String> {
        drop(self.child.stdin.take());
        self.expect(word)
    }

    pub(super) fn cpu(&self) -> Cpu {
        let Ok(tasks) = std::fs::read_dir(format!("/proc/{}/task", self.child.id())) else {
            return Cpu::new();
        };
        let threads = tasks.filter_map(|task| {
            let path = task.ok()?.path();
            let name = std::fs::read_to_string(path.join("comm")).ok()?;
            let spent = std::fs::read_to_string(path.join("schedstat")).ok()?;
            let spent_ns = spent.split(' ').next()?.parse().ok()?;
            let id = path.file_name()?.to_string_lossy().into_owned();
            Some((id, (name.trim_end().to_owned(), spent_ns)))
        });
        threads.collect()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// CPU time of a program as a fraction of one core.
pub(super) fn share(before: &Cpu, after: &Cpu, wall_s: f64) -> f64 {
    let spent = |(id, (_, ns)): (&String, &(String, u64))| {
        ns.saturating_sub(before.get(id).map_or(0, |(_, before)| *before))
    };
    after.iter().map(spent).sum::<u64>() as f64 * 1e-9 / wall_s
}

/// The same for each thread name.
pub(super) fn threads(before: &Cpu, after: &Cpu, wall_s: f64) -> Value {
    let mut names: BTreeMap<&str, f64> = BTreeMap::new();
    for (id, (name, ns)) in after {
        let spent_ns = ns.saturating_sub(before.get(id).map_or(0, |(_, before)| *before));
        *names.entry(name).or_default() += spent_ns as f64 * 1e-9 / wall_s;
    }
    let rounded = |share: f64| Value::from((share * 1e4).round() / 1e4);
    let all = names.into_iter().map(|(name, share)| (name.to_owned(), rounded(share)));
    Value::Object(all.collect::<Map<_, _>>())
}
