//! Running simulations and live graphs, as the commands of `periplus` compose them.
//!
//! A [`SimulationSession`] is a simulated world with its recording, estimator nodes, networks (ROS
//! 2 on DDS or Zenoh, ROS 1, Gazebo Transport) and page. [`SessionBuilder`] composes it, a [`SessionTask`]
//! works between its steps, and a [`RunReport`] sums it up. A [`LiveGraph`] is a graph without a
//! simulation on ROS 2. Progress and findings are printed to stderr.

mod arguments;
mod builder;
pub mod check;
pub mod demo;
mod description;
pub mod difference;
mod error;
pub mod files;
#[cfg(not(target_family = "wasm"))]
mod live;
pub mod log_mapping;
#[cfg(any(test, target_family = "wasm"))]
#[cfg_attr(
    not(target_family = "wasm"),
    expect(unreachable_pub, reason = "only a tab has messages")
)]
mod messages;
#[cfg(not(target_family = "wasm"))]
mod network;
#[cfg(target_family = "wasm")]
#[path = "network/absent.rs"]
mod network;
pub mod nodes;
pub mod page;
pub mod picture;
pub mod pictures;
#[cfg(not(target_family = "wasm"))]
mod progress;
#[cfg(target_family = "wasm")]
#[path = "progress/absent.rs"]
mod progress;
pub mod recorded;
mod recording;
mod report;
pub mod rerun;
pub mod scan_log;
mod session;
mod steps;
#[cfg(not(target_family = "wasm"))]
pub mod stop;
pub mod terminal;
pub mod timing;

pub use arguments::read_arguments;
pub use builder::{RecordingRequest, SessionBuilder};
pub use description::with_version;
pub use error::RunError;
#[cfg(not(target_family = "wasm"))]
pub use live::{LiveGraph, NodeMonitor, PollSleep};
#[cfg(not(target_family = "wasm"))]
pub use network::join_ros1;
pub use network::{GazeboSettings, Ros1Reach, Ros1Value, Ros2Reach};
pub use page::{Page, PageContext, PageError, PageHub, PageSettings};
#[cfg(not(target_family = "wasm"))]
pub use periplus_gz_transport::DiscoveryReach as GazeboReach;
pub use progress::ProgressLine;
pub use report::RunReport;
pub use session::{NoTask, RunEnd, RunSettings, SessionTask, SimulationSession};
pub use steps::SessionSnapshot;
