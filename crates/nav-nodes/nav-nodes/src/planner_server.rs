//! Planner server: paths on the global costmap.
//!
//! A [`PlannerServer`] is the lifecycle node `planner_server` of Nav2 with the actions
//! `compute_path_to_pose` and `compute_path_through_poses`, the service `is_path_valid` and the topic `plan`. It
//! owns the node of the global costmap, which follows its lifecycle. The planners are those of
//! [`periplus_planners`].
//!
//! Source of names, rules and texts: `nav2_planner` (main, jazzy, humble).

mod failure;
mod goals;
mod node;
mod parameters;
mod validity;

pub use node::PlannerServer;
pub use parameters::{PLANNER_SERVER, PlannerServerParams};
