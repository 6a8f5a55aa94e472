//! Connections of a publisher to its subscribers.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::common::Common;
use crate::info::TopicInfo;
use crate::interceptor::{InterceptedMessage, Interceptor};
use crate::parallel::{self, ParallelNamespace};
use crate::payload::Payload;
use crate::qos_event::ReportedEvents;
use crate::sample::{EndpointId, Sample};
use crate::subscription_core::SubscriptionCore;
use crate::tap::Tap;
use crate::{Durability, Qos};

/// State shared by all endpoints of one topic.
pub(crate) struct Topic {
    pub(crate) name: Arc<str>,
    /// The namespace of the topic that runs beside others.
    pub(crate) namespace: Option<Arc<ParallelNamespace>>,
    /// Sequence number of the last message.
    pub(crate) sequence: AtomicU64,
}

/// Shared state of a publisher.
pub(crate) struct PublisherCore {
    pub(crate) id: EndpointId,
    pub(crate) node: Arc<str>,
    pub(crate) topic: Arc<Topic>,
    common: Arc<Common>,
    /// Number of subscriptions and taps.
    listeners: AtomicUsize,
    /// False if a message needs not be made into a sample.
    is_busy: AtomicBool,
    /// True if an interceptor takes the messages.
    is_intercepted: AtomicBool,
    pub(crate) published: AtomicU64,
    /// QoS events already reported.
    pub(crate) reported: Mutex<ReportedEvents>,
    flow: Mutex<Flow>,
}

#[derive(Default)]
struct Flow {
    qos: Qos,
    subscriptions: Vec<Arc<SubscriptionCore>>,
    taps: Arc<[Arc<Tap>]>,
    info: Arc<TopicInfo>,
    interceptor: Option<Arc<dyn Interceptor>>,
    /// Messages retained for late subscribers.
    kept: VecDeque<Sample>,
    last_ns: Option<i64>,
    missed_deadlines: u64,
    /// Time of the last liveliness assertion \[ns\].
    asserted_ns: i64,
}

impl PublisherCore {
    pub(crate) fn new(
        id: EndpointId,
        node: Arc<str>,
        topic: Arc<Topic>,
        qos: Qos,
        common: Arc<Common>,
    ) -> Self {
        let publisher = Self {
            id,
            node,
            topic,
            common,
            listeners: AtomicUsize::new(0),
            is_busy: AtomicBool::new(false),
            is_intercepted: AtomicBool::new(false),
            published: AtomicU64::new(0),
            reported: Mutex::default(),
            flow: Mutex::new(Flow { qos, ..Flow::default() }),
        };
        publisher.assert_liveliness();
        publisher.is_busy.store(keeps(&qos), Ordering::Relaxed);
        publisher
    }

    fn lock(&self) -> MutexGuard<'_, Flow> {
        self.flow.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The offered QoS.
    pub(crate) fn qos(&self) -> Qos {
        self.lock().qos
    }

    /// Changes the offered QoS. The caller reconnects the topic.
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

    /// Time of the last liveliness assertion \[ns\].
    pub(crate) fn asserted_ns(&self) -> i64 {
        self.lock().asserted_ns
    }

    pub(crate) fn assert_liveliness(&self) {
        let now_ns = self.common.clock.now_ns();
        self.lock().asserted_ns = now_ns;
    }

    /// Sets the subscribers. Returns the messages retained for late subscribers, oldest first.
    pub(crate) fn connect(
        &self,
        subscriptions: Vec<Arc<SubscriptionCore>>,
        taps: Arc<[Arc<Tap>]>,
        info: Arc<TopicInfo>,
        interceptor: Option<Arc<dyn Interceptor>>,
    ) -> Vec<Sample> {
        let now_ns = self.common.clock.now_ns();
        let mut flow = self.lock();
        let listeners = subscriptions.len() + taps.len();
        self.listeners.store(listeners, Ordering::Relaxed);
        self.is_busy.store(listeners > 0 || keeps(&flow.qos), Ordering::Release);
        self.is_intercepted.store(interceptor.is_some(), Ordering::Release);
        flow.subscriptions = subscriptions;
        flow.taps = taps;
        flow.info = info;
        flow.interceptor = interceptor;
        flow.kept.iter().filter(|sample| !sample.is_stale(now_ns)).cloned().collect()
    }

    /// Publishes the result of `payload`, if it is needed.
    #[inline]
    pub(crate) fn publish(self: &Arc<Self>, payload: impl FnOnce() -> Payload) {
        self.published.fetch_add(1, Ordering::Relaxed);
        if !self.is_busy.load(Ordering::Acquire) {
            self.topic.sequence.fetch_add(1, Ordering::Relaxed);
            return;
        }
        let payload = Arc::new(payload());
        // An interceptor sees the messages of all namespaces.
        let is_shared = self.is_intercepted.load(Ordering::Acquire) && parallel::is_running();
        if is_shared || !parallel::may_change(self.topic.namespace.as_ref()) {
            let this = self.clone();
            parallel::after_all(move || this.deliver(payload));
        } else {
            self.deliver(payload);
        }
    }

    /// Delivers a message to the interceptor, or to all subscribers.
    fn deliver(self: &Arc<Self>, payload: Arc<Payload>) {
        if !self.is_intercepted.load(Ordering::Acquire) {
            self.send(payload);
            return;
        }
        let flow = self.lock();
        let interceptor = flow.interceptor.clone();
        let message =
            InterceptedMessage { publisher: self.clone(), info: flow.info.clone(), payload };
        drop(flow);
        match interceptor {
            Some(interceptor) => interceptor.intercept(message),
            None => message.forward(),
        }
    }

    /// Delivers a message to all subscribers.
    pub(crate) fn send(&self, payload: Arc<Payload>) {
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
        for subscription in &flow.subscriptions {
            subscription.receive(&sample);
        }
        let tapped =
            (!flow.taps.is_empty()).then(|| (flow.taps.clone(), flow.info.clone(), sample.clone()));
        if flow.qos.durability == Durability::TransientLocal {
            if flow.kept.len() == flow.qos.capacity() {
                flow.kept.pop_front();
            }
            flow.kept.push_back(sample);
        }
        // Under the lock, so that taps see the messages of a topic in their order.
        let Some((taps, info, sample)) = tapped else { return };
        if parallel::is_running() {
            return parallel::after_all(move || {
                taps.iter().for_each(|tap| tap.push(&info, &sample));
                taps.iter().for_each(|tap| tap.flush());
            });
        }
        taps.iter().for_each(|tap| tap.push(&info, &sample));
        drop(flow);
        taps.iter().for_each(|tap| tap.flush());
    }
}

/// True if messages have to be kept without subscribers.
fn keeps(qos: &Qos) -> bool {
    qos.durability == Durability::TransientLocal
        || qos.deadline_ns.is_some()
        || qos.lease_ns.is_some()
}

/// Number of deadlines missed between two messages.
pub(crate) fn missed(last_ns: Option<i64>, time_ns: i64, deadline_ns: i64) -> u64 {
    let Some(last_ns) = last_ns else { return 0 };
    let gap_ns = time_ns.saturating_sub(last_ns);
    if gap_ns <= deadline_ns { 0 } else { ((gap_ns - 1) / deadline_ns.max(1)).unsigned_abs() }
}
