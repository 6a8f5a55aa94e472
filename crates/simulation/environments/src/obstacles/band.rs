//! Cross-sections of shapes: the area that a shape covers between two heights.

use std::f64::consts::PI;

use periplus_geometry::{DVec3, Pose};
use periplus_raycast::RaycastShape;

use super::ObstacleArea;
use crate::plane::{Point2, convex_hull};

/// Sides of the polyhedra that replace tilted cylinders, cones, capsules and ellipsoids.
const POLYHEDRON_SIDE_COUNT: u32 = 48;
/// Rings from pole to pole of a polyhedron that replaces a round shape.
const POLYHEDRON_RING_COUNT: u32 = 24;
/// Axes closer to vertical than this sine of their angle count as vertical.
const MAX_UPRIGHT_SINE_RATIO: f64 = 1e-9;

/// Range of heights above the floor of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightBand {
    /// Lower end \[m\].
    pub low_m: f64,
    /// Upper end \[m\].
    pub high_m: f64,
}

/// Returns the area of a shape in a band; none if it is above or below.
///
/// # Errors
/// The reason, as a clause that follows the name of the shape.
pub(super) fn area_of_shape(
    shape: &RaycastShape,
    world_from_body: &Pose,
    band: HeightBand,
) -> Result<Option<ObstacleArea>, String> {
    let centre = world_from_body.translation;
    let axis = world_from_body.rotation * DVec3::Z;
    let is_upright = libm::hypot(axis.x, axis.y) < MAX_UPRIGHT_SINE_RATIO;
    let circle = |radius_m: f64, half_height_m: f64| {
        let is_in_band =
            centre.z - half_height_m < band.high_m && centre.z + half_height_m > band.low_m;
        let area = ObstacleArea::Circle { centre: [centre.x, centre.y], radius_m };
        Ok(is_in_band.then_some(area))
    };
    let solid = match *shape {
        RaycastShape::Plane { size_m } => {
            let Some([x, y]) = size_m else {
                return if is_upright && (axis.z > 0.0) == (centre.z <= band.low_m) {
                    Ok(None)
                } else {
                    Err("is an infinite plane that is not the floor".into())
                };
            };
            let corner = |sx: f64, sy: f64| DVec3::new(sx * x / 2.0, sy * y / 2.0, 0.0);
            let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
            Polyhedron::ring(corners.map(|(sx, sy)| corner(sx, sy)).to_vec())
        }
        RaycastShape::Box { size_m } => {
            let half = size_m / 2.0;
            let ring = |z: f64| {
                let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
                corners.map(|(x, y)| half * DVec3::new(x, y, z)).to_vec()
            };
            Polyhedron::of_rings(vec![ring(-1.0), ring(1.0)])
        }
        RaycastShape::Cylinder { radius_m, length_m } if is_upright => {
            return circle(radius_m, length_m / 2.0);
        }
        RaycastShape::Sphere { radius_m } => {
            let above = (band.low_m - centre.z).max(centre.z - band.high_m).max(0.0);
            let squared = radius_m * radius_m - above * above;
            return circle(squared.max(0.0).sqrt(), radius_m);
        }
        RaycastShape::Cylinder { radius_m, length_m } => {
            let half = length_m / 2.0;
            Polyhedron::of_rings(vec![circle_ring(radius_m, -half), circle_ring(radius_m, half)])
        }
        RaycastShape::Cone { radius_m, length_m } => {
            let half = length_m / 2.0;
            Polyhedron::of_rings(vec![circle_ring(radius_m, -half), circle_ring(0.0, half)])
        }
        RaycastShape::Ellipsoid { radii_m } => {
            let mut rings = latitude_rings();
            rings.iter_mut().flatten().for_each(|corner| *corner *= radii_m);
            Polyhedron::of_rings(rings)
        }
        RaycastShape::Capsule { radius_m, length_m } => {
            let mut rings = latitude_rings();
            for corner in rings.iter_mut().flatten() {
                let shift = length_m / 2.0 * if corner.z > 0.0 { 1.0 } else { -1.0 };
                *corner = *corner * radius_m + DVec3::Z * shift;
            }
            Polyhedron::of_rings(rings)
        }
    };
    Ok(solid.area(world_from_body, band))
}

/// Returns the area of a triangle in a band; none if it is above or below.
pub(super) fn area_of_triangle(corners: [DVec3; 3], band: HeightBand) -> Option<ObstacleArea> {
    Polyhedron::ring(corners.to_vec()).area(&Pose::IDENTITY, band)
}

/// Circumscribed polygon of a circle at a height.
fn circle_ring(radius_m: f64, z_m: f64) -> Vec<DVec3> {
    let outer_m = radius_m / libm::cos(PI / f64::from(POLYHEDRON_SIDE_COUNT));
    let corner = |at: u32| {
        let (sine, cosine) =
            libm::sincos(2.0 * PI * f64::from(at) / f64::from(POLYHEDRON_SIDE_COUNT));
        DVec3::new(outer_m * cosine, outer_m * sine, z_m)
    };
    (0..POLYHEDRON_SIDE_COUNT).map(corner).collect()
}

/// Rings of a unit sphere from pole to pole.
fn latitude_rings() -> Vec<Vec<DVec3>> {
    let ring = |at: u32| {
        let (sine, cosine) = libm::sincos(PI * f64::from(at) / f64::from(POLYHEDRON_RING_COUNT));
        circle_ring(sine, -cosine)
    };
    (0..=POLYHEDRON_RING_COUNT).map(ring).collect()
}

/// Convex polyhedron, or polygon, as corners and edges.
struct Polyhedron {
    corners: Vec<DVec3>,
    edges: Vec<[usize; 2]>,
}

impl Polyhedron {
    fn ring(corners: Vec<DVec3>) -> Self {
        Self::of_rings(vec![corners])
    }

    /// Rings of equally many corners; corners of one number are joined from ring to ring.
    fn of_rings(rings: Vec<Vec<DVec3>>) -> Self {
        let count = rings.first().map_or(0, Vec::len);
        let mut edges = Vec::new();
        for ring in 0..rings.len() {
            for at in 0..count {
                let here = ring * count + at;
                edges.push([here, ring * count + (at + 1) % count]);
                if ring + 1 < rings.len() {
                    edges.push([here, here + count]);
                }
            }
        }
        Self { corners: rings.into_iter().flatten().collect(), edges }
    }

    /// The hull of corners in the band and of points in which edges cross its ends.
    fn area(&self, world_from_body: &Pose, band: HeightBand) -> Option<ObstacleArea> {
        let corners: Vec<DVec3> =
            self.corners.iter().map(|corner| world_from_body.transform_point(*corner)).collect();
        let is_in_band = |z: f64| band.low_m < z && z < band.high_m;
        let mut points: Vec<Point2> = Vec::new();
        points.extend(corners.iter().filter(|it| is_in_band(it.z)).map(|it| [it.x, it.y]));
        for [a, b] in &self.edges {
            let (a, b) = (corners[*a], corners[*b]);
            for height_m in [band.low_m, band.high_m] {
                if (a.z < height_m) != (b.z < height_m) {
                    let point = a + (b - a) * ((height_m - a.z) / (b.z - a.z));
                    points.push([point.x, point.y]);
                }
            }
        }
        let crosses = corners.iter().any(|it| it.z < band.high_m)
            && corners.iter().any(|it| it.z > band.low_m);
        (crosses && !points.is_empty()).then(|| ObstacleArea::Polygon(convex_hull(points)))
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{Rpy, quaternion_from_rpy};

    use super::*;

    const BAND: HeightBand = HeightBand { low_m: 0.1, high_m: 0.4 };

    fn area(shape: &RaycastShape, pose: &Pose) -> Option<ObstacleArea> {
        area_of_shape(shape, pose, BAND).expect("a bounded shape")
    }

    #[test]
    fn a_box_covers_its_rectangle() {
        let shape = RaycastShape::Box { size_m: DVec3::new(2.0, 1.0, 1.0) };
        let corners = vec![[4.0, 4.5], [6.0, 4.5], [6.0, 5.5], [4.0, 5.5]];
        let found = area(&shape, &Pose::from_xyz(5.0, 5.0, 0.5));
        assert_eq!(found, Some(ObstacleArea::Polygon(corners)));
    }

    #[test]
    fn what_is_above_or_below_covers_nothing() {
        let plate = RaycastShape::Box { size_m: DVec3::new(2.0, 1.0, 0.1) };
        assert_eq!(area(&plate, &Pose::from_xyz(0.0, 0.0, 0.05)), None, "a step below");
        assert_eq!(area(&plate, &Pose::from_xyz(0.0, 0.0, 0.7)), None, "the top of a table");
        let floor = RaycastShape::Plane { size_m: None };
        assert_eq!(area(&floor, &Pose::IDENTITY), None);
        let ball = RaycastShape::Sphere { radius_m: 0.2 };
        assert_eq!(area(&ball, &Pose::from_xyz(0.0, 0.0, 0.7)), None);
    }

    #[test]
    fn a_ball_is_as_wide_as_its_section() {
        // 0.3 below the centre of a ball of 0.5: a circle of 0.4.
        let ball = RaycastShape::Sphere { radius_m: 0.5 };
        let Some(ObstacleArea::Circle { radius_m, .. }) =
            area(&ball, &Pose::from_xyz(0.0, 0.0, 0.7))
        else {
            panic!("a circle")
        };
        assert!((radius_m - 0.4).abs() < 1e-12);
    }

    #[test]
    fn a_ramp_ends_where_it_leaves_the_band() {
        // From (0, 0, 0) to (1, 0, 1): in the band from x = 0.1 to x = 0.4.
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]].map(DVec3::from_array);
        let Some(ObstacleArea::Polygon(corners)) = area_of_triangle(corners, BAND) else {
            panic!("a polygon")
        };
        let xs: Vec<f64> = corners.iter().map(|corner| corner[0]).collect();
        let low = xs.iter().copied().fold(f64::INFINITY, f64::min);
        let high = xs.iter().copied().fold(0.0, f64::max);
        assert!((low - 0.1).abs() < 1e-12 && (high - 0.4).abs() < 1e-12, "{low} {high}");
    }

    #[test]
    fn a_lying_cylinder_covers_a_rectangle() {
        let shape = RaycastShape::Cylinder { radius_m: 0.25, length_m: 2.0 };
        let lying = Pose {
            translation: DVec3::new(0.0, 0.0, 0.25),
            rotation: quaternion_from_rpy(Rpy { roll: 0.0, pitch: PI / 2.0, yaw: 0.0 }),
        };
        let Some(ObstacleArea::Polygon(corners)) = area(&shape, &lying) else {
            panic!("a polygon")
        };
        let wide = corners.iter().map(|corner| corner[1].abs()).fold(0.0, f64::max);
        let long = corners.iter().map(|corner| corner[0].abs()).fold(0.0, f64::max);
        assert!((wide - 0.25).abs() < 0.001 && (long - 1.0).abs() < 1e-9, "{wide} {long}");
    }
}
