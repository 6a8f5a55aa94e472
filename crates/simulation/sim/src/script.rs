//! Scripts of velocity commands and goals.
//!
//! A script is a YAML list; each entry is a velocity or a goal:
//!
//! ```yaml
//! - {at: 0.0, linear: [0.5, 0, 0], angular: [0, 0, 0.2]}    # once
//! - {at: 2, until: 5, rate: 10, linear: 0.5}                # from 2 s on, ten times a second, before 5 s
//! - {at: 5, topic: /demo/cmd_vel, type: geometry_msgs/msg/TwistStamped, frame: base_link}
//! - {goto: [2.0, 1.0]}                                      # then there [m], in the world's frame
//! - {goto: [0, 0], speed: 0.3, turn: 0.5, tolerance: 0.05}
//! ```
//!
//! Commands without `topic` use the topic that the robot subscribes to, with its type.
//!
//! Times are seconds of simulated time. `linear: 0.5` is forward, `angular: 0.2` is
//! counterclockwise; lists are x, y, z; mappings such as `{x: 0.5}` work too. Missing values are
//! zero. A [`GoalController`] drives to goals in their order; with `at` not before that time. A
//! [recording](replay) can be played as well.

mod command;
mod goal_controller;
mod read;
mod replay;

pub use command::{CommandMessage, VelocityCommand};
pub use goal_controller::{Goal, GoalController, PlanarVelocity};
pub use read::{DriveScript, read, read_node};
pub use replay::replay;
