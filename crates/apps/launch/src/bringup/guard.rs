//! Guard process that outlives a launch, to end the processes it started.
//!
//! A launch that is killed (`kill -9`, out of memory) cannot end its processes. So it keeps a
//! second process that waits for the end of a pipe, which closes with the launch in every case.
//! Process groups that were reported and not withdrawn are then ended.

use std::collections::BTreeSet;
use std::io::{BufRead, Write as _};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use periplus_os::{Stopwatch, sleep};

/// Time between signals.
const SIGNAL_INTERVAL: Duration = Duration::from_secs(3);

/// Polling period.
const POLL_PERIOD: Duration = Duration::from_millis(20);

/// Guard of the processes of a launch; clones share it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Guard(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    process: Option<(Child, ChildStdin)>,
    has_failed: bool,
}

impl Guard {
    /// Reports a process group. The guard process, `program __guard`, starts with the first one.
    pub(crate) fn watch(&self, command: &[String], group: u32) {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if state.process.is_none() && !state.has_failed {
            state.process = start(command);
            state.has_failed = state.process.is_none();
        }
        state.send('+', group);
    }

    /// Withdraws a process group that has ended.
    pub(crate) fn forget(&self, group: u32) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).send('-', group);
    }
}

impl State {
    fn send(&mut self, sign: char, group: u32) {
        let Some((_, pipe)) = &mut self.process else { return };
        if writeln!(pipe, "{sign}{group}").and_then(|()| pipe.flush()).is_err() {
            self.process = None;
        }
    }
}

impl Drop for State {
    fn drop(&mut self) {
        if let Some((mut process, pipe)) = self.process.take() {
            drop(pipe);
            let _ = process.wait();
        }
    }
}

fn start(words: &[String]) -> Option<(Child, ChildStdin)> {
    let (program, words) = words.split_first()?;
    let mut command = Command::new(program);
    command
        .args(words)
        .arg(GUARD_VERB)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    own_group(&mut command);
    // Ctrl-C in the terminal must not end the guard.
    #[cfg(windows)]
    std::os::windows::process::CommandExt::creation_flags(&mut command, CREATE_NEW_PROCESS_GROUP);
    let mut process = command.spawn().ok()?;
    let pipe = process.stdin.take()?;
    Some((process, pipe))
}

/// Flag of `CreateProcess`.
#[cfg(windows)]
const CREATE_NEW_PROCESS_GROUP: u32 = 0x200;

/// Argument that makes the program a guard. Not a command for users.
pub const GUARD_VERB: &str = "__guard";

/// Main function of the guard process: reads reports until the launch ends, then ends the remaining
/// groups.
pub fn guard(reports: impl BufRead) {
    let mut groups = BTreeSet::new();
    for line in reports.lines().map_while(Result::ok) {
        let Some((sign, Ok(group))) = line.split_at_checked(1).map(|(s, n)| (s, n.parse::<u32>()))
        else {
            continue;
        };
        match sign {
            "+" => groups.insert(group),
            _ => groups.remove(&group),
        };
    }
    for signal in [EndSignal::Interrupt, EndSignal::Terminate, EndSignal::Kill] {
        groups.retain(|group| has_members(*group));
        groups.iter().for_each(|group| send(*group, signal));
        let since = Stopwatch::start();
        while groups.iter().any(|group| has_members(*group)) && since.elapsed() < SIGNAL_INTERVAL {
            sleep(POLL_PERIOD);
        }
    }
}

/// Signals to end processes, in the order in which `launch` sends them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EndSignal {
    /// SIGINT, as Ctrl-C.
    Interrupt,
    /// SIGTERM, as `kill`.
    Terminate,
    /// SIGKILL.
    Kill,
}

/// Makes a program the leader of a new process group, which contains its child processes; Ctrl-C in
/// the terminal reaches it through the launch only.
pub(crate) fn own_group(command: &mut Command) {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    #[cfg(not(unix))]
    let _ = command;
}

/// Sends a signal to all processes of a group.
#[cfg(unix)]
pub(crate) fn send(group: u32, ending: EndSignal) {
    use rustix::process::{Signal, kill_process_group};
    let signal = match ending {
        EndSignal::Interrupt => Signal::INT,
        EndSignal::Terminate => Signal::TERM,
        EndSignal::Kill => Signal::KILL,
    };
    if let Some(group) = group_id(group) {
        let _ = kill_process_group(group, signal);
    }
}

/// Returns true if a process of a group is left.
#[cfg(unix)]
pub(crate) fn has_members(group: u32) -> bool {
    group_id(group).is_some_and(|group| rustix::process::test_kill_process_group(group).is_ok())
}

#[cfg(unix)]
fn group_id(group: u32) -> Option<rustix::process::Pid> {
    // 0 and 1 would address this process's own group, and all processes.
    i32::try_from(group).ok().filter(|group| *group > 1).and_then(rustix::process::Pid::from_raw)
}

/// Sends a signal to a process and its children, as far as the system has it.
#[cfg(windows)]
pub(crate) fn send(process: u32, ending: EndSignal) {
    super::process_tree::end(process, ending);
}

/// Returns true if a process runs.
#[cfg(windows)]
pub(crate) fn has_members(process: u32) -> bool {
    super::process_tree::runs(process)
}

/// Other systems have no processes.
#[cfg(not(any(unix, windows)))]
pub(crate) fn send(_group: u32, _ending: EndSignal) {}

/// Other systems have no processes.
#[cfg(not(any(unix, windows)))]
pub(crate) fn has_members(_group: u32) -> bool {
    false
}
