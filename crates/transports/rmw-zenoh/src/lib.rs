//! Zenoh transport compatible with `rmw_zenoh`: connects a graph to ROS 2 programs on a Zenoh
//! network. It needs no ROS, but a Zenoh router, as `rmw_zenoh` does.
//!
//! Zenoh itself is some 200 crates, so it is built only with the feature `zenoh`; without it this
//! crate has the names: keys, liveliness tokens, attachments.
//!
#![cfg_attr(feature = "zenoh", doc = "```no_run")]
#![cfg_attr(not(feature = "zenoh"), doc = "```ignore")]
//! use std::time::Duration;
//!
//! use periplus_graph::{Graph, NodeSettings, Qos};
//! use periplus_rmw_zenoh::{Settings, ZenohTransport};
//!
//! let wire = ZenohTransport::open(&Settings::default())?;
//! let graph = Graph::live();
//! wire.attach(&graph)?;
//! let node = graph.node(NodeSettings::new("listener"))?;
//! let hash = "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828";
//! let of = "sensor_msgs/msg/LaserScan";
//! let scans = node.raw_mailbox("/scan", of, Some(hash), Qos::sensor_data())?;
//! wire.wait_for(Duration::from_secs(2), |others| !others.is_empty());
//! println!("{} scans", scans.drain().len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod attachment;
mod error;
pub mod qos;
mod settings;
pub mod token;

#[cfg(feature = "zenoh")]
mod link;
#[cfg(feature = "zenoh")]
mod outgoing;
#[cfg(feature = "zenoh")]
mod wire;

pub use error::ZenohError;
pub use settings::Settings;
pub use token::{End, EntityKind, EntityToken};
#[cfg(feature = "zenoh")]
pub use wire::ZenohTransport;
