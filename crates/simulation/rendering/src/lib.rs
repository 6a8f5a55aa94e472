//! What rays see of a scene.
//!
//! [`Surroundings`] puts the collision or the visual shapes of a world into one
//! [`raycast::World`](periplus_raycast::World), moves them with their links, and tells of every hit
//! what it is: model, link, colour, brightness to a laser, label. [`Surroundings::take`] takes
//! pictures: colour, depth and labels in one pass, with lights and shadows. Shapes of files come from
//! [`Shapes`], so nothing here reads a file.
//!
//! ```
//! use periplus_geometry::{DVec3, Pose};
//! use periplus_rendering::{Geometry, NoShapes, Surroundings};
//! use periplus_raycast::{Filter, Ray};
//! use periplus_scene::{Collision, Link, Model, Shape};
//!
//! let mut ball = Link::new("ball");
//! ball.collisions.push(Collision::new("round", Shape::Sphere { radius_m: 0.1 }));
//! let mut model = Model::new("toy");
//! model.links.push(ball);
//!
//! let mut surroundings = Surroundings::empty(Geometry::Collision, 1);
//! let parts = surroundings.add(&model, Pose::from_xyz(1.0, 0.0, 0.0), &NoShapes);
//! let ray = Ray::new(DVec3::ZERO, DVec3::X);
//! let hit = surroundings.rays().cast(&ray, Filter::default()).expect("a hit");
//! assert!((hit.distance_m - 0.9).abs() < 1e-12);
//! assert_eq!(surroundings.surface(&hit).link, "ball");
//!
//! surroundings.place(&[(parts.parts[0], Pose::from_xyz(2.0, 0.0, 0.0))]);
//! let hit = surroundings.rays().cast(&ray, Filter::default()).expect("a hit");
//! assert!((hit.distance_m - 1.9).abs() < 1e-12);
//! ```

mod body;
mod ground;
mod label;
mod lens;
mod light;
mod look;
mod mesh;
mod outline;
mod picture;
mod shapes;
mod store;
mod surroundings;
mod walk;

pub use ground::{Ground, ground};
pub use lens::Lens;
pub use mesh::{Selected, select};
pub use periplus_images::{BadImage, Grey, Image};
pub use picture::{Picture, Shot, Wanted};
pub use shapes::{NoShapes, Shapes};
pub use surroundings::{
    Geometry, ModelGroup, ModelId, PartId, Parts, SHADOW_MASK, Surface, Surroundings, filter,
};
