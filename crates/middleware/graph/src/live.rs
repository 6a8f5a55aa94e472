//! Threads of nodes, in live.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, Weak};

use periplus_diagnostics::Diagnostic;

use crate::agenda::Agenda;
use crate::common::{Common, lock};

/// The agendas of all nodes that have a thread.
#[derive(Default)]
pub(crate) struct Live {
    agendas: Mutex<Vec<Weak<Agenda>>>,
}

impl Live {
    /// Starts the thread of a node. It ends when the agenda is closed.
    pub(crate) fn start(&self, node: &Arc<str>, common: &Arc<Common>) -> Arc<Agenda> {
        let agenda = Arc::new(Agenda::default());
        let mut agendas = lock(&self.agendas);
        agendas.retain(|agenda| agenda.strong_count() > 0);
        agendas.push(Arc::downgrade(&agenda));
        drop(agendas);
        let (own, node, common) = (agenda.clone(), node.clone(), common.clone());
        let name = node.to_string();
        spawn(&name, move || run(&own, &node, &common));
        agenda
    }

    fn each(&self, act: impl Fn(&Agenda)) {
        let agendas: Vec<_> = lock(&self.agendas).iter().filter_map(Weak::upgrade).collect();
        for agenda in agendas {
            act(&agenda);
        }
    }

    /// Time moved.
    pub(crate) fn advance_to(&self, now_ns: i64) {
        self.each(|agenda| agenda.wake_if_due(now_ns));
    }

    /// Time of the first event of all nodes \[ns\].
    pub(crate) fn first_ns(&self) -> Option<i64> {
        lock(&self.agendas).iter().filter_map(Weak::upgrade).filter_map(|it| it.first_ns()).min()
    }

    /// The clock jumped.
    pub(crate) fn rebase(&self, now_ns: i64) {
        self.each(|agenda| agenda.rebase(now_ns));
    }
}

/// Lets happen what is due, one after the other.
fn run(agenda: &Agenda, node: &str, common: &Common) {
    while let Some((key, event)) = agenda.wait_due(|| common.clock.now_ns()) {
        // One node that panics must not silence the others, and not go unnoticed either.
        if catch_unwind(AssertUnwindSafe(|| event.happen(&key))).is_err() {
            agenda.close();
            let message = format!("the node `{node}` panicked and reacts no more");
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
    thread.spawn(run).expect("the system gives a thread");
}
