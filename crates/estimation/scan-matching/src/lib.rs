//! Scan matching: registration of scans with each other and with likelihood fields.
//!
//! - [`Cloud`]: the points of one scan with their surface normals, with lookups of nearest points
//!   and of the surface seen along a bearing.
//! - [`register`]: local registration of clouds from a good initial pose, with the information
//!   matrix of the result.
//! - [`ScoreField`]: the likelihood of points over a window; [`ScoreField::search`] finds the best pose in a
//!   window with certainty, without an initial pose.
//! - [`agreement`]: whether two scans can be of the same scene, since points of one must not be in
//!   space that the other saw as free.
//! - [`PackedCloud`]: a cloud in compressed form.
//!
//! Computation on one thread: the same input gives the same bits.
//!
//! ```
//! use periplus_geometry::Pose2;
//! use periplus_scan_matching::{Cloud, CloudSettings, Placed, RegisterSettings, register};
//!
//! // Two scans of a room of 6 m by 4 m; the second one is measured 0.2 m farther along x.
//! let scan = |x_m: f32| {
//!     let end = |beam: u16| {
//!         let (sin, cos) = f32::from(beam).to_radians().sin_cos();
//!         let range_m = ((3.0 * cos.signum() - x_m) / cos).min(2.0 / sin.abs());
//!         Some([range_m * cos, range_m * sin])
//!     };
//!     Cloud::new((0..360).map(end), [0.0; 2], 1_f32.to_radians(), &CloudSettings::default())
//! };
//! let (first, second) = (scan(0.0), scan(0.2));
//! let (target, moving) = ([Placed::alone(&first)], [Placed::alone(&second)]);
//! let fit = register(&moving, &target, Pose2::IDENTITY, None, &RegisterSettings::default());
//! assert!((fit.target_from_moving.x_m - 0.2).abs() < 0.01);
//! ```

mod agreement;
mod cloud;
mod field;
mod packed;
mod register;
mod search;
mod surface;
mod symmetric;

pub use agreement::{Agreement, agreement};
pub use cloud::{Cloud, CloudSettings, Point};
pub use field::{FieldSettings, ScoreField};
pub use packed::{PackedCloud, PackedPlaces};
pub use register::{Comparison, Fit, Placed, Prior, RegisterSettings, compare, register};
pub use search::{Peak, Wanted, Window};
pub use symmetric::Symmetric3;
