//! Simultaneous localization and mapping from flat laser scans.
//!
//! [`Slam::add_scan`] takes a scan and where odometry has the robot, and tells where the robot is.
//! Values in, values out: no clock, no files, and the same input gives the same bits.
//!
//! The way of a scan:
//! 1. it becomes a cloud of points with the surfaces they lie on (`scan`);
//! 2. it is searched for and laid onto the scans just before (`local`), odometry being a prior whose
//!    trust is learnt (`odometry`);
//! 3. when the robot has moved enough it is kept: a pose in the graph, and an edge (`graph`);
//! 4. old scans nearby whose place is well known are tied to it directly (`near`);
//! 5. where the uncertainty has grown, loops are searched, doubted and believed (`loops`, `drift`);
//! 6. what odometry and scans say of each other is weighed, and told when it is odd (`diagnostics`);
//! 7. at the end all scans are held against their neighbours at once (`refine`), and drawn (`map`).
//!
//! [`Gmapping`] is another method behind the same interface, [`Mapper`]: particles with a map each.
//! Both take the parameters that programs of ROS have for them ([`tables`]).

// Worlds of the tests are written for the crate as others see it.
#[cfg(test)]
extern crate self as periplus_slam;

mod audit;
mod drift;
mod engine;
mod g2o;
mod gmapping;
mod graph;
mod keyframe;
mod local;
mod localizer;
mod loops;
mod map;
mod method;
mod mounting;
mod odometry_diagnostics;
mod odometry_monitor;
mod odometry_noise;
mod offsets;
mod proximity;
mod refine;
mod relations;
mod remark;
mod scan;
mod session;
mod settings;
pub mod tables;

pub use engine::{
    ConstraintKind, ConstraintResidual, Counts, MapContradiction, ScanOutcome, Slam, Update,
};
pub use gmapping::{Gmapping, GmappingSettings, Noise};
pub use localizer::Localizer;
pub use loops::Closure;
pub use map::{MapSnapshot, Plan, SnapshotRaster};
pub use method::{Mapper, Method};
pub use mounting::{CorrectedInput, MountingCorrection};
pub use relations::{Errors, Miss, Relation, Score, Stamped, misses, read_relations, score};
pub use remark::{Remark, RemarkKind};
pub use scan::Scan;
pub use session::{SESSION_MAGIC, SESSION_VERSION, SessionError};
pub use settings::Settings;
