//! Taps for outgoing messages. Only topics with remote subscribers are tapped: messages without
//! subscribers are not computed.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::{Arc, Mutex};

use periplus_graph::{EndpointId, Graph, Sample, Sink, TapId, TopicInfo};

use crate::lock;

/// Maximum number of queued messages of publishers without a send path yet.
const MOST_EARLY: usize = 64;

/// Publishers of a graph that represent remote ones: their messages are not sent again.
pub type Foreign = Arc<Mutex<BTreeSet<EndpointId>>>;

/// Send path of a publisher.
pub trait Way: Send + Sync + 'static {
    /// True if there is a remote subscriber, or messages have to be retained.
    fn is_wanted(&self) -> bool;

    /// Sends or queues a message; it never blocks on a slow subscriber.
    fn push(self: &Arc<Self>, sample: Sample);
}

/// Taps on the topics of a graph.
pub struct Taps<W> {
    taps: BTreeMap<String, (TapId, Arc<TopicSink<W>>)>,
    foreign: Foreign,
}

impl<W> Default for Taps<W> {
    fn default() -> Self {
        Self { taps: BTreeMap::new(), foreign: Foreign::default() }
    }
}

/// Sink of one topic.
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

    /// Messages that cannot be sent at once are queued by the transport.
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
    /// Set of the publishers that represent remote ones.
    #[must_use]
    pub fn foreign(&self) -> &Foreign {
        &self.foreign
    }

    /// Taps the topics of these publishers, each given with its topic and send path.
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
