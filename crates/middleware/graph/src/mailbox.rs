//! Subscriptions that somebody looks into from time to time.

use std::marker::PhantomData;
use std::sync::Arc;

use periplus_msgs::Message;

use crate::Qos;
use crate::inlet::InletCounts;
use crate::node::OwnInlet;
use crate::sample::{EndpointId, Sample};

/// The messages of a topic, as many as the QoS lets wait. It never holds up a publisher.
pub struct Mailbox<T> {
    own: OwnInlet,
    of: PhantomData<fn() -> T>,
}

impl<T: Message> Mailbox<T> {
    pub(crate) fn new(own: OwnInlet) -> Self {
        Self { own, of: PhantomData }
    }

    pub(crate) fn own(&self) -> &OwnInlet {
        &self.own
    }

    /// The newest message since the last look; older ones are gone with it. Messages that are no
    /// such type are counted and passed over.
    #[must_use]
    pub fn latest(&self) -> Option<Arc<T>> {
        self.own.inlet.drain().iter().rev().find_map(|sample| self.read(sample))
    }

    /// All messages since the last look, oldest first.
    #[must_use]
    pub fn drain(&self) -> Vec<Arc<T>> {
        self.own.inlet.drain().iter().filter_map(|sample| self.read(sample)).collect()
    }

    /// As [`Mailbox::drain`], with the times and numbers of the messages.
    #[must_use]
    pub fn drain_samples(&self) -> Vec<(Sample, Arc<T>)> {
        let samples = self.own.inlet.drain().into_iter();
        samples.filter_map(|sample| self.read(&sample).map(|message| (sample, message))).collect()
    }

    fn read(&self, sample: &Sample) -> Option<Arc<T>> {
        sample.message().map_err(|error| self.own.inlet.reject(&error)).ok()
    }

    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.own.inlet.topic
    }

    /// What arrived and what was lost.
    #[must_use]
    pub fn counts(&self) -> InletCounts {
        self.own.inlet.counts()
    }
}

/// The messages of a topic whose type is known only by name, as they are.
pub struct RawMailbox {
    own: OwnInlet,
}

impl RawMailbox {
    pub(crate) fn new(own: OwnInlet) -> Self {
        Self { own }
    }

    pub(crate) fn own(&self) -> &OwnInlet {
        &self.own
    }

    /// What it asks for.
    #[must_use]
    pub fn qos(&self) -> Qos {
        self.own.inlet.qos()
    }

    /// Which end of the topic it is.
    #[must_use]
    pub fn id(&self) -> EndpointId {
        self.own.inlet.id
    }

    /// All messages since the last look, oldest first.
    #[must_use]
    pub fn drain(&self) -> Vec<Sample> {
        self.own.inlet.drain().into()
    }

    /// Full name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.own.inlet.topic
    }

    /// What arrived and what was lost.
    #[must_use]
    pub fn counts(&self) -> InletCounts {
        self.own.inlet.counts()
    }
}
