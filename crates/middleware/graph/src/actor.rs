//! Nodes that react: a state, and closures for messages, timers and calls.

mod jump;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use periplus_msgs::{Message, Service};

use crate::agenda::{Agenda, Event, Key, Rank};
use crate::common::{Common, lock};
use crate::inlet::Reaction;
use crate::node::{Node, NodeCore};
use crate::payload::Payload;
use crate::registry::TypeOf;
use crate::service::{CallError, Client, Reply, Request, ServerReaction, read_answer};
use crate::{GraphError, Qos};

pub(crate) use jump::Jumps;

/// A node with a state, as long as this is there. Its closures get the state, what happened, and an
/// [`Io`]; never two of them at once.
#[must_use = "the node stops reacting when this is dropped"]
pub struct Actor<S> {
    state: Arc<Mutex<S>>,
    node: Node,
    /// Ends of topics and services, and timers.
    parts: Vec<Box<dyn Send + Sync>>,
}

/// Something that is done with a closure and the state.
pub(crate) type Run<'r, F, S> = dyn FnMut(&mut F, &mut S, &mut Io<'_, S>) + 'r;

/// What a closure can do beside changing the state.
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

    /// Calls a service; `react` gets the answer when it comes.
    pub fn call<V: Service>(
        &self,
        client: &Client<V>,
        request: V::Request,
        react: impl FnOnce(&mut S, Result<Arc<V::Response>, CallError>, &mut Io<'_, S>) + Send + 'static,
    ) {
        let name = client.caller.name.clone();
        let (node, state) = (Arc::downgrade(&self.node.0), self.state.clone());
        let agenda = self.node.0.agenda();
        let ordinal = self.node.0.next_ordinal();
        let reply = Reply::new(name.clone(), move |answer| {
            // The node may be gone by now.
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
            agenda.add(key, Arc::new(event));
        });
        client.caller.call(Payload::typed(Arc::new(request)), reply);
    }
}

impl<S: Send + 'static> Actor<S> {
    pub(crate) fn new(node: Node, state: S) -> Self {
        Self { state: Arc::new(Mutex::new(state)), node, parts: Vec::new() }
    }

    /// The node.
    #[must_use]
    pub fn node(&self) -> &Node {
        &self.node
    }

    /// Looks at the state.
    pub fn with<R>(&self, look: impl FnOnce(&mut S) -> R) -> R {
        look(&mut lock(&self.state))
    }

    /// Reacts to the messages of a topic.
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
            agenda: self.node.0.agenda(),
            ordinal: self.node.0.next_ordinal(),
            react: Box::new(move |sample| {
                let message = sample.message::<T>()?;
                act(&mut |react, state, io| react(state, message.clone(), io));
                Ok(())
            }),
        };
        let own = self.node.0.inlet(topic, TypeOf::message::<T>(), qos, Some(reaction))?;
        self.parts.push(Box::new(own));
        Ok(())
    }

    /// Acts every `period_ns` of the graph's time, first after one period.
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
                "the timer of `{}` has a period of {period_ns} ns; give it at least 1",
                self.node.full_name()
            );
            return Err(GraphError::Value { reason });
        }
        let act = self.act(react);
        let agenda = self.node.0.agenda();
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
            agenda: agenda.clone(),
            is_over: AtomicBool::new(false),
            common: self.node.0.core.common.clone(),
            is_live: self.node.0.core.live.is_some(),
            react: Box::new(move || act(&mut |react, state, io| react(state, io))),
        });
        agenda.add(key.clone(), timer.clone());
        self.parts.push(Box::new(OwnTimer { timer, node: key.node, ordinal: key.ordinal }));
        Ok(())
    }

    /// Answers a service.
    ///
    /// # Errors
    /// When the name is not valid, the service has another type, or another node answers it.
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

    /// Keeps something as long as the actor is there.
    pub(crate) fn keep(&mut self, part: impl Send + Sync + 'static) {
        self.parts.push(Box::new(part));
    }

    /// Runs something with a closure, the state and an [`Io`].
    pub(crate) fn act<F: Send + 'static>(
        &self,
        react: F,
    ) -> impl Fn(&mut Run<'_, F, S>) + Send + Sync + use<F, S> {
        let (state, react) = (self.state.clone(), Mutex::new(react));
        // The node must be able to go while its closures are still known to the graph.
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
    agenda: Arc<Agenda>,
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
            // Too slow for its period: what is missed is left out, the phase stays.
            time_ns = now_ns + (time_ns - now_ns).rem_euclid(self.period_ns);
        }
        self.agenda.add(Key { time_ns, ..key.clone() }, this);
        (self.react)();
    }

    fn time_after_jump(&self, now_ns: i64) -> i64 {
        now_ns.saturating_add(self.period_ns)
    }
}

/// A timer that ends when this is dropped.
struct OwnTimer {
    timer: Arc<Timer>,
    node: Arc<str>,
    ordinal: u64,
}

impl Drop for OwnTimer {
    fn drop(&mut self) {
        self.timer.is_over.store(true, Ordering::Release);
        self.timer.agenda.remove_timer(&self.node, self.ordinal);
    }
}

/// Something that happens once.
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
