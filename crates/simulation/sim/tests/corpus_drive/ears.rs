//! Subscriber to all topics of a run.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use periplus_graph::{Node, Qos, RawMailbox, Sample, Sink, TopicInfo};
use periplus_sim::Simulation;

use crate::sound::fault;

/// Images and clouds are slow to check: two of each are enough.
const HEAVY: [&str; 3] =
    ["sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage", "sensor_msgs/msg/PointCloud2"];
const ENOUGH: u64 = 2;

/// Types that an active robot publishes within seconds, without a request.
const TALKATIVE: [&str; 11] = [
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/PointCloud2",
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/Imu",
    "sensor_msgs/msg/NavSatFix",
    "sensor_msgs/msg/MagneticField",
    "sensor_msgs/msg/Range",
    "sensor_msgs/msg/JointState",
    "nav_msgs/msg/Odometry",
    "rosgraph_msgs/msg/Clock",
];

/// Messages received on a topic.
#[derive(Clone, Debug, Default)]
pub(crate) struct Heard {
    pub(crate) messages: u64,
    pub(crate) fault: Option<String>,
}

type Topics = Arc<Mutex<BTreeMap<String, Heard>>>;

/// Listens to all topics.
pub(crate) struct Ears {
    topics: Topics,
    heavy: Vec<(String, RawMailbox)>,
    expected: Vec<String>,
}

struct Tap(Topics);

impl Ears {
    pub(crate) fn open(simulation: &Simulation, node: &Node) -> Self {
        let mut ears = Self { topics: Topics::default(), heavy: Vec::new(), expected: Vec::new() };
        let graph = simulation.graph();
        for topic in graph.topics().into_iter().filter(|topic| !topic.publishers.is_empty()) {
            if TALKATIVE.contains(&topic.type_name.as_str()) {
                ears.expected.push(topic.name.clone());
            }
            if HEAVY.contains(&topic.type_name.as_str()) {
                let qos = Qos::best_effort(8);
                let made = node.raw_mailbox(&topic.name, &topic.type_name, None, qos);
                ears.heavy.push((topic.type_name, made.unwrap()));
            }
        }
        graph.tap(Box::new(Tap(Arc::clone(&ears.topics))));
        ears
    }

    /// Receives the queued images and clouds; unsubscribes from topics with enough messages.
    pub(crate) fn listen(&mut self) {
        let topics = &self.topics;
        self.heavy.retain(|(type_name, mailbox)| {
            mailbox
                .drain()
                .iter()
                .all(|sample| note(topics, mailbox.topic(), type_name, sample).messages < ENOUGH)
        });
    }

    /// Number of messages, and their problems.
    pub(crate) fn close(mut self) -> (u64, Vec<String>) {
        self.listen();
        let topics = self.topics.lock().unwrap();
        let mut wrong: Vec<String> = topics
            .iter()
            .filter_map(|(name, heard)| Some(format!("{name}: {}", heard.fault.as_ref()?)))
            .collect();
        let silent = self.expected.iter().filter(|name| !topics.contains_key(*name));
        wrong.extend(silent.map(|name| format!("{name}: silent")));
        (topics.values().map(|heard| heard.messages).sum(), wrong)
    }
}

impl Sink for Tap {
    fn wants(&self, topic: &TopicInfo) -> bool {
        !HEAVY.contains(&topic.type_name.as_str())
    }

    fn take(&self, topic: &TopicInfo, sample: &Sample) {
        note(&self.0, &topic.name, &topic.type_name, sample);
    }
}

fn note(topics: &Topics, name: &str, type_name: &str, sample: &Sample) -> Heard {
    let found = fault(type_name, sample);
    let mut topics = topics.lock().unwrap();
    let heard = topics.entry(name.to_owned()).or_default();
    heard.messages += 1;
    heard.fault = heard.fault.take().or(found);
    heard.clone()
}
