//! Exact ray casting against the world that sensors measure.
//!
//! A [`RaycastWorld`] holds fixed triangles, movable meshes, primitives with closed forms, and height
//! fields. It returns the first hit of a [`Ray`], for single rays or batches.
//!
//! ```
//! use periplus_geometry::{DVec3, Pose};
//! use periplus_raycast::{Filter, Ray, RaycastShape, Tags, RaycastWorld};
//!
//! let mut builder = RaycastWorld::builder();
//! let ball = RaycastShape::Sphere { radius_m: 0.1 };
//! builder.add_shape(&ball, &Pose::from_xyz(1.0, 0.0, 0.0), Tags::default())?;
//! let world = builder.build(1)?;
//! let hit = world.cast(&Ray::new(DVec3::ZERO, DVec3::X), Filter::default());
//! assert!(hit.is_some_and(|hit| (hit.distance_m - 0.9).abs() < 1e-12));
//! # Ok::<(), periplus_raycast::InstanceError>(())
//! ```
//!
//! No ray passes between triangles that chunk an edge; `src/triangle.rs` gives the reason.
//! Experiments on speed and their results: `EXPERIMENTS.md`.

mod bvh;
mod double_double;
mod heightfield;
mod local_ray;
mod mesh;
mod packet;
mod quadric;
mod ray;
mod shape;
mod simd;
mod simd8;
mod traversal;
mod triangle;
mod world;

pub use heightfield::{Heightfield, HeightfieldError};
pub use mesh::{TriangleMesh, TriangleMeshError};
pub use ray::{Hit, InstanceId, Ray};
pub use shape::{RaycastShape, ShapeSizeError};
pub use world::{
    Filter, InstanceChangeError, InstanceError, RaycastWorld, RaycastWorldBuilder, Tags,
};
