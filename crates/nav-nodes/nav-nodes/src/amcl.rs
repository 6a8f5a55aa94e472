//! Localization as a node on the graph.
//!
//! An [`AmclNode`] is what `nav2_amcl` is in ROS 2, and `amcl` in ROS 1: a managed node with the same
//! topics, services, parameters and transforms around a [`periplus_localization::Amcl`]. Here is only
//! who is told, under which name, and in which message; beyond those two it finds itself without
//! being told where it is, and says whether it knows.
//!
//! Source of names and QoS: `nav2_amcl/src/amcl_node.cpp` (main, 2026) and the wiki of ROS 1's `amcl`.

mod file;
mod inputs;
mod messages;
mod node;
mod outputs;
mod saved;
mod services;

pub use messages::scan;
pub use node::{AmclNode, read};
