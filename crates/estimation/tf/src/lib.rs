//! Where frames were, at which time, as tf2 has it: what is kept and for how long, what lies between
//! two samples, which chain leads from one frame to another, and what is said when there is none.
//!
//! Times are nanoseconds. As in tf2, time 0 asks for the newest time that all frames of a chain have
//! in common.
//!
//! ```
//! use periplus_geometry::Pose;
//! use periplus_tf::{Buffer, Kind, Stamped};
//!
//! let mut buffer = Buffer::default();
//! let at = |stamp_ns, x_m| Stamped::new("odom", "base_link", stamp_ns, Pose::from_xyz(x_m, 0.0, 0.0));
//! buffer.set(&at(1_000_000_000, 1.0), "wheels", Kind::Moving)?;
//! buffer.set(&at(2_000_000_000, 2.0), "wheels", Kind::Moving)?;
//! let found = buffer.lookup("odom", "base_link", 1_500_000_000)?;
//! assert_eq!(found.target_from_source.translation.x, 1.5);
//! let missing = buffer.lookup("odom", "base_link", 3_000_000_000).unwrap_err();
//! assert!(missing.to_string().contains("extrapolation into the future"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod buffer;
mod cache;
mod error;
mod survey;
mod text;
mod walk;

pub use buffer::{Buffer, CACHE_NS, Found, Kept, Kind, Lookup, Stamped};
pub use cache::{Sample, Samples};
pub use error::{LookupError, Refused, Unreachable};
pub use survey::{Parent, Survey};
pub use text::display_time;
