//! Helpers shared by the tests.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]
#![allow(dead_code, reason = "not every test uses all of it")]

use periplus_geometry::{DVec3, Pose, Stream};
use periplus_raycast::{RaycastWorld, Tags};

/// Triangles.
#[derive(Default)]
pub(crate) struct Solid {
    pub(crate) positions_m: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// A world of these triangles only.
pub(crate) fn fixed(solid: &Solid) -> RaycastWorld {
    let mut builder = RaycastWorld::builder();
    builder
        .add_fixed(&solid.positions_m, &solid.triangles, &Pose::IDENTITY, Tags::default())
        .unwrap();
    builder.build(1).unwrap()
}

/// A direction with uniform distribution on the sphere (by Archimedes: uniform height and angle).
pub(crate) fn unit(stream: &mut Stream) -> DVec3 {
    let z = 2.0 * stream.unit() - 1.0;
    let (sine, cosine) = libm::sincos(std::f64::consts::TAU * stream.unit());
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * cosine, r * sine, z)
}
