//! A listener that throws away what it hears.

use periplus_graph::{Sample, Sink, TapId, TopicInfo};

use crate::{Simulation, Wanted};

struct Deaf(Wanted);

impl Sink for Deaf {
    fn wants(&self, topic: &TopicInfo) -> bool {
        (self.0)(&topic.name)
    }

    fn depth(&self) -> usize {
        1
    }

    fn take(&self, _: &TopicInfo, _: &Sample) {}
}

/// Has the topics measured and published that are wanted, as for a subscriber in this process. What
/// nobody hears is not computed; so this is how to learn what it would cost.
pub fn hear(simulation: &Simulation, wanted: Wanted) -> TapId {
    simulation.graph().tap(Box::new(Deaf(wanted)))
}
