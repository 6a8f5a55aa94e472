//! Polled subscriptions.

use std::marker::PhantomData;
use std::sync::Arc;

use periplus_msgs::Message;

use crate::Qos;
use crate::node::OwnedSubscription;
use crate::sample::{EndpointId, Sample};
use crate::subscription_core::SubscriptionCounts;

/// Polled subscription: messages wait up to the depth of the QoS. It never blocks a publisher.
pub struct Mailbox<T> {
    own: OwnedSubscription,
    of: PhantomData<fn() -> T>,
}

impl<T: Message> Mailbox<T> {
    pub(crate) fn new(own: OwnedSubscription) -> Self {
        Self { own, of: PhantomData }
    }

    pub(crate) fn own(&self) -> &OwnedSubscription {
        &self.own
    }

    /// Returns the newest message since the last call and discards older ones. Messages that cannot
    /// be decoded are counted and skipped.
    #[must_use]
    pub fn latest(&self) -> Option<Arc<T>> {
        self.own.subscription.drain().iter().rev().find_map(|sample| self.read(sample))
    }

    /// Returns all messages since the last call, oldest first.
    #[must_use]
    pub fn drain(&self) -> Vec<Arc<T>> {
        self.own.subscription.drain().iter().filter_map(|sample| self.read(sample)).collect()
    }

    /// Same as [`Mailbox::drain`], with the times and sequence numbers of the messages.
    #[must_use]
    pub fn drain_samples(&self) -> Vec<(Sample, Arc<T>)> {
        let samples = self.own.subscription.drain().into_iter();
        samples.filter_map(|sample| self.read(&sample).map(|message| (sample, message))).collect()
    }

    /// Returns the messages that wait, oldest first, without taking them.
    #[must_use]
    pub fn pending(&self) -> Vec<Sample> {
        self.own.subscription.pending()
    }

    /// Replaces the messages that wait, such as by those that [`Mailbox::pending`] returned earlier.
    /// The counts do not change.
    pub fn set_pending(&self, samples: &[Sample]) {
        self.own.subscription.set_pending(samples);
    }

    fn read(&self, sample: &Sample) -> Option<Arc<T>> {
        sample.message().map_err(|error| self.own.subscription.reject(&error)).ok()
    }

    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.own.subscription.topic
    }

    /// Counts of received and lost messages.
    #[must_use]
    pub fn counts(&self) -> SubscriptionCounts {
        self.own.subscription.counts()
    }
}

/// Polled subscription to a topic whose type is known only by name.
pub struct RawMailbox {
    own: OwnedSubscription,
}

impl RawMailbox {
    pub(crate) fn new(own: OwnedSubscription) -> Self {
        Self { own }
    }

    pub(crate) fn own(&self) -> &OwnedSubscription {
        &self.own
    }

    /// The requested QoS.
    #[must_use]
    pub fn qos(&self) -> Qos {
        self.own.subscription.qos()
    }

    /// Id of the endpoint.
    #[must_use]
    pub fn id(&self) -> EndpointId {
        self.own.subscription.id
    }

    /// Removes and returns the oldest message.
    #[must_use]
    pub fn take(&self) -> Option<Sample> {
        self.own.subscription.take_oldest()
    }

    /// True if a message waits.
    #[must_use]
    pub fn has_messages(&self) -> bool {
        self.own.subscription.has_messages()
    }

    /// Sets a callback that runs once for each new message, on the thread of the publisher; it must
    /// not block. Only the first callback is kept.
    pub fn on_message(&self, wake: impl Fn() + Send + Sync + 'static) {
        let _ = self.own.subscription.wake.set(Box::new(wake));
    }

    /// Returns all messages since the last call, oldest first.
    #[must_use]
    pub fn drain(&self) -> Vec<Sample> {
        self.own.subscription.drain().into()
    }

    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.own.subscription.topic
    }

    /// Counts of received and lost messages.
    #[must_use]
    pub fn counts(&self) -> SubscriptionCounts {
        self.own.subscription.counts()
    }
}
