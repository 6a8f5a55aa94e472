//! Nodes in Python in step with the simulation.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use periplus_diagnostics::Diagnostics;
use periplus_graph::Graph;
use periplus_launch::bringup::Lockstep;
use periplus_lockstep::LockstepHost;

/// Environment variable with the link by which a process joins.
const LINK_VARIABLE: &str = "PERIPLUS_LOCKSTEP";

/// Environment variable with the seed of the simulation, for random numbers of a process.
const SEED_VARIABLE: &str = "PERIPLUS_SEED";

/// Environment variable of Python with the seed of its hashes, which order its sets.
const HASH_SEED_VARIABLE: &str = "PYTHONHASHSEED";

/// Number of hash seeds of Python.
const HASH_SEEDS: u64 = 1 << 32;

/// Lockstep of a run.
pub(super) struct RunLockstep {
    host: Mutex<Option<LockstepHost>>,
    seed: u64,
    /// Ends the wait for processes.
    stop: Arc<AtomicBool>,
    findings: Mutex<Diagnostics>,
}

impl std::fmt::Debug for RunLockstep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RunLockstep").field("seed", &self.seed).finish_non_exhaustive()
    }
}

impl RunLockstep {
    /// Connects processes with the graph of a simulation with this seed.
    ///
    /// # Errors
    /// When there is no socket.
    pub(super) fn start(graph: &Graph, seed: u64, stop: Arc<AtomicBool>) -> io::Result<Self> {
        let host = Mutex::new(Some(LockstepHost::new(graph)?));
        Ok(Self { host, seed, stop, findings: Mutex::default() })
    }

    /// Calls a function with the host, until it is closed.
    fn with<T>(&self, call: impl FnOnce(&LockstepHost) -> T) -> Option<T> {
        self.host.lock().unwrap_or_else(PoisonError::into_inner).as_ref().map(call)
    }

    /// Findings since the last call: processes that did not join or respond.
    pub(super) fn take_findings(&self) -> Diagnostics {
        let mut findings = self.findings.lock().unwrap_or_else(PoisonError::into_inner);
        let mut findings = std::mem::take(&mut *findings);
        for finding in self.with(LockstepHost::take_findings).unwrap_or_default().iter() {
            findings.push(finding.clone());
        }
        findings
    }
}

impl Lockstep for RunLockstep {
    fn expect(&self, label: &str) -> Vec<(String, String)> {
        let Some(link) = self.with(|host| host.expect(label)) else { return Vec::new() };
        vec![
            (LINK_VARIABLE.to_owned(), link),
            (SEED_VARIABLE.to_owned(), self.seed.to_string()),
            (HASH_SEED_VARIABLE.to_owned(), (self.seed % HASH_SEEDS).to_string()),
        ]
    }

    fn admit(&self, is_running: &mut dyn FnMut(&str) -> bool) {
        let is_stopped = || self.stop.load(Ordering::Relaxed);
        self.with(|host| host.admit(&mut |label| !is_stopped() && is_running(label)));
    }

    fn is_gone(&self, label: &str) -> bool {
        self.with(|host| host.is_gone(label)).unwrap_or(true)
    }

    fn close(&self) {
        let findings = self.take_findings();
        *self.findings.lock().unwrap_or_else(PoisonError::into_inner) = findings;
        *self.host.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }
}
