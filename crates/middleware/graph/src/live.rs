//! Threads of nodes in live mode.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, Weak};

use periplus_diagnostics::Diagnostic;

use crate::common::{Common, lock};
use crate::event_queue::EventQueue;

/// Event queues of all nodes that have a thread.
#[derive(Default)]
pub(crate) struct Live {
    event_queues: Mutex<Vec<Weak<EventQueue>>>,
}

impl Live {
    /// Starts the thread of a node. It ends when the queue is closed.
    pub(crate) fn start(&self, node: &Arc<str>, common: &Arc<Common>) -> Arc<EventQueue> {
        let event_queue = Arc::new(EventQueue::default());
        let mut event_queues = lock(&self.event_queues);
        event_queues.retain(|event_queue| event_queue.strong_count() > 0);
        event_queues.push(Arc::downgrade(&event_queue));
        drop(event_queues);
        let (own, node, common) = (event_queue.clone(), node.clone(), common.clone());
        let name = node.to_string();
        spawn(&name, move || run(&own, &node, &common));
        event_queue
    }

    fn each(&self, act: impl Fn(&EventQueue)) {
        let event_queues: Vec<_> =
            lock(&self.event_queues).iter().filter_map(Weak::upgrade).collect();
        for event_queue in event_queues {
            act(&event_queue);
        }
    }

    /// Wakes the nodes with due events.
    pub(crate) fn advance_to(&self, now_ns: i64) {
        self.each(|event_queue| event_queue.wake_if_due(now_ns));
    }

    /// Time of the first event of all nodes \[ns\].
    pub(crate) fn first_ns(&self) -> Option<i64> {
        lock(&self.event_queues)
            .iter()
            .filter_map(Weak::upgrade)
            .filter_map(|it| it.first_ns())
            .min()
    }

    /// Reschedules after a jump of the clock.
    pub(crate) fn rebase(&self, now_ns: i64) {
        self.each(|event_queue| event_queue.rebase(now_ns));
    }
}

/// Executes due events one after the other.
fn run(event_queue: &EventQueue, node: &str, common: &Common) {
    while let Some((key, event)) = event_queue.wait_due(|| common.clock.now_ns()) {
        // A node that panics must not stop the others, and must be reported.
        if catch_unwind(AssertUnwindSafe(|| event.happen(&key))).is_err() {
            event_queue.close();
            let message = format!("the node `{node}` panicked; its callbacks no longer run");
            common.report(Diagnostic::error("node-panicked", message));
        }
    }
}

/// Starts a thread.
///
/// # Panics
/// When the system has no more threads.
pub(crate) fn spawn(name: &str, run: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().name(name.to_owned());
    thread.spawn(run).expect("the system starts a thread");
}
