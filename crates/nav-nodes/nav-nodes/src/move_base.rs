//! Navigation of ROS 1: the node `move_base`.
//!
//! A [`MoveBase`] has the action `move_base`, the topic `move_base_simple/goal`, the services `~/make_plan` and
//! `~/clear_costmaps`, and two costmaps, each on a separate node. It plans with [`periplus_planners`], follows the
//! plan with the local planners of [`periplus_controllers::ros1`], and recovers as `move_base` does.
//!
//! Source of names, rules and texts: `move_base`, `actionlib`, `navfn`, `clear_costmap_recovery`, `rotate_recovery`,
//! `move_slow_and_clear` and `costmap_2d` of `ros-planning/navigation` (Noetic). Differences: a recovery can be
//! cancelled and preempted while it runs, and an aborted goal names the last reason.

mod actionlib;
mod cell_costs;
mod config;
mod control;
mod costmaps;
mod cycle;
mod global_planner;
mod job;
mod local_planner;
mod node;
mod outputs;
mod params;
mod plan;
mod recovery;
mod services;
mod values;

pub use config::{MoveBaseConfig, UnknownMoveBaseClass};
pub use global_planner::{GLOBAL_PLANNER, GlobalPlannerParams, NAVFN_ROS, NavfnRosParams};
pub use node::MoveBase;
pub use params::{MOVE_BASE, MoveBaseParams};
pub use recovery::{
    CLEAR_COSTMAP_RECOVERY, ClearCostmapParams, MOVE_SLOW_AND_CLEAR, MoveSlowAndClearParams,
    ROTATE_RECOVERY, RotateRecoveryParams,
};
