//! AMCL as a ROS node.
//!
//! [`AmclNode`] corresponds to `nav2_amcl` in ROS 2 and `amcl` in ROS 1: a lifecycle node with the
//! same topics, services, parameters and transforms around a [`periplus_localization::Amcl`]. In
//! addition, it localizes globally without an initial pose, and publishes how certain the pose is.
//!
//! Source of names and QoS: `nav2_amcl/src/amcl_node.cpp` (main, 2026) and the ROS 1 wiki of
//! `amcl`.

mod inputs;
mod messages;
mod node;
mod outputs;
mod parameter_file;
mod saved_pose;
mod services;

pub use node::AmclNode;
pub use parameter_file::read_parameters;
