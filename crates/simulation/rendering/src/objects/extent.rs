//! Exact extents of shapes along given axes.

use periplus_geometry::{DVec3, Pose};
use periplus_raycast::RaycastShape;

use crate::body::RenderBody;

/// Extent of shapes along the axes of a frame.
pub(super) struct Extent {
    world_from_frame: Pose,
    low_m: DVec3,
    high_m: DVec3,
}

impl Extent {
    pub(super) fn new(world_from_frame: Pose) -> Self {
        Self { world_from_frame, low_m: DVec3::INFINITY, high_m: DVec3::NEG_INFINITY }
    }

    /// Adds a shape. Planes without a size have no extent and are left out.
    pub(super) fn add(&mut self, body: &RenderBody, world_from_body: &Pose) {
        let frame_from_body = self.world_from_frame.inverse() * *world_from_body;
        let body_from_frame = frame_from_body.rotation.conjugate();
        let reach = |direction: DVec3| {
            let farthest_m = support_m(body, body_from_frame * direction)?;
            Some(farthest_m + frame_from_body.translation.dot(direction))
        };
        let ends = |axis: DVec3| Some((reach(-axis)?, reach(axis)?));
        let (Some(x), Some(y), Some(z)) = (ends(DVec3::X), ends(DVec3::Y), ends(DVec3::Z)) else {
            return;
        };
        self.low_m = self.low_m.min(-DVec3::new(x.0, y.0, z.0));
        self.high_m = self.high_m.max(DVec3::new(x.1, y.1, z.1));
    }

    /// Returns the pose of the centre of the box around all shapes, and its edges \[m\]; `None` without a shape.
    pub(super) fn bounding_box(&self) -> Option<(Pose, DVec3)> {
        let size_m = self.high_m - self.low_m;
        if !size_m.is_finite() {
            return None;
        }
        let DVec3 { x, y, z } = (self.low_m + self.high_m) / 2.0;
        Some((self.world_from_frame * Pose::from_xyz(x, y, z), size_m))
    }
}

/// Returns the farthest distance of a body's points along a unit vector in its frame (its support function) \[m\];
/// `None` for an infinite plane.
fn support_m(body: &RenderBody, direction: DVec3) -> Option<f64> {
    let along = |points: &mut dyn Iterator<Item = DVec3>| {
        points.map(|point| point.dot(direction)).reduce(f64::max)
    };
    match body {
        RenderBody::Mesh(mesh) => {
            along(&mut mesh.selected.positions_m.iter().copied().map(DVec3::from_array))
        }
        RenderBody::Heightmap(heights) => {
            let (low_m, high_m) = heights.bounds_m();
            let centre_m = (low_m + high_m) / 2.0;
            let half_m = (high_m - low_m) / 2.0;
            Some(centre_m.dot(direction) + half_m.dot(direction.abs()))
        }
        RenderBody::Shape(shape) => shape_support_m(shape, direction),
    }
}

fn shape_support_m(shape: &RaycastShape, direction: DVec3) -> Option<f64> {
    let up = direction.z;
    let level = libm::hypot(direction.x, direction.y);
    Some(match *shape {
        RaycastShape::Plane { size_m } => {
            let [x, y] = size_m?;
            (x * direction.x.abs() + y * direction.y.abs()) / 2.0
        }
        RaycastShape::Box { size_m } => size_m.dot(direction.abs()) / 2.0,
        RaycastShape::Sphere { radius_m } => radius_m,
        RaycastShape::Cylinder { radius_m, length_m } => {
            radius_m * level + length_m * up.abs() / 2.0
        }
        RaycastShape::Capsule { radius_m, length_m } => radius_m + length_m * up.abs() / 2.0,
        RaycastShape::Cone { radius_m, length_m } => {
            (length_m * up / 2.0).max(radius_m * level - length_m * up / 2.0)
        }
        RaycastShape::Ellipsoid { radii_m } => (radii_m * direction).length(),
    })
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Rpy;

    use super::*;

    fn extent(shape: RaycastShape, roll: f64) -> DVec3 {
        let mut extent = Extent::new(Pose::IDENTITY);
        let turned = Rpy { roll, pitch: 0.0, yaw: 0.0 };
        extent.add(&RenderBody::Shape(shape), &Pose::from_xyz_rpy([1.0, 0.0, 0.0], turned));
        let (pose, size_m) = extent.bounding_box().unwrap();
        assert!((pose.translation.x - 1.0).abs() < 1e-12);
        size_m
    }

    /// A cylinder that lies along y has its length there; at 45° both add up.
    #[test]
    fn extents_are_exact() {
        let cylinder = RaycastShape::Cylinder { radius_m: 0.5, length_m: 2.0 };
        let lying = extent(cylinder, std::f64::consts::FRAC_PI_2);
        assert!((lying - DVec3::new(1.0, 2.0, 1.0)).length() < 1e-12, "{lying}");
        let leaning = extent(cylinder, std::f64::consts::FRAC_PI_4);
        let edge = libm::sqrt(2.0) + libm::sqrt(0.5);
        assert!((leaning - DVec3::new(1.0, edge, edge)).length() < 1e-12, "{leaning}");
        let ellipsoid = RaycastShape::Ellipsoid { radii_m: DVec3::new(1.0, 2.0, 3.0) };
        assert!((extent(ellipsoid, 0.0) - DVec3::new(2.0, 4.0, 6.0)).length() < 1e-12);
        let cone = RaycastShape::Cone { radius_m: 1.0, length_m: 3.0 };
        assert!((extent(cone, 0.0) - DVec3::new(2.0, 2.0, 3.0)).length() < 1e-12);
    }

    #[test]
    fn planes_without_a_size_have_no_extent() {
        let mut extent = Extent::new(Pose::IDENTITY);
        extent.add(&RenderBody::Shape(RaycastShape::Plane { size_m: None }), &Pose::IDENTITY);
        assert!(extent.bounding_box().is_none());
    }
}
