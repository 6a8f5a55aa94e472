//! Output and interruption of the processes of a launch, also from other threads than that of the run.

use std::collections::{BTreeSet, VecDeque};
use std::io::{BufRead as _, BufReader, Read};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::Duration;

use periplus_os::{Stopwatch, sleep};

use crate::bringup::guard::{self, EndSignal};

/// Time for the last output of a process that has ended.
const LAST_OUTPUT_TIMEOUT: Duration = Duration::from_millis(200);

/// Processes of a launch; clones share them.
///
/// A run that waits for a process in lockstep neither prints nor stops. Another thread then prints the output
/// of the processes, such as the stack of a node that hangs, and interrupts them.
#[derive(Clone, Debug, Default)]
pub struct LaunchProcesses(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    outputs: Vec<Weak<ProcessOutput>>,
    /// Process groups in lockstep.
    groups: BTreeSet<u32>,
}

impl LaunchProcesses {
    /// Returns lines that have waited this long to be printed.
    #[must_use]
    pub fn take_output(&self, min_age: Duration) -> Vec<String> {
        let outputs = self.state().outputs.clone();
        outputs.iter().filter_map(Weak::upgrade).flat_map(|output| output.take(min_age)).collect()
    }

    /// Interrupts the processes in lockstep, as Ctrl-C does.
    pub fn interrupt(&self) {
        self.send(EndSignal::Interrupt);
    }

    /// Kills the processes in lockstep.
    pub fn kill(&self) {
        self.send(EndSignal::Kill);
    }

    fn send(&self, signal: EndSignal) {
        let groups = self.state().groups.clone();
        groups.into_iter().for_each(|group| guard::send(group, signal));
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds a process by its name in the log.
    pub(crate) fn add(&self, name: &str) -> Arc<ProcessOutput> {
        let output = Arc::new(ProcessOutput {
            name: name.to_owned(),
            lines: Mutex::default(),
            has_printed: AtomicBool::new(false),
        });
        let mut state = self.state();
        state.outputs.retain(|output| output.strong_count() > 0);
        state.outputs.push(Arc::downgrade(&output));
        output
    }

    /// Adds a process group in lockstep.
    pub(crate) fn add_group(&self, group: u32) {
        self.state().groups.insert(group);
    }

    /// Removes a process group that has ended.
    pub(crate) fn remove_group(&self, group: u32) {
        self.state().groups.remove(&group);
    }
}

/// Output of a process that is not printed yet.
#[derive(Debug)]
pub(crate) struct ProcessOutput {
    name: String,
    lines: Mutex<VecDeque<(Stopwatch, String)>>,
    has_printed: AtomicBool,
}

impl ProcessOutput {
    /// Reads a pipe on a thread, which owns `kept` until the pipe ends.
    pub(crate) fn read<T: Send + 'static>(
        self: &Arc<Self>,
        pipe: impl Read + Send + 'static,
        kept: T,
    ) {
        let output = self.clone();
        std::thread::spawn(move || {
            let _kept = kept;
            for line in BufReader::new(pipe).split(b'\n').map_while(Result::ok) {
                let line = String::from_utf8_lossy(&line);
                output.push(format!("[{}] {}", output.name, line.trim_end_matches('\r')));
            }
        });
    }

    /// Waits shortly for the last output of a process that has ended. Its descendants may keep the pipe open.
    pub(crate) fn wait_for_end(self: &Arc<Self>) {
        let since = Stopwatch::start();
        // The threads that read share ownership.
        while Arc::strong_count(self) > 1 && since.elapsed() < LAST_OUTPUT_TIMEOUT {
            sleep(Duration::from_millis(1));
        }
    }

    fn push(&self, line: String) {
        self.has_printed.store(true, Ordering::Relaxed);
        self.lines().push_back((Stopwatch::start(), line));
    }

    fn lines(&self) -> MutexGuard<'_, VecDeque<(Stopwatch, String)>> {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the lines that are at least this old.
    pub(crate) fn take(&self, min_age: Duration) -> Vec<String> {
        let mut lines = self.lines();
        let count = lines.iter().take_while(|(since, _)| since.elapsed() >= min_age).count();
        lines.drain(..count).map(|(_, line)| line).collect()
    }

    /// Returns true if there was output since the last call.
    pub(crate) fn take_has_printed(&self) -> bool {
        self.has_printed.swap(false, Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_threads_take_lines_that_have_waited() {
        let processes = LaunchProcesses::default();
        let output = processes.add("wall");
        output.push("[wall] stack".to_owned());
        assert!(processes.take_output(Duration::from_secs(60)).is_empty());
        assert_eq!(processes.take_output(Duration::ZERO), ["[wall] stack"]);
        assert!(output.take(Duration::ZERO).is_empty());
        // The launch still knows that the process has printed.
        assert!(output.take_has_printed() && !output.take_has_printed());
    }
}
