//! The transform tree, as `view_frames` of `tf2_tools` draws it: Graphviz text, SVG and PDF
//! (without Graphviz); and the faults of the tree.
//!
//! ```
//! use periplus_geometry::Pose;
//! use periplus_ros2cli::frames::Forest;
//! use periplus_tf::{TransformKind, StampedTransform, TransformMonitor};
//!
//! let mut survey = TransformMonitor::default();
//! let laser = StampedTransform::new("base_link", "laser", 0, Pose::from_xyz(0.2, 0.0, 0.1));
//! survey.insert(&laser, "/robot_state_publisher", TransformKind::Fixed)?;
//! let forest = Forest::new(&survey);
//! assert_eq!(forest.roots().collect::<Vec<_>>(), ["base_link"]);
//! assert!(forest.faults().is_empty());
//! assert!(forest.dot("12.0").contains(r#""base_link" -> "laser""#));
//! # Ok::<(), periplus_tf::RejectedTransform>(())
//! ```

mod dot;
mod drawing;
mod faults;
mod forest;
mod layout;
mod pdf;
mod svg;
mod widths;

pub use faults::TreeFault;
pub use forest::{Edge, Forest, Frame};
