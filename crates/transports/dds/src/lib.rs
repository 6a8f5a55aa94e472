//! DDS transport for ROS 2: connects a graph to ROS 2 programs on the network, without a ROS
//! installation.
//!
//! A [`DdsTransport`] joins the network and lists the nodes, topics and services of other programs
//! ([`DdsTransport::remote`]). An attached graph takes part: its publishers and subscriptions are matched
//! with those of other programs, and services work in both directions.
//!
//! ```no_run
//! use std::time::Duration;
//!
//! use periplus_dds::{DdsTransport, Settings};
//! use periplus_graph::{Graph, NodeSettings, Qos};
//!
//! let transport = DdsTransport::open(&Settings::default())?;
//! let graph = Graph::live();
//! transport.attach(&graph)?;
//! let node = graph.node(NodeSettings::new("listener"))?;
//! let qos = Qos::sensor_data();
//! let scans = node.raw_mailbox("/scan", "sensor_msgs/msg/LaserScan", None, qos)?;
//! transport.wait_for(Duration::from_secs(2), |remote| remote.topic("/scan").is_some());
//! for sample in scans.drain() {
//!     println!("{} bytes", sample.cdr()?.len());
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `Settings::from_environment(&host)` reads `ROS_DOMAIN_ID` and the other variables of ROS 2.
//!
//! A program that publishes once and exits must call [`DdsTransport::flush`] first.

pub mod entities;
mod error;
mod link;
pub mod names;
mod outgoing;
mod peers;
pub mod ports;
mod qos;
mod remote;
pub mod request;
mod settings;
pub mod user_data;
mod wire;

pub use error::DdsError;
pub use periplus_cyclonedds_sys::{Guid, Vendor};
pub use remote::{
    DiscoveryProgress, Remote, RemoteEndpoint, RemoteNode, RemoteService, RemoteTopic,
};
pub use settings::{DiscoveryRange, Settings};
pub use wire::DdsTransport;
