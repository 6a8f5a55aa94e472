//! Nodes, topics, services, actions and parameters of ROS 2 in one program.
//!
//! A [`Graph`] has nodes; a [`Node`] has publishers, subscriptions, servers and clients. Polling
//! programs use [`Mailbox`] and [`Calls`]; event-driven nodes are an [`Actor`]: a state and
//! callbacks. Recorders, transports and viewers are taps ([`Sink`]). [`Parameters`] are declared in
//! a table and set through the ROS 2 parameter services.
//!
//! ```
//! use periplus_graph::{Graph, NodeSettings, Qos};
//! use periplus_msgs::geometry_msgs::Twist;
//!
//! let graph = Graph::new();
//! let joystick = graph.node(NodeSettings::new("joystick").namespace("/demo"))?;
//! let wheels = graph.node(NodeSettings::new("wheels").remap("cmd", "/demo/cmd_vel"))?;
//! let commands = joystick.publisher::<Twist>("cmd_vel", Qos::reliable(10))?;
//! let mailbox = wheels.mailbox::<Twist>("cmd", Qos::reliable(1))?;
//!
//! assert!(commands.is_heard());
//! commands.publish(Twist::default());
//! assert!(mailbox.latest().is_some());
//! assert!(mailbox.latest().is_none());
//! # Ok::<(), periplus_graph::GraphError>(())
//! ```
//!
//! The caller advances the time of a graph ([`Graph::advance_to`]); the graph reads no clock. Due
//! events are executed in one order (time, node, topic, sequence number), so that a program
//! produces the same bytes in every run.

mod action;
mod actor;
mod arguments;
mod common;
mod describe;
mod error;
mod event_queue;
mod executor;
mod graph;
mod info;
mod interceptor;
mod lifecycle;
mod live;
mod log;
mod mailbox;
mod name;
mod node;
mod parallel;
mod parameters;
mod payload;
mod publisher;
mod publisher_core;
mod qos;
mod qos_event;
mod reactions;
mod registry;
mod remap;
mod sample;
mod service;
mod settings;
mod standard;
mod steady;
mod subscription_core;
mod tap;

pub use action::{
    ActionClient, ActionInfo, ActionServer, ActionSettings, DynamicActionClient, DynamicGoal,
    DynamicProgress, GoalEvent, GoalHandle, GoalId, GoalProgress, GoalState, NewGoal, SentGoal,
};
pub use actor::{Actor, Io};
pub use arguments::{
    Arguments, InvalidParameter, ParameterFileError, ROS_ARGS, parameter_from_yaml,
    parameter_to_yaml, parameters_to_yaml, split_arguments,
};
pub use error::{GraphError, TypeClash};
pub use executor::MAX_REACTIONS;
pub use graph::Graph;
pub use info::{
    EndpointInfo, NodeInfo, PublisherTraffic, QosMismatch, ServiceInfo, SubscriptionTraffic,
    TopicInfo, Traffic,
};
pub use interceptor::{InterceptedMessage, Interceptor};
pub use lifecycle::{
    Bond, BondSettings, Lifecycle, LifecycleCallbacks, LifecycleNode, LifecycleState, Step,
    StepOutcome, Transition,
};
pub use log::Level;
pub use mailbox::{Mailbox, RawMailbox};
pub use name::{
    MAX_NAMESPACE_BYTES, MAX_NODE_NAME_BYTES, MAX_TOPIC_NAME_BYTES, check_namespace, check_node,
    check_topic, valid_node_name, valid_topic_name,
};
pub use node::Node;
pub use parameters::{ParameterRejection, Parameters};
pub use publisher::{Publisher, RawPublisher};
pub use qos::{Durability, History, KEEP_ALL_MAX_MESSAGES, Liveliness, Policy, Qos, Reliability};
pub use qos_event::{IncompatiblePolicy, QosEvent};
pub use reactions::Alarm;
pub use sample::{EndpointId, Sample};
pub use service::{
    Call, CallError, Calls, Client, Pending, RawCall, RawCalls, RawClient, RawMessage,
};
pub use settings::{NodeNames, NodeSettings};
pub use steady::{SteadyCallback, SteadyDriver};
pub use subscription_core::SubscriptionCounts;
pub use tap::{Sink, TapId};
