//! Transform buffer with the behaviour of tf2: caching, interpolation between samples, lookup along
//! chains of frames, and the error messages.
//!
//! Times are nanoseconds. As in tf2, time 0 requests the latest common time of all frames of a
//! chain.
//!
//! ```
//! use periplus_geometry::Pose;
//! use periplus_tf::{Buffer, TransformKind, StampedTransform};
//!
//! let mut buffer = Buffer::default();
//! let at = |stamp_ns, x_m| StampedTransform::new("odom", "base_link", stamp_ns, Pose::from_xyz(x_m, 0.0, 0.0));
//! buffer.set(&at(1_000_000_000, 1.0), "wheels", TransformKind::Moving)?;
//! buffer.set(&at(2_000_000_000, 2.0), "wheels", TransformKind::Moving)?;
//! let found = buffer.lookup("odom", "base_link", 1_500_000_000)?;
//! assert_eq!(found.target_from_source.translation.x, 1.5);
//! let missing = buffer.lookup("odom", "base_link", 3_000_000_000).unwrap_err();
//! assert!(missing.to_string().contains("extrapolation into the future"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod buffer;
mod cache;
mod error;
mod monitor;
mod text;
mod walk;

pub use buffer::{
    Buffer, CACHE_NS, FrameStatus, ResolvedTransform, StampedTransform, TransformKind,
    TransformLookup,
};
pub use cache::{TransformCache, TransformSample};
pub use error::{LookupError, LookupErrorKind, RejectedTransform};
pub use monitor::{PublishedParent, TransformMonitor};
pub use text::display_time;
