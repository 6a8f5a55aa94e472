//! From a shape of a scene to what rays meet.

use std::sync::Arc;

use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_raycast::{Heightfield, Shape as Form};
use periplus_scene::Shape;

use crate::ground::ground;
use crate::mesh::Prepared;
use crate::outline::extrude;
use crate::shapes::Shapes;
use crate::store::Store;
use crate::surroundings::Geometry;

/// What rays meet.
#[derive(Clone, Debug)]
pub(crate) enum Body {
    Form(Form),
    Mesh(Arc<Prepared>),
    Ground(Arc<Heightfield>),
}

/// A body, and its frame in that of the collision or visual.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    pub(crate) shape_from_body: Pose,
    pub(crate) body: Body,
}

/// How bad it is that there is no body.
pub(crate) enum Problem {
    /// The file says what cannot be.
    Impossible(String),
    /// It cannot be shown here, or not now.
    Unseen(String),
}
use Problem::{Impossible, Unseen};

/// The body of a shape; none where the shape is empty.
pub(crate) fn body_of(
    shape: &Shape,
    geometry: Geometry,
    shapes: &dyn Shapes,
    store: &mut Store,
) -> Result<Option<Placed>, Problem> {
    let here = |body| Ok(Some(Placed { shape_from_body: Pose::IDENTITY, body }));
    let form = |form| here(Body::Form(form));
    match shape {
        Shape::Empty => Ok(None),
        Shape::Box { size_m } => form(Form::Box { size_m: *size_m }),
        Shape::Sphere { radius_m } => form(Form::Sphere { radius_m: *radius_m }),
        Shape::Cylinder { radius_m, length_m } => {
            form(Form::Cylinder { radius_m: *radius_m, length_m: *length_m })
        }
        Shape::Capsule { radius_m, length_m } => {
            form(Form::Capsule { radius_m: *radius_m, length_m: *length_m })
        }
        Shape::Cone { radius_m, length_m } => {
            form(Form::Cone { radius_m: *radius_m, length_m: *length_m })
        }
        Shape::Ellipsoid { radii_m } => form(Form::Ellipsoid { radii_m: *radii_m }),
        Shape::Plane { normal, size_m } => {
            let Some(normal) = normal.try_normalize() else {
                return Err(Impossible("is a plane without a normal".into()));
            };
            // Endless to touch, of a size to see.
            let size_m = (geometry == Geometry::Visual).then_some(*size_m);
            let rotation = DQuat::from_rotation_arc(DVec3::Z, normal);
            let shape_from_body = Pose { translation: DVec3::ZERO, rotation };
            Ok(Some(Placed { shape_from_body, body: Body::Form(Form::Plane { size_m }) }))
        }
        Shape::Mesh(mesh) => here(Body::Mesh(store.mesh(mesh, shapes).map_err(Unseen)?)),
        Shape::Polylines(outlines) => {
            let selected = extrude(outlines).map_err(Impossible)?;
            here(Body::Mesh(Arc::new(Prepared::new(selected))))
        }
        Shape::Heightmap(map) => {
            let tell = |why| Unseen(format!("has a ground (`{}`) that {why}", map.uri));
            let ground = ground(map, shapes).map_err(tell)?;
            let shape_from_body = ground.shape_from_ground;
            let body = Body::Ground(ground.field().map_err(tell)?);
            Ok(Some(Placed { shape_from_body, body }))
        }
        // The schema knows it; neither Classic's `MapShape` nor any later Gazebo makes anything
        // of it.
        Shape::Image(_) => {
            Err(Unseen("is extruded from an image, which Gazebo does not show either".into()))
        }
        Shape::Unknown(element) => {
            Err(Unseen(format!("has a shape of unknown kind, <{}>", element.name)))
        }
    }
}
