//! `periplus bridge ros1`: topics and services between ROS 1 and ROS 2, as `dynamic_bridge` of `ros1_bridge` does.
//!
//! Each network has a graph; a relay subscribes in one and publishes in the other. A relay ignores messages of
//! the relay in the other direction, so that no message circulates.

use std::collections::{BTreeMap, BTreeSet};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_graph::{
    Durability, EndpointId, Graph, Node, NodeSettings, Qos, RawClient, RawMailbox, RawPublisher,
};
use periplus_msgs::TypeRegistry;
use periplus_os::{Stopwatch, unix_ns};
use periplus_ros1::{
    SystemState, message_definition, ros1_type, ros2_service_type, ros2_type, service_definition,
};
use periplus_session::{LiveGraph, stop};
use periplus_transport::Bell;

use crate::error::CliError;
use crate::offered_qos::strongest_request;
use crate::terminal;

/// Period at which topics and services are compared.
const COMPARE_PERIOD: Duration = Duration::from_millis(250);

/// Longest sleep while no message arrives.
const LONGEST_SLEEP: Duration = Duration::from_millis(20);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

/// Name of the bridge on both sides.
const NODE: &str = "ros_bridge";

/// Topics that belong to one network.
const NOT_BRIDGED: [&str; 2] = ["/rosout_agg", "/parameter_events"];

/// A network with its graph and the node of the bridge.
struct Side {
    live: LiveGraph,
    node: Node,
    /// Publishers of the bridge.
    own: BTreeSet<EndpointId>,
}

/// A topic from one side to the other.
struct Relay {
    heard: RawMailbox,
    type_name: String,
    /// Created when the publisher and its QoS are known.
    publisher: Option<RawPublisher>,
}

/// Direction: from ROS 1 to ROS 2, or back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Way {
    To2,
    To1,
}

impl Way {
    fn shown(self) -> &'static str {
        match self {
            Self::To2 => "ROS 1 -> ROS 2",
            Self::To1 => "ROS 2 -> ROS 1",
        }
    }
}

struct Bridge {
    one: Side,
    two: Side,
    relays: BTreeMap<(String, Way), Relay>,
    /// Keeps a service in the graph where it is offered.
    services: BTreeMap<(String, Way), periplus_graph::RawCalls>,
    /// Rings when a message has arrived.
    bell: Arc<Bell>,
    is_all: bool,
}

/// Runs until Ctrl-C. `is_all` bridges topics without subscribers, too.
pub(super) fn run(is_all: bool) -> Result<ExitCode, CliError> {
    let stop = stop::on_signal();
    let one = Side::open(LiveGraph::open_ros1(Default::default())?)?;
    let two = Side::open(LiveGraph::open(Default::default())?)?;
    let master = one.live.ros1.as_ref().map(|ros1| ros1.client().uri().to_owned());
    terminal::say(&format!(
        "bridging ROS 1 at {} and ROS 2 in domain {}; Ctrl-C ends it",
        master.unwrap_or_default(),
        two.live.domain_id
    ));
    let (relays, services, bell) = Default::default();
    let mut bridge = Bridge { one, two, relays, services, bell, is_all };
    bridge.spin(&stop)?;
    let Bridge { one, two, .. } = bridge;
    one.live.end(FLUSH_TIMEOUT);
    two.live.end(FLUSH_TIMEOUT);
    Ok(ExitCode::SUCCESS)
}

impl Side {
    fn open(live: LiveGraph) -> Result<Self, CliError> {
        let node = live.graph.node(NodeSettings::new(NODE).bare())?;
        Ok(Self { live, node, own: BTreeSet::new() })
    }
}

impl Bridge {
    fn spin(&mut self, stop: &AtomicBool) -> Result<(), CliError> {
        let mut compared: Option<Stopwatch> = None;
        while !stop.load(Ordering::Relaxed) {
            if compared.as_ref().is_none_or(|since| since.elapsed() >= COMPARE_PERIOD) {
                self.compare()?;
                compared = Some(Stopwatch::start());
            }
            self.forward();
            for side in [&self.one, &self.two] {
                side.live.graph.advance_to(unix_ns());
                side.live.print_findings();
            }
            self.bell.wait(LONGEST_SLEEP);
        }
        Ok(())
    }

    /// Adds and removes relays.
    fn compare(&mut self) -> Result<(), CliError> {
        let Some(ros1) = &self.one.live.ros1 else { return Ok(()) };
        // A master that does not answer changes nothing.
        let Ok(state) = ros1.client().system_state() else { return Ok(()) };
        let state = state.without(&BTreeSet::from([format!("/{NODE}")]));
        let remote = self.two.live.wire.remote();
        let subscribed: BTreeSet<&String> =
            state.subscribers.iter().map(|(name, _)| name).collect();
        let mut wanted: BTreeMap<(String, Way), (String, Qos)> = BTreeMap::new();
        for (name, _) in &state.publishers {
            let is_heard = remote.topic(name).is_some_and(|topic| !topic.subscriptions.is_empty());
            if let Some(of) = type_in(&state, name)
                && (is_heard || self.is_all)
            {
                wanted.insert((name.clone(), Way::To2), (of, Qos::reliable(100)));
            }
        }
        for topic in remote.topics.iter().filter(|topic| !topic.publishers.is_empty()) {
            let Some(of) = topic.type_names.first() else { continue };
            let is_known = ros1_type(of).is_some_and(|of| message_definition(&of).is_some());
            if is_known && (subscribed.contains(&topic.name) || self.is_all) {
                let qos = strongest_request(topic.publishers.iter().map(|one| &one.qos));
                wanted.insert((topic.name.clone(), Way::To1), (of.clone(), qos));
            }
        }
        wanted.retain(|(name, _), _| !NOT_BRIDGED.contains(&name.as_str()));
        let gone: Vec<(String, Way)> =
            self.relays.keys().filter(|key| !wanted.contains_key(*key)).cloned().collect();
        for key in gone {
            self.drop_relay(&key);
        }
        for (key, (of, qos)) in wanted {
            if !self.relays.contains_key(&key) {
                self.add_relay(key, of, qos)?;
            }
        }
        self.offer_services(&state);
        Ok(())
    }

    fn sides(&mut self, way: Way) -> (&Side, &mut Side) {
        match way {
            Way::To2 => (&self.one, &mut self.two),
            Way::To1 => (&self.two, &mut self.one),
        }
    }

    fn add_relay(&mut self, key: (String, Way), of: String, qos: Qos) -> Result<(), CliError> {
        let (name, way) = &key;
        let bell = self.bell.clone();
        let (from, _) = self.sides(*way);
        let hash = TypeRegistry::builtin().hash(&of);
        let heard = from.node.raw_mailbox(name, &of, hash.as_deref(), qos);
        let heard = match heard {
            Ok(heard) => heard,
            Err(error) => {
                terminal::complain(&format!("`{name}` is not bridged: {error}"));
                return Ok(());
            }
        };
        heard.on_message(move || bell.ring());
        terminal::say(&format!("{}: {name} ({of})", way.shown()));
        self.relays.insert(key, Relay { heard, type_name: of, publisher: None });
        Ok(())
    }

    fn drop_relay(&mut self, key: &(String, Way)) {
        let Some(relay) = self.relays.remove(key) else { return };
        let (_, to) = self.sides(key.1);
        if let Some(publisher) = relay.publisher {
            to.own.remove(&publisher.id());
        }
        terminal::say(&format!("{}: {} has ended", key.1.shown(), key.0));
    }

    /// Publishes what has arrived.
    fn forward(&mut self) {
        for ((name, way), relay) in &mut self.relays {
            let (from, to) = match way {
                Way::To2 => (&self.one, &mut self.two),
                Way::To1 => (&self.two, &mut self.one),
            };
            while let Some(sample) = relay.heard.take() {
                if from.own.contains(&sample.publisher) {
                    continue;
                }
                if relay.publisher.is_none() {
                    let qos = offered(&from.live.graph, name, sample.publisher);
                    let hash = TypeRegistry::builtin().hash(&relay.type_name);
                    let made = to.node.raw_publisher(name, &relay.type_name, hash.as_deref(), qos);
                    match made {
                        Ok(publisher) => {
                            to.own.insert(publisher.id());
                            relay.publisher = Some(publisher);
                        }
                        Err(error) => {
                            terminal::complain(&format!("`{name}` is not bridged: {error}"));
                            continue;
                        }
                    }
                }
                // A message that violates its type is dropped.
                if let (Some(publisher), Ok(cdr)) = (&relay.publisher, sample.cdr()) {
                    publisher.publish(cdr.to_vec());
                }
            }
        }
    }

    /// Offers the services of each side on the other.
    fn offer_services(&mut self, state: &SystemState) {
        let mut wanted: BTreeMap<(String, Way), String> = BTreeMap::new();
        for (name, _) in &state.services {
            let key = (name.clone(), Way::To2);
            if self.services.contains_key(&key) {
                // The server states its type once.
                wanted.insert(key, String::new());
            } else if let Some(ros1) = &self.one.live.ros1
                && let Ok(of) = ros1.client().service_type(name)
                && service_definition(&of).is_some()
                && let Some(of) = ros2_service_type(&of)
            {
                wanted.insert(key, of);
            }
        }
        for service in &self.two.live.wire.remote().services {
            let Some(of) = service.type_names.first() else { continue };
            let is_known = ros1_type(of).is_some_and(|of| service_definition(&of).is_some());
            let is_offered = wanted.contains_key(&(service.name.clone(), Way::To2));
            if is_known && !service.servers.is_empty() && !is_offered {
                wanted.insert((service.name.clone(), Way::To1), of.clone());
            }
        }
        self.services.retain(|key, _| wanted.contains_key(key));
        for (key, of) in wanted {
            if self.services.contains_key(&key) {
                continue;
            }
            let (from, to) = self.sides(key.1);
            let client = from.node.raw_client(&key.0, &of, None);
            let Ok(client) = client else { continue };
            if let Some(calls) = relay_service(to, &key.0, &of, client) {
                terminal::say(&format!("{}: service {} ({of})", key.1.shown(), key.0));
                self.services.insert(key, calls);
            }
        }
    }
}

/// Serves a service on one side by calling the other.
fn relay_service(
    to: &Side,
    name: &str,
    of: &str,
    client: RawClient,
) -> Option<periplus_graph::RawCalls> {
    let made = to.node.raw_server_with(name, of, None, move |call| {
        // A call that is dropped gives its caller an error.
        let Ok(cdr) = call.request.cdr().map(<[u8]>::to_vec) else { return };
        client.call(cdr, move |answered| {
            if let Ok(message) = answered
                && let Ok(cdr) = message.cdr()
            {
                call.answer(cdr.to_vec());
            }
        });
    });
    made.map_err(|error| terminal::complain(&format!("`{name}` is not bridged: {error}"))).ok()
}

/// Type in ROS 2 of a topic of ROS 1; none if this program does not know it.
fn type_in(state: &SystemState, topic: &str) -> Option<String> {
    let of = ros2_type(state.topic_types.get(topic)?)?;
    TypeRegistry::builtin().layout(&of).map(|_| of)
}

/// QoS with which a message is published again: retained if it was.
fn offered(graph: &Graph, topic: &str, publisher: EndpointId) -> Qos {
    let topics = graph.topics();
    let topic = topics.iter().find(|one| one.name == topic);
    let ends = topic.into_iter().flat_map(|topic| &topic.publishers);
    let qos = ends.into_iter().find(|end| end.id == publisher).map(|end| end.qos);
    match qos {
        Some(qos) if qos.durability == Durability::TransientLocal => Qos::latched(1),
        _ => Qos::reliable(100),
    }
}
