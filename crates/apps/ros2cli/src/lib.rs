//! Verbs of the `ros2` command for topics, nodes, services, parameters, actions, lifecycle nodes and
//! interfaces, with the same arguments and output. [`map`] implements the programs of map servers,
//! [`tf`] those of tf2, [`frames`] the drawings of `view_frames`, and [`teleop`] the keys of
//! `teleop_twist_keyboard`.
//!
//! A [`Network`] provides discovery and a graph; a [`Session`] is one use of the command: its
//! network, its types, and its output. Each verb is a function over a session. Nothing here depends
//! on DDS, so that all of it is tested in one process.
//!
//! Source of the arguments and of the output format: `ros2/ros2cli` and `ros2/rosidl_runtime_py`.

pub mod action;
mod ask;
pub mod clock;
pub mod doctor;
mod failure;
mod filter;
pub mod frames;
pub mod interface;
pub mod lifecycle;
mod listen;
pub mod map;
mod network;
pub mod node;
pub mod param;
mod qos;
mod seen;
pub mod service;
mod session;
pub mod show;
pub mod teleop;
pub mod tf;
pub mod topic;
mod types;
mod values;

pub use failure::{Failure, NodeRefusal, Outcome, Ros2Line};
pub use network::{InGraph, Network, Progress};
pub use qos::QosRequest;
pub use seen::{Seen, SeenNode, SeenService, SeenTopic, TopicEndpoint, is_hidden};
pub use session::Session;
pub use types::Types;
pub use values::Values;
