//! Publishers.

use std::marker::PhantomData;
use std::sync::Arc;

use periplus_msgs::Message;

use crate::node::OwnOutlet;
use crate::payload::Payload;
use crate::sample::EndpointId;

/// Publishes messages of one type on one topic, as long as it is there.
pub struct Publisher<T> {
    own: OwnOutlet,
    of: PhantomData<fn(T)>,
}

impl<T: Message> Publisher<T> {
    pub(crate) fn new(own: OwnOutlet) -> Self {
        Self { own, of: PhantomData }
    }

    pub(crate) fn own(&self) -> &OwnOutlet {
        &self.own
    }

    /// Publishes a message at the time of the graph. All who listen share it; nothing is copied.
    /// It never waits for anybody who listens, except for the sinks of taps in lockstep.
    #[inline]
    pub fn publish(&self, message: T) {
        self.own.outlet.publish(|| Payload::typed(Arc::new(message)));
    }

    /// As [`Publisher::publish`], of a message that others hold too.
    #[inline]
    pub fn publish_shared(&self, message: &Arc<T>) {
        self.own.outlet.publish(|| Payload::typed(message.clone()));
    }

    /// Whether anybody listens: a subscription whose QoS fits, or a tap. What nobody hears need not
    /// be computed, except what is latched.
    #[must_use]
    #[inline]
    pub fn is_heard(&self) -> bool {
        self.own.outlet.is_heard()
    }

    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.own.outlet.topic.name
    }

    /// What [`crate::Sample::publisher`] says of its messages.
    #[must_use]
    pub fn id(&self) -> EndpointId {
        self.own.outlet.id
    }
}

/// Publishes bytes on a topic whose type is known only by name: what comes from a wire or a bag.
pub struct RawPublisher {
    own: OwnOutlet,
}

impl RawPublisher {
    pub(crate) fn new(own: OwnOutlet) -> Self {
        Self { own }
    }

    pub(crate) fn own(&self) -> &OwnOutlet {
        &self.own
    }

    /// Publishes a message as CDR, with the four bytes in front that say how it is coded. Who
    /// subscribes with a type decodes it, once for all.
    pub fn publish(&self, cdr: Vec<u8>) {
        self.own.outlet.publish(|| Payload::raw(cdr));
    }

    /// Whether anybody listens; see [`Publisher::is_heard`].
    #[must_use]
    pub fn is_heard(&self) -> bool {
        self.own.outlet.is_heard()
    }

    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.own.outlet.topic.name
    }

    /// What [`crate::Sample::publisher`] says of its messages.
    #[must_use]
    pub fn id(&self) -> EndpointId {
        self.own.outlet.id
    }
}
