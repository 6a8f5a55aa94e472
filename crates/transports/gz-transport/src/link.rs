//! Bridge between a graph and Gazebo Transport.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_graph::{EndpointId, Graph, Node, Qos, RawMailbox, TapId, TopicInfo};
use periplus_gz_msgs::bare_name;
use periplus_transport::{is_stand_in, lock, stand_in};

use crate::convert::{Feed, between, gazebo_types, ros_types};
use crate::outgoing::{Ear, Lane, Outgoing, Who};
use crate::{GzSubscription, GzTransportError, Transport};

/// Period at which changes are checked.
const LOOK: Duration = Duration::from_millis(20);

/// Message types of drive commands.
const COMMANDS: [&str; 3] =
    ["geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped", "std_msgs/msg/Float64"];

/// Direction of a bridge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BridgeDirection {
    /// In both directions.
    #[default]
    Both,
    /// From Gazebo to ROS.
    ToRos,
    /// From ROS to Gazebo.
    ToGazebo,
}

/// A bridged pair of topics.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TopicPair {
    /// ROS topic, as written by a node.
    pub ros_topic: String,
    /// Gazebo topic.
    pub gz_topic: String,
    /// ROS type, such as `sensor_msgs/msg/LaserScan`.
    pub ros_type: String,
    /// Gazebo type, such as `gz.msgs.LaserScan`.
    pub gz_type: String,
    /// Direction.
    pub direction: BridgeDirection,
    /// Subscribe in Gazebo only while there are subscribers in ROS.
    pub is_lazy: bool,
    /// Queue depth of the ROS publisher.
    pub publisher_queue: usize,
    /// Queue depth of the ROS subscription.
    pub subscriber_queue: usize,
}

/// Reason for which a pair of topics cannot be bridged.
#[derive(Clone, Debug)]
pub enum TopicPairError {
    /// There is no conversion between the types; the text names alternatives.
    Types(String),
    /// A name is invalid, or the graph refused an endpoint.
    Wire(GzTransportError),
}

impl std::fmt::Display for TopicPairError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Types(words) => f.write_str(words),
            Self::Wire(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for TopicPairError {}

impl<E: Into<GzTransportError>> From<E> for TopicPairError {
    fn from(error: E) -> Self {
        Self::Wire(error.into())
    }
}

/// Bridges between a graph and Gazebo Transport, which exist until this is dropped.
pub struct GzBridge {
    graph: Graph,
    transport: Arc<Transport>,
    inner: Arc<Mutex<Inner>>,
    lane: Lane,
    is_closing: Arc<AtomicBool>,
    threads: Vec<JoinHandle<()>>,
}

#[derive(Default)]
struct Inner {
    bridges: Vec<Bridge>,
    /// Topics bridged automatically, by their names in the graph.
    own: Option<Automatic>,
    findings: Diagnostics,
    said: BTreeSet<String>,
}

/// A bridge for one topic.
struct Bridge {
    out: Option<Out>,
    into: Option<Inward>,
}

struct Out {
    outgoing: Arc<Outgoing>,
    tap: Option<TapId>,
    topic: String,
    /// Makes other transports of the graph subscribe to the topic.
    _heard: Option<RawMailbox>,
}

struct Inward {
    feed: Arc<dyn Feed>,
    gz_topic: String,
    gz_type: String,
    is_lazy: bool,
    subscription: Option<GzSubscription>,
    unsaid: Arc<AtomicBool>,
}

/// Gazebo name of a topic of the graph; none to leave it out.
type Rename = Box<dyn Fn(&str) -> Option<String> + Send>;

/// Automatic bridging.
struct Automatic {
    node: Node,
    rename: Rename,
    generation: Option<u64>,
    bridges: BTreeMap<(String, bool), Bridge>,
}

impl GzBridge {
    /// Creates a link between a graph and a Gazebo transport.
    #[must_use]
    pub fn new(graph: &Graph, transport: &Arc<Transport>) -> Self {
        let inner: Arc<Mutex<Inner>> = Arc::default();
        let is_closing = Arc::new(AtomicBool::new(false));
        let (lane, converting) = Lane::start("gz-convert", Outgoing::send);
        let worker = Worker {
            graph: graph.clone(),
            transport: transport.clone(),
            inner: inner.clone(),
            lane: lane.clone(),
        };
        let closing = is_closing.clone();
        let thread = std::thread::Builder::new().name("gz-link".to_owned());
        let linking = thread.spawn(move || {
            while !closing.load(Ordering::Acquire) {
                worker.follow();
                std::thread::sleep(LOOK);
            }
        });
        let threads = vec![linking.expect("the system starts a thread"), converting];
        let (graph, transport) = (graph.clone(), transport.clone());
        Self { graph, transport, inner, lane, is_closing, threads }
    }

    /// Bridges a topic; `node` publishes and subscribes in the graph.
    ///
    /// # Errors
    /// When there is no conversion between the types, or a name is invalid.
    pub fn bridge(&self, node: &Node, pair: &TopicPair) -> Result<(), TopicPairError> {
        let (ros_type, convert) = between(&pair.ros_type, &pair.gz_type)
            .ok_or_else(|| TopicPairError::Types(no_such_pair(&pair.ros_type, &pair.gz_type)))?;
        let mut bridge = Bridge { out: None, into: None };
        let mut own = BTreeSet::new();
        if pair.direction != BridgeDirection::ToGazebo {
            let qos = Qos::reliable(pair.publisher_queue.max(1));
            let feed: Arc<dyn Feed> = convert.feed(node, &pair.ros_topic, qos)?.into();
            own.insert(feed.id());
            bridge.into = Some(Inward {
                feed,
                gz_topic: pair.gz_topic.clone(),
                gz_type: pair.gz_type.clone(),
                is_lazy: pair.is_lazy,
                subscription: None,
                unsaid: Arc::default(),
            });
        }
        if pair.direction != BridgeDirection::ToRos {
            let qos = Qos::reliable(pair.subscriber_queue.max(1));
            let heard = node.raw_mailbox(&pair.ros_topic, ros_type, None, qos)?;
            let topic = heard.topic().to_owned();
            let publisher = self.transport.advertise(&pair.gz_topic, &pair.gz_type)?;
            let (depth, who) = (pair.subscriber_queue, Who::AllBut(own));
            let outgoing = Outgoing::new(&topic, publisher, convert, depth, who, &self.lane);
            bridge.out = Some(Out { outgoing, tap: None, topic, _heard: Some(heard) });
        }
        lock(&self.inner).bridges.push(bridge);
        Ok(())
    }

    /// Bridges all convertible topics: publishers of the graph are advertised in Gazebo, and
    /// subscriptions of the graph receive from Gazebo. `rename` returns the Gazebo name of a topic;
    /// none leaves it out.
    ///
    /// # Errors
    /// When it is called twice.
    pub fn offer_all(
        &self,
        rename: impl Fn(&str) -> Option<String> + Send + 'static,
    ) -> Result<(), GzTransportError> {
        let node = stand_in(&self.graph, b"gz")?;
        let rename: Rename = Box::new(rename);
        let bridges = BTreeMap::new();
        lock(&self.inner).own = Some(Automatic { node, rename, generation: None, bridges });
        Ok(())
    }

    /// Returns the findings since the last call.
    #[must_use]
    pub fn take_findings(&self) -> Diagnostics {
        std::mem::take(&mut lock(&self.inner).findings)
    }
}

impl Drop for GzBridge {
    fn drop(&mut self) {
        self.is_closing.store(true, Ordering::Release);
        self.lane.end();
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
        let mut inner = lock(&self.inner);
        let automatic = inner.own.take().map(|own| own.bridges.into_values());
        let all = std::mem::take(&mut inner.bridges);
        for mut bridge in all.into_iter().chain(automatic.into_iter().flatten()) {
            bridge.untap(&self.graph);
        }
    }
}

struct Worker {
    graph: Graph,
    transport: Arc<Transport>,
    inner: Arc<Mutex<Inner>>,
    lane: Lane,
}

impl Worker {
    fn follow(&self) {
        let mut inner = lock(&self.inner);
        let Inner { bridges, own, findings, said } = &mut *inner;
        if let Some(own) = own {
            let generation = self.graph.generation();
            if own.generation.replace(generation) != Some(generation) {
                own.sync(self, findings);
            }
        }
        let automatic = own.iter_mut().flat_map(|own| own.bridges.values_mut());
        for bridge in bridges.iter_mut().chain(automatic) {
            bridge.follow(self, findings, said);
        }
    }
}

impl Bridge {
    /// Starts and stops subscriptions on each side according to the subscribers on the other.
    fn follow(&mut self, worker: &Worker, findings: &mut Diagnostics, said: &mut BTreeSet<String>) {
        if let Some(out) = &mut self.out {
            match (out.outgoing.is_heard(), out.tap) {
                (true, None) => {
                    out.tap = Some(worker.graph.tap(Box::new(Ear(out.outgoing.clone()))));
                }
                (false, Some(_)) => untap(&worker.graph, &mut out.tap),
                _ => {}
            }
            if out.outgoing.unsaid() > 0 {
                say(findings, said, &out.topic, "ROS", "Gazebo");
            }
        }
        if let Some(into) = &mut self.into {
            let is_wanted = !into.is_lazy || into.feed.is_heard();
            match (is_wanted, &into.subscription) {
                (true, None) => match into.subscribe(&worker.transport) {
                    Ok(subscription) => into.subscription = Some(subscription),
                    Err(error) => {
                        let finding = Diagnostic::warning("gz-topic", error.to_string());
                        if said.insert(finding.message.clone()) {
                            findings.push(finding);
                        }
                    }
                },
                (false, Some(_)) => into.subscription = None,
                _ => {}
            }
            if into.unsaid.load(Ordering::Relaxed) {
                say(findings, said, &into.gz_topic, "Gazebo", "ROS");
            }
        }
    }

    fn untap(&mut self, graph: &Graph) {
        if let Some(out) = &mut self.out {
            untap(graph, &mut out.tap);
        }
    }
}

fn untap(graph: &Graph, tap: &mut Option<TapId>) {
    if let Some(tap) = tap.take() {
        graph.untap(tap);
    }
}

/// Warns once per topic that messages cannot be converted.
fn say(findings: &mut Diagnostics, said: &mut BTreeSet<String>, topic: &str, a: &str, b: &str) {
    let message = format!(
        "messages on the topic `{topic}` of {a} have another type than declared, are malformed, or \
         have no equivalent in {b}"
    );
    if said.insert(message.clone()) {
        findings.push(Diagnostic::warning("gz-unsaid", message).help(
            "compare the types with `gz topic -i -t` and `ros2 topic info`; for images compare the \
             kinds of pixels",
        ));
    }
}

impl Inward {
    fn subscribe(&self, transport: &Transport) -> Result<GzSubscription, GzTransportError> {
        let (feed, unsaid) = (self.feed.clone(), self.unsaid.clone());
        let wanted = bare_name(&self.gz_type).map(str::to_owned);
        transport.subscribe(&self.gz_topic, &self.gz_type, move |arrival| {
            let is_type = bare_name(arrival.type_name).map(str::to_owned) == wanted;
            if !is_type || !feed.take(arrival.bytes) {
                unsaid.store(true, Ordering::Relaxed);
            }
        })
    }
}

impl Automatic {
    /// Adds bridges for new topics and removes those of old ones.
    fn sync(&mut self, worker: &Worker, findings: &mut Diagnostics) {
        let mut gone: BTreeSet<(String, bool)> = self.bridges.keys().cloned().collect();
        for topic in worker.graph.topics() {
            let own = |ends: &[periplus_graph::EndpointInfo]| -> BTreeSet<EndpointId> {
                ends.iter().filter(|end| !is_stand_in(&end.node)).map(|end| end.id).collect()
            };
            let (publishers, subscriptions) = (own(&topic.publishers), own(&topic.subscriptions));
            for is_out in [true, false] {
                let is_there = if is_out { &publishers } else { &subscriptions };
                // Traffic among nodes of the graph is not bridged, except drive commands.
                let is_command = COMMANDS.contains(&topic.type_name.as_str());
                let is_inner = !is_out && !publishers.is_empty() && !is_command;
                if is_there.is_empty() || is_inner {
                    continue;
                }
                let key = (topic.name.clone(), is_out);
                gone.remove(&key);
                if !self.bridges.contains_key(&key) {
                    match self.make(worker, &topic, is_out) {
                        Ok(Some(bridge)) => _ = self.bridges.insert(key.clone(), bridge),
                        Ok(None) => {}
                        Err(error) => {
                            findings.push(Diagnostic::warning("gz-topic", error.to_string()));
                        }
                    }
                }
                if let Some(Bridge { out: Some(out), .. }) = self.bridges.get(&key) {
                    out.outgoing.set_who(Who::Only(publishers.clone()));
                }
            }
        }
        for key in gone {
            if let Some(mut bridge) = self.bridges.remove(&key) {
                bridge.untap(&worker.graph);
            }
        }
    }

    fn make(
        &self,
        worker: &Worker,
        topic: &TopicInfo,
        is_out: bool,
    ) -> Result<Option<Bridge>, GzTransportError> {
        let Some(gz_topic) = (self.rename)(&topic.name) else { return Ok(None) };
        let Some(bare) = gazebo_types(&topic.type_name).into_iter().next() else { return Ok(None) };
        let gz_type = worker.transport.settings().dialect.full_name(bare);
        let Some((_, convert)) = between(&topic.type_name, &gz_type) else { return Ok(None) };
        if is_out {
            let publisher = worker.transport.advertise(&gz_topic, &gz_type)?;
            let (depth, who) = (10, Who::Only(BTreeSet::new()));
            let outgoing = Outgoing::new(&topic.name, publisher, convert, depth, who, &worker.lane);
            let out = Out { outgoing, tap: None, topic: topic.name.clone(), _heard: None };
            return Ok(Some(Bridge { out: Some(out), into: None }));
        }
        let feed = convert.feed(&self.node, &topic.name, Qos::reliable(10))?.into();
        let (is_lazy, unsaid) = (false, Arc::default());
        let into = Inward { feed, gz_topic, gz_type, is_lazy, subscription: None, unsaid };
        Ok(Some(Bridge { out: None, into: Some(into) }))
    }
}

/// Error text for two types without conversion, with alternatives.
fn no_such_pair(ros: &str, gazebo: &str) -> String {
    let (there, here) = (gazebo_types(ros), ros_types(gazebo));
    let words = match (there.as_slice(), here.as_slice()) {
        ([], []) => "neither type is bridged".to_owned(),
        ([], here) => format!("{gazebo} is {}", here.join(" or ")),
        (there, _) => {
            let near = closest(bare_name(gazebo).unwrap_or(gazebo), there.iter().copied());
            let near = near.unwrap_or(there[0]);
            format!("{ros} is bridged to gz.msgs.{near}")
        }
    };
    format!("there is no conversion between {ros} and {gazebo}: {words}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_names_the_wrong_type_is_told_the_right_one() {
        assert_eq!(
            no_such_pair("sensor_msgs/msg/LaserScan", "gz.msgs.LaserScam"),
            "there is no conversion between sensor_msgs/msg/LaserScan and gz.msgs.LaserScam: \
             sensor_msgs/msg/LaserScan is bridged to gz.msgs.LaserScan"
        );
        let words = no_such_pair("sensor_msgs/msg/Range", "gz.msgs.IMU");
        assert!(words.ends_with("gz.msgs.IMU is sensor_msgs/msg/Imu"), "{words}");
    }
}
