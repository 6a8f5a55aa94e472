//! Path-following controllers with the behaviour of Nav2, and the checkers of goal and progress.
//!
//! A [`Controller`] gets the robot's pose, velocity, local costmap and plan as arguments and returns a velocity;
//! it has no clock and no inputs.

mod controller;
pub mod mppi;

pub use controller::{ControlError, ControlInput, Controller, GoalTolerance};
