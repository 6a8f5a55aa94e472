//! TF listener and message conversions shared by the ROS nodes.
//!
//! [`Frames`] is the buffer of `/tf` with a diagnosis of missing transforms. Messages wait for their
//! transforms in a [`MessageFilter`], scans in a [`ScanQueue`]. [`transform`] and [`pose`] convert to
//! messages. [`Told`] throttles log messages.

mod frames;
mod message_filter;
mod poses;
mod scan_queue;
mod scans;
mod told;

pub use frames::{Frames, plain};
pub use message_filter::{FilterOrder, FilterSettings, MessageFilter};
pub use poses::{pose, transform};
pub use scan_queue::{NO_SCANS, SCAN_TRANSFORM_TIMEOUT_NS, ScanQueue, TransformedScan};
pub use scans::{MissingTransform, RobotFrames, ScanTransforms, laser_scan, scan_transforms};
pub use told::Told;
