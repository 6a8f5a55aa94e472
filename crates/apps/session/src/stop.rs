//! Signals that end a run in good order.
//!
//! Ctrl-C (`SIGINT`), `docker stop` and systemd (`SIGTERM`) and a closed terminal (`SIGHUP`) set one flag:
//! the run ends after its step, and closes its bag, map and report. GNU `timeout` and shells signal a
//! program and its group, so a second signal within a second is the same request. A later signal ends the program at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::time::Duration;

use periplus_os::Stopwatch;

use crate::terminal::complain;

/// Signals within this time of the first count as the same request.
const SAME_REQUEST: Duration = Duration::from_secs(1);

/// Offset that shells add to a signal for an exit code.
const SHELL_SIGNAL_OFFSET: i32 = 128;

/// First signal received; 0 is none.
static FIRST_SIGNAL: AtomicI32 = AtomicI32::new(0);

/// Returns a flag that the first of the signals sets.
#[must_use]
pub fn on_signal() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    if let Err(error) = platform::listen(Arc::clone(&stop)) {
        complain(&format!(
            "signals cannot be caught ({error}); Ctrl-C ends the program at once, without the end of \
             its bag"
        ));
    }
    stop
}

/// Exit code of a run that the system ended: 143 for `SIGTERM`, 129 for `SIGHUP`. Ctrl-C is a
/// regular end of a run, with separate rules.
#[must_use]
pub fn exit_code() -> Option<u8> {
    match FIRST_SIGNAL.load(Ordering::Relaxed) {
        signal @ (platform::TERMINATE | platform::HANG_UP) => {
            u8::try_from(SHELL_SIGNAL_OFFSET + signal).ok()
        }
        _ => None,
    }
}

/// State of the requests to end.
struct Requests {
    stop: Arc<AtomicBool>,
    first: Option<Stopwatch>,
}

/// Response to a request to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Answer {
    /// End the run in good order.
    InGoodOrder,
    /// Already requested.
    Same,
    /// End the program now.
    AtOnce,
}

impl Requests {
    fn new(stop: Arc<AtomicBool>) -> Self {
        Self { stop, first: None }
    }

    fn take(&mut self, signal: i32) -> Answer {
        match &self.first {
            None => {
                self.first = Some(Stopwatch::start());
                FIRST_SIGNAL.store(signal, Ordering::Relaxed);
                self.stop.store(true, Ordering::Relaxed);
                Answer::InGoodOrder
            }
            Some(first) => answer_to_another(first.elapsed()),
        }
    }
}

/// Response to a request some time after the first.
fn answer_to_another(since_first: Duration) -> Answer {
    if since_first < SAME_REQUEST { Answer::Same } else { Answer::AtOnce }
}

#[cfg(unix)]
mod platform {
    use std::fs::File;
    use std::io::{self, IsTerminal as _};
    use std::path::Path;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use periplus_os::Machine;
    use periplus_resources::Host as _;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    use super::{Answer, Requests, SHELL_SIGNAL_OFFSET};

    pub(super) const TERMINATE: i32 = SIGTERM;
    pub(super) const HANG_UP: i32 = SIGHUP;

    pub(super) fn listen(stop: Arc<AtomicBool>) -> io::Result<()> {
        let mut wanted = vec![SIGINT, SIGTERM];
        if !is_ignored(SIGHUP) {
            wanted.push(SIGHUP);
        }
        let mut signals = Signals::new(wanted)?;
        std::thread::Builder::new().name("signals".into()).spawn(move || {
            let mut requests = Requests::new(stop);
            for signal in signals.forever() {
                if signal == SIGHUP {
                    leave_terminal();
                }
                if requests.take(signal) == Answer::AtOnce {
                    signal_hook::low_level::exit(SHELL_SIGNAL_OFFSET + signal);
                }
            }
        })?;
        Ok(())
    }

    /// Returns true if the program was started with a signal ignored, as `nohup` does.
    fn is_ignored(signal: i32) -> bool {
        let Ok(status) = Machine.read(Path::new("/proc/self/status")) else { return false };
        let status = String::from_utf8_lossy(&status);
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
        mask & (1 << (signal - 1)) != 0
    }

    /// A closed terminal refuses every line, which must not prevent closing a bag: output is
    /// discarded from here on.
    fn leave_terminal() {
        let Ok(nowhere) = File::options().write(true).open("/dev/null") else { return };
        if io::stdout().is_terminal() {
            let _ = rustix::stdio::dup2_stdout(&nowhere);
        }
        if io::stderr().is_terminal() {
            let _ = rustix::stdio::dup2_stderr(&nowhere);
        }
    }
}

#[cfg(not(unix))]
mod platform {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use super::{Answer, Requests, SHELL_SIGNAL_OFFSET};

    const INTERRUPT: i32 = 2;
    pub(super) const TERMINATE: i32 = 15;
    pub(super) const HANG_UP: i32 = 1;

    pub(super) fn listen(stop: Arc<AtomicBool>) -> Result<(), ctrlc::Error> {
        let mut requests = Requests::new(stop);
        ctrlc::set_handler(move || {
            if requests.take(INTERRUPT) == Answer::AtOnce {
                std::process::exit(SHELL_SIGNAL_OFFSET + INTERRUPT);
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signals_that_come_together_are_one_request() {
        let stop = Arc::new(AtomicBool::new(false));
        let mut requests = Requests::new(Arc::clone(&stop));
        assert_eq!(requests.take(2), Answer::InGoodOrder);
        assert!(stop.load(Ordering::Relaxed));
        assert_eq!(requests.take(2), Answer::Same);
        assert_eq!(answer_to_another(Duration::from_millis(999)), Answer::Same);
        assert_eq!(answer_to_another(Duration::from_millis(1001)), Answer::AtOnce);
    }
}
