//! The end of a publisher: to whom its messages go.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::common::Common;
use crate::info::TopicInfo;
use crate::inlet::Inlet;
use crate::payload::Payload;
use crate::qos_event::Told;
use crate::sample::{EndpointId, Sample};
use crate::tap::Tap;
use crate::{Durability, Qos};

/// What all ends of one topic share.
pub(crate) struct Topic {
    pub(crate) name: Arc<str>,
    /// Number of the last message.
    pub(crate) sequence: AtomicU64,
}

/// The end of a publisher.
pub(crate) struct Outlet {
    pub(crate) id: EndpointId,
    pub(crate) node: Arc<str>,
    pub(crate) topic: Arc<Topic>,
    common: Arc<Common>,
    /// How many listen.
    listeners: AtomicUsize,
    /// Whether a message must be made into a sample at all.
    is_busy: AtomicBool,
    pub(crate) published: AtomicU64,
    /// What was told to who asks for events.
    pub(crate) told: Mutex<Told>,
    flow: Mutex<Flow>,
}

#[derive(Default)]
struct Flow {
    qos: Qos,
    inlets: Vec<Arc<Inlet>>,
    taps: Arc<[Arc<Tap>]>,
    info: Arc<TopicInfo>,
    /// For latecomers.
    kept: VecDeque<Sample>,
    last_ns: Option<i64>,
    missed_deadlines: u64,
    /// When it last said that it lives.
    asserted_ns: i64,
}

impl Outlet {
    pub(crate) fn new(
        id: EndpointId,
        node: Arc<str>,
        topic: Arc<Topic>,
        qos: Qos,
        common: Arc<Common>,
    ) -> Self {
        let outlet = Self {
            id,
            node,
            topic,
            common,
            listeners: AtomicUsize::new(0),
            is_busy: AtomicBool::new(false),
            published: AtomicU64::new(0),
            told: Mutex::default(),
            flow: Mutex::new(Flow { qos, ..Flow::default() }),
        };
        outlet.assert_liveliness();
        outlet.is_busy.store(keeps(&qos), Ordering::Relaxed);
        outlet
    }

    fn lock(&self) -> MutexGuard<'_, Flow> {
        self.flow.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What it offers.
    pub(crate) fn qos(&self) -> Qos {
        self.lock().qos
    }

    /// Offers something else from now on. Who listens has to be told again.
    pub(crate) fn set_qos(&self, qos: Qos) {
        self.lock().qos = qos;
    }

    pub(crate) fn is_heard(&self) -> bool {
        self.listeners.load(Ordering::Relaxed) > 0
    }

    pub(crate) fn missed_deadlines(&self) -> u64 {
        let (flow, now_ns) = (self.lock(), self.common.clock.now_ns());
        let since =
            flow.qos.deadline_ns.map(|deadline_ns| missed(flow.last_ns, now_ns, deadline_ns));
        flow.missed_deadlines + since.unwrap_or_default()
    }

    /// When it last said that it lives \[ns\].
    pub(crate) fn asserted_ns(&self) -> i64 {
        self.lock().asserted_ns
    }

    pub(crate) fn assert_liveliness(&self) {
        let now_ns = self.common.clock.now_ns();
        self.lock().asserted_ns = now_ns;
    }

    /// Who listens from now on. Gives what latecomers get, oldest first.
    pub(crate) fn connect(
        &self,
        inlets: Vec<Arc<Inlet>>,
        taps: Arc<[Arc<Tap>]>,
        info: Arc<TopicInfo>,
    ) -> Vec<Sample> {
        let now_ns = self.common.clock.now_ns();
        let mut flow = self.lock();
        let listeners = inlets.len() + taps.len();
        self.listeners.store(listeners, Ordering::Relaxed);
        self.is_busy.store(listeners > 0 || keeps(&flow.qos), Ordering::Release);
        flow.inlets = inlets;
        flow.taps = taps;
        flow.info = info;
        flow.kept.iter().filter(|sample| !sample.is_stale(now_ns)).cloned().collect()
    }

    /// Publishes what `payload` makes, if it matters to anyone.
    #[inline]
    pub(crate) fn publish(&self, payload: impl FnOnce() -> Payload) {
        self.published.fetch_add(1, Ordering::Relaxed);
        if self.is_busy.load(Ordering::Acquire) {
            self.send(Arc::new(payload()));
        } else {
            self.topic.sequence.fetch_add(1, Ordering::Relaxed);
        }
    }

    fn send(&self, payload: Arc<Payload>) {
        let mut flow = self.lock();
        let time_ns = self.common.clock.now_ns();
        let sequence = self.topic.sequence.fetch_add(1, Ordering::Relaxed) + 1;
        let stale_ns = flow.qos.lifespan_ns.map_or(i64::MAX, |span| time_ns.saturating_add(span));
        flow.asserted_ns = time_ns;
        let sample = Sample { time_ns, sequence, publisher: self.id, stale_ns, payload };
        if let Some(deadline_ns) = flow.qos.deadline_ns {
            flow.missed_deadlines += missed(flow.last_ns, time_ns, deadline_ns);
            flow.last_ns = Some(time_ns);
        }
        for inlet in &flow.inlets {
            inlet.push(&sample);
        }
        for tap in flow.taps.iter() {
            tap.push(&flow.info, &sample);
        }
        let taps = if flow.taps.is_empty() { None } else { Some(flow.taps.clone()) };
        if flow.qos.durability == Durability::TransientLocal {
            if flow.kept.len() == flow.qos.capacity() {
                flow.kept.pop_front();
            }
            flow.kept.push_back(sample);
        }
        drop(flow);
        for tap in taps.iter().flat_map(|taps| taps.iter()) {
            tap.flush();
        }
    }
}

/// Whether messages matter even if nobody listens.
fn keeps(qos: &Qos) -> bool {
    qos.durability == Durability::TransientLocal
        || qos.deadline_ns.is_some()
        || qos.lease_ns.is_some()
}

/// How many deadlines passed between two messages.
pub(crate) fn missed(last_ns: Option<i64>, time_ns: i64, deadline_ns: i64) -> u64 {
    let Some(last_ns) = last_ns else { return 0 };
    let gap_ns = time_ns.saturating_sub(last_ns);
    if gap_ns <= deadline_ns { 0 } else { ((gap_ns - 1) / deadline_ns.max(1)).unsigned_abs() }
}
