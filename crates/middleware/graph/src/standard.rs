//! Standard interfaces of every ROS 2 node: six parameter services, `~/get_type_description`, and
//! publishers of `/parameter_events` and `/rosout`.
//!
//! Source: `rclcpp/node.cpp` (the interfaces that a node creates) and `rcl/logging_rosout.h`.

use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex};

use periplus_msgs::rcl_interfaces::{Log, ParameterEvent};
use periplus_msgs::{Message, Service};

use crate::arguments::Arguments;
use crate::common::lock;
use crate::describe;
use crate::graph::Core;
use crate::log::Level;
use crate::node::NodeCore;
use crate::parameters::{Store, services};
use crate::payload::Payload;
use crate::publisher_core::PublisherCore;
use crate::registry::TypeOf;
use crate::service::{Server, ServerReaction};
use crate::{GraphError, Qos};

/// Standard endpoints of a node. They do not keep it alive.
pub(crate) struct Standard {
    pub(crate) store: Mutex<Store>,
    /// Called before parameters change.
    pub(crate) change: Mutex<Option<Change>>,
    /// Minimum [`Level`] that is logged.
    pub(crate) min_level: AtomicU8,
    events: Option<Arc<PublisherCore>>,
    rosout: Option<Arc<PublisherCore>>,
    servers: Vec<Arc<Server>>,
}

/// Callback that applies or rejects new parameters. The number distinguishes it from earlier ones.
pub(crate) struct Change {
    pub(crate) ordinal: u64,
    pub(crate) apply: Arc<Apply>,
}

pub(crate) type Apply = dyn Fn(&periplus_params::ParamValues) -> Result<(), String> + Send + Sync;

impl Standard {
    /// Creates the endpoints of a node; none for a bare one.
    pub(crate) fn join(
        node: &Arc<NodeCore>,
        store: Store,
        is_bare: bool,
        arguments: &Arguments,
    ) -> Result<(), GraphError> {
        let level = arguments.level_of(&node.full_name);
        let mut standard = Self {
            store: Mutex::new(store),
            change: Mutex::new(None),
            min_level: AtomicU8::new(level.number()),
            events: None,
            rosout: None,
            servers: Vec::new(),
        };
        if !is_bare && let Err(error) = standard.make(node, arguments) {
            standard.leave(&node.core);
            return Err(error);
        }
        // The node has not been handed out yet.
        let _ = node.standard.set(standard);
        node.publish_parameter_event(|store| ParameterEvent {
            new_parameters: store.all(),
            ..Default::default()
        });
        Ok(())
    }

    fn make(&mut self, node: &Arc<NodeCore>, arguments: &Arguments) -> Result<(), GraphError> {
        self.events =
            Some(publisher::<ParameterEvent>(node, "/parameter_events", Qos::parameters())?);
        if arguments.logs_to_rosout() {
            self.rosout = Some(publisher::<Log>(node, "/rosout", Qos::rosout())?);
        }
        services::serve(node, &mut self.servers)?;
        self.servers.push(describe::serve(node)?);
        Ok(())
    }

    /// Removes the endpoints from the graph.
    pub(crate) fn leave(&self, core: &Core) {
        for publisher in [&self.events, &self.rosout].into_iter().flatten() {
            let gone = lock(&core.registry).remove_publisher(publisher, &core.common);
            drop(gone);
        }
        for server in &self.servers {
            server.leave(core);
        }
    }

    pub(crate) fn publish_log(&self, log: Log) {
        if let Some(rosout) = &self.rosout {
            rosout.publish(|| Payload::typed(Arc::new(log)));
        }
    }

    pub(crate) fn logs(&self, level: Level) -> bool {
        self.rosout.is_some() && self.min_level.load(Ordering::Relaxed) <= level.number()
    }

    pub(crate) fn publish_event(&self, event: ParameterEvent) {
        if let Some(events) = &self.events {
            events.publish(|| Payload::typed(Arc::new(event)));
        }
    }
}

fn publisher<T: Message>(
    node: &Arc<NodeCore>,
    topic: &str,
    qos: Qos,
) -> Result<Arc<PublisherCore>, GraphError> {
    node.bare_publisher(topic, TypeOf::message::<T>(), qos)
}

/// Creates a server that does not keep its node alive.
pub(crate) fn server<S: Service>(
    node: &Arc<NodeCore>,
    name: &str,
    answer: impl Fn(&Arc<NodeCore>, &S::Request) -> S::Response + Send + Sync + 'static,
) -> Result<Arc<Server>, GraphError> {
    node.bare_server(name, TypeOf::service::<S>(), Some(reaction::<S>(node, answer)))
}

/// Creates a server that responds at once, without the state of an actor.
pub(crate) fn reaction<S: Service>(
    node: &Arc<NodeCore>,
    answer: impl Fn(&Arc<NodeCore>, &S::Request) -> S::Response + Send + Sync + 'static,
) -> ServerReaction {
    let owner = Arc::downgrade(node);
    ServerReaction {
        node: owner.clone(),
        react: Box::new(move |request| {
            let Some(node) = owner.upgrade() else { return };
            match request.payload.message::<S::Request>() {
                Ok(question) => {
                    let answer = Payload::typed(Arc::new(answer(&node, &question)));
                    request.reply.send(Ok(Arc::new(answer)));
                }
                Err(error) => request.reply.undecodable(&error),
            }
        }),
    }
}
