//! A graph on the wire, as ROS 2 speaks it: other programs see our nodes, topics and services as
//! they see any others, and we see theirs. Over DDS; no ROS is needed.
//!
//! A [`Wire`] joins the network and tells who else is there ([`Wire::remote`]). What is attached to
//! it takes part: a publisher is heard as soon as a subscription elsewhere matches it, messages from
//! elsewhere come to subscriptions, and services work both ways.
//!
//! ```no_run
//! use std::time::Duration;
//!
//! use periplus_graph::{Graph, NodeSettings, Qos};
//! use periplus_dds::{Settings, Wire};
//!
//! // What the environment says is read with `Settings::from_environment(&host)`.
//! let wire = Wire::open(&Settings::default())?;
//!
//! // What others have, after they have had a moment to say so.
//! wire.wait_for(Duration::from_secs(2), |remote| remote.topic("/scan").is_some());
//! for topic in &wire.remote().topics {
//!     println!("{} {:?}", topic.name, topic.type_names);
//! }
//!
//! // Taking part: `ros2 topic echo`, in short.
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
//! A program that publishes once and ends calls [`Wire::flush`] before.

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

pub use error::WireError;
pub use periplus_cyclonedds_sys::{Guid, Vendor};
pub use remote::{Progress, Remote, RemoteEndpoint, RemoteNode, RemoteService, RemoteTopic};
pub use settings::{Range, Settings};
pub use wire::Wire;
