//! Local planners of ROS 1, for `move_base`.
//!
//! Source: `dwa_local_planner`, `base_local_planner` of `ros-planning/navigation` (Noetic). Defaults are those of
//! dynamic reconfigure, whose callback runs once at the start and wins.

mod critics;
mod dwa;
mod dwa_params;
mod goal;
mod rollout;
mod stop_rotate;
mod teb;
mod teb_params;
mod trajectory_params;
mod trajectory_planner;
mod wavefront;

pub use dwa::DwaPlanner;
pub use dwa_params::{DWA_PLANNER, DwaPlannerParams};
pub use goal::create_local_goal_checker;
pub use teb::TebReplacement;
pub use teb_params::{TEB_PLANNER, TebPlannerParams};
pub use trajectory_params::{TRAJECTORY_PLANNER, TrajectoryPlannerParams};
pub use trajectory_planner::TrajectoryPlanner;
pub use wavefront::WavefrontDistances;

pub(crate) use dwa::create as create_dwa;
pub(crate) use teb::create as create_teb;
pub(crate) use trajectory_planner::create as create_trajectory_planner;
