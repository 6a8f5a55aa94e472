//! What the `ros2` command does with topics, nodes, services, parameters, actions, lifecycle nodes
//! and interfaces: the same words, the same output. [`map`] does what the programs of
//! map servers do, [`tf`] what those of tf2 do, with pictures of the tree by [`frames`], and
//! [`teleop`] drives by keys.
//!
//! A [`Network`] says who is there and lets a graph take part; a [`Session`] is one use of the
//! command: its network, the types it knows, and where it writes. Each verb is a function over a
//! session. Nothing here knows DDS, so all of it is tested in one process.
//!
//! Source of words and of the shape of the output: `ros2/ros2cli` and `ros2/rosidl_runtime_py`.

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

pub use failure::{Failure, Outcome, Refusal, Ros2Line};
pub use network::{InGraph, Network, Progress};
pub use qos::QosWish;
pub use seen::{Seen, SeenEnd, SeenNode, SeenService, SeenTopic, is_hidden};
pub use session::Session;
pub use types::Types;
pub use values::Values;
