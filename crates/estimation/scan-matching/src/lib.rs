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
