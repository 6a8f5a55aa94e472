//! Convex hulls of movable meshes, from a bounded number of points.
//!
//! Time and memory of a hull grow with the square of the number of its corners: the 8,192 points of
//! a smooth mesh took 4 s and 2.4 GB. Larger meshes are reduced to the extreme points in
//! [`DIRECTIONS`] directions, spread evenly over the sphere.

use periplus_geometry::DVec3;
use rapier3d_f64::geometry::SharedShape;

use crate::shapes::Triangles;

/// Maximum number of points that are used without reduction.
const MAX_POINTS: usize = 1_000;
/// Number of directions in which a larger mesh keeps its extreme points. Neighbours are 6.4 degrees
/// apart, so a sphere is approximated to 0.2 % of its radius.
const DIRECTIONS: u32 = 1_000;
/// Number of directions for measuring the error of the reduction.
const CHECKED_DIRECTIONS: u32 = 500;

/// A hull, and the error of its reduction.
pub(crate) struct Hull {
    pub(crate) shape: SharedShape,
    pub(crate) simplified: Option<Simplified>,
}

/// Accuracy of a hull of reduced points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Simplified {
    pub(crate) points_before: usize,
    pub(crate) points_after: usize,
    /// Maximum distance of the mesh from the hull, over the tested directions [m].
    pub(crate) cut_off_m: f64,
    /// Relative error of the volume; `None` for an open mesh.
    pub(crate) volume_error: Option<f64>,
}

/// Returns the convex hull of a mesh; `None` for a flat one.
pub(crate) fn hull_of(mesh: &Triangles) -> Option<Hull> {
    let points = used_points(mesh);
    if points.len() <= MAX_POINTS {
        return Some(Hull { shape: SharedShape::convex_hull(&points)?, simplified: None });
    }
    let mut kept: Vec<usize> =
        (0..DIRECTIONS).map(|index| furthest(&points, direction(index, DIRECTIONS)).0).collect();
    kept.sort_unstable();
    kept.dedup();
    let corners: Vec<DVec3> = kept.into_iter().map(|index| points[index]).collect();
    let shape = SharedShape::convex_hull(&corners)?;
    let cut_off_m = (0..CHECKED_DIRECTIONS)
        .map(|index| direction(index, CHECKED_DIRECTIONS))
        .map(|along| furthest(&points, along).1 - furthest(&corners, along).1)
        .fold(0.0, f64::max);
    let volume_m3 = shape.mass_properties(1.0).mass();
    let volume_error = volume(mesh).map(|of_mesh_m3| volume_m3 / of_mesh_m3 - 1.0);
    let simplified = Simplified {
        points_before: points.len(),
        points_after: corners.len(),
        cut_off_m,
        volume_error,
    };
    Some(Hull { shape, simplified: Some(simplified) })
}

/// Returns the points that triangles use, each position once, in a fixed order.
fn used_points(mesh: &Triangles) -> Vec<DVec3> {
    if mesh.points_m.len() <= MAX_POINTS {
        return mesh.points_m.clone();
    }
    let corners = mesh.triangles.iter().flatten();
    let mut points: Vec<DVec3> = corners.map(|&corner| mesh.points_m[corner as usize]).collect();
    points.sort_unstable_by(|a, b| {
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
    });
    points.dedup();
    points
}

/// Returns index and distance of the extreme point along a direction; the first of equal ones.
fn furthest(points: &[DVec3], along: DVec3) -> (usize, f64) {
    let mut found = (0, f64::NEG_INFINITY);
    for (index, point) in points.iter().enumerate() {
        let distance = point.dot(along);
        if distance > found.1 {
            found = (index, distance);
        }
    }
    found
}

/// Returns one of evenly spread directions: a spiral from pole to pole with the golden angle between
/// neighbours (a Fibonacci lattice).
fn direction(index: u32, count: u32) -> DVec3 {
    let golden_angle = std::f64::consts::PI * (3.0 - libm::sqrt(5.0));
    let z = 1.0 - 2.0 * (f64::from(index) + 0.5) / f64::from(count);
    let (sine, cosine) = libm::sincos(golden_angle * f64::from(index));
    let radius = libm::sqrt(1.0 - z * z);
    DVec3::new(radius * cosine, radius * sine, z)
}

/// Returns the volume of a closed mesh [m³], for either orientation of its triangles; `None` for an
/// open mesh.
fn volume(mesh: &Triangles) -> Option<f64> {
    let corner = |index: u32| mesh.points_m[index as usize];
    let (mut six_volumes, mut open) = (0.0, DVec3::ZERO);
    let mut area = 0.0;
    for &[a, b, c] in &mesh.triangles {
        let (a, b, c) = (corner(a), corner(b), corner(c));
        let normal = (b - a).cross(c - a);
        six_volumes += a.dot(b.cross(c));
        open += normal;
        area += normal.length();
    }
    // The area vectors of a closed surface sum to zero.
    let is_closed = open.length() <= 1e-6 * area;
    (is_closed && six_volumes != 0.0).then(|| six_volumes.abs() / 6.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sphere of quads split in two, `rings` from pole to pole.
    fn sphere(rings: u32, radius_m: f64) -> Triangles {
        let sectors = 2 * rings;
        let mut mesh = Triangles::default();
        for ring in 0..=rings {
            let (sine, cosine) =
                libm::sincos(std::f64::consts::PI * f64::from(ring) / f64::from(rings));
            for sector in 0..sectors {
                let turn = std::f64::consts::TAU * f64::from(sector) / f64::from(sectors);
                let (y, x) = libm::sincos(turn);
                mesh.points_m.push(DVec3::new(sine * x, sine * y, cosine) * radius_m);
            }
        }
        for ring in 0..rings {
            for sector in 0..sectors {
                let next = (sector + 1) % sectors;
                let at = |ring: u32, sector: u32| ring * sectors + sector;
                mesh.triangles.push([at(ring, sector), at(ring + 1, sector), at(ring + 1, next)]);
                mesh.triangles.push([at(ring, sector), at(ring + 1, next), at(ring, next)]);
            }
        }
        mesh
    }

    #[test]
    fn few_points_stay_as_they_are() {
        let hull = hull_of(&sphere(10, 1.0)).unwrap();
        assert_eq!(hull.simplified, None);
    }

    #[test]
    fn a_smooth_sphere_loses_half_a_percent() {
        // 16,200 triangles.
        let hull = hull_of(&sphere(90, 0.5)).unwrap();
        let simplified = hull.simplified.unwrap();
        assert!(simplified.points_before > 15_000 && simplified.points_after <= 1_000);
        assert!((0.0..0.002).contains(&simplified.cut_off_m), "{simplified:?}");
        let error = simplified.volume_error.unwrap();
        assert!((-0.01..0.0).contains(&error), "{simplified:?}");
    }

    #[test]
    fn a_fine_box_keeps_its_corners() {
        // A grid of 40 by 40 on each side of a cube.
        let mut mesh = Triangles::default();
        for axis in 0..3 {
            for side in [0.0, 1.0] {
                let first = mesh.points_m.len() as u32;
                for row in 0..=40 {
                    for column in 0..=40 {
                        let (u, v) = (f64::from(row) / 40.0, f64::from(column) / 40.0);
                        let mut point = [side; 3];
                        point[(axis + 1) % 3] = u;
                        point[(axis + 2) % 3] = v;
                        mesh.points_m.push(DVec3::from_array(point));
                    }
                }
                for row in 0..40 {
                    for column in 0..40 {
                        let at = first + row * 41 + column;
                        let [a, b, c, d] = [at, at + 41, at + 42, at + 1];
                        let (one, two) = ([a, b, c], [a, c, d]);
                        let turned =
                            |[a, b, c]: [u32; 3]| if side > 0.5 { [a, b, c] } else { [a, c, b] };
                        mesh.triangles.extend([turned(one), turned(two)]);
                    }
                }
            }
        }
        let hull = hull_of(&mesh).unwrap();
        let simplified = hull.simplified.unwrap();
        assert!(
            simplified.cut_off_m < 1e-12 && simplified.volume_error.unwrap().abs() < 1e-9,
            "{simplified:?}"
        );
    }

    #[test]
    fn an_open_mesh_has_no_volume() {
        let mut mesh = sphere(10, 1.0);
        assert!(volume(&mesh).is_some());
        mesh.triangles.truncate(100);
        assert_eq!(volume(&mesh), None);
    }
}
