//! Namespaces whose nodes run at the same time as those of other namespaces, in lockstep.
//!
//! At one time of the graph, the nodes outside of these namespaces run first, and then all of these namespaces side by
//! side, each in the order of its events. What a node does there beyond its namespace (a message on a topic of
//! others, a request to a server of others, what recorders and transports see) waits until all are done, and then
//! happens in the order of the namespaces. This repeats until nothing is due. The order of events therefore does not
//! depend on the number of threads.

mod workers;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use periplus_diagnostics::Diagnostic;

use crate::common::{Common, lock};
use crate::event_queue::EventQueue;
use crate::executor::Reactions;
use crate::sample::EndpointId;

pub(crate) use workers::Workers;

/// A namespace whose nodes share no state with nodes elsewhere.
pub(crate) struct ParallelNamespace {
    /// Full name, such as `/robot1`.
    name: Box<str>,
    /// Number of the namespace, from 1, for ids of endpoints.
    number: u64,
    last_endpoint: AtomicU64,
    pub(crate) event_queue: Arc<EventQueue>,
    pub(crate) reactions: Mutex<Reactions>,
    /// Effects beyond the namespace that wait.
    effects: Mutex<Vec<Effect>>,
}

/// An effect of a node beyond its namespace.
enum Effect {
    Act(Box<dyn FnOnce() + Send>),
    Report(Box<Diagnostic>),
}

thread_local! {
    /// The namespace whose nodes this thread runs, and their effects beyond it.
    static RUNNING: RefCell<Option<Running>> = const { RefCell::new(None) };
}

struct Running {
    namespace: Arc<ParallelNamespace>,
    effects: Vec<Effect>,
}

/// Bits of an endpoint id below the number of its namespace.
const ENDPOINT_BITS: u32 = 40;

impl ParallelNamespace {
    /// Namespaces of these full names, in the order of the names.
    pub(crate) fn all(names: &[String]) -> Arc<[Arc<Self>]> {
        let mut names: Vec<&str> = names.iter().map(|name| name.trim_end_matches('/')).collect();
        names.sort_unstable();
        names.dedup();
        let make = |(index, name): (u64, &str)| {
            Arc::new(Self {
                name: name.into(),
                number: index + 1,
                last_endpoint: AtomicU64::new(0),
                event_queue: Arc::default(),
                reactions: Mutex::default(),
                effects: Mutex::default(),
            })
        };
        (0..).zip(names.into_iter().filter(|name| !name.is_empty())).map(make).collect()
    }

    /// The one of these that has a node, topic or service of this full name.
    pub(crate) fn of<'a>(all: &'a [Arc<Self>], full_name: &str) -> Option<&'a Arc<Self>> {
        // The last name that is not behind this one; no longer name between them can be a prefix of it.
        let end = all.partition_point(|it| *it.name <= *full_name);
        all[..end].iter().rev().find(|it| it.has(full_name))
    }

    fn has(&self, full_name: &str) -> bool {
        full_name.strip_prefix(&*self.name).is_some_and(|rest| rest.starts_with('/'))
    }

    /// Executes what is due, and keeps the effects beyond the namespace.
    fn run(self: &Arc<Self>, common: &Common, limit: u64) {
        self.within(|| lock(&self.reactions).run_due(&self.event_queue, common, limit));
    }

    /// Runs something as a node of the namespace does, and keeps the effects beyond the namespace.
    fn within(self: &Arc<Self>, act: impl FnOnce()) {
        let running = Running { namespace: self.clone(), effects: Vec::new() };
        let _end = End;
        RUNNING.set(Some(running));
        act();
        let ended = RUNNING.take();
        lock(&self.effects).extend(ended.into_iter().flat_map(|it| it.effects));
    }

    /// Lets the effects beyond the namespace happen.
    pub(crate) fn finish(&self, common: &Common) {
        let effects = std::mem::take(&mut *lock(&self.effects));
        for effect in effects {
            match effect {
                Effect::Act(act) => act(),
                Effect::Report(finding) => common.report(*finding),
            }
        }
    }
}

/// Runs work of namespaces on at most `threads` threads, each namespace as its nodes run; work of others first.
pub(crate) fn run_work<T: Send>(
    namespaces: &[Arc<ParallelNamespace>],
    common: &Common,
    threads: usize,
    work: Vec<(&str, T)>,
    act: &(impl Fn(T) + Sync),
) {
    let mut groups: BTreeMap<u64, (Arc<ParallelNamespace>, Vec<T>)> = BTreeMap::new();
    for (namespace, item) in work {
        match ParallelNamespace::of(namespaces, &format!("{}/", namespace.trim_end_matches('/'))) {
            Some(own) => {
                let group = groups.entry(own.number).or_insert_with(|| (own.clone(), Vec::new()));
                group.1.push(item);
            }
            None => act(item),
        }
    }
    let owners: Vec<_> = groups.values().map(|(own, _)| own.clone()).collect();
    let queue = Mutex::new(groups.into_values());
    let help = || {
        while let Some((own, items)) = { lock(&queue).next() } {
            own.within(|| items.into_iter().for_each(act));
        }
    };
    let helpers = threads.min(owners.len()).saturating_sub(1);
    std::thread::scope(|scope| {
        (0..helpers).for_each(|_| drop(scope.spawn(help)));
        help();
    });
    owners.iter().for_each(|own| own.finish(common));
}

/// Ends the run of a namespace on this thread, also after a panic.
struct End;

impl Drop for End {
    fn drop(&mut self) {
        RUNNING.take();
    }
}

/// True while nodes of a namespace run on this thread beside others.
pub(crate) fn is_running() -> bool {
    RUNNING.with(|it| it.borrow().is_some())
}

/// The namespace whose nodes this thread runs.
pub(crate) fn running() -> Option<Arc<ParallelNamespace>> {
    RUNNING.with(|it| it.borrow().as_ref().map(|it| it.namespace.clone()))
}

/// True if what belongs to `owner` may be changed now: no other thread uses it.
pub(crate) fn may_change(owner: Option<&Arc<ParallelNamespace>>) -> bool {
    RUNNING.with(|it| match (&*it.borrow(), owner) {
        (None, _) => true,
        (Some(running), Some(owner)) => Arc::ptr_eq(&running.namespace, owner),
        (Some(_), None) => false,
    })
}

/// Lets something happen when all namespaces have run, or now if none runs on this thread.
pub(crate) fn after_all(act: impl FnOnce() + Send + 'static) {
    if let Some(act) = wait(act, |act| Effect::Act(Box::new(act))) {
        act();
    }
}

/// Keeps a finding of a running namespace; returns it if none runs on this thread.
pub(crate) fn report(finding: Diagnostic) -> Option<Diagnostic> {
    wait(finding, |finding| Effect::Report(Box::new(finding)))
}

/// Adds an effect to those of the running namespace; returns it if there is none.
fn wait<T>(what: T, effect: impl FnOnce(T) -> Effect) -> Option<T> {
    RUNNING.with(|it| match &mut *it.borrow_mut() {
        Some(running) => {
            running.effects.push(effect(what));
            None
        }
        None => Some(what),
    })
}

/// Id of an endpoint that is created by a running namespace: the same in every run.
pub(crate) fn next_endpoint() -> Option<EndpointId> {
    RUNNING.with(|it| {
        it.borrow().as_ref().map(|it| {
            let count = it.namespace.last_endpoint.fetch_add(1, Ordering::Relaxed) + 1;
            EndpointId((it.namespace.number << ENDPOINT_BITS) + count)
        })
    })
}
