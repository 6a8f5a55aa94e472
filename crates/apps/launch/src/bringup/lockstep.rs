//! Processes that run in step with the simulation.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Simulation that waits for processes: its time advances only while each of them is blocked.
///
/// Processes are named by labels, one for each start. Labels are the same in every run.
pub trait Lockstep: Debug + Send + Sync {
    /// Announces a process that is about to start; returns the environment variables with which it joins.
    fn expect(&self, label: &str) -> Vec<(String, String)>;

    /// Waits until each announced process has joined and waits for the first time, or has ended. Simulated
    /// time does not advance meanwhile.
    fn admit(&self, is_running: &mut dyn FnMut(&str) -> bool);

    /// Returns true once a process that was admitted has left. The answer changes at the same simulated
    /// time in every run.
    fn is_gone(&self, label: &str) -> bool;

    /// Ends the connections: the processes are interrupted.
    fn close(&self);
}

/// Lockstep of a launch, if any; clones share it.
#[derive(Clone, Debug, Default)]
pub(crate) struct LockstepNodes {
    host: Option<Arc<dyn Lockstep>>,
    starts: Arc<Mutex<Starts>>,
}

#[derive(Debug, Default)]
struct Starts {
    /// Number of starts by label without number.
    counts: BTreeMap<String, u32>,
    /// Processes that were announced and not yet admitted.
    announced: BTreeMap<String, Weak<Membership>>,
}

impl LockstepNodes {
    pub(crate) fn new(host: Arc<dyn Lockstep>) -> Self {
        Self { host: Some(host), starts: Arc::default() }
    }

    /// Returns true if processes run in step with the simulation.
    pub(crate) fn is_active(&self) -> bool {
        self.host.is_some()
    }

    /// Announces the next start of a node; `None` without lockstep. The readers of the process's output,
    /// which end with it, own the membership.
    pub(crate) fn expect(&self, name: &str) -> Option<Arc<Membership>> {
        let host = self.host.clone()?;
        let mut starts = self.starts.lock().unwrap_or_else(PoisonError::into_inner);
        let number = starts.counts.entry(name.to_owned()).or_default();
        *number += 1;
        let label = if *number == 1 { name.to_owned() } else { format!("{name}#{number}") };
        let variables = host.expect(&label);
        let membership = Arc::new(Membership { host, label: label.clone(), variables });
        starts.announced.insert(label, Arc::downgrade(&membership));
        Some(membership)
    }

    /// Waits for the announced processes.
    pub(crate) fn admit(&self) {
        let Some(host) = &self.host else { return };
        let mut starts = self.starts.lock().unwrap_or_else(PoisonError::into_inner);
        let announced = std::mem::take(&mut starts.announced);
        drop(starts);
        if !announced.is_empty() {
            let is_owned = |membership: &Weak<Membership>| membership.strong_count() > 0;
            host.admit(&mut |label| announced.get(label).is_some_and(is_owned));
        }
    }

    /// Ends the connections.
    pub(crate) fn close(&self) {
        if let Some(host) = &self.host {
            host.close();
        }
    }
}

/// Process in lockstep.
#[derive(Debug)]
pub(crate) struct Membership {
    host: Arc<dyn Lockstep>,
    label: String,
    variables: Vec<(String, String)>,
}

impl Membership {
    /// Environment variables of the process.
    pub(crate) fn variables(&self) -> &[(String, String)] {
        &self.variables
    }

    /// Observer that does not own the membership.
    pub(crate) fn watch(self: &Arc<Self>) -> MembershipWatch {
        let (host, label) = (self.host.clone(), self.label.clone());
        MembershipWatch { host, label, membership: Arc::downgrade(self) }
    }
}

/// Observer of a process in lockstep.
#[derive(Debug)]
pub(crate) struct MembershipWatch {
    host: Arc<dyn Lockstep>,
    label: String,
    membership: Weak<Membership>,
}

impl MembershipWatch {
    /// Returns true once the process has left the simulation, or has ended without joining it.
    pub(crate) fn is_gone(&self) -> bool {
        self.host.is_gone(&self.label) || self.membership.strong_count() == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Default)]
    struct Calls(Mutex<Vec<String>>);

    impl Lockstep for Calls {
        fn expect(&self, label: &str) -> Vec<(String, String)> {
            self.0.lock().unwrap().push(label.to_owned());
            vec![("LABEL".to_owned(), label.to_owned())]
        }

        fn admit(&self, is_running: &mut dyn FnMut(&str) -> bool) {
            for label in self.0.lock().unwrap().iter_mut() {
                *label += if is_running(label) { " runs" } else { " has ended" };
            }
        }

        fn is_gone(&self, _: &str) -> bool {
            false
        }

        fn close(&self) {}
    }

    #[test]
    fn each_start_has_a_label_and_ended_processes_are_not_waited_for() {
        let calls = Arc::new(Calls::default());
        let nodes = LockstepNodes::new(calls.clone());
        let first = nodes.expect("/wall").unwrap();
        let watch = first.watch();
        let second = nodes.expect("/wall").unwrap();
        assert_eq!(second.variables(), [("LABEL".to_owned(), "/wall#2".to_owned())]);
        assert!(!watch.is_gone());
        drop(first);
        assert!(watch.is_gone());
        nodes.admit();
        nodes.admit();
        assert_eq!(*calls.0.lock().unwrap(), ["/wall has ended", "/wall#2 runs"]);
    }
}
