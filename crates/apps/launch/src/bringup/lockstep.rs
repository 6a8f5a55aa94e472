//! Processes that run in step with the simulation.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::sync::{Arc, Mutex, PoisonError};

/// Simulation that waits for processes: its time advances only while each of them is blocked.
///
/// Processes are named by labels, one for each start. Labels are the same in every run.
pub trait Lockstep: Debug + Send + Sync {
    /// Environment variables with which a process joins.
    fn environment(&self, label: &str) -> Vec<(String, String)>;

    /// Announces a process that is about to start. Time does not advance until it waits for the first time,
    /// or is withdrawn.
    fn expect(&self, label: &str);

    /// Withdraws a process that has ended, and may never have joined. Can be called from any thread, and more
    /// than once.
    fn withdraw(&self, label: &str);

    /// Returns true once a process has left or was withdrawn. The answer changes at the same simulated time
    /// in every run.
    fn is_gone(&self, label: &str) -> bool;

    /// Called periodically while the launch waits for the end of processes that it has interrupted, so that
    /// their last messages are published.
    fn serve(&self) {}
}

/// Lockstep of a launch, with the labels that are in use; clones share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct LockstepNodes {
    host: Option<Arc<dyn Lockstep>>,
    starts: Arc<Mutex<BTreeMap<String, u32>>>,
}

impl LockstepNodes {
    pub(crate) fn new(host: Arc<dyn Lockstep>) -> Self {
        Self { host: Some(host), starts: Arc::default() }
    }

    /// Returns true if processes run in step with the simulation.
    pub(crate) fn is_active(&self) -> bool {
        self.host.is_some()
    }

    /// Announces the next start of a node; `None` without lockstep.
    pub(crate) fn expect(&self, name: &str) -> Option<Arc<Joined>> {
        let host = self.host.clone()?;
        let mut starts = self.starts.lock().unwrap_or_else(PoisonError::into_inner);
        let number = starts.entry(name.to_owned()).or_default();
        *number += 1;
        let label = if *number == 1 { name.to_owned() } else { format!("{name}#{number}") };
        host.expect(&label);
        Some(Arc::new(Joined { host, label }))
    }
}

/// Process in lockstep. It is withdrawn when the last owner drops it: the readers of its output, which end
/// with it.
#[derive(Debug)]
pub(crate) struct Joined {
    host: Arc<dyn Lockstep>,
    label: String,
}

impl Joined {
    pub(crate) fn environment(&self) -> Vec<(String, String)> {
        self.host.environment(&self.label)
    }

    /// Handle that does not keep the process from being withdrawn.
    pub(crate) fn watch(&self) -> JoinedWatch {
        JoinedWatch { host: self.host.clone(), label: self.label.clone() }
    }
}

impl Drop for Joined {
    fn drop(&mut self) {
        self.host.withdraw(&self.label);
    }
}

/// Observer of a process in lockstep.
#[derive(Clone, Debug)]
pub(crate) struct JoinedWatch {
    host: Arc<dyn Lockstep>,
    label: String,
}

impl JoinedWatch {
    pub(crate) fn is_gone(&self) -> bool {
        self.host.is_gone(&self.label)
    }

    pub(crate) fn serve(&self) {
        self.host.serve();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Default)]
    struct Calls(Mutex<Vec<String>>);

    impl Calls {
        fn add(&self, call: String) {
            self.0.lock().unwrap().push(call);
        }
    }

    impl Lockstep for Calls {
        fn environment(&self, label: &str) -> Vec<(String, String)> {
            vec![("LABEL".to_owned(), label.to_owned())]
        }

        fn expect(&self, label: &str) {
            self.add(format!("expect {label}"));
        }

        fn withdraw(&self, label: &str) {
            self.add(format!("withdraw {label}"));
        }

        fn is_gone(&self, label: &str) -> bool {
            self.0.lock().unwrap().contains(&format!("withdraw {label}"))
        }
    }

    #[test]
    fn each_start_has_a_label_and_is_withdrawn_once() {
        let calls = Arc::new(Calls::default());
        let nodes = LockstepNodes::new(calls.clone());
        let first = nodes.expect("/wall").unwrap();
        let watch = first.watch();
        let second = nodes.expect("/wall").unwrap();
        assert_eq!(second.environment(), [("LABEL".to_owned(), "/wall#2".to_owned())]);
        assert!(!watch.is_gone());
        drop(first);
        assert!(watch.is_gone());
        let expected = ["expect /wall", "expect /wall#2", "withdraw /wall"];
        assert_eq!(*calls.0.lock().unwrap(), expected);
    }
}
