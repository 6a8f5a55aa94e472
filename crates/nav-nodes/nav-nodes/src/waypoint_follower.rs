//! Node of `nav2_waypoint_follower`: drives to poses one after the other, with a task at each.
//!
//! The actions `follow_waypoints` and, from Jazzy on, `follow_gps_waypoints` send `navigate_to_pose`
//! for each pose. GPS poses are converted by the service `/fromLL` of `robot_localization`. Tasks do not
//! block: a goal can be canceled while one runs.
//!
//! Source: `waypoint_follower.cpp` and `plugins/` (humble to main).

mod actions;
mod config;
mod follow;
mod node;
mod tasks;

pub use config::{
    INPUT_AT_WAYPOINT, InputAtWaypointParams, PHOTO_AT_WAYPOINT, PhotoAtWaypointParams, TaskKind,
    WAIT_AT_WAYPOINT, WAYPOINT_FOLLOWER, WaitAtWaypointParams, WaypointFollowerConfig,
    WaypointFollowerParams,
};
pub use node::WaypointFollowerNode;
pub use tasks::SavePhoto;
