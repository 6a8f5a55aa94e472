//! Costmaps as nodes on the graph.
//!
//! A [`CostmapNode`] is what `nav2_costmap_2d` is in ROS 2: a managed node with the same topics,
//! services and parameters around a [`periplus_costmap::LayeredCostmap`]. Here is only who is told,
//! under which name, and in which message. [`VoxelMarkers`] and [`VoxelCloud`] show voxels.
//!
//! Source of names and QoS: `nav2_costmap_2d/src/costmap_2d_ros.cpp`, `costmap_2d_publisher.cpp`,
//! `clear_costmap_service.cpp`.

mod clouds;
mod frames;
mod health;
mod inputs;
mod messages;
mod node;
mod outputs;
mod parameters;
mod services;
mod topics;
mod voxels;

pub use node::{CostmapNode, CostmapStatus};
pub use parameters::{node_values, split};
pub use voxels::{VoxelCloud, VoxelMarkers};
