//! Programs that run beside the measurement.

use std::io::{BufRead as _, BufReader, Read as _};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Variables of ROS that would change which programs find each other.
const DISCOVERY: [&str; 4] = [
    "ROS_LOCALHOST_ONLY",
    "ROS_STATIC_PEERS",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "FASTRTPS_DEFAULT_PROFILES_FILE",
];

/// A command in a domain of ROS 2, with the default discovery range.
pub(crate) fn command(program: &Path, domain_id: u32, words: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(words).env("ROS_DOMAIN_ID", domain_id.to_string());
    for name in DISCOVERY {
        command.env_remove(name);
    }
    command
}

/// Runs a program to its end.
pub(crate) fn output(command: &mut Command) -> Result<Output, String> {
    let output = command.stdin(Stdio::null()).output();
    output.map_err(|error| format!("{}: {error}", command.get_program().to_string_lossy()))
}

/// A program that runs; it is killed when this is dropped.
pub(crate) struct Running {
    child: Child,
    lines: Receiver<String>,
    name: String,
}

impl Running {
    /// Starts a program; lines of its standard output are read with [`Running::expect`].
    pub(crate) fn start(command: &mut Command) -> Result<Self, String> {
        let name = command.get_program().to_string_lossy().into_owned();
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{name}: {error}"))?;
        let (send, lines) = channel();
        if let Some(output) = child.stdout.take() {
            std::thread::spawn(move || {
                let lines = BufReader::new(output).lines().map_while(Result::ok);
                lines.for_each(|line| drop(send.send(line)));
            });
        }
        Ok(Self { child, lines, name })
    }

    /// Waits for a line that begins with a word; returns the rest of the line.
    pub(crate) fn expect(&self, word: &str, patience: Duration) -> Result<String, String> {
        let end = Instant::now() + patience;
        loop {
            let rest = end.saturating_duration_since(Instant::now());
            let line = self.lines.recv_timeout(rest).map_err(|_| {
                format!("{} printed no `{word}` within {:.0} s", self.name, patience.as_secs_f64())
            })?;
            if let Some(rest) = line.strip_prefix(word) {
                return Ok(rest.trim().to_owned());
            }
        }
    }

    /// Closes the standard input.
    pub(crate) fn close_input(&mut self) {
        drop(self.child.stdin.take());
    }

    /// CPU time of all threads so far \[s\].
    pub(crate) fn cpu_s(&self) -> f64 {
        let threads = std::fs::read_dir(format!("/proc/{}/task", self.child.id()));
        let Ok(threads) = threads else { return f64::NAN };
        let spent_ns = threads.filter_map(|thread| {
            let text = std::fs::read_to_string(thread.ok()?.path().join("schedstat")).ok()?;
            text.split(' ').next()?.parse::<u64>().ok()
        });
        spent_ns.sum::<u64>() as f64 * 1e-9
    }

    /// Share of a core that the program uses during a window.
    pub(crate) fn core_share(&self, window: Duration) -> f64 {
        let (cpu_s, start) = (self.cpu_s(), Instant::now());
        std::thread::sleep(window);
        (self.cpu_s() - cpu_s) / start.elapsed().as_secs_f64()
    }

    /// Sends a signal such as `-STOP`.
    pub(crate) fn signal(&self, name: &str) -> Result<(), String> {
        let mut kill = Command::new("kill");
        let status = kill.args([name, &self.child.id().to_string()]).status();
        if status.is_ok_and(|status| status.success()) {
            Ok(())
        } else {
            Err(format!("{} did not take the signal {name}", self.name))
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The value in the middle; NaN of none.
pub(crate) fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// The value below which this share of all values is; NaN of none.
pub(crate) fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = (share * sorted.len().saturating_sub(1) as f64).round() as usize;
    sorted.get(place).copied().unwrap_or(f64::NAN)
}

/// Reads standard input until its end.
pub(crate) fn await_end() {
    let _ = std::io::stdin().read_to_end(&mut Vec::new());
}
