//! Exact rays against everything a robot's sensors may meet.
//!
//! Shapes in, rays out: a [`World`] holds fixed triangles, moving meshes, primitives with closed
//! forms, and height fields; it answers what a [`Ray`] meets first, one at a time or many.
//!
//! ```
//! use periplus_geometry::{DVec3, Pose};
//! use periplus_raycast::{Filter, Ray, Shape, Tags, World};
//!
//! let mut builder = World::builder();
//! let ball = Shape::Sphere { radius_m: 0.1 };
//! builder.add_shape(&ball, &Pose::from_xyz(1.0, 0.0, 0.0), Tags::default())?;
//! let world = builder.build(1)?;
//! let hit = world.cast(&Ray::new(DVec3::ZERO, DVec3::X), Filter::default());
//! assert!(hit.is_some_and(|hit| (hit.distance_m - 0.9).abs() < 1e-12));
//! # Ok::<(), periplus_raycast::BadInstance>(())
//! ```
//!
//! No ray slips between triangles that share an edge; how is told at the triangle test in
//! `src/triangle.rs`. What was tried for speed, and what came of it: `EXPERIMENTS.md`.

mod bvh;
mod eight;
mod heightfield;
mod local;
mod mesh;
mod packet;
mod quadric;
mod ray;
mod shape;
mod simd;
mod triangle;
mod walk;
mod wide;
mod world;

pub use heightfield::{BadHeightfield, Heightfield};
pub use mesh::{MeshError, TriangleMesh};
pub use ray::{Hit, InstanceId, Ray};
pub use shape::{BadSize, Shape};
pub use world::{BadChange, BadInstance, Filter, Tags, World, WorldBuilder};
