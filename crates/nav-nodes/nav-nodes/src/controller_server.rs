//! Controller server: follows paths with the local costmap.
//!
//! A [`ControllerServer`] is the lifecycle node `controller_server` of Nav2 with the action `follow_path`, the topic
//! `cmd_vel` and the topics of its controllers. It owns the node of the local costmap, which follows its lifecycle.
//! The controllers, checkers and path handlers are those of [`periplus_controllers`].
//!
//! Source of names, rules and texts: `nav2_controller` (main, jazzy, humble).

mod control;
mod job;
mod node;
mod outputs;
mod parameters;
mod plugins;
mod reports;
mod samples;
mod tracking;

pub use node::ControllerServer;
pub use parameters::{CONTROLLER_SERVER, ControllerServerParams};
