//! ROS 1 on the wire, without ROS: master and parameter server over XML-RPC, topics and services over TCPROS.
//!
//! A [`Ros1Transport`] joins a master, or starts one, and attaches a graph: each of its nodes is a node of ROS 1 with
//! a port for the slave API, topics and services. A [`Master`] serves programs that are started later, as `roscore`
//! does.
//!
//! ```
//! use periplus_ros1::{Master, MasterClient};
//!
//! let master = Master::open([127, 0, 0, 1].into(), "localhost", 0)?;
//! let client = MasterClient::new(master.uri(), "/teleop");
//! client.set_parameter("/speed", 0.5.into()).expect("a master that answers");
//! assert!(client.system_state().expect("a master that answers").publishers.len() == 1);
//! # Ok::<(), periplus_ros1::Ros1Error>(())
//! ```
//!
//! Source: `wiki.ros.org` (Master API, Slave API, Parameter Server API, TCPROS, Connection Header).

mod client;
mod codec;
mod error;
mod fuzz;
mod link;
mod master;
mod names;
mod node;
mod outgoing;
mod rpc;
mod server;
mod settings;
mod tcpros;
mod wire;
mod xmlrpc;

pub use client::{MasterClient, NodesByName, SystemState};
pub use error::Ros1Error;
#[doc(hidden)]
pub use fuzz::{fuzz_http, fuzz_tcpros};
pub use master::{Master, MasterState, Notification};
pub use names::{
    Ros1Type, message_definition, node_name, ros1_type, ros2_service_type, ros2_type,
    service_definition,
};
pub use rpc::{RpcError, ask, call};
pub use settings::{MASTER_PORT, Ros1Reach, Settings};
pub use tcpros::{Header, MAX_HEADER_BYTES, MAX_MESSAGE_BYTES, MalformedHeader};
pub use wire::{MasterUse, Ros1Transport};
pub use xmlrpc::{
    MalformedXmlRpc, RpcCall, RpcFault, XmlRpcValue, read_call, read_response, write_call,
    write_fault, write_response,
};
