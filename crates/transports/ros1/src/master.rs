//! The ROS master and its parameter server.
//!
//! Source: `wiki.ros.org/ROS/Master_API` and `wiki.ros.org/ROS/Parameter Server API`. [`MasterState`] is plain data:
//! calls change it and give the notifications to send. [`Master`] serves one on a port.

mod notify;
mod parameters;
mod registrations;
mod rosout;
mod serve;
mod state;

pub use serve::Master;
pub(crate) use state::process_id;
pub use state::{MasterState, Notification};
