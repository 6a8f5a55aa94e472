//! Costmap nodes.
//!
//! A [`CostmapNode`] is a lifecycle node with the topics, services and parameters of
//! `nav2_costmap_2d` around a [`periplus_costmap::LayeredCostmap`]. This module only converts
//! messages and connects topics. [`VoxelMarkers`] and [`VoxelCloud`] publish voxels for display.
//!
//! Source of names and QoS: `nav2_costmap_2d/src/costmap_2d_ros.cpp`, `costmap_2d_publisher.cpp`,
//! `clear_costmap_service.cpp`.

mod blame;
pub(crate) mod clouds;
pub(crate) mod frames;
mod health;
mod inputs;
pub(crate) mod messages;
mod node;
mod outputs;
mod parameters;
mod services;
mod topics;
mod voxels;

pub use blame::blame;
pub(crate) use messages::pose2 as pose2_of;
pub use node::{CostmapNode, CostmapStatus};
pub use parameters::{node_values, split};
pub use voxels::{VoxelCloud, VoxelMarkers};
