//! Thread that serves the processes of a launch while the run waits for one of them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_launch::bringup::LaunchProcesses;
use periplus_os::{Stopwatch, sleep};

use crate::terminal;

/// Period of the thread.
const PERIOD: Duration = Duration::from_millis(100);

/// Age of output that the run has not printed.
const OUTPUT_AGE: Duration = Duration::from_secs(1);

/// Time after Ctrl-C that the run has to end before processes are interrupted.
const INTERRUPT_DELAY: Duration = Duration::from_secs(1);

/// Time after Ctrl-C before processes are killed.
const KILL_DELAY: Duration = Duration::from_secs(6);

/// The thread; it ends when this is dropped.
pub(super) struct ProcessWatch {
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl ProcessWatch {
    /// Starts the thread. `stop` is set by Ctrl-C.
    pub(super) fn start(processes: LaunchProcesses, stop: Arc<AtomicBool>, is_quiet: bool) -> Self {
        let is_over = Arc::new(AtomicBool::new(false));
        let over = is_over.clone();
        let thread = std::thread::spawn(move || {
            let mut stopped: Option<Stopwatch> = None;
            let mut has_interrupted = false;
            while !over.load(Ordering::Relaxed) {
                sleep(PERIOD);
                for line in processes.take_output(OUTPUT_AGE).iter().filter(|_| !is_quiet) {
                    terminal::say(line);
                }
                if !stop.load(Ordering::Relaxed) {
                    continue;
                }
                let waited = stopped.get_or_insert_with(Stopwatch::start).elapsed();
                if waited >= KILL_DELAY {
                    processes.kill();
                } else if waited >= INTERRUPT_DELAY && !has_interrupted {
                    has_interrupted = true;
                    processes.interrupt();
                }
            }
        });
        Self { is_over, thread: Some(thread) }
    }
}

impl Drop for ProcessWatch {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
