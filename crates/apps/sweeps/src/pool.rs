//! Pool of processes on this machine: one process for each job.

use std::io;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use periplus_diagnostics::plain_words;

/// Time between two looks at a process.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// End of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JobEnd {
    /// Number of the job.
    pub index: usize,
    /// The reason, for a job without a result.
    pub outcome: Result<(), String>,
}

/// Pool of processes on this machine.
#[derive(Clone, Copy, Debug)]
pub struct LocalPool<'a> {
    /// Number of processes at a time.
    pub workers: usize,
    /// Flag that ends the pool: running processes are killed, and their jobs have no result.
    pub stop: &'a AtomicBool,
}

impl LocalPool<'_> {
    /// Runs a process for each of these jobs, and calls `ended` in this thread at the end of each. A job whose process
    /// fails does not stop the others. After a stop the remaining jobs are left out.
    pub fn run(
        &self,
        jobs: &[usize],
        command: impl Fn(usize) -> Command + Sync,
        mut ended: impl FnMut(JobEnd),
    ) {
        let next = AtomicUsize::new(0);
        // Only one process is started at a time: on some systems a child inherits the pipes of one that starts beside it.
        let starting = Mutex::new(());
        let (sender, receiver) = mpsc::channel();
        thread::scope(|scope| {
            for _ in 0..self.workers.clamp(1, jobs.len().max(1)) {
                let (sender, next, command, starting) =
                    (sender.clone(), &next, &command, &starting);
                scope.spawn(move || {
                    while !self.stop.load(Ordering::Relaxed) {
                        let Some(index) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) else {
                            break;
                        };
                        let mut process = command(*index);
                        process.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
                        let child = {
                            let _one = starting.lock();
                            process.spawn()
                        };
                        let outcome = self.outcome(child);
                        let Some(outcome) = outcome else { break };
                        if sender.send(JobEnd { index: *index, outcome }).is_err() {
                            break;
                        }
                    }
                });
            }
            drop(sender);
            for end in receiver {
                ended(end);
            }
        });
    }

    /// Waits for a process; `None` if the pool is stopped.
    fn outcome(&self, child: io::Result<Child>) -> Option<Result<(), String>> {
        let mut child = match child {
            Ok(child) => child,
            Err(error) => {
                return Some(Err(format!("a process cannot be started: {}", plain_words(&error))));
            }
        };
        let text = child.stderr.take().map(|mut stderr| {
            thread::spawn(move || {
                let mut text = Vec::new();
                // What a process wrote until it was killed is still its message.
                let _ = io::Read::read_to_end(&mut stderr, &mut text);
                String::from_utf8_lossy(&text).into_owned()
            })
        });
        let status = loop {
            match child.try_wait() {
                Ok(Some(status)) => break status,
                Ok(None) if self.stop.load(Ordering::Relaxed) => {
                    let _ = child.kill();
                    let _ = child.wait();
                    return None;
                }
                Ok(None) => thread::sleep(POLL_PERIOD),
                Err(error) => return Some(Err(plain_words(&error))),
            }
        };
        if status.success() {
            return Some(Ok(()));
        }
        if self.stop.load(Ordering::Relaxed) {
            // Ctrl-C reaches the processes of a terminal, too.
            return None;
        }
        let text = text.and_then(|thread| thread.join().ok()).unwrap_or_default();
        let text = text.trim().trim_start_matches("error: ");
        let reason = if status.code().is_some() && !text.is_empty() {
            text.to_owned()
        } else {
            format!("the process of the run ended with {status}; {text}")
                .trim_end_matches("; ")
                .to_owned()
        };
        Some(Err(reason))
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(line: &str) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", line]);
        command
    }

    fn ends(workers: usize, jobs: &[usize], line: impl Fn(usize) -> String + Sync) -> Vec<JobEnd> {
        let stop = AtomicBool::new(false);
        let mut ends = Vec::new();
        let pool = LocalPool { workers, stop: &stop };
        pool.run(jobs, |index| shell(&line(index)), |end| ends.push(end));
        ends.sort_by_key(|end| end.index);
        ends
    }

    #[test]
    fn every_job_runs_once_and_a_failure_stops_no_other() {
        let line = |index| match index {
            1 => "echo 'error: no robot' >&2; exit 1".to_owned(),
            2 => "kill -9 $$".to_owned(),
            _ => "true".to_owned(),
        };
        let ends = ends(3, &[0, 1, 2, 3, 5], line);
        assert_eq!(ends.iter().map(|end| end.index).collect::<Vec<_>>(), [0, 1, 2, 3, 5]);
        assert_eq!(ends[0].outcome, Ok(()));
        assert_eq!(ends[1].outcome, Err("no robot".to_owned()));
        assert!(ends[2].outcome.as_ref().unwrap_err().contains("signal"), "{:?}", ends[2]);
        assert_eq!(ends[4].outcome, Ok(()));
    }

    #[test]
    fn a_stop_kills_the_processes_and_starts_no_more() {
        let stop = AtomicBool::new(false);
        let pool = LocalPool { workers: 2, stop: &stop };
        let mut ended = Vec::new();
        let command = |index| shell(if index == 0 { "true" } else { "sleep 600" });
        pool.run(&[0, 1, 2, 3], command, |end| {
            ended.push(end.index);
            stop.store(true, Ordering::Relaxed);
        });
        assert_eq!(ended, [0]);
    }
}
