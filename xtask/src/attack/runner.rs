//! Running a program on a hostile input, within limits of time and memory.

use std::fs::File;
use std::os::unix::process::ExitStatusExt as _;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use crate::step::peak_memory_kb;

/// Exit codes of a Rust panic, and of shells for an abort and a segmentation fault.
const BROKEN: [i32; 3] = [101, 134, 139];

/// Time between two looks at a running program.
const LOOK: Duration = Duration::from_millis(4);

/// Limits of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Processor time of the program \[s\].
    pub(super) cpu_s: u64,
    /// Time of the wall, for what waits instead of computing \[s\].
    pub(super) wall_s: u64,
    /// Resident memory \[MB\].
    pub(super) memory_mb: u64,
    /// Address space \[MB\]; more is refused by the system.
    pub(super) address_mb: u64,
    /// Largest file that it may write \[MB\].
    pub(super) file_mb: u64,
}

/// Limits of one input.
pub(super) const ONE: Limits =
    Limits { cpu_s: 10, wall_s: 120, memory_mb: 500, address_mb: 6000, file_mb: 200 };

/// Limits of several inputs in one process.
pub(super) const SEVERAL: Limits = Limits { cpu_s: 20, ..ONE };

/// Failure of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// Ended by a signal, a panic or an abort.
    Broken(String),
    /// More than the limit \[s\].
    TimeOut(u64),
    /// More than the limit; the most that was seen \[MB\].
    Memory(u64),
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Broken(how) => f.write_str(how),
            Self::TimeOut(seconds) => write!(f, "takes more than {seconds} s"),
            Self::Memory(megabytes) => write!(f, "takes {megabytes} MB"),
        }
    }
}

/// Runs words in a folder; its standard error goes to a file.
pub(super) fn run(
    program: &Path,
    words: &[String],
    folder: &Path,
    errors: &Path,
    limits: Limits,
) -> Result<(), Fault> {
    let broken = |why: &dyn std::fmt::Display| Fault::Broken(format!("cannot be run: {why}"));
    // The shell sets the limits and becomes the program, so that its number stays the same.
    let script = format!(
        "ulimit -v {}; ulimit -t {}; ulimit -f {}; exec \"$0\" \"$@\"",
        limits.address_mb * 1000,
        limits.cpu_s,
        limits.file_mb * 1000
    );
    let errors = File::create(errors).map_err(|error| broken(&error))?;
    let mut child = Command::new("bash")
        .args(["-c", &script])
        .arg(program)
        .args(words)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(errors)
        .spawn()
        .map_err(|error| broken(&error))?;
    let status_file = format!("/proc/{}/status", child.id());
    let own_name = std::fs::read_to_string("/proc/thread-self/comm").unwrap_or_default();
    let start = Instant::now();
    let mut most_mb = 0;
    loop {
        most_mb = most_mb.max(
            std::fs::read_to_string(&status_file).map_or(0, |text| peak_mb(&text, own_name.trim())),
        );
        let ended = child.try_wait().map_err(|error| broken(&error))?;
        if let Some(status) = ended {
            return judged(status, most_mb, limits);
        }
        let is_late = start.elapsed() > Duration::from_secs(limits.wall_s);
        if is_late || most_mb > limits.memory_mb {
            // It may have ended by itself meanwhile.
            let _ = child.kill();
            let _ = child.wait();
            return Err(if is_late {
                Fault::TimeOut(limits.wall_s)
            } else {
                Fault::Memory(most_mb)
            });
        }
        std::thread::sleep(LOOK);
    }
}

fn judged(status: ExitStatus, most_mb: u64, limits: Limits) -> Result<(), Fault> {
    /// The limit of processor time, soft and hard.
    const TIME_SIGNALS: [i32; 2] = [24, 9];
    if most_mb > limits.memory_mb {
        return Err(Fault::Memory(most_mb));
    }
    match (status.signal(), status.code()) {
        (Some(signal), _) if TIME_SIGNALS.contains(&signal) => Err(Fault::TimeOut(limits.cpu_s)),
        (Some(signal), _) => Err(Fault::Broken(format!("ends by signal {signal}"))),
        (None, Some(code)) if BROKEN.contains(&code) => {
            Err(Fault::Broken(format!("ends with exit code {code}")))
        }
        _ => Ok(()),
    }
}

/// Most resident memory of a process so far \[MB\], from its `/proc/PID/status`. It is 0 once the
/// process has gone, and while it has the name of the thread that started it: until it becomes another
/// program it shares the memory of this one.
fn peak_mb(status: &str, starter: &str) -> u64 {
    let name = status.lines().find_map(|line| line.strip_prefix("Name:")).map(str::trim);
    if name == Some(starter) {
        return 0;
    }
    peak_memory_kb(status).unwrap_or(0) / 1000
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(script: &str, limits: Limits) -> Result<(), Fault> {
        let folder = std::env::temp_dir();
        let errors = folder.join(format!("periplus-attack-{}", std::process::id()));
        let words = ["-c".to_owned(), script.to_owned()];
        let outcome = run(Path::new("bash"), &words, &folder, &errors, limits);
        let _ = std::fs::remove_file(errors);
        outcome
    }

    #[test]
    fn memory_of_the_starter_does_not_count() {
        let status = "Name:\txtask\nVmPeak:\t 9 kB\nVmHWM:\t 1330000 kB\n";
        assert_eq!(peak_mb(status, "xtask"), 0);
        assert_eq!(peak_mb(status, "another"), 1330);
        assert_eq!(peak_mb("Name:\tperiplus\n", "xtask"), 0);
    }

    #[test]
    fn aborts_time_outs_and_memory_are_seen() {
        assert_eq!(check("exit 1", ONE), Ok(()));
        assert_eq!(check("exit 101", ONE), Err(Fault::Broken("ends with exit code 101".into())));
        assert_eq!(check("kill -ABRT $$", ONE), Err(Fault::Broken("ends by signal 6".into())));
        assert_eq!(check("kill -SEGV $$", ONE), Err(Fault::Broken("ends by signal 11".into())));
        let short = Limits { cpu_s: 1, wall_s: 1, ..ONE };
        assert_eq!(check("exec sleep 30", short), Err(Fault::TimeOut(1)));
        let busy = Limits { cpu_s: 1, wall_s: 60, ..ONE };
        assert_eq!(check("while :; do :; done", busy), Err(Fault::TimeOut(1)));
        let small = Limits { memory_mb: 50, ..ONE };
        let hungry = check("exec tail -c 400000000 < <(head -c 600000000 /dev/zero)", small);
        assert!(matches!(hungry, Err(Fault::Memory(51..))), "{hungry:?}");
    }
}
