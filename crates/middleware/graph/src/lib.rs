//! Nodes, topics and services in one program, as ROS 2 knows them.
//!
//! A [`Graph`] has nodes; a [`Node`] has publishers, subscriptions, servers and clients. Who only
//! looks from time to time polls: [`Mailbox`], [`Calls`]. Who reacts is an [`Actor`]: a state and
//! closures. Recorders, wires and viewers are taps ([`Sink`]).
//! [`Parameters`] come from a table and are set through the services that ROS 2 knows.
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
//! Time is told to a graph ([`Graph::advance_to`]); it reads no clock. Everything due then happens
//! in one order, that of time, node, topic and number of the message, so that the same program gives
//! the same bytes every time.

mod action;
mod actor;
mod agenda;
mod arguments;
mod common;
mod describe;
mod error;
mod executor;
mod graph;
mod info;
mod inlet;
mod lifecycle;
mod live;
mod log;
mod mailbox;
mod name;
mod node;
mod outlet;
mod parameters;
mod payload;
mod publisher;
mod qos;
mod qos_event;
mod registry;
mod remap;
mod sample;
mod service;
mod settings;
mod standard;
mod steady;
mod tap;

pub use action::{
    ActionClient, ActionInfo, ActionServer, ActionSettings, DynamicActionClient, DynamicGoal,
    DynamicProgress, GoalEvent, GoalHandle, GoalId, GoalProgress, GoalState, NewGoal, SentGoal,
};
pub use actor::{Actor, Io};
pub use arguments::{
    Arguments, ROS_ARGS, parameter_from_yaml, parameter_to_yaml, parameters_to_yaml,
    split_arguments,
};
pub use error::{GraphError, TypeClash};
pub use executor::MOST_REACTIONS;
pub use graph::Graph;
pub use info::{
    EndpointInfo, Mismatch, NodeInfo, PublisherTraffic, ServiceInfo, SubscriptionTraffic,
    TopicInfo, Traffic,
};
pub use inlet::InletCounts;
pub use lifecycle::{Bond, BondSettings, Lifecycle, LifecycleState, Step, StepOutcome, Transition};
pub use log::Level;
pub use mailbox::{Mailbox, RawMailbox};
pub use name::{
    LONGEST_NAMESPACE, LONGEST_NODE, LONGEST_TOPIC, check_namespace, check_node, check_topic,
    valid_node_name, valid_topic_name,
};
pub use node::Node;
pub use parameters::Parameters;
pub use publisher::{Publisher, RawPublisher};
pub use qos::{Durability, History, Liveliness, MOST_KEPT, Policy, Qos, Reliability};
pub use qos_event::{QosEvent, Unfit};
pub use sample::{EndpointId, Sample};
pub use service::{
    Call, CallError, Calls, Client, Pending, RawCall, RawCalls, RawClient, RawMessage,
};
pub use settings::{NodeNames, NodeSettings};
pub use steady::{SteadyCallback, SteadyDriver};
pub use tap::{Sink, TapId};
