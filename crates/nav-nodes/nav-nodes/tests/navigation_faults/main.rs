//! Faults of navigation: all servers together, with a robot that obeys its last command, in lockstep.
//!
//! A fault ends the action with its code and reason, the robot stands, and the servers serve the next goal.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "helpers of tests, which read shared files"
)]

#[path = "../common/mod.rs"]
mod common;

mod direct_goals;
#[path = "../common/files.rs"]
mod files;
mod goals;
mod inputs;
mod interruptions;
mod lifecycle;
mod params;
mod robot;
mod several_poses;
mod stock;
mod trees;
mod world;
