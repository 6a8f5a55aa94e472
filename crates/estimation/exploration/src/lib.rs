//! Where a robot goes to see what it has not seen, and how it gets there.
//!
//! Frontiers are where what is known to be free meets what nobody knows (Yamauchi, "A frontier-based
//! approach for autonomous exploration", 1997). [`frontiers`] finds those that can be reached, with the
//! way to each; an [`Explorer`] chooses one, follows the way, looks again when the map has grown, and
//! lets a place be that it cannot reach. Values in, values out: it reads no clock and knows no topics.

mod explorer;
mod follow;
mod frontier;
mod reach;

pub use explorer::{Explorer, Mood, Settings};
pub use follow::{Velocity, follow};
pub use frontier::{Frontier, frontiers};
pub use reach::{Reach, Robot};
