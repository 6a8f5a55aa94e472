//! What every wire needs, whatever its network: a node in the graph that stands for all others, what
//! the graph has of its own, messages on their way out, names of types as ROS 2 gives them to
//! networks, what the environment says to all of them, and what does not fit.

mod clock;
pub mod environment;
pub mod names;
mod own;
pub mod report;
mod steady;
mod taps;

use std::sync::{Mutex, MutexGuard, PoisonError};

pub use clock::{Since, unix_ns};
pub use own::{Own, is_stand_in, stand_in};
pub use steady::SteadyClock;
pub use taps::{Foreign, Taps, Way};

/// Locks; a panic elsewhere must not spread.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
