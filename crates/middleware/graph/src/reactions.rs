//! Callbacks without an [`crate::Actor`]: for messages whose types are known only by name, and for one time.

use std::sync::Arc;

use crate::actor::Once;
use crate::event_queue::{EventQueue, Key, Rank};
use crate::mailbox::RawMailbox;
use crate::node::Node;
use crate::registry::TypeOf;
use crate::sample::Sample;
use crate::subscription_core::Reaction;
use crate::{GraphError, Qos};

impl Node {
    /// Subscribes to a topic whose type is known only by name and optional hash, with a callback that
    /// runs in the order of the graph's events. The subscription ends when the result is dropped.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn raw_subscription(
        &self,
        topic: &str,
        type_name: &str,
        type_hash: Option<&str>,
        qos: Qos,
        react: impl Fn(&Sample) + Send + Sync + 'static,
    ) -> Result<RawMailbox, GraphError> {
        let reaction = Reaction {
            event_queue: self.0.event_queue(),
            ordinal: self.0.next_ordinal(),
            react: Box::new(move |sample| {
                react(sample);
                Ok(())
            }),
        };
        let type_of = TypeOf::new(type_name, type_hash);
        Ok(RawMailbox::new(self.0.subscription(topic, type_of, qos, Some(reaction))?))
    }

    /// Runs a callback once at a time of the graph \[ns\], or now if that has passed. It does not run if
    /// the result is dropped before.
    pub fn alarm(&self, time_ns: i64, act: impl FnOnce() + Send + 'static) -> Alarm {
        let event_queue = self.0.event_queue();
        let ordinal = self.0.next_ordinal();
        let node = self.0.full_name.clone();
        let key = Key {
            time_ns: time_ns.max(self.now_ns()),
            node: node.clone(),
            rank: Rank::Timer,
            name: "".into(),
            sequence: 0,
            ordinal,
        };
        event_queue.add(key, Arc::new(Once::new(act)));
        Alarm { event_queue, node, ordinal }
    }
}

/// Callback at one time, which does not run once this is dropped.
#[must_use]
pub struct Alarm {
    event_queue: Arc<EventQueue>,
    node: Arc<str>,
    ordinal: u64,
}

impl Drop for Alarm {
    fn drop(&mut self) {
        self.event_queue.remove_timer(&self.node, self.ordinal);
    }
}
