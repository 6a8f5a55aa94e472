//! Frontier exploration: selection of goals at the border of explored space, and path following.
//!
//! Frontiers are the borders between free and unknown space (Yamauchi, "A frontier-based approach
//! for autonomous exploration", 1997). [`frontiers`] returns the reachable ones with path costs; an
//! [`Explorer`] selects one, follows the path, selects again when the map has grown, and abandons
//! goals that it cannot reach. The crate has no clock and no topics: all inputs are arguments.

mod explorer;
mod follow;
mod frontier;
mod reach;

pub use explorer::{Explorer, Mood, Settings};
pub use follow::{Velocity, follow};
pub use frontier::{Frontier, frontiers};
pub use reach::{Reach, Robot};
