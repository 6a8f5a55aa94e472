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
//! use periplus_graph::{Graph, NodeSettings, Qos};
//! use periplus_dds::{Settings, DdsTransport};
//!
//! // Read the environment with `Settings::from_environment(&host)`.
//! let wire = DdsTransport::open(&Settings::default())?;
//!
//! // Endpoints of other programs, once discovery has run.
//! wire.wait_for(Duration::from_secs(2), |remote| remote.topic("/scan").is_some());
//! for topic in &wire.remote().topics {
//!     println!("{} {:?}", topic.name, topic.type_names);
//! }
//!
//! // Taking part: a short `ros2 topic echo`.
//! let graph = Graph::live();
//! wire.attach(&graph)?;
//! let node = graph.node(NodeSettings::new("listener"))?;
//! let scans =
//!     node.raw_mailbox("/scan", "sensor_msgs/msg/LaserScan", None, Qos::sensor_data())?;
//! loop {
//!     for sample in scans.drain() {
//!         println!("{} bytes", sample.cdr()?.len());
//!     }
//!     std::thread::sleep(Duration::from_millis(10));
//! }
//! # #[allow(unreachable_code)]
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
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
