//! What a graph publishes, on its way out. Only topics that somebody elsewhere wants are listened to:
//! what nobody hears is not computed.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::{Arc, Mutex};

use periplus_graph::{EndpointId, Graph, Sample, Sink, TapId, TopicInfo};

use crate::lock;

/// Messages of publishers whose way out is not made yet; so many wait.
const MOST_EARLY: usize = 64;

/// Publishers of a graph that stand for others: what they publish does not go out again.
pub type Foreign = Arc<Mutex<BTreeSet<EndpointId>>>;

/// The way of one publisher's messages to the network.
pub trait Way: Send + Sync + 'static {
    /// Whether a message would matter to anyone.
    fn is_wanted(&self) -> bool;

    /// Sends a message or puts it to be sent; it never waits for who is slow.
    fn push(self: &Arc<Self>, sample: Sample);
}

/// The topics of a graph that are listened to for others.
pub struct Taps<W> {
    taps: BTreeMap<String, (TapId, Arc<TopicSink<W>>)>,
    foreign: Foreign,
}

impl<W> Default for Taps<W> {
    fn default() -> Self {
        Self { taps: BTreeMap::new(), foreign: Foreign::default() }
    }
}

/// Takes what is published on one topic.
struct TopicSink<W> {
    topic: String,
    ways: Mutex<Ways<W>>,
    foreign: Foreign,
}

struct Ways<W> {
    of: BTreeMap<EndpointId, Arc<W>>,
    early: VecDeque<Sample>,
}

struct SinkHandle<W>(Arc<TopicSink<W>>);

impl<W: Way> Sink for SinkHandle<W> {
    fn wants(&self, topic: &TopicInfo) -> bool {
        topic.name == self.0.topic
    }

    /// What cannot be sent at once waits in a queue of the wire.
    fn is_quick(&self) -> bool {
        true
    }

    fn take(&self, _: &TopicInfo, sample: &Sample) {
        let mut ways = lock(&self.0.ways);
        if let Some(way) = ways.of.get(&sample.publisher).cloned() {
            drop(ways);
            if way.is_wanted() {
                way.push(sample.clone());
            }
        } else if !lock(&self.0.foreign).contains(&sample.publisher) {
            if ways.early.len() == MOST_EARLY {
                ways.early.pop_front();
            }
            ways.early.push_back(sample.clone());
        }
    }
}

impl<W: Way> TopicSink<W> {
    fn set(&self, of: BTreeMap<EndpointId, Arc<W>>) {
        let mut ways = lock(&self.ways);
        ways.of = of;
        for sample in std::mem::take(&mut ways.early) {
            match ways.of.get(&sample.publisher) {
                Some(way) if way.is_wanted() => way.push(sample),
                Some(_) => {}
                None => ways.early.push_back(sample),
            }
        }
    }
}

impl<W: Way> Taps<W> {
    /// Where publishers that stand for others are to be noted.
    #[must_use]
    pub fn foreign(&self) -> &Foreign {
        &self.foreign
    }

    /// Listens to the topics of the graph that somebody elsewhere wants, of those that have ways: the
    /// topic of each publisher, and its way.
    pub fn listen<'a>(
        &mut self,
        graph: &Graph,
        ways: impl Iterator<Item = (&'a str, EndpointId, &'a Arc<W>)>,
    ) {
        let mut wanted: BTreeMap<&str, BTreeMap<EndpointId, Arc<W>>> = BTreeMap::new();
        let mut heard: BTreeSet<&str> = BTreeSet::new();
        for (topic, id, way) in ways {
            if way.is_wanted() {
                heard.insert(topic);
            }
            wanted.entry(topic).or_default().insert(id, way.clone());
        }
        wanted.retain(|topic, _| heard.contains(topic));
        self.taps.retain(|topic, (id, _)| {
            let stays = wanted.contains_key(topic.as_str());
            if !stays {
                graph.untap(*id);
            }
            stays
        });
        for (topic, of) in wanted {
            if let Some((_, sink)) = self.taps.get(topic) {
                sink.set(of);
                continue;
            }
            let sink = Arc::new(TopicSink {
                topic: topic.to_owned(),
                ways: Mutex::new(Ways { of, early: VecDeque::new() }),
                foreign: self.foreign.clone(),
            });
            let id = graph.tap(Box::new(SinkHandle(sink.clone())));
            self.taps.insert(topic.to_owned(), (id, sink));
        }
    }
}
