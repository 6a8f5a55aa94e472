//! Nodes.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, Weak};

use periplus_msgs::{Message, Service};

use crate::actor::Actor;
use crate::common::lock;
use crate::event_queue::EventQueue;
use crate::graph::{Core, Graph};
use crate::lifecycle::LifecycleCore;
use crate::mailbox::{Mailbox, RawMailbox};
use crate::parallel::ParallelNamespace;
use crate::parameters::Store;
use crate::publisher::{Publisher, RawPublisher};
use crate::publisher_core::PublisherCore;
use crate::registry::TypeOf;
use crate::service::{Calls, Client};
use crate::settings::{NodeNames, NodeSettings};
use crate::standard::Standard;
use crate::subscription_core::{Reaction, SubscriptionCore, Waiting};
use crate::{GraphError, Qos};

/// A node. This is a handle: clones refer to the same node. The node exists until all handles and
/// everything created with it are dropped.
#[derive(Clone)]
pub struct Node(pub(crate) Arc<NodeCore>);

pub(crate) struct NodeCore {
    pub(crate) names: NodeNames,
    pub(crate) full_name: Arc<str>,
    pub(crate) core: Arc<Core>,
    /// Counter that distinguishes otherwise equal endpoints.
    ordinal: AtomicU64,
    /// The namespace that runs beside others, in lockstep.
    pub(crate) namespace: Option<Arc<ParallelNamespace>>,
    /// Event queue of its thread, in live mode.
    own_event_queue: OnceLock<Arc<EventQueue>>,
    pub(crate) standard: OnceLock<Standard>,
    /// Lifecycle of a managed node.
    pub(crate) lifecycle: OnceLock<Weak<LifecycleCore>>,
}

impl Node {
    pub(crate) fn new(graph: &Graph, settings: NodeSettings) -> Result<Self, GraphError> {
        let arguments = graph.arguments();
        let (any, is_bare) = (settings.takes_any_parameter(), settings.is_bare());
        let is_shared = settings.shares_name();
        let read = settings.read_parameters();
        let (names, own) = settings.resolve(&arguments)?;
        let full_name: Arc<str> = names.full_name().into();
        let mut given = arguments.parameters_of(&full_name);
        given.extend(own);

        let mut registry = lock(&graph.0.registry);
        let is_taken = registry.nodes.contains_key(&full_name);
        if is_taken && !is_shared {
            return Err(GraphError::NodeExists { node: full_name.to_string() });
        }
        if !is_taken {
            // The name is reserved now; the node itself is added below.
            registry.nodes.insert(full_name.clone(), Weak::new());
        }
        registry.changes += 1;
        let namespace = registry.namespace_of(&full_name);
        drop(registry);
        let core = graph.0.clone();
        let store = Store::new(full_name.clone(), core.common.clone(), given, any).reading(read);
        let node = Arc::new(NodeCore {
            names,
            namespace,
            full_name,
            core,
            ordinal: 0.into(),
            own_event_queue: OnceLock::new(),
            standard: OnceLock::new(),
            lifecycle: OnceLock::new(),
        });
        Standard::join(&node, store, is_bare, &arguments)?;
        if !is_taken {
            let itself = Arc::downgrade(&node);
            lock(&graph.0.registry).nodes.insert(node.full_name.clone(), itself);
        }
        Ok(Self(node))
    }

    /// Namespace and name, such as `/demo/scan`.
    #[must_use]
    pub fn full_name(&self) -> &str {
        &self.0.full_name
    }

    /// Names of the node, to resolve relative names.
    #[must_use]
    pub fn names(&self) -> &NodeNames {
        &self.0.names
    }

    /// The graph of the node.
    #[must_use]
    pub fn graph(&self) -> Graph {
        Graph(self.0.core.clone())
    }

    /// The time of the graph \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.0.core.common.clock.now_ns()
    }

    /// True in the active state of a managed node; always true for other nodes. It is false while a
    /// transition to or from the active state runs.
    #[must_use]
    pub fn is_active(&self) -> bool {
        let lifecycle = self.0.lifecycle.get();
        lifecycle.is_none_or(|life| life.upgrade().is_some_and(|life| life.is_active()))
    }

    /// Creates a publisher.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn publisher<T: Message>(&self, topic: &str, qos: Qos) -> Result<Publisher<T>, GraphError> {
        Ok(Publisher::new(self.0.publisher(topic, TypeOf::message::<T>(), qos)?))
    }

    /// Creates a polled subscription; messages wait in a queue.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn mailbox<T: Message>(&self, topic: &str, qos: Qos) -> Result<Mailbox<T>, GraphError> {
        Ok(Mailbox::new(self.0.subscription(topic, TypeOf::message::<T>(), qos, None)?))
    }

    /// Creates a publisher for serialized messages of a type known only by name and optional hash.
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
        Ok(RawPublisher::new(self.0.publisher(topic, TypeOf::new(type_name, type_hash), qos)?))
    }

    /// Creates a polled subscription to a topic whose type is known only by name and optional hash.
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
        Ok(RawMailbox::new(self.0.subscription(topic, type_of, qos, None)?))
    }

    /// Creates a service that is polled; requests wait in a queue.
    ///
    /// # Errors
    /// When the name is not valid, the service has another type, or another node serves
    /// it.
    pub fn server<S: Service>(&self, name: &str) -> Result<Calls<S>, GraphError> {
        Ok(Calls::new(self.0.server(name, TypeOf::service::<S>(), None)?))
    }

    /// Creates a service client. The server may appear later.
    ///
    /// # Errors
    /// When the name is not valid or the service has another type.
    pub fn client<S: Service>(&self, name: &str) -> Result<Client<S>, GraphError> {
        Ok(Client::new(self.0.caller(name, TypeOf::service::<S>())?))
    }

    /// Gives the node a state and callbacks for messages, timers and services.
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
        // Another node of the same name may be the one that is listed.
        let listed = registry.nodes.get(&self.full_name);
        if listed
            .is_some_and(|listed| std::ptr::eq(listed.as_ptr(), self) || listed.strong_count() == 0)
        {
            registry.nodes.remove(&self.full_name);
        }
        registry.changes += 1;
        drop(registry);
        if let Some(standard) = self.standard.get() {
            standard.leave(&self.core);
        }
        if let Some(event_queue) = self.own_event_queue.get() {
            event_queue.close();
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

/// A publisher that is removed from the graph when it is dropped.
pub(crate) struct OwnedPublisher {
    pub(crate) publisher: Arc<PublisherCore>,
    pub(crate) node: Arc<NodeCore>,
}

impl Drop for OwnedPublisher {
    fn drop(&mut self) {
        let core = &self.node.core;
        let gone = lock(&core.registry).remove_publisher(&self.publisher, &core.common);
        drop(gone);
    }
}

/// A subscription that is removed from the graph when it is dropped.
pub(crate) struct OwnedSubscription {
    pub(crate) subscription: Arc<SubscriptionCore>,
    pub(crate) node: Arc<NodeCore>,
}

impl Drop for OwnedSubscription {
    fn drop(&mut self) {
        let core = &self.node.core;
        let gone = lock(&core.registry).remove_subscription(&self.subscription, &core.common);
        drop(gone);
        self.subscription.withdraw();
    }
}

impl NodeCore {
    /// Event queue of the node: in lockstep the queue of the graph or of its namespace, in live mode its own, whose
    /// thread starts on first use.
    pub(crate) fn event_queue(&self) -> Arc<EventQueue> {
        let Some(live) = &self.core.live else {
            let namespace = self.namespace.as_ref();
            return namespace.map_or(&self.core.event_queue, |it| &it.event_queue).clone();
        };
        let start = || live.start(&self.full_name, &self.core.common);
        self.own_event_queue.get_or_init(start).clone()
    }

    pub(crate) fn next_ordinal(&self) -> u64 {
        self.ordinal.fetch_add(1, Ordering::Relaxed)
    }

    pub(crate) fn standard(&self) -> &Standard {
        self.standard.get().expect("set before the node is handed out")
    }

    pub(crate) fn publisher(
        self: &Arc<Self>,
        topic: &str,
        type_of: TypeOf,
        qos: Qos,
    ) -> Result<OwnedPublisher, GraphError> {
        Ok(OwnedPublisher {
            publisher: self.bare_publisher(topic, type_of, qos)?,
            node: self.clone(),
        })
    }

    /// A publisher that the caller has to remove from the graph.
    pub(crate) fn bare_publisher(
        &self,
        topic: &str,
        type_of: TypeOf,
        qos: Qos,
    ) -> Result<Arc<PublisherCore>, GraphError> {
        let full = self.names.topic(topic)?;
        let (core, node) = (&self.core, self.full_name.clone());
        let common = core.common.clone();
        lock(&core.registry).add_publisher(
            &self.full_name,
            &full,
            type_of,
            |id, topic| PublisherCore::new(id, node, topic, qos, common),
            &core.common,
        )
    }

    pub(crate) fn subscription(
        self: &Arc<Self>,
        topic: &str,
        type_of: TypeOf,
        qos: Qos,
        reaction: Option<Reaction>,
    ) -> Result<OwnedSubscription, GraphError> {
        let full = self.names.topic(topic)?;
        let (core, node) = (&self.core, self.full_name.clone());
        let common = core.common.clone();
        let namespace = self.namespace.clone();
        let make = |id, topic| SubscriptionCore {
            id,
            node,
            namespace,
            topic,
            common,
            reaction,
            waiting: Mutex::new(Waiting::new(qos)),
            wake: OnceLock::new(),
            reported: Default::default(),
        };
        let subscription = lock(&core.registry).add_subscription(
            &self.full_name,
            &full,
            type_of,
            make,
            &core.common,
        )?;
        Ok(OwnedSubscription { subscription, node: self.clone() })
    }
}
