//! Event-driven nodes: a state, and callbacks for messages, timers and services.

mod jump;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use periplus_msgs::{Message, Service};

use crate::common::{Common, lock};
use crate::event_queue::{Event, EventQueue, Key, Rank};
use crate::node::{Node, NodeCore, OwnedSubscription};
use crate::payload::Payload;
use crate::registry::TypeOf;
use crate::sample::Sample;
use crate::service::{CallError, Client, Reply, Request, ServerReaction, read_answer};
use crate::subscription_core::Reaction;
use crate::{Alarm, GraphError, Qos};

pub(crate) use jump::Jumps;

/// A node with a state and callbacks. Each callback gets the state, the event, and an [`Io`]; two
/// callbacks never run at the same time.
#[must_use = "the node stops reacting when this is dropped"]
pub struct Actor<S> {
    state: Arc<Mutex<S>>,
    node: Node,
    /// Subscriptions in the order of [`Actor::subscribe`].
    subscriptions: Vec<OwnedSubscription>,
    /// Endpoints of services, and timers.
    parts: Vec<Box<dyn Send + Sync>>,
}

/// Runs a callback on the state.
pub(crate) type Run<'r, F, S> = dyn FnMut(&mut F, &mut S, &mut Io<'_, S>) + 'r;

/// Interface of a callback to its node.
pub struct Io<'a, S> {
    node: &'a Node,
    state: &'a Arc<Mutex<S>>,
}

impl<S: Send + 'static> Io<'_, S> {
    /// The time of the graph \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.node.now_ns()
    }

    /// The node.
    #[must_use]
    pub fn node(&self) -> &Node {
        self.node
    }

    /// Calls a service; `react` gets the response.
    pub fn call<V: Service>(
        &self,
        client: &Client<V>,
        request: V::Request,
        react: impl FnOnce(&mut S, Result<Arc<V::Response>, CallError>, &mut Io<'_, S>) + Send + 'static,
    ) {
        let name = client.caller.name.clone();
        let (node, state) = (Arc::downgrade(&self.node.0), self.state.clone());
        let event_queue = self.node.0.event_queue();
        let ordinal = self.node.0.next_ordinal();
        let reply = Reply::new(name.clone(), move |answer| {
            // The node may have been dropped.
            let Some(node) = node.upgrade() else { return };
            let key = Key {
                time_ns: node.core.common.clock.now_ns(),
                node: node.full_name.clone(),
                rank: Rank::Answer,
                name: name.clone(),
                sequence: ordinal,
                ordinal: 0,
            };
            let node = Node(node);
            let event = Once::new(move || {
                let answer = read_answer::<V>(answer, &name);
                let mut io = Io { node: &node, state: &state };
                react(&mut lock(&state), answer, &mut io);
            });
            event_queue.add(key, Arc::new(event));
        });
        client.caller.call(Payload::typed(Arc::new(request)), reply);
    }

    /// Runs a callback once at a time of the graph \[ns\], or now if that has passed. It does not run
    /// if the result is dropped before.
    pub fn alarm(
        &self,
        time_ns: i64,
        react: impl FnOnce(&mut S, &mut Io<'_, S>) + Send + 'static,
    ) -> Alarm {
        // The state may hold the alarm, so the alarm must not hold the state.
        let (node, state) = (Arc::downgrade(&self.node.0), Arc::downgrade(self.state));
        self.node.alarm(time_ns, move || {
            let (Some(node), Some(state)) = (node.upgrade(), state.upgrade()) else { return };
            let node = Node(node);
            let mut io = Io { node: &node, state: &state };
            react(&mut lock(&state), &mut io);
        })
    }
}

impl<S: Send + 'static> Actor<S> {
    pub(crate) fn new(node: Node, state: S) -> Self {
        let state = Arc::new(Mutex::new(state));
        Self { state, node, subscriptions: Vec::new(), parts: Vec::new() }
    }

    /// The node.
    #[must_use]
    pub fn node(&self) -> &Node {
        &self.node
    }

    /// Accesses the state.
    pub fn with<R>(&self, look: impl FnOnce(&mut S) -> R) -> R {
        look(&mut lock(&self.state))
    }

    /// Subscribes to a topic with a callback.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn subscribe<T: Message>(
        &mut self,
        topic: &str,
        qos: Qos,
        react: impl FnMut(&mut S, Arc<T>, &mut Io<'_, S>) + Send + 'static,
    ) -> Result<(), GraphError> {
        let act = self.act(react);
        let reaction = Reaction {
            event_queue: self.node.0.event_queue(),
            ordinal: self.node.0.next_ordinal(),
            react: Box::new(move |sample| {
                let message = sample.message::<T>()?;
                act(&mut |react, state, io| react(state, message.clone(), io));
                Ok(())
            }),
        };
        let own = self.node.0.subscription(topic, TypeOf::message::<T>(), qos, Some(reaction))?;
        self.subscriptions.push(own);
        Ok(())
    }

    /// Returns the messages that wait for the callbacks, oldest first, by subscription in the order
    /// of [`Actor::subscribe`]. They stay.
    #[must_use]
    pub fn pending(&self) -> Vec<Vec<Sample>> {
        self.subscriptions.iter().map(|own| own.subscription.pending()).collect()
    }

    /// Replaces the messages that wait for the callbacks, such as by those that [`Actor::pending`]
    /// returned earlier. Subscriptions without an entry lose their messages.
    pub fn set_pending(&self, samples: &[Vec<Sample>]) {
        for (index, own) in self.subscriptions.iter().enumerate() {
            own.subscription.set_pending(samples.get(index).map_or(&[], Vec::as_slice));
        }
    }

    /// Creates a timer with a period of `period_ns` in the graph's time; it first fires after one
    /// period.
    ///
    /// # Errors
    /// When the period is not positive.
    pub fn timer(
        &mut self,
        period_ns: i64,
        react: impl FnMut(&mut S, &mut Io<'_, S>) + Send + 'static,
    ) -> Result<(), GraphError> {
        if period_ns <= 0 {
            let reason = format!(
                "the timer of `{}` has a period of {period_ns} ns; it must be at least 1",
                self.node.full_name()
            );
            return Err(GraphError::Value { reason });
        }
        let act = self.act(react);
        let event_queue = self.node.0.event_queue();
        let key = Key {
            time_ns: self.node.now_ns().saturating_add(period_ns),
            node: self.node.0.full_name.clone(),
            rank: Rank::Timer,
            name: "".into(),
            sequence: 0,
            ordinal: self.node.0.next_ordinal(),
        };
        let timer = Arc::new_cyclic(|this| Timer {
            this: this.clone(),
            period_ns,
            event_queue: event_queue.clone(),
            is_over: AtomicBool::new(false),
            common: self.node.0.core.common.clone(),
            is_live: self.node.0.core.live.is_some(),
            react: Box::new(move || act(&mut |react, state, io| react(state, io))),
        });
        event_queue.add(key.clone(), timer.clone());
        self.parts.push(Box::new(OwnTimer { timer, node: key.node, ordinal: key.ordinal }));
        Ok(())
    }

    /// Creates a service with a callback.
    ///
    /// # Errors
    /// When the name is not valid, the service has another type, or another node serves it.
    pub fn serve<V: Service>(
        &mut self,
        name: &str,
        react: impl FnMut(&mut S, Arc<V::Request>, &mut Io<'_, S>) -> V::Response + Send + 'static,
    ) -> Result<(), GraphError> {
        let act = self.act(react);
        let react = move |request: Request| match request.payload.message::<V::Request>() {
            Ok(question) => {
                let mut answer = None;
                act(&mut |react, state, io| answer = Some(react(state, question.clone(), io)));
                if let Some(answer) = answer {
                    request.reply.send(Ok(Arc::new(Payload::typed(Arc::new(answer)))));
                }
            }
            Err(error) => request.reply.undecodable(&error),
        };
        let node = Arc::downgrade(&self.node.0);
        let reaction = ServerReaction { node, react: Box::new(react) };
        let own = self.node.0.server(name, TypeOf::service::<V>(), Some(reaction))?;
        self.parts.push(Box::new(own));
        Ok(())
    }

    /// Keeps something alive with the actor.
    pub(crate) fn keep(&mut self, part: impl Send + Sync + 'static) {
        self.parts.push(Box::new(part));
    }

    /// Runs a closure with the callback, the state and an [`Io`].
    pub(crate) fn act<F: Send + 'static>(
        &self,
        react: F,
    ) -> impl Fn(&mut Run<'_, F, S>) + Send + Sync + use<F, S> {
        let (state, react) = (self.state.clone(), Mutex::new(react));
        // The node can be dropped while its callbacks are still in the queue.
        let node: std::sync::Weak<NodeCore> = Arc::downgrade(&self.node.0);
        move |run| {
            let Some(node) = node.upgrade() else { return };
            let node = Node(node);
            let mut io = Io { node: &node, state: &state };
            run(&mut lock(&react), &mut lock(&state), &mut io);
        }
    }
}

struct Timer {
    this: std::sync::Weak<Self>,
    period_ns: i64,
    event_queue: Arc<EventQueue>,
    is_over: AtomicBool,
    common: Arc<Common>,
    is_live: bool,
    react: Box<dyn Fn() + Send + Sync>,
}

impl Timer {
    fn live_now_ns(&self) -> Option<i64> {
        self.is_live.then(|| self.common.clock.now_ns())
    }
}

impl Event for Timer {
    fn happen(&self, key: &Key) {
        let Some(this) = self.this.upgrade() else { return };
        if self.is_over.load(Ordering::Acquire) {
            return;
        }
        let mut time_ns = key.time_ns.saturating_add(self.period_ns);
        if let Some(now_ns) = self.live_now_ns()
            && time_ns < now_ns
        {
            // Overrun: skip the missed periods and keep the phase.
            time_ns = now_ns + (time_ns - now_ns).rem_euclid(self.period_ns);
        }
        self.event_queue.add(Key { time_ns, ..key.clone() }, this);
        (self.react)();
    }

    fn time_after_jump(&self, now_ns: i64) -> i64 {
        now_ns.saturating_add(self.period_ns)
    }
}

/// A timer that stops when this is dropped.
struct OwnTimer {
    timer: Arc<Timer>,
    node: Arc<str>,
    ordinal: u64,
}

impl Drop for OwnTimer {
    fn drop(&mut self) {
        self.timer.is_over.store(true, Ordering::Release);
        self.timer.event_queue.remove_timer(&self.node, self.ordinal);
    }
}

/// An event that runs once.
pub(crate) struct Once(Mutex<Option<Box<dyn FnOnce() + Send>>>);

impl Once {
    pub(crate) fn new(act: impl FnOnce() + Send + 'static) -> Self {
        Self(Mutex::new(Some(Box::new(act))))
    }
}

impl Event for Once {
    fn happen(&self, _: &Key) {
        let act = lock(&self.0).take();
        if let Some(act) = act {
            act();
        }
    }
}
