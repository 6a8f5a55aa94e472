//! Where scans fit.
//!
//! A [`Cloud`] holds the points of one scan with the surfaces they lie on, and answers what is near
//! and what was seen along a bearing. [`register`] moves a cloud onto others from a good start, and
//! tells how sure it is, in which directions. A [`Field`] is the likelihood of points over a window,
//! and [`Field::search`] finds the best place in all of a window, with certainty: no start is needed.
//! [`agreement`] tells whether two scans can be of the same place at all: points must not lie where
//! the other saw through. A [`PackedCloud`] waits in few bytes.
//!
//! All is plain computation on one thread: the same input gives the same bits.

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
pub use field::{Field, FieldSettings};
pub use packed::{PackedCloud, PackedPlaces};
pub use register::{Comparison, Fit, Placed, Prior, RegisterSettings, compare, register};
pub use search::{Peak, Wanted, Window};
pub use symmetric::Symmetric3;
