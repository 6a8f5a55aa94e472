//! Conversion of scene shapes to ray-cast geometry.

use std::sync::Arc;

use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_raycast::{Heightfield, RaycastShape};
use periplus_scene::Shape;

use crate::asset_cache::AssetCache;
use crate::assets::AssetLoader;
use crate::heightmap::sample_heightmap;
use crate::mesh::SharedMesh;
use crate::outline::extrude;
use crate::render_scene::SensedGeometry;

/// Ray-cast geometry of a shape.
#[derive(Clone, Debug)]
pub(crate) enum RenderBody {
    Shape(RaycastShape),
    Mesh(Arc<SharedMesh>),
    Heightmap(Arc<Heightfield>),
}

/// A body, and its frame relative to the collision or visual.
#[derive(Clone, Debug)]
pub(crate) struct PlacedBody {
    pub(crate) shape_from_body: Pose,
    pub(crate) body: RenderBody,
}

/// Severity and reason of a shape without a body.
pub(crate) enum ShapeProblem {
    /// The file contains invalid values.
    Invalid(String),
    /// The shape is not supported or not available.
    Unsupported(String),
}
use ShapeProblem::{Invalid, Unsupported};

/// Returns the body of a shape; `None` for an empty shape.
pub(crate) fn body_of(
    shape: &Shape,
    geometry: SensedGeometry,
    shapes: &dyn AssetLoader,
    assets: &mut AssetCache,
) -> Result<Option<PlacedBody>, ShapeProblem> {
    let here = |body| Ok(Some(PlacedBody { shape_from_body: Pose::IDENTITY, body }));
    let form = |form| here(RenderBody::Shape(form));
    match shape {
        Shape::Empty => Ok(None),
        Shape::Box { size_m } => form(RaycastShape::Box { size_m: *size_m }),
        Shape::Sphere { radius_m } => form(RaycastShape::Sphere { radius_m: *radius_m }),
        Shape::Cylinder { radius_m, length_m } => {
            form(RaycastShape::Cylinder { radius_m: *radius_m, length_m: *length_m })
        }
        Shape::Capsule { radius_m, length_m } => {
            form(RaycastShape::Capsule { radius_m: *radius_m, length_m: *length_m })
        }
        Shape::Cone { radius_m, length_m } => {
            form(RaycastShape::Cone { radius_m: *radius_m, length_m: *length_m })
        }
        Shape::Ellipsoid { radii_m } => form(RaycastShape::Ellipsoid { radii_m: *radii_m }),
        Shape::Plane { normal, size_m } => {
            let Some(normal) = normal.try_normalize() else {
                return Err(Invalid("is a plane without a normal".into()));
            };
            // Infinite for collisions, bounded for visuals.
            let size_m = (geometry == SensedGeometry::Visual).then_some(*size_m);
            let rotation = DQuat::from_rotation_arc(DVec3::Z, normal);
            let shape_from_body = Pose { translation: DVec3::ZERO, rotation };
            Ok(Some(PlacedBody {
                shape_from_body,
                body: RenderBody::Shape(RaycastShape::Plane { size_m }),
            }))
        }
        Shape::Mesh(mesh) => {
            here(RenderBody::Mesh(assets.mesh(mesh, shapes).map_err(Unsupported)?))
        }
        Shape::Polylines(outlines) => {
            let selected = extrude(outlines).map_err(Invalid)?;
            here(RenderBody::Mesh(Arc::new(SharedMesh::new(selected))))
        }
        Shape::Heightmap(map) => {
            let unsupported =
                |why: String| Unsupported(format!("has a heightmap (`{}`) that {why}", map.uri));
            let samples =
                sample_heightmap(map, shapes).map_err(|error| unsupported(error.to_string()))?;
            let shape_from_body = samples.shape_from_heightmap;
            let body = RenderBody::Heightmap(samples.into_heightfield().map_err(unsupported)?);
            Ok(Some(PlacedBody { shape_from_body, body }))
        }
        // SDF's schema allows it, but neither Classic's `MapShape` nor any later Gazebo implements
        // it.
        Shape::Image(_) => Err(Unsupported(
            "is extruded from an image, which Gazebo does not support either".into(),
        )),
        Shape::Unknown(element) => {
            Err(Unsupported(format!("has a shape of unknown kind, <{}>", element.name)))
        }
    }
}
