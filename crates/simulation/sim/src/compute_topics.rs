//! Subscriptions that discard their messages.

use periplus_graph::{Sample, Sink, TapId, TopicInfo};

use crate::{Simulation, TopicFilter};

struct DiscardTap(TopicFilter);

impl Sink for DiscardTap {
    fn wants(&self, topic: &TopicInfo) -> bool {
        (self.0)(&topic.name)
    }

    fn depth(&self) -> usize {
        1
    }

    fn take(&self, _: &TopicInfo, _: &Sample) {}
}

/// Subscribes to topics and discards the messages, as a subscriber in this process. Topics without
/// subscribers are not computed, so this measures their cost.
pub fn compute_topics(simulation: &Simulation, wanted: TopicFilter) -> TapId {
    simulation.graph().tap(Box::new(DiscardTap(wanted)))
}
