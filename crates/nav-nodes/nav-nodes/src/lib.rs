//! Map server, SLAM, localization, costmap, odometry filter and navigation nodes.
//!
//! Each module has the nodes of one ROS package or program, with its topics, services, parameters
//! and QoS: [`map_server`] (`nav2_map_server`), [`slam_toolbox`] (also `slam_gmapping`), [`amcl`]
//! (of Nav2 and of ROS 1), [`costmap_2d`] (`nav2_costmap_2d`), [`ekf_node`] (`robot_localization`)
//! and [`bt_navigator`] (`nav2_bt_navigator`). The estimators themselves are libraries without ROS.
//!
//! The servers of Nav2: [`planner_server`], [`smoother_server`], [`controller_server`],
//! [`behavior_server`], [`velocity_smoother`], [`collision_monitor`] and [`waypoint_follower`], with
//! [`simple_action_server`] for their actions and [`nav2_actions`] for the forms of the releases. The navigation of
//! ROS 1 is [`move_base`].
//!
//! ```
//! use periplus_diagnostics::Diagnostics;
//! use periplus_ekf::Settings;
//! use periplus_graph::{Graph, NodeSettings, Qos};
//! use periplus_msgs::nav_msgs::Odometry;
//! use periplus_nav_nodes::ekf_node::EkfNode;
//! use periplus_params::Given;
//!
//! let graph = Graph::new();
//! let wheels = [Given::new("odom0", "wheels"), Given::new("two_d_mode", "true")];
//! let (settings, values) = Settings::read(wheels, &mut Diagnostics::new());
//! let ekf = EkfNode::at(graph.node(NodeSettings::new("ekf_filter_node"))?, settings, values)?;
//! assert!(graph.topics().iter().any(|topic| topic.name == "/odometry/filtered"));
//! # Ok::<(), periplus_graph::GraphError>(())
//! ```

pub mod amcl;
pub mod behavior_server;
pub mod bt_navigator;
pub mod collision_monitor;
mod common_parameters;
pub mod controller_server;
pub mod costmap_2d;
mod costmap_subscriber;
pub mod ekf_node;
mod loop_rate;
pub mod map_server;
pub mod move_base;
pub mod nav2_actions;
pub mod navigation;
pub mod navigation_plugins;
mod node_parameters;
pub mod parameter_groups;
pub mod planner_server;
mod server_plugins;
pub mod simple_action_server;
pub mod slam_toolbox;
pub mod smoother_server;
pub mod velocity_smoother;
pub mod velocity_topics;
pub mod waypoint_follower;

pub use node_parameters::NodeParameters;

/// File access for nodes that load and save maps, sessions and poses.
pub trait Files: periplus_resources::Host + periplus_resources::Store + Send + Sync {}

impl<F: periplus_resources::Host + periplus_resources::Store + Send + Sync> Files for F {}
