//! Running simulations and live graphs, as the commands of `periplus` compose them.
//!
//! A [`SimulationSession`] is a simulated world with its recording, estimator nodes, networks (ROS
//! 2 on DDS or Zenoh, Gazebo Transport) and page. [`SessionBuilder`] composes it, a [`SessionTask`]
//! works between its steps, and a [`RunReport`] sums it up. A [`LiveGraph`] is a graph without a
//! simulation on ROS 2. Progress and findings are printed to stderr.

mod builder;
mod description;
pub mod difference;
mod error;
pub mod files;
mod live;
mod network;
pub mod nodes;
pub mod page;
pub mod picture;
mod progress;
pub mod recorded;
mod recording;
mod report;
pub mod rerun;
mod session;
mod steps;
pub mod stop;
pub mod terminal;

pub use builder::{RecordingRequest, SessionBuilder};
pub use error::RunError;
pub use live::{LiveGraph, NodeMonitor, PollSleep};
pub use network::{GazeboSettings, Ros2Reach};
pub use page::{Page, PageContext, PageError, PageSettings};
pub use periplus_gz_transport::DiscoveryReach as GazeboReach;
pub use progress::ProgressLine;
pub use report::RunReport;
pub use session::{NoTask, RunEnd, RunSettings, SessionTask, SimulationSession};
pub use steps::SessionSnapshot;
