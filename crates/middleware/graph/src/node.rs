//! Nodes: what publishes, subscribes, answers and calls.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, Weak};

use periplus_msgs::{Message, Service};

use crate::actor::Actor;
use crate::agenda::Agenda;
use crate::common::lock;
use crate::graph::{Core, Graph};
use crate::inlet::{Inlet, Reaction, Waiting};
use crate::mailbox::{Mailbox, RawMailbox};
use crate::outlet::Outlet;
use crate::parameters::Store;
use crate::publisher::{Publisher, RawPublisher};
use crate::registry::TypeOf;
use crate::service::{Calls, Client};
use crate::settings::{NodeNames, NodeSettings};
use crate::standard::Standard;
use crate::{GraphError, Qos};

/// A node. This is a handle: clones mean the same node. It is there as long as a handle of it, or
/// anything made with it, is.
#[derive(Clone)]
pub struct Node(pub(crate) Arc<NodeCore>);

pub(crate) struct NodeCore {
    pub(crate) names: NodeNames,
    pub(crate) full_name: Arc<str>,
    pub(crate) core: Arc<Core>,
    /// Counts what it made, to tell equal things apart.
    ordinal: AtomicU64,
    /// What is to happen in its thread, in live.
    own_agenda: OnceLock<Arc<Agenda>>,
    pub(crate) standard: OnceLock<Standard>,
}

impl Node {
    pub(crate) fn new(graph: &Graph, settings: NodeSettings) -> Result<Self, GraphError> {
        let arguments = graph.arguments();
        let (any, is_bare) = (settings.takes_any_parameter(), settings.is_bare());
        let (names, own) = settings.resolve(&arguments)?;
        let full_name: Arc<str> = names.full_name().into();
        let mut given = arguments.parameters_of(&full_name);
        given.extend(own);

        let mut registry = lock(&graph.0.registry);
        if registry.nodes.contains_key(&full_name) {
            return Err(GraphError::NodeExists { node: full_name.to_string() });
        }
        // Taken from now on; the node itself follows.
        registry.nodes.insert(full_name.clone(), Weak::new());
        registry.changes += 1;
        drop(registry);
        let core = graph.0.clone();
        let store = Store::new(full_name.clone(), core.common.clone(), given, any);
        let node = Arc::new(NodeCore {
            names,
            full_name,
            core,
            ordinal: 0.into(),
            own_agenda: OnceLock::new(),
            standard: OnceLock::new(),
        });
        Standard::join(&node, store, is_bare, &arguments)?;
        let itself = Arc::downgrade(&node);
        lock(&graph.0.registry).nodes.insert(node.full_name.clone(), itself);
        Ok(Self(node))
    }

    /// Namespace and name, such as `/demo/scan`.
    #[must_use]
    pub fn full_name(&self) -> &str {
        &self.0.full_name
    }

    /// Its names, to resolve others.
    #[must_use]
    pub fn names(&self) -> &NodeNames {
        &self.0.names
    }

    /// The graph that it belongs to.
    #[must_use]
    pub fn graph(&self) -> Graph {
        Graph(self.0.core.clone())
    }

    /// The time of the graph \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.0.core.common.clock.now_ns()
    }

    /// Publishes on a topic.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn publisher<T: Message>(&self, topic: &str, qos: Qos) -> Result<Publisher<T>, GraphError> {
        Ok(Publisher::new(self.0.outlet(topic, TypeOf::message::<T>(), qos)?))
    }

    /// Subscribes to a topic; the messages wait until somebody looks.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn mailbox<T: Message>(&self, topic: &str, qos: Qos) -> Result<Mailbox<T>, GraphError> {
        Ok(Mailbox::new(self.0.inlet(topic, TypeOf::message::<T>(), qos, None)?))
    }

    /// Publishes bytes on a topic whose type is known only by name and, perhaps, by its hash.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn raw_publisher(
        &self,
        topic: &str,
        type_name: &str,
        type_hash: Option<&str>,
        qos: Qos,
    ) -> Result<RawPublisher, GraphError> {
        Ok(RawPublisher::new(self.0.outlet(topic, TypeOf::new(type_name, type_hash), qos)?))
    }

    /// Subscribes to a topic whose type is known only by name and, perhaps, by its hash.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn raw_mailbox(
        &self,
        topic: &str,
        type_name: &str,
        type_hash: Option<&str>,
        qos: Qos,
    ) -> Result<RawMailbox, GraphError> {
        let type_of = TypeOf::new(type_name, type_hash);
        Ok(RawMailbox::new(self.0.inlet(topic, type_of, qos, None)?))
    }

    /// Answers a service; the calls wait until somebody looks.
    ///
    /// # Errors
    /// When the name is not valid, the service has another type, or another node answers it.
    pub fn server<S: Service>(&self, name: &str) -> Result<Calls<S>, GraphError> {
        Ok(Calls::new(self.0.server(name, TypeOf::service::<S>(), None)?))
    }

    /// Calls a service. Who answers it may come later.
    ///
    /// # Errors
    /// When the name is not valid or the service has another type.
    pub fn client<S: Service>(&self, name: &str) -> Result<Client<S>, GraphError> {
        Ok(Client::new(self.0.caller(name, TypeOf::service::<S>())?))
    }

    /// Gives the node a state and lets closures act on it: for messages, timers and calls.
    pub fn actor<S: Send + 'static>(&self, state: S) -> Actor<S> {
        Actor::new(self.clone(), state)
    }
}

impl std::fmt::Debug for Node {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Node").field(&self.full_name()).finish()
    }
}

impl Drop for NodeCore {
    fn drop(&mut self) {
        let mut registry = lock(&self.core.registry);
        registry.nodes.remove(&self.full_name);
        registry.changes += 1;
        drop(registry);
        if let Some(standard) = self.standard.get() {
            standard.leave(&self.core);
        }
        if let Some(agenda) = self.own_agenda.get() {
            agenda.close();
        }
    }
}

impl TypeOf {
    pub(crate) fn new(name: &str, hash: Option<&str>) -> Self {
        Self { name: name.to_owned(), hash: hash.map(str::to_owned) }
    }

    pub(crate) fn message<T: Message>() -> Self {
        Self { name: T::TYPE_NAME.into(), hash: Some(T::TYPE_HASH.into()) }
    }

    pub(crate) fn service<S: Service>() -> Self {
        Self { name: S::TYPE_NAME.into(), hash: Some(S::TYPE_HASH.into()) }
    }
}

/// An outlet that leaves the graph when it is dropped.
pub(crate) struct OwnOutlet {
    pub(crate) outlet: Arc<Outlet>,
    pub(crate) node: Arc<NodeCore>,
}

impl Drop for OwnOutlet {
    fn drop(&mut self) {
        let core = &self.node.core;
        let gone = lock(&core.registry).remove_outlet(&self.outlet, &core.common);
        drop(gone);
    }
}

/// An inlet that leaves the graph when it is dropped.
pub(crate) struct OwnInlet {
    pub(crate) inlet: Arc<Inlet>,
    pub(crate) node: Arc<NodeCore>,
}

impl Drop for OwnInlet {
    fn drop(&mut self) {
        let core = &self.node.core;
        let gone = lock(&core.registry).remove_inlet(&self.inlet, &core.common);
        drop(gone);
        self.inlet.withdraw();
    }
}

impl NodeCore {
    /// Where its reactions are put: in lockstep the one agenda of the graph, in live its own, whose
    /// thread starts with the first.
    pub(crate) fn agenda(&self) -> Arc<Agenda> {
        let Some(live) = &self.core.live else { return self.core.agenda.clone() };
        let start = || live.start(&self.full_name, &self.core.common);
        self.own_agenda.get_or_init(start).clone()
    }

    pub(crate) fn next_ordinal(&self) -> u64 {
        self.ordinal.fetch_add(1, Ordering::Relaxed)
    }

    pub(crate) fn standard(&self) -> &Standard {
        self.standard.get().expect("a node has it before anybody else has the node")
    }

    pub(crate) fn outlet(
        self: &Arc<Self>,
        topic: &str,
        type_of: TypeOf,
        qos: Qos,
    ) -> Result<OwnOutlet, GraphError> {
        Ok(OwnOutlet { outlet: self.bare_outlet(topic, type_of, qos)?, node: self.clone() })
    }

    /// An outlet that somebody has to take out of the graph.
    pub(crate) fn bare_outlet(
        &self,
        topic: &str,
        type_of: TypeOf,
        qos: Qos,
    ) -> Result<Arc<Outlet>, GraphError> {
        let full = self.names.topic(topic)?;
        let (core, node) = (&self.core, self.full_name.clone());
        let common = core.common.clone();
        lock(&core.registry).add_outlet(
            &self.full_name,
            &full,
            type_of,
            |id, topic| Outlet::new(id, node, topic, qos, common),
            &core.common,
        )
    }

    pub(crate) fn inlet(
        self: &Arc<Self>,
        topic: &str,
        type_of: TypeOf,
        qos: Qos,
        reaction: Option<Reaction>,
    ) -> Result<OwnInlet, GraphError> {
        let full = self.names.topic(topic)?;
        let (core, node) = (&self.core, self.full_name.clone());
        let common = core.common.clone();
        let make = |id, topic| Inlet {
            id,
            node,
            topic,
            common,
            reaction,
            waiting: Mutex::new(Waiting::new(qos)),
            told: Default::default(),
        };
        let inlet =
            lock(&core.registry).add_inlet(&self.full_name, &full, type_of, make, &core.common)?;
        Ok(OwnInlet { inlet, node: self.clone() })
    }
}
