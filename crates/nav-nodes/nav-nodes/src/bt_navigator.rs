//! Navigator of Nav2 (`nav2_bt_navigator`): goals are executed by behavior trees.
//!
//! Trees are read by [`periplus_behavior_tree`]; the tree nodes here are clients of the planner, the
//! controller, the behaviors and the costmaps. Nothing waits: a tree node sends its goal in one tick and looks
//! for the answer in the next ones. Rates and timeouts count the time of the graph, so that a simulation in
//! lockstep never loses an acknowledgement to a busy machine.

mod action_node;
mod actions;
mod cancel_node;
mod condition_nodes;
mod data_nodes;
mod default_trees;
mod errors;
mod kinds;
mod loading;
mod navigator;
mod node;
mod parameters;
mod paths;
mod service_node;
mod services;
mod shared;
mod simple_trees;
mod status;
mod topic_nodes;
mod tree_nodes;

pub use default_trees::{
    NAVIGATE_CAR_TO_POSE_FILE, NAVIGATE_KEEPING_PATH_FILE, NAVIGATE_THROUGH_POSES_FILE,
    NAVIGATE_TO_POSE_FILE, built_in_tree, built_in_tree_files,
};
pub use node::BtNavigator;
pub use parameters::{BT_NAVIGATOR, BtNavigatorParams};
pub use status::{NavigatorStatus, ServerError};
