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
//!
//! ```
//! use periplus_geometry::{LaserScan2, Pose2, ScannerMounting};
//! use periplus_slam::{Settings, Slam};
//!
//! // A robot without odometry drives 1 m along a room of 6 m by 4 m.
//! let mut slam = Slam::new(Settings::default());
//! for step in 0..=10_u16 {
//!     let ranges_m = (0..360_u16).map(|beam| {
//!         let (sin, cos) = f32::from(beam).to_radians().sin_cos();
//!         ((3.0 * cos.signum() - 0.1 * f32::from(step)) / cos).min(2.0 / sin.abs())
//!     });
//!     let scan = LaserScan2 { time_ns: 100_000_000 * i64::from(step), ranges_m: ranges_m.collect(),
//!         mounting: ScannerMounting::upright(Pose2::IDENTITY), angle_min_rad: 0.0, range_min_m: 0.1,
//!         angle_increment_rad: 0.0174533, time_increment_s: 0.0, range_max_m: 10.0 };
//!     slam.add_scan(&scan, None);
//! }
//! assert!((slam.map_from_base().x_m - 1.0).abs() < 0.02);
//! ```

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
mod memory;
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
pub use method::{AnyMapper, Mapper, Method};
pub use mounting::{CorrectedInput, MountingCorrection};
pub use relations::{Errors, Miss, Relation, Score, Stamped, misses, read_relations, score};
pub use remark::{Remark, RemarkKind};
pub use session::{SESSION_MAGIC, SESSION_VERSION, SessionError};
pub use settings::Settings;
