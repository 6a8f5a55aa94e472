//! Handle of a graph.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, Weak};

use periplus_diagnostics::Diagnostics;
use periplus_msgs::rcl_interfaces::{Parameter, ParameterValue};

use crate::arguments::Arguments;
use crate::common::{Common, lock};
use crate::event_queue::EventQueue;
use crate::info::{NodeInfo, ServiceInfo, TopicInfo, Traffic};
use crate::interceptor::Interceptor;
use crate::live::Live;
use crate::node::{Node, NodeCore};
use crate::parallel::{self, ParallelNamespace, Workers};
use crate::parameters::ParameterRejection;
use crate::registry::{Registry, TopicEntry};
use crate::settings::NodeSettings;
use crate::tap::{Sink, TapId};
use crate::{EndpointId, GraphError, Qos, executor, live};

/// A graph of nodes. This is a handle: clones refer to the same graph. One program can have several
/// independent graphs.
#[derive(Clone, Default)]
pub struct Graph(pub(crate) Arc<Core>);

#[derive(Default)]
pub(crate) struct Core {
    pub(crate) common: Arc<Common>,
    pub(crate) registry: Mutex<Registry>,
    /// The event queue, in lockstep.
    pub(crate) event_queue: Arc<EventQueue>,
    /// Locked while time advances.
    pub(crate) turn: Mutex<executor::Turn>,
    /// The threads, in live mode.
    pub(crate) live: Option<Live>,
    /// Arguments for all nodes to come.
    arguments: Mutex<Arc<Arguments>>,
}

impl Core {
    /// Namespaces whose nodes run beside those of others.
    pub(crate) fn namespaces(&self) -> Arc<[Arc<ParallelNamespace>]> {
        lock(&self.registry).namespaces.clone()
    }

    /// Time of the first event of these namespaces and of the nodes elsewhere \[ns\].
    pub(crate) fn first_ns(&self, namespaces: &[Arc<ParallelNamespace>]) -> Option<i64> {
        let queues = namespaces.iter().map(|it| &it.event_queue);
        queues.chain([&self.event_queue]).filter_map(|it| it.first_ns()).min()
    }
}

impl Drop for Core {
    fn drop(&mut self) {
        for tap in &lock(&self.registry).taps {
            tap.close();
        }
    }
}

impl Graph {
    /// Creates an empty graph in lockstep, at time 0.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Creates an empty graph in live mode, at time 0: the node of every [`crate::Actor`] and every
    /// tap has its own thread, and [`Graph::advance_to`] only sets the clock. A slow subscriber
    /// loses messages according to its QoS and blocks no other node.
    #[must_use]
    pub fn live() -> Self {
        let mut core = Core::default();
        core.live = Some(Live::default());
        Self(Arc::new(core))
    }

    /// True in live mode, where nodes have their own threads.
    #[must_use]
    pub fn is_live(&self) -> bool {
        self.0.live.is_some()
    }

    /// The time of the graph \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.0.common.clock.now_ns()
    }

    /// Creates a node.
    ///
    /// # Errors
    /// When a name or remapping is not valid, or the graph has a node of this name.
    pub fn node(&self, settings: NodeSettings) -> Result<Node, GraphError> {
        Node::new(self, settings)
    }

    /// Sets names, parameters and log levels for all nodes to come, as from `--ros-args`.
    /// [`NodeSettings`] of a node take precedence.
    pub fn set_arguments(&self, arguments: Arguments) {
        *lock(&self.0.arguments) = Arc::new(arguments);
    }

    /// Parameters that the arguments of this program give to a node by its full name.
    #[must_use]
    pub fn parameters_given_to(&self, full_name: &str) -> BTreeMap<String, ParameterValue> {
        self.arguments().parameters_of(full_name)
    }

    /// Warnings about arguments that no node uses: patterns that match no node, and parameters that
    /// none of the matched nodes declares. Every node has `use_sim_time`.
    #[must_use]
    pub fn unused_arguments(&self) -> Diagnostics {
        let nodes = self.living_nodes();
        let names: Vec<&str> = nodes.iter().map(|node| &*node.full_name).collect();
        self.arguments().unused(&names, &|node, parameter| {
            nodes[node].standard.get().is_some_and(|own| lock(&own.store).uses(parameter))
        })
    }

    /// Parameters of all nodes with their values, by the full names of the nodes.
    #[must_use]
    pub fn parameters(&self) -> Vec<(String, Vec<Parameter>)> {
        let nodes = self.living_nodes();
        let of = |node: &Arc<NodeCore>| {
            let own = node.standard.get().map(|own| lock(&own.store).all());
            (node.full_name.to_string(), own.unwrap_or_default())
        };
        nodes.iter().map(of).collect()
    }

    /// Checks a value for a parameter, without setting it.
    ///
    /// # Errors
    /// The reason: no such node or parameter, another type, or a value out of its range.
    pub fn check_parameter(
        &self,
        node: &str,
        parameter: Parameter,
    ) -> Result<(), ParameterRejection> {
        let nodes = self.living_nodes();
        let found = nodes.iter().find(|it| *it.full_name == *node);
        let own = found.and_then(|node| node.standard.get());
        let missing = || ParameterRejection::new(format!("there is no node `{node}`"));
        let own = own.ok_or_else(missing)?;
        let proposed = lock(&own.store).propose(std::slice::from_ref(&parameter));
        proposed.map(drop).map_err(ParameterRejection::new)
    }

    fn living_nodes(&self) -> Vec<Arc<NodeCore>> {
        let nodes: Vec<Weak<NodeCore>> = lock(&self.0.registry).nodes.values().cloned().collect();
        nodes.iter().filter_map(Weak::upgrade).collect()
    }

    /// Names, parameters and log levels for all nodes.
    #[must_use]
    pub fn arguments(&self) -> Arc<Arguments> {
        lock(&self.0.arguments).clone()
    }

    /// Adds a tap. It sees the chosen topics, present and future, and first gets the retained
    /// messages of latched topics.
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

    /// Removes a tap: its sink is dropped after its last message.
    pub fn untap(&self, id: TapId) {
        let gone = lock(&self.0.registry).remove_tap(id, &self.0.common);
        if let Some(tap) = gone {
            tap.close();
        }
    }

    /// Sets the interceptor of published messages, or removes it. It sees the topics that it wants, present and
    /// future. Call this again with the same interceptor when its choice of topics has changed.
    pub fn set_interceptor(&self, interceptor: Option<Arc<dyn Interceptor>>) {
        lock(&self.0.registry).set_interceptor(interceptor, &self.0.common);
    }

    /// Number of messages that a tap lost because its sink is too slow; always 0 in lockstep.
    #[must_use]
    pub fn tap_dropped(&self, id: TapId) -> u64 {
        let registry = lock(&self.0.registry);
        registry.taps.iter().find(|tap| tap.id == id).map_or(0, |tap| tap.dropped())
    }

    /// Advances time to `time_ns`. Everything that is due until then is executed in the order of
    /// time, node, topic and sequence number; the reactions at one time are executed before time
    /// advances. An earlier time is a jump back, as [`Graph::jump_to`].
    ///
    /// While the graph is paused, time does not advance, but what is due now is executed.
    ///
    /// In live mode this sets the clock and wakes the nodes with due events.
    pub fn advance_to(&self, time_ns: i64) {
        executor::advance(&self.0, time_ns);
    }

    /// Time of the next scheduled event \[ns\], such as a timer; none if there is none. A program
    /// that advances time can sleep until then.
    #[must_use]
    pub fn next_due_ns(&self) -> Option<i64> {
        match &self.0.live {
            Some(live) => live.first_ns(),
            None => self.0.first_ns(&self.0.namespaces()),
        }
    }

    /// Executes everything that is due now, without advancing time.
    pub fn settle(&self) {
        executor::advance(&self.0, self.now_ns());
    }

    /// Sets the clock, backward (a reset) or forward, without executing the time between. What is
    /// due now is executed first; timers restart.
    pub fn jump_to(&self, time_ns: i64) {
        executor::jump(&self.0, time_ns);
    }

    /// Pauses or resumes time.
    pub fn set_paused(&self, is_paused: bool) {
        self.0.common.clock.set_paused(is_paused);
    }

    /// Sets the source of time: a simulation (default) or the system clock. The parameter
    /// `use_sim_time` of all nodes reports it.
    pub fn set_simulated_time(&self, is_simulated: bool) {
        self.0.common.clock.set_simulated(is_simulated);
    }

    /// True while time is paused.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.0.common.clock.is_paused()
    }

    /// Lets the nodes in each of these namespaces run at the same time as those in the others, on `threads` threads, in
    /// lockstep. Such nodes may share state only with nodes in their namespace; messages and requests may go anywhere.
    ///
    /// The order of events does not depend on the number of threads: at one time, first the nodes elsewhere run, then
    /// each of these namespaces, and then what they did beyond themselves happens, in the order of their names.
    ///
    /// Set this before the nodes, topics and services of these namespaces are created: those that exist stay outside.
    pub fn run_in_parallel(&self, namespaces: &[String], threads: usize) {
        let namespaces = ParallelNamespace::all(namespaces);
        // The thread that advances time is one of them, and each namespace runs on one at a time.
        let helpers = threads.min(namespaces.len()).saturating_sub(1);
        lock(&self.0.registry).namespaces = namespaces;
        lock(&self.0.turn).workers = Workers::new(helpers);
    }

    /// Runs work of several namespaces, given by their full names: that in namespaces of [`Graph::run_in_parallel`] at the
    /// same time as their nodes would run, on as many threads unless `is_short`, and what else there is before. The order
    /// of what others see does not depend on the number of threads.
    pub fn run_beside<T: Send>(
        &self,
        work: Vec<(&str, T)>,
        is_short: bool,
        act: impl Fn(T) + Sync,
    ) {
        let threads = if is_short { 1 } else { lock(&self.0.turn).workers.threads() + 1 };
        parallel::run_work(&self.0.namespaces(), &self.0.common, threads, work, &act);
    }

    /// Replaces the limit [`crate::MAX_REACTIONS`] of events without progress of time.
    pub fn limit_reactions(&self, most: u64) {
        lock(&self.0.turn).most = Some(most);
    }

    /// Returns the findings since the last call: incompatible QoS, messages that cannot be decoded,
    /// endless loops of reactions.
    #[must_use]
    pub fn take_findings(&self) -> Diagnostics {
        self.0.common.take_findings()
    }

    /// Counter that changes when a node, publisher, subscription, server or client is added or
    /// removed; transports check it before they compare the rest.
    #[must_use]
    pub fn generation(&self) -> u64 {
        lock(&self.0.registry).changes
    }

    /// Changes the QoS of a publisher or subscription; endpoints that were incompatible before may
    /// connect now. The node still sees the QoS that it requested. False if there is no such
    /// endpoint.
    pub fn set_qos(&self, end: EndpointId, qos: Qos) -> bool {
        lock(&self.0.registry).set_qos(end, qos, &self.0.common)
    }

    /// Topics with a publisher or subscription, by name.
    #[must_use]
    pub fn topics(&self) -> Vec<TopicInfo> {
        lock(&self.0.registry).topic_infos()
    }

    /// True if a topic of this full name has a subscription.
    #[must_use]
    pub fn is_subscribed(&self, topic: &str) -> bool {
        lock(&self.0.registry).topics.get(topic).is_some_and(TopicEntry::is_subscribed)
    }

    /// Services with a server or client, by name.
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

    /// Message counts of all topics, by name.
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
