//! Simultaneous localization and mapping (SLAM) with 2D laser scans.
//!
//! [`Slam::add_scan`] takes a scan and the odometry pose and returns the corrected pose of the robot. The
//! crate uses no clock and no files; equal input gives equal output, bit for bit.
//!
//! Processing of a scan:
//! 1. The scan becomes a point cloud with surface normals (`scan`).
//! 2. It is matched against the last keyframes (`local`) with odometry as the prior, weighted by the
//!    learned odometry noise (`odometry_noise`).
//! 3. After enough motion it becomes a keyframe: a pose and a sequential constraint in the graph (`graph`).
//! 4. Old keyframes nearby with a well-known relative pose get a proximity constraint (`proximity`).
//! 5. Where the uncertainty has grown (`drift`), loop closures are searched, verified and decided
//!    (`loops`).
//! 6. Odometry is compared with the scans, and faults are reported (`odometry_diagnostics`).
//! 7. At the end all keyframes are refined together (`refine`) and the map is drawn (`map`).
//!
//! [`Gmapping`] is a second method with the same interface, [`Mapper`]: a Rao-Blackwellized particle
//! filter. Both accept the parameters of the corresponding ROS nodes ([`tables`]).

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
pub use session::{SESSION_MAGIC, SESSION_VERSION, SessionError};
pub use settings::Settings;
