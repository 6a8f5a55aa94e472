//! TF listener and message conversions shared by the ROS nodes.
//!
//! [`Frames`] is the buffer of `/tf` with a diagnosis of missing transforms. Messages wait for their
//! transforms in a [`MessageFilter`], scans in a [`ScanQueue`]. [`transform`] and [`pose`] convert to
//! messages. [`LogThrottle`] throttles log messages.
//!
//! ```
//! use periplus_geometry::Pose;
//! use periplus_tf::TransformKind;
//! use periplus_tf_ros::{Frames, transform};
//!
//! let mut frames = Frames::default();
//! let message = transform("odom", "base_link", Pose::from_xyz(1.0, 0.0, 0.0), 20_000_000);
//! frames.take(&message, TransformKind::Moving);
//! let (odom_from_base, time_ns) = frames.at("odom", "base_link", 0)?;
//! assert_eq!((odom_from_base.translation.x, time_ns), (1.0, 20_000_000));
//! assert!(frames.missing("map", "base_link").contains("`map` is not published"));
//! # Ok::<(), periplus_tf::LookupError>(())
//! ```

mod frames;
mod log_throttle;
mod message_filter;
mod poses;
mod scan_queue;
mod scans;

pub use frames::{Frames, plain};
pub use log_throttle::LogThrottle;
pub use message_filter::{FilterOrder, FilterSettings, MessageFilter};
pub use poses::{InvalidPose, pose, pose_with_covariance, pose2, transform};
pub use scan_queue::{NO_SCANS, SCAN_TRANSFORM_TIMEOUT_NS, ScanQueue, TransformedScan};
pub use scans::{MissingTransform, RobotFrames, ScanTransforms, laser_scan, scan_transforms};
