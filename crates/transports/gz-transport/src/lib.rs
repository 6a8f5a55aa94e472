//! Gazebo Transport: the protocol of `gz topic`, `gz service` and Gazebo's programs, without their
//! libraries.
//!
//! A [`Transport`] joins the network. Discovery uses multicast; topics and services use TCP with
//! ZeroMQ framing. A [`GzBridge`] bridges topics of a graph.
//!
//! ```no_run
//! use periplus_gz_msgs::{Boolean, Message};
//! use periplus_resources::MemoryHost;
//! use periplus_gz_transport::{Settings, Transport};
//!
//! let (settings, _) = Settings::from_environment(&MemoryHost::default());
//! let transport = Transport::open(&settings)?;
//! let publisher = transport.advertise("/lamp", "gz.msgs.Boolean")?;
//! publisher.publish(Boolean::from(true).encode());
//! # Ok::<(), periplus_gz_transport::GzTransportError>(())
//! ```
//!
//! Source: the wire protocol of `gz-transport` 11 to 14, discovery version 10, and ZMTP 3.0
//! (`rfc.zeromq.org/spec/23`).

mod convert;
mod error;
mod link;
mod names;
mod outgoing;
mod settings;
mod transport;

pub use convert::{gazebo_types, ros_types};
pub use error::{GzTransportError, ServiceCallError};
pub use link::{BridgeDirection, GzBridge, TopicPair, TopicPairError};
pub use names::{MOST_NAME, Name};
pub use settings::{DiscoveryReach, Settings};
pub use transport::{
    Advertisement, GzPublisher, GzService, GzSubscription, ReceivedMessage, ServiceReply,
    ServiceRequest, Transport, fuzz_discovery, fuzz_frames,
};
