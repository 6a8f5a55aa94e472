//! Node of `nav2_behaviors`: spin, back up, drive on heading, assisted teleoperation, wait.
//!
//! The name of a behavior is that of its action. The costmap and the footprint are received as messages
//! of another node. A motion publishes one velocity per cycle; every end of it publishes zero.
//!
//! Source: `nav2_behaviors/timed_behavior.hpp` and `plugins/` (humble to main).

mod behavior;
mod config;
mod motions;
mod node;
mod others;
mod plugin;
mod world;

pub use behavior::{CycleOutcome, FailureReason, MotionFailure};
pub use config::{BehaviorConfig, BehaviorKind, BehaviorServerConfig};
pub use node::BehaviorServerNode;
pub use plugin::{BehaviorAction, BehaviorGoal, BehaviorInput, BehaviorPlugin, RegisteredBehavior};
