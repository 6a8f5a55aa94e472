//! Thread of the transport: keeps the registrations at the master and the endpoints in the graph in sync.

mod parameters;
mod services;
mod topics;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{Graph, Node};
use periplus_transport::{Own, Since, SteadyClock, lock};

use crate::client::MasterClient;
use crate::node::{NodePort, Place};
use crate::outgoing::Lane;
use crate::rpc::RpcError;
use crate::wire::Shared;
use crate::xmlrpc::XmlRpcValue;

use parameters::Parameters;
use services::Services;
use topics::Topics;

/// Period at which changes of the graph are checked, unless something else wakes the thread.
const LOOK: Duration = Duration::from_millis(25);

/// Shortest period at which the master is asked for the registrations of other programs.
const OBSERVE: Duration = Duration::from_millis(800);

/// Period at which the master is asked whether it knows this program.
const CHECK: Duration = Duration::from_secs(2);

pub(crate) struct Link {
    net: Net,
    attached: Option<Attached>,
}

/// State shared by the parts of the link.
pub(crate) struct Net {
    place: Place,
    client: MasterClient,
    shared: Arc<Shared>,
    lane: Lane,
    /// True if the master is in this program and cannot be lost.
    is_master_here: bool,
    said: RefCell<BTreeSet<String>>,
}

/// The attached graph.
struct Attached {
    graph: Graph,
    /// The node that represents all remote programs.
    node: Node,
    generation: Option<u64>,
    ports: Ports,
    topics: Topics,
    services: Services,
    parameters: Parameters,
    steady: SteadyClock,
    checked: Since,
    observed: Since,
}

/// Ports of the nodes by their names in the graph.
pub(crate) type Ports = BTreeMap<String, NodePort>;

impl Net {
    /// Reports a finding once.
    fn say(&self, finding: Diagnostic) {
        if self.said.borrow_mut().insert(finding.message.clone()) {
            self.shared.report(finding);
        }
    }

    /// Reports an error of the graph once.
    fn complain_of_graph(&self, error: &periplus_graph::GraphError) {
        self.say(Diagnostic::warning("wire", format!("ROS 1: {error}")));
    }

    /// Registers or unregisters in the name of a node.
    fn tell_master(&self, method: &str, params: Vec<XmlRpcValue>) -> Option<XmlRpcValue> {
        let result = crate::rpc::ask(self.client.uri(), method, params, Duration::from_secs(3));
        result.map_err(|error| self.lost(&error)).ok()
    }

    fn lost(&self, error: &RpcError) {
        let message = format!("ROS 1: the master does not accept a registration: {error}");
        self.say(Diagnostic::warning("ros1-master", message).help(
            "connections that exist go on; everything is registered again when the master answers",
        ));
    }
}

impl Link {
    pub(crate) fn new(
        place: Place,
        client: MasterClient,
        shared: Arc<Shared>,
        lane: Lane,
        is_master_here: bool,
    ) -> Self {
        let said = RefCell::default();
        let net = Net { place, client, shared, lane, is_master_here, said };
        Self { net, attached: None }
    }

    pub(crate) fn run(mut self) {
        while self.net.shared.sleep(LOOK) {
            if let Some((graph, node)) = lock(&self.net.shared.joining).take() {
                let topics = Topics::default();
                *lock(&self.net.shared.reports) = Some(topics.reporter());
                self.attached = Some(Attached {
                    steady: SteadyClock::new(&graph),
                    graph,
                    node,
                    generation: None,
                    ports: Ports::new(),
                    topics,
                    services: Services::default(),
                    parameters: Parameters::default(),
                    checked: Since::now(),
                    observed: Since::now(),
                });
            }
            if let Some(attached) = &mut self.attached {
                attached.follow(&self.net);
            }
        }
        if let Some(attached) = &mut self.attached {
            attached.leave(&self.net);
        }
    }
}

impl Attached {
    /// Synchronizes the master with the graph, and the graph with what others publish and serve.
    fn follow(&mut self, net: &Net) {
        let generation = self.graph.generation();
        let is_new = self.generation.replace(generation) != Some(generation);
        if is_new {
            let own = Own::of(&self.graph);
            self.topics.sync(net, &mut self.ports, &self.node, &own.topics);
            self.services.sync(net, &mut self.ports, &self.node, &own.services);
            self.drop_idle_ports();
        }
        self.topics.feed(net, &self.ports);
        self.topics.listen(&self.graph, is_new);
        self.topics.look_at_traffic(net);
        self.services.meet(net, &self.node);
        self.services.send_questions(net);
        self.parameters.follow(net, &self.graph);
        self.steady.advance();
        if self.observed.elapsed() >= OBSERVE
            && net.shared.is_observed.swap(false, Ordering::AcqRel)
        {
            self.observed = Since::now();
            self.observe(net);
        }
        if !net.is_master_here && self.checked.elapsed() >= CHECK {
            self.checked = Since::now();
            self.check_master(net);
        }
    }

    /// Notes what other programs have registered.
    fn observe(&self, net: &Net) {
        // A master that does not answer leaves what is known.
        let Ok(state) = net.client.system_state() else { return };
        let own = self.ports.values().map(|port| port.name().to_owned()).collect();
        *lock(&net.shared.remote) = Arc::new(state.without(&own));
    }

    /// Registers everything again at a master that was restarted.
    fn check_master(&mut self, net: &Net) {
        let Some(port) = self.ports.values().next() else { return };
        let known = net.client.node(port.name());
        match known {
            Ok(uri) if uri == port.uri() => return,
            // Another node took the name; the master asked this one to end.
            Ok(_) => return,
            Err(RpcError::Refused(_)) => {}
            Err(error) => return net.lost(&error),
        }
        let message = format!("ROS 1: the master {} was restarted", net.client.uri());
        net.shared.report(
            Diagnostic::warning("ros1-master", message)
                .help("everything is registered there again"),
        );
        self.topics.register_again(net, &self.ports);
        self.services.register_again(net, &self.ports);
        self.parameters = Parameters::default();
    }

    /// Removes the ports of nodes without topics and services.
    fn drop_idle_ports(&mut self) {
        let mut used = self.topics.nodes();
        used.extend(self.services.nodes());
        let idle: Vec<String> =
            self.ports.keys().filter(|name| !used.contains(*name)).cloned().collect();
        for name in idle {
            self.ports.remove(&name);
        }
    }

    /// Unregisters everything.
    fn leave(&mut self, net: &Net) {
        self.topics.leave(net, &self.ports);
        self.services.leave(net, &self.ports);
        self.ports.clear();
    }
}

/// Port of a node, opened when it is needed first.
fn port<'a>(net: &Net, ports: &'a mut Ports, node: &str) -> Option<&'a NodePort> {
    if !ports.contains_key(node) {
        let name = crate::names::node_name(node);
        match NodePort::open(&net.place, &name, net.shared.clone()) {
            Ok(port) => _ = ports.insert(node.to_owned(), port),
            Err(error) => {
                net.say(Diagnostic::warning("wire", error.to_string()));
                return None;
            }
        }
    }
    ports.get(node)
}

/// Addresses in a result of the master.
fn addresses(value: &XmlRpcValue) -> BTreeSet<String> {
    let list = value.list().unwrap_or_default().iter();
    list.filter_map(XmlRpcValue::text).map(str::to_owned).collect()
}
