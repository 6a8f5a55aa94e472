//! Mapping as nodes on the graph.
//!
//! A [`SlamNode`] corresponds to the nodes of `slam_toolbox` in ROS 2 and to `slam_gmapping` in ROS 1
//! ([`Program`]): a managed node with the same topics, services, parameters and transforms around the
//! engines of [`periplus_slam`]. This module has the names and messages; in addition it reports missing
//! transforms, and why loops were closed or not.
//!
//! Source of names and QoS: `slam_toolbox/src/slam_toolbox_common.cpp` and its siblings (humble to
//! rolling, 2026), `gmapping/src/slam_gmapping.cpp` (noetic).

mod correction;
mod drawing;
mod engine;
mod file;
mod health;
mod inputs;
mod markers;
mod messages;
mod node;
mod outputs;
mod parameters;
mod program;
mod services;

pub use crate::node_parameters::Written;
pub use file::{InFile, MapperParameters, in_file, read};
pub use node::{Pace, SlamNode, SlamStatus};
pub use program::Program;
