//! Publishers.

use std::marker::PhantomData;
use std::sync::Arc;

use periplus_msgs::Message;

use crate::node::OwnedPublisher;
use crate::payload::Payload;
use crate::sample::EndpointId;

/// Publisher of one topic; removed from the graph when it is dropped.
pub struct Publisher<T> {
    own: OwnedPublisher,
    of: PhantomData<fn(T)>,
}

impl<T: Message> Publisher<T> {
    pub(crate) fn new(own: OwnedPublisher) -> Self {
        Self { own, of: PhantomData }
    }

    pub(crate) fn own(&self) -> &OwnedPublisher {
        &self.own
    }

    /// Publishes a message at the time of the graph. All subscribers share it without a copy.
    /// Publishing never blocks on a subscriber, except for the sinks of taps in lockstep.
    #[inline]
    pub fn publish(&self, message: T) {
        self.own.publisher.publish(|| Payload::typed(Arc::new(message)));
    }

    /// Same as [`Publisher::publish`], for a message that is shared already.
    #[inline]
    pub fn publish_shared(&self, message: &Arc<T>) {
        self.own.publisher.publish(|| Payload::typed(message.clone()));
    }

    /// True if there is a compatible subscription or a tap. Without one, a message need not be
    /// computed unless the topic is latched.
    #[must_use]
    #[inline]
    pub fn is_heard(&self) -> bool {
        self.own.publisher.is_heard()
    }

    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.own.publisher.topic.name
    }

    /// The value of [`crate::Sample::publisher`] in its messages.
    #[must_use]
    pub fn id(&self) -> EndpointId {
        self.own.publisher.id
    }
}

/// Publisher of serialized messages whose type is known only by name, for transports and bags.
pub struct RawPublisher {
    own: OwnedPublisher,
}

impl RawPublisher {
    pub(crate) fn new(own: OwnedPublisher) -> Self {
        Self { own }
    }

    pub(crate) fn own(&self) -> &OwnedPublisher {
        &self.own
    }

    /// Publishes a message as CDR, with the four-byte encapsulation header. It is decoded once for
    /// all typed subscriptions.
    pub fn publish(&self, cdr: Vec<u8>) {
        self.own.publisher.publish(|| Payload::raw(cdr));
    }

    /// True if there is a compatible subscription or a tap; see [`Publisher::is_heard`].
    #[must_use]
    pub fn is_heard(&self) -> bool {
        self.own.publisher.is_heard()
    }

    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.own.publisher.topic.name
    }

    /// The value of [`crate::Sample::publisher`] in its messages.
    #[must_use]
    pub fn id(&self) -> EndpointId {
        self.own.publisher.id
    }
}
