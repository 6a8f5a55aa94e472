//! Smoother server: smooths paths on request.
//!
//! A [`SmootherServer`] is the lifecycle node `smoother_server` of Nav2 with the action `smooth_path` and the topic
//! `plan_smoothed`. It subscribes to the costmap and the footprint of the planner server. The smoothers are those of
//! [`periplus_planners`].
//!
//! Source of names, rules and texts: `nav2_smoother/src/nav2_smoother.cpp` (main, jazzy, humble).

mod node;
mod parameters;

pub use node::SmootherServer;
pub use parameters::{SMOOTHER_SERVER, SmootherServerParams};
