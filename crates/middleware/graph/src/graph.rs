//! The handle of a graph.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, Weak};

use periplus_diagnostics::Diagnostics;
use periplus_msgs::rcl_interfaces::ParameterValue;

use crate::agenda::Agenda;
use crate::arguments::Arguments;
use crate::common::{Common, lock};
use crate::info::{NodeInfo, ServiceInfo, TopicInfo, Traffic};
use crate::live::Live;
use crate::node::{Node, NodeCore};
use crate::registry::Registry;
use crate::settings::NodeSettings;
use crate::tap::{Sink, TapId};
use crate::{EndpointId, GraphError, Qos, executor, live};

/// A graph of nodes. This is a handle: clones mean the same graph. There can be several graphs in
/// one program, and they know nothing of each other.
#[derive(Clone, Default)]
pub struct Graph(pub(crate) Arc<Core>);

#[derive(Default)]
pub(crate) struct Core {
    pub(crate) common: Arc<Common>,
    pub(crate) registry: Mutex<Registry>,
    /// What is to happen, in lockstep.
    pub(crate) agenda: Arc<Agenda>,
    /// Held while time moves.
    pub(crate) turn: Mutex<executor::Turn>,
    /// The threads, in live.
    pub(crate) live: Option<Live>,
    /// What holds for all nodes to come.
    arguments: Mutex<Arc<Arguments>>,
}

impl Drop for Core {
    fn drop(&mut self) {
        for tap in &lock(&self.registry).taps {
            tap.close();
        }
    }
}

impl Graph {
    /// An empty graph in lockstep, at time 0.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// An empty graph in live, at time 0: every [`crate::Actor`]'s node and every tap has a thread
    /// of its own, and [`Graph::advance_to`] only tells the time. Who is slow loses messages by its
    /// QoS and holds up nobody.
    #[must_use]
    pub fn live() -> Self {
        let mut core = Core::default();
        core.live = Some(Live::default());
        Self(Arc::new(core))
    }

    /// Whether nodes have threads of their own.
    #[must_use]
    pub fn is_live(&self) -> bool {
        self.0.live.is_some()
    }

    /// The time of the graph \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.0.common.clock.now_ns()
    }

    /// Makes a node.
    ///
    /// # Errors
    /// When a name or remapping is not valid, or the graph has a node of this name.
    pub fn node(&self, settings: NodeSettings) -> Result<Node, GraphError> {
        Node::new(self, settings)
    }

    /// Names, parameters and log levels for all nodes to come, as `--ros-args` gives them to a
    /// program. What [`NodeSettings`] says of a node comes first.
    pub fn set_arguments(&self, arguments: Arguments) {
        *lock(&self.0.arguments) = Arc::new(arguments);
    }

    /// Parameters that the arguments of this program give a node of a full name.
    #[must_use]
    pub fn parameters_given_to(&self, full_name: &str) -> BTreeMap<String, ParameterValue> {
        self.arguments().parameters_of(full_name)
    }

    /// What the arguments say that no node has use for: patterns that fit none, and parameters that
    /// none of those declares. `use_sim_time` is every node's.
    #[must_use]
    pub fn unused_arguments(&self) -> Diagnostics {
        let nodes: Vec<Weak<NodeCore>> = lock(&self.0.registry).nodes.values().cloned().collect();
        let nodes: Vec<Arc<NodeCore>> = nodes.iter().filter_map(Weak::upgrade).collect();
        let names: Vec<&str> = nodes.iter().map(|node| &*node.full_name).collect();
        self.arguments().unused(&names, &|node, parameter| {
            nodes[node].standard.get().is_some_and(|own| lock(&own.store).has(parameter))
        })
    }

    pub(crate) fn arguments(&self) -> Arc<Arguments> {
        lock(&self.0.arguments).clone()
    }

    /// Adds a tap. It sees the chosen topics, those that are there and those to come, and gets what
    /// latched topics hold.
    pub fn tap(&self, sink: Box<dyn Sink>) -> TapId {
        let is_live = self.is_live();
        let tap = lock(&self.0.registry).add_tap(sink, is_live, &self.0.common);
        if tap.has_thread() {
            let (tap, common) = (tap.clone(), self.0.common.clone());
            live::spawn("tap", move || tap.feed(&common));
        }
        tap.flush();
        tap.id
    }

    /// Ends a tap: its sink is dropped when its last message is taken.
    pub fn untap(&self, id: TapId) {
        let gone = lock(&self.0.registry).remove_tap(id, &self.0.common);
        if let Some(tap) = gone {
            tap.close();
        }
    }

    /// How many messages a tap lost because its sink is too slow; always 0 in lockstep.
    #[must_use]
    pub fn tap_dropped(&self, id: TapId) -> u64 {
        let registry = lock(&self.0.registry);
        registry.taps.iter().find(|tap| tap.id == id).map_or(0, |tap| tap.dropped())
    }

    /// Lets time go on to `time_ns`. Everything that is due by then happens, in the order of time,
    /// node, topic and number of the message; what that sets off happens before time moves on.
    /// A time before now is a jump back, as [`Graph::jump_to`].
    ///
    /// While the graph is paused, time stands still, and what is due now happens.
    ///
    /// In live the clock is set, and nodes for which something is due are woken.
    pub fn advance_to(&self, time_ns: i64) {
        executor::advance(&self.0, time_ns);
    }

    /// Time of the first event that is planned \[ns\], such as the next turn of a timer; none where there
    /// is none. A program that lets time pass can sleep until then.
    #[must_use]
    pub fn next_due_ns(&self) -> Option<i64> {
        match &self.0.live {
            Some(live) => live.first_ns(),
            None => self.0.agenda.first_ns(),
        }
    }

    /// Lets everything happen that is due now, without moving time.
    pub fn settle(&self) {
        executor::advance(&self.0, self.now_ns());
    }

    /// Sets the clock, back (a reset) or forward, without letting the time between pass. What is due
    /// happens before; timers start anew.
    pub fn jump_to(&self, time_ns: i64) {
        executor::jump(&self.0, time_ns);
    }

    /// Stops time, or lets it go on.
    pub fn set_paused(&self, is_paused: bool) {
        self.0.common.clock.set_paused(is_paused);
    }

    /// Whether the time that it is told is that of a simulation (so it is at first) or that of the
    /// machine. It is what the parameter `use_sim_time` of all nodes says.
    pub fn set_simulated_time(&self, is_simulated: bool) {
        self.0.common.clock.set_simulated(is_simulated);
    }

    /// Whether time stands still.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.0.common.clock.is_paused()
    }

    /// Another bound than [`crate::MOST_REACTIONS`] for what may happen without time moving.
    pub fn limit_reactions(&self, most: u64) {
        lock(&self.0.turn).most = Some(most);
    }

    /// What was wrong since the last call: QoS that do not fit, messages that cannot be read,
    /// reactions without end.
    #[must_use]
    pub fn take_findings(&self) -> Diagnostics {
        self.0.common.take_findings()
    }

    /// Changes whenever a node, publisher, subscription, server or client comes or goes; a wire
    /// looks at it to know when to look at the rest.
    #[must_use]
    pub fn generation(&self) -> u64 {
        lock(&self.0.registry).changes
    }

    /// Makes a publisher offer, or a subscription ask for, something else than it was made with: who
    /// did not fit before may hear from now on. What its node believes of it stays. False where there
    /// is no such end.
    pub fn set_qos(&self, end: EndpointId, qos: Qos) -> bool {
        lock(&self.0.registry).set_qos(end, qos, &self.0.common)
    }

    /// The topics that somebody publishes or subscribes to, by name.
    #[must_use]
    pub fn topics(&self) -> Vec<TopicInfo> {
        lock(&self.0.registry).topic_infos()
    }

    /// The services that somebody answers or calls, by name.
    #[must_use]
    pub fn services(&self) -> Vec<ServiceInfo> {
        lock(&self.0.registry).service_infos()
    }

    /// The nodes, by name.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeInfo> {
        let registry = lock(&self.0.registry);
        let (topics, services) = (registry.topic_infos(), registry.service_infos());
        let info = |name: &Arc<str>| {
            let mine = |node: &String| **node == **name;
            let topic_names = |uses: &dyn Fn(&TopicInfo) -> bool| {
                topics.iter().filter(|topic| uses(topic)).map(|topic| topic.name.clone()).collect()
            };
            let service_names = |uses: &dyn Fn(&ServiceInfo) -> bool| {
                services.iter().filter(|one| uses(one)).map(|one| one.name.clone()).collect()
            };
            NodeInfo {
                name: name.to_string(),
                publishes: topic_names(&|topic| topic.publishers.iter().any(|end| mine(&end.node))),
                subscribes: topic_names(&|topic| {
                    topic.subscriptions.iter().any(|end| mine(&end.node))
                }),
                serves: service_names(&|service| service.server.as_ref().is_some_and(mine)),
                calls: service_names(&|service| service.clients.iter().any(mine)),
            }
        };
        registry.nodes.keys().map(info).collect()
    }

    /// What went through the topics so far, by name.
    #[must_use]
    pub fn traffic(&self) -> Vec<Traffic> {
        lock(&self.0.registry).traffic(self.now_ns())
    }
}

impl std::fmt::Debug for Graph {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Graph").field("now_ns", &self.now_ns()).finish_non_exhaustive()
    }
}
