//! Callbacks for jumps of the clock.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use super::{Actor, Io};
use crate::common::{Common, lock};
use crate::event_queue::{Event, EventQueue, Key, Rank};

/// Jump handlers by node and number.
#[derive(Default)]
pub(crate) struct Jumps(Mutex<BTreeMap<HandlerKey, Arc<JumpHandler>>>);

/// Name of the node, and number of the handler in it.
type HandlerKey = (Arc<str>, u64);

pub(crate) struct JumpHandler {
    event_queue: Arc<EventQueue>,
    react: Box<dyn Fn() + Send + Sync>,
}

impl Event for JumpHandler {
    fn happen(&self, _: &Key) {
        (self.react)();
    }
}

impl Jumps {
    /// Queues the jump handlers of all nodes; they run before anything else.
    pub(crate) fn notify(&self, now_ns: i64) {
        for ((node, ordinal), handler) in lock(&self.0).iter() {
            let key = Key {
                time_ns: now_ns,
                node: node.clone(),
                rank: Rank::Jump,
                name: "".into(),
                sequence: 0,
                ordinal: *ordinal,
            };
            handler.event_queue.add(key, handler.clone());
        }
    }
}

/// A handler that is removed when this is dropped.
struct OwnJump {
    key: HandlerKey,
    common: Arc<Common>,
}

impl Drop for OwnJump {
    fn drop(&mut self) {
        let gone = lock(&self.common.jumps.0).remove(&self.key);
        drop(gone);
    }
}

impl<S: Send + 'static> Actor<S> {
    /// Calls back on a jump of the clock, such as a reset or a bag that loops. Clear time-dependent
    /// buffers here. Timers restart by themselves.
    pub fn on_jump(&mut self, react: impl FnMut(&mut S, &mut Io<'_, S>) + Send + 'static) {
        let act = self.act(react);
        let node = self.node.0.clone();
        let handler = JumpHandler {
            event_queue: node.event_queue(),
            react: Box::new(move || act(&mut |react, state, io| react(state, io))),
        };
        let key = (node.full_name.clone(), node.next_ordinal());
        let common = node.core.common.clone();
        lock(&common.jumps.0).insert(key.clone(), Arc::new(handler));
        self.parts.push(Box::new(OwnJump { key, common }));
    }
}
