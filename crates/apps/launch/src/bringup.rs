//! Execution of plans.
//!
//! [`Bringup`] executes a [`crate::Plan`] step by step. Known ROS programs become built-in nodes on
//! one graph ([`table`] lists them); Gazebo becomes a [`periplus_sim::Simulation`] that the caller
//! creates from [`Bringup::world`]. Other programs run if the machine has them. Missing ones are
//! reported, and the rest runs.

mod bridge;
mod catalogue;
mod costmaps;
mod crew;
mod environment;
mod guard;
mod hands;
mod includes;
mod make;
mod parameters;
mod parts;
mod preparation;
mod told;
mod transform;
mod words;
mod world;
mod xacro;

pub use catalogue::table;
pub use crew::{Bringup, Settings};
pub use environment::Environment;
pub use guard::{GUARD_VERB, guard};
pub use includes::{STOOD_FOR, stands_for};
pub use told::{Became, Kind, Line, Said};
pub use world::WorldWish;
pub use xacro::{Xacro, xacro};
