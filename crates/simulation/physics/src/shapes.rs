//! Collision shapes.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_scene::{Collision, Heightmap, MeshShape, Polyline, Shape};
use rapier3d_f64::geometry::SharedShape;
use rapier3d_f64::math::Vector;
use rapier3d_f64::parry::utils::Array2;

use crate::build::rapier_pose;
use crate::hull::{Simplified, hull_of};
use crate::limits::{MAX_SIZE_M, is_within};
use crate::outline::pieces;

/// Triangles of a mesh, scaled and in the mesh's own frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Corners [m].
    pub points_m: Vec<DVec3>,
    /// Three corner indices each, counterclockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Terrain heights over a rectangle centred on the shape's frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heights {
    /// Samples along x, at least two.
    pub columns: usize,
    /// Samples along y, at least two.
    pub rows: usize,
    /// Heights [m], row by row from the lowest y.
    pub heights_m: Vec<f64>,
    /// Lengths of the rectangle along x and y [m].
    pub size_m: [f64; 2],
}

/// Provides meshes and heightmaps of files to code that must not read files.
pub trait Meshes {
    /// Returns the triangles of a mesh, submesh and scale applied; `None` if it could not be read.
    fn triangles(&self, mesh: &MeshShape) -> Option<Triangles>;
    /// Returns the heights of a heightmap; `None` if it could not be read.
    fn heights(&self, heightmap: &Heightmap) -> Option<Heights>;
}

/// A provider without files.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoMeshes;

impl Meshes for NoMeshes {
    fn triangles(&self, _: &MeshShape) -> Option<Triangles> {
        None
    }

    fn heights(&self, _: &Heightmap) -> Option<Heights> {
        None
    }
}

/// A solver's shape and its frame in the collision's.
pub(crate) type PlacedShape = (Pose, SharedShape);

/// Returns the solver's shape of a collision; reports a problem and returns `None` without one.
pub(crate) fn shape(
    collision: &Collision,
    name: &str,
    moves: bool,
    meshes: &dyn Meshes,
    diagnostics: &mut Diagnostics,
) -> Option<PlacedShape> {
    let mut hints = Vec::new();
    let made = make(&collision.shape, moves, meshes, &mut hints);
    for hint in hints {
        diagnostics.push(
            Diagnostic::hint("mesh-simplified", format!("collision `{name}` {hint}"))
                .at(collision.origin)
                .help("use a simpler mesh, or boxes, cylinders and spheres, for collisions"),
        );
    }
    let (severity, message) = match made {
        Ok(shape) => return shape,
        Err(problem) => problem,
    };
    let diagnostic = match severity {
        Invalid => Diagnostic::error("shape-impossible", format!("collision `{name}` {message}")),
        Unsupported => Diagnostic::warning(
            "shape-not-simulated",
            format!("collision `{name}` {message}; it has no contacts"),
        ),
    };
    diagnostics.push(diagnostic.at(collision.origin));
    None
}

enum ShapeIssue {
    Invalid,
    Unsupported,
}
use ShapeIssue::{Invalid, Unsupported};

fn make(
    shape: &Shape,
    moves: bool,
    meshes: &dyn Meshes,
    hints: &mut Vec<String>,
) -> Result<Option<PlacedShape>, (ShapeIssue, String)> {
    let here = |shape| Ok(Some((Pose::IDENTITY, shape)));
    // parry's cylinders and cones have their axis along y.
    let upright = |shape| {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let z_from_y = DQuat::from_xyzw(half, 0.0, 0.0, half);
        Ok(Some((Pose { translation: DVec3::ZERO, rotation: z_from_y }, shape)))
    };
    match shape {
        Shape::Empty => Ok(None),
        Shape::Box { size_m } => {
            let half = positive(*size_m)? / 2.0;
            here(SharedShape::cuboid(half.x, half.y, half.z))
        }
        Shape::Sphere { radius_m } => here(SharedShape::ball(positive_1(*radius_m)?)),
        Shape::Cylinder { radius_m, length_m } => {
            upright(SharedShape::cylinder(positive_1(*length_m)? / 2.0, positive_1(*radius_m)?))
        }
        Shape::Cone { radius_m, length_m } => {
            upright(SharedShape::cone(positive_1(*length_m)? / 2.0, positive_1(*radius_m)?))
        }
        Shape::Capsule { radius_m, length_m } => {
            here(SharedShape::capsule_z(positive_1(*length_m)? / 2.0, positive_1(*radius_m)?))
        }
        Shape::Ellipsoid { radii_m } => {
            let radii = positive(*radii_m)?;
            if radii.min_element() == radii.max_element() {
                return here(SharedShape::ball(radii.x));
            }
            let points: Vec<Vector> = sphere_points().into_iter().map(|p| p * radii).collect();
            hull(&points)
        }
        Shape::Plane { normal, .. } => {
            if moves {
                return Err((Unsupported, "is an infinite plane on a movable body".into()));
            }
            let length = normal.length();
            if !(length.is_finite() && length > 0.0) {
                return Err((Invalid, "is a plane without a normal".into()));
            }
            here(SharedShape::halfspace(*normal / length))
        }
        Shape::Mesh(mesh) => {
            let Some(triangles) = meshes.triangles(mesh) else {
                return Err((
                    Unsupported,
                    format!("has a mesh (`{}`) that was not read", mesh.uri),
                ));
            };
            mesh_shape(triangles, moves, hints)
        }
        Shape::Heightmap(map) => {
            let Some(heights) = meshes.heights(map) else {
                return Err((
                    Unsupported,
                    format!("has a heightmap (`{}`) that was not read", map.uri),
                ));
            };
            ground(&heights)
        }
        Shape::Polylines(outlines) => prism(outlines),
        Shape::Image(_) => Err((Unsupported, "is extruded from an image".into())),
        Shape::Unknown(element) => {
            Err((Unsupported, format!("has a shape of unknown kind, <{}>", element.name)))
        }
    }
}

fn positive(size: DVec3) -> Result<DVec3, (ShapeIssue, String)> {
    if is_within(size, MAX_SIZE_M) && size.min_element() > 0.0 {
        return Ok(size);
    }
    Err((Invalid, format!("has a size that is not positive, or more than {MAX_SIZE_M} m")))
}

fn positive_1(size: f64) -> Result<f64, (ShapeIssue, String)> {
    positive(DVec3::splat(size)).map(|size| size.x)
}

fn mesh_shape(
    mesh: Triangles,
    moves: bool,
    hints: &mut Vec<String>,
) -> Result<Option<PlacedShape>, (ShapeIssue, String)> {
    let Triangles { points_m, triangles } = &mesh;
    let count = points_m.len();
    let sound = points_m.iter().all(|&point| is_within(point, MAX_SIZE_M))
        && triangles.iter().flatten().all(|&corner| (corner as usize) < count);
    if !sound || triangles.is_empty() {
        return Err((Invalid, "has a mesh without triangles, or with broken ones".into()));
    }
    if moves {
        let Some(hull) = hull_of(&mesh) else { return Err((Invalid, FLAT.into())) };
        hints.extend(hull.simplified.map(|found| simplification(mesh.triangles.len(), found)));
        return Ok(Some((Pose::IDENTITY, hull.shape)));
    }
    let Triangles { points_m, triangles } = mesh;
    match SharedShape::trimesh(points_m, triangles) {
        Ok(shape) => Ok(Some((Pose::IDENTITY, shape))),
        Err(error) => Err((Invalid, format!("has a mesh that cannot be used: {error}"))),
    }
}

fn prism(outlines: &[Polyline]) -> Result<Option<PlacedShape>, (ShapeIssue, String)> {
    let pieces = pieces(outlines).map_err(|why| (Invalid, why))?;
    // A piece without volume, between nearly equal corners, has no contacts.
    let hulls = pieces.iter().filter_map(|corners| SharedShape::convex_hull(corners));
    let parts: Vec<_> = hulls.map(|hull| (rapier_pose(Pose::IDENTITY), hull)).collect();
    if parts.is_empty() {
        return Err((Invalid, "encloses nothing".into()));
    }
    Ok(Some((Pose::IDENTITY, SharedShape::compound(parts))))
}

fn hull(points: &[Vector]) -> Result<Option<PlacedShape>, (ShapeIssue, String)> {
    match SharedShape::convex_hull(points) {
        Some(shape) => Ok(Some((Pose::IDENTITY, shape))),
        None => Err((Invalid, FLAT.into())),
    }
}

const FLAT: &str = "is flat: it has no convex hull";

/// Describes a simplified hull.
fn simplification(triangles: usize, found: Simplified) -> String {
    let Simplified { points_before, points_after, cut_off_m, volume_error } = found;
    let volume = volume_error
        .map_or("the mesh is open, so its volume is unknown".into(), |error| {
            format!("its volume differs from the mesh's by {:+.2} %", error * 100.0)
        });
    format!(
        "has a mesh of {triangles} triangles and {points_before} points; the convex hull of \
         {points_after} of them is used: the mesh exceeds it by up to {:.2} mm, and {volume}",
        cut_off_m * 1e3
    )
}

fn ground(heights: &Heights) -> Result<Option<PlacedShape>, (ShapeIssue, String)> {
    let Heights { columns, rows, heights_m, size_m: [x, y] } = heights;
    let sound = *columns >= 2
        && *rows >= 2
        && columns.checked_mul(*rows) == Some(heights_m.len())
        && heights_m.iter().all(|height| height.abs() <= MAX_SIZE_M);
    if !sound {
        return Err((Invalid, "has a heightmap of fewer than two by two finite heights".into()));
    }
    let size = positive(DVec3::new(*x, *y, 1.0))?;
    // parry's height field is over x and z with y up: its z is our -y.
    let mut ordered = Vec::with_capacity(heights_m.len());
    for column in 0..*columns {
        ordered.extend((0..*rows).rev().map(|row| heights_m[row * columns + column]));
    }
    let shape = SharedShape::heightfield(
        Array2::new(*rows, *columns, ordered),
        Vector::new(size.x, 1.0, size.y),
    );
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let z_from_y = DQuat::from_xyzw(half, 0.0, 0.0, half);
    Ok(Some((Pose { translation: DVec3::ZERO, rotation: z_from_y }, shape)))
}

/// 162 points on a unit sphere: rings of 20 at 8 latitudes, and the poles.
fn sphere_points() -> Vec<DVec3> {
    let mut points = vec![DVec3::Z, DVec3::NEG_Z];
    for ring in 1..=8 {
        let (sine, cosine) = libm::sincos(std::f64::consts::PI * f64::from(ring) / 9.0);
        for step in 0..20 {
            let (y, x) = libm::sincos(std::f64::consts::TAU * f64::from(step) / 20.0);
            points.push(DVec3::new(sine * x, sine * y, cosine));
        }
    }
    points
}
