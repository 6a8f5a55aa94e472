//! Telling nodes that the clock jumped.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use super::{Actor, Io};
use crate::agenda::{Agenda, Event, Key, Rank};
use crate::common::{Common, lock};

/// Who wants to know, by node and number.
#[derive(Default)]
pub(crate) struct Jumps(Mutex<BTreeMap<Place, Arc<JumpHandler>>>);

/// Name of the node, and number of the handler in it.
type Place = (Arc<str>, u64);

pub(crate) struct JumpHandler {
    agenda: Arc<Agenda>,
    react: Box<dyn Fn() + Send + Sync>,
}

impl Event for JumpHandler {
    fn happen(&self, _: &Key) {
        (self.react)();
    }
}

impl Jumps {
    /// The clock jumped to `now_ns`: before anything else, each node hears of it.
    pub(crate) fn tell(&self, now_ns: i64) {
        for ((node, ordinal), handler) in lock(&self.0).iter() {
            let key = Key {
                time_ns: now_ns,
                node: node.clone(),
                rank: Rank::Jump,
                name: "".into(),
                sequence: 0,
                ordinal: *ordinal,
            };
            handler.agenda.add(key, handler.clone());
        }
    }
}

/// A handler that is forgotten when this is dropped.
struct OwnJump {
    place: Place,
    common: Arc<Common>,
}

impl Drop for OwnJump {
    fn drop(&mut self) {
        let gone = lock(&self.common.jumps.0).remove(&self.place);
        drop(gone);
    }
}

impl<S: Send + 'static> Actor<S> {
    /// Reacts to a jump of the clock: a reset, or a bag that begins again. Buffers of what was are
    /// emptied here. Timers start anew by themselves.
    pub fn on_jump(&mut self, react: impl FnMut(&mut S, &mut Io<'_, S>) + Send + 'static) {
        let act = self.act(react);
        let node = self.node.0.clone();
        let handler = JumpHandler {
            agenda: node.agenda(),
            react: Box::new(move || act(&mut |react, state, io| react(state, io))),
        };
        let place = (node.full_name.clone(), node.next_ordinal());
        let common = node.core.common.clone();
        lock(&common.jumps.0).insert(place.clone(), Arc::new(handler));
        self.parts.push(Box::new(OwnJump { place, common }));
    }
}
