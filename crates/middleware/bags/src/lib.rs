//! Reading and writing of bags: MCAP with the ROS 2 profile, and ROS 1.
//!
//! A [`Writer`] creates MCAP files with the profile of ROS 2, which `ros2 bag`, Foxglove and
//! Lichtblick open; [`BagInfo`] is the content of `metadata.yaml`. A [`Reader`] returns the
//! messages of any MCAP file and of ROS 1 bags in the order of time, also from truncated files. A
//! [`Ros1Writer`] creates ROS 1 bags, and a [`Translation`] converts messages between the two. These
//! work on sinks and sources; the module `files`, a default feature, opens bags on disk, databases
//! included, and connects them to a graph.
//!
//! ```
//! use periplus_bags::{QosProfile, Settings, Stamp, Topic, Writer};
//! use periplus_msgs::{Message, geometry_msgs::Twist};
//!
//! let mut bag = Writer::new(Vec::new(), Settings::new("run.mcap"))?;
//! let topic = bag.topic(Topic::of::<Twist>("/cmd_vel", &[QosProfile::reliable(10)]))?;
//! bag.write(topic, Stamp::at(20_000_000), &Twist::default().to_cdr()?)?;
//! let (bytes, info) = bag.finish()?;
//! assert_eq!(info.messages(), 1);
//! assert!(bytes.starts_with(b"\x89MCAP0\r\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! File format: the MCAP specification, version 1 (mcap.dev); ROS 2 profile: `ros2/rosbag2`,
//! packages `rosbag2_storage` and `rosbag2_storage_mcap`.

mod carmen;
mod check;
mod compression;
#[cfg(feature = "files")]
pub mod files;
mod metadata;
mod qos;
mod read;
mod record;
mod repair;
mod ros1;
mod translate;
mod write;
mod zstandard;

pub use carmen::{
    CarmenLog, CarmenOdometry, CarmenScan, CarmenScanKind, is_carmen, read_carmen, read_carmen_from,
};
pub use check::{Fault, check};
pub use compression::Compression;
pub use metadata::{BagInfo, FileInfo, Metadata, Stored, Style, TopicInformation, read_metadata};
pub use qos::{Durability, History, Liveliness, QosProfile, Reliability};
pub use read::{BagTopic, Limits, Message, Messages, OwnMessages, ReadError, Reader, Selection};
pub use repair::{RepairError, repair};
pub use ros1::{Ros1Compression, Ros1Settings, Ros1Writer};
pub use translate::{Target, Translation};
pub use write::{Settings, Stamp, Topic, TopicId, WriteError, Writer};
