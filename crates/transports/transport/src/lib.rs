//! Code shared by all transports: the node that represents remote programs in the graph, the
//! graph's own endpoints, send queues, type names on networks, environment variables, and reports
//! of incompatible endpoints.
//!
//! ```
//! use periplus_diagnostics::Diagnostics;
//! use periplus_resources::MemoryHost;
//! use periplus_transport::{environment, names};
//!
//! let host = MemoryHost::new().with_variable("ROS_DOMAIN_ID", "7");
//! assert_eq!(environment::domain_id(&host, &mut Diagnostics::new()), 7);
//! assert_eq!(names::type_of("std_msgs/msg/String"), "std_msgs::msg::dds_::String_");
//! ```

mod bell;
mod clock;
pub mod environment;
mod lane;
pub mod names;
mod own;
pub mod report;
mod steady;
mod taps;

use std::sync::{Mutex, MutexGuard, PoisonError};

pub use bell::{Bell, wait_until};
pub use clock::{Since, unix_ns};
pub use lane::{Lane, SendQueue};
pub use own::{Own, is_stand_in, stand_in};
pub use steady::SteadyClock;
pub use taps::{Foreign, Taps, Way};

/// Locks a mutex and ignores poisoning, so that a panic does not spread.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
