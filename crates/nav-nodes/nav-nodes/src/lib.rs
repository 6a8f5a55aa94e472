//! Map server, SLAM, localization, costmap and odometry filter nodes.
//!
//! Each module has the nodes of one ROS package or program, with its topics, services, parameters
//! and QoS: [`map_server`] (`nav2_map_server`), [`slam_toolbox`] (also `slam_gmapping`), [`amcl`]
//! (of Nav2 and of ROS 1), [`costmap_2d`] (`nav2_costmap_2d`) and [`ekf_node`]
//! (`robot_localization`). The estimators themselves are libraries without ROS.

pub mod amcl;
pub mod costmap_2d;
pub mod ekf_node;
pub mod map_server;
pub mod slam_toolbox;

/// File access for nodes that load and save maps, sessions and poses.
pub trait Files: periplus_resources::Host + periplus_resources::Store + Send + Sync {}

impl<F: periplus_resources::Host + periplus_resources::Store + Send + Sync> Files for F {}
