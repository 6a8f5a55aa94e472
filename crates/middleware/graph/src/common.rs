//! State shared by all parts of one graph: its clock and its findings.

use std::sync::atomic::{AtomicBool, AtomicI64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use periplus_diagnostics::{Diagnostic, Diagnostics};

use crate::actor::Jumps;
use crate::parallel;
use crate::steady::Steady;

#[derive(Default)]
pub(crate) struct Common {
    pub(crate) clock: Clock,
    pub(crate) steady: Steady,
    pub(crate) jumps: Jumps,
    findings: Mutex<Diagnostics>,
}

/// Clock of a graph. It is set from outside; nothing here reads a system clock.
#[derive(Default)]
pub(crate) struct Clock {
    now_ns: AtomicI64,
    is_paused: AtomicBool,
    /// True if it shows the system time instead of simulated time.
    is_real: AtomicBool,
}

impl Clock {
    pub(crate) fn now_ns(&self) -> i64 {
        self.now_ns.load(Ordering::Acquire)
    }

    pub(crate) fn set(&self, now_ns: i64) {
        self.now_ns.store(now_ns, Ordering::Release);
    }

    pub(crate) fn is_simulated(&self) -> bool {
        !self.is_real.load(Ordering::Acquire)
    }

    pub(crate) fn set_simulated(&self, is_simulated: bool) {
        self.is_real.store(!is_simulated, Ordering::Release);
    }

    pub(crate) fn is_paused(&self) -> bool {
        self.is_paused.load(Ordering::Acquire)
    }

    pub(crate) fn set_paused(&self, is_paused: bool) {
        self.is_paused.store(is_paused, Ordering::Release);
    }
}

impl Common {
    pub(crate) fn report(&self, finding: Diagnostic) {
        if let Some(finding) = parallel::report(finding) {
            lock(&self.findings).push(finding);
        }
    }

    pub(crate) fn take_findings(&self) -> Diagnostics {
        std::mem::take(&mut *lock(&self.findings))
    }
}

/// Locks a mutex and ignores poisoning, so that a panic does not spread.
pub(crate) fn lock<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
