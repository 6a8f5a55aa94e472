//! Footprint of a robot: its collisions seen from above.

use std::f64::consts::PI;

use periplus_geometry::{DVec3, Pose};
use periplus_physics::Meshes;
use periplus_scene::{Model, Shape};

use crate::default_world::reach_m;

/// Number of sides that bound the footprint. A circle becomes a polygon that is 0.5 % larger.
const SIDE_COUNT: usize = 32;

/// Minimum distance of neighbouring corners \[m\].
const MIN_SIDE_M: f64 = 1e-3;

/// Extent of a model in each direction of the plane.
struct Extents<'a> {
    /// Largest coordinate along each direction \[m\].
    most_m: [f64; SIDE_COUNT],
    meshes: &'a dyn Meshes,
}

/// Returns the convex polygon around all collisions of a model, in the model's frame \[m\], counterclockwise; `None` if
/// no collision has a size. It lies outside of round parts by at most 0.5 % of their radius.
pub(crate) fn footprint_m(model: &Model, meshes: &dyn Meshes) -> Option<Vec<[f64; 2]>> {
    let mut extents = Extents { most_m: [f64::NEG_INFINITY; SIDE_COUNT], meshes };
    extents.add_model(model, Pose::IDENTITY);
    let corners = extents.corners();
    (corners.len() >= 3).then_some(corners)
}

/// Returns the direction of a side's normal.
fn normal(side: usize) -> DVec3 {
    let (sine, cosine) = libm::sincos(2.0 * PI * side as f64 / SIDE_COUNT as f64);
    DVec3::new(cosine, sine, 0.0)
}

impl Extents<'_> {
    fn add_model(&mut self, model: &Model, base_from_model: Pose) {
        for link in &model.links {
            for collision in &link.collisions {
                let base_from_shape =
                    base_from_model * link.model_from_link * collision.link_from_collision;
                self.add_shape(&collision.shape, base_from_shape);
            }
        }
        for inner in &model.models {
            self.add_model(inner, base_from_model * inner.parent_from_model);
        }
    }

    fn add_shape(&mut self, shape: &Shape, base_from_shape: Pose) {
        if let Shape::Mesh(mesh) = shape {
            let triangles = self.meshes.triangles(mesh).unwrap_or_default();
            for point_m in &triangles.points_m {
                let point_m = base_from_shape.transform_point(*point_m);
                self.extend(|normal| Some(normal.dot(point_m)));
            }
            return;
        }
        let shape_from_base = base_from_shape.rotation.conjugate();
        let middle_m = base_from_shape.translation;
        self.extend(|normal| {
            let reach_m = reach_m(shape, shape_from_base * normal)?;
            Some(normal.dot(middle_m) + reach_m)
        });
    }

    fn extend(&mut self, coordinate_m: impl Fn(DVec3) -> Option<f64>) {
        for (side, most_m) in self.most_m.iter_mut().enumerate() {
            let found_m = coordinate_m(normal(side)).filter(|found_m| found_m.is_finite());
            *most_m = most_m.max(found_m.unwrap_or(f64::NEG_INFINITY));
        }
    }

    /// Intersections of neighbouring sides, without those that coincide.
    fn corners(&self) -> Vec<[f64; 2]> {
        if self.most_m.iter().any(|most_m| !most_m.is_finite()) {
            return Vec::new();
        }
        let mut corners: Vec<[f64; 2]> = Vec::new();
        let is_far =
            |[x, y]: [f64; 2], [px, py]: [f64; 2]| libm::hypot(x - px, y - py) > MIN_SIDE_M;
        for side in 0..SIDE_COUNT {
            let next = (side + 1) % SIDE_COUNT;
            let (n, m) = (normal(side), normal(next));
            let (a, b) = (self.most_m[side], self.most_m[next]);
            let determinant = n.x * m.y - n.y * m.x;
            let corner = [(a * m.y - b * n.y) / determinant, (b * n.x - a * m.x) / determinant];
            if corners.last().is_none_or(|last| is_far(*last, corner)) {
                corners.push(corner);
            }
        }
        while corners.len() > 1 && !is_far(corners[0], corners[corners.len() - 1]) {
            corners.pop();
        }
        corners
    }
}

#[cfg(test)]
mod tests {
    use periplus_physics::NoMeshes;
    use periplus_scene::{Collision, Link};

    use super::*;

    fn check(shapes: &[(Shape, Pose)]) -> Vec<[f64; 2]> {
        let mut link = Link::new("base");
        for (shape, link_from_collision) in shapes {
            let mut collision = Collision::new("part", shape.clone());
            collision.link_from_collision = *link_from_collision;
            link.collisions.push(collision);
        }
        let mut model = Model::new("robot");
        model.links.push(link);
        footprint_m(&model, &NoMeshes).unwrap_or_default()
    }

    #[test]
    fn a_box_has_its_four_corners() {
        let shape = Shape::Box { size_m: DVec3::new(0.4, 0.2, 0.1) };
        let corners = check(&[(shape, Pose::from_xyz(0.1, 0.0, 0.3))]);
        let expected = [[0.3, 0.1], [-0.1, 0.1], [-0.1, -0.1], [0.3, -0.1]];
        assert_eq!(corners.len(), 4, "{corners:?}");
        for [x, y] in expected {
            let is_near = |at: &&[f64; 2]| (at[0] - x).abs() < 1e-9 && (at[1] - y).abs() < 1e-9;
            assert!(corners.iter().any(|at| is_near(&at)), "{corners:?} lacks {x}, {y}");
        }
    }

    #[test]
    fn a_disk_is_covered_by_a_slightly_larger_polygon() {
        let shape = Shape::Cylinder { radius_m: 0.2, length_m: 0.1 };
        for [x, y] in check(&[(shape, Pose::IDENTITY)]) {
            let radius_m = libm::hypot(x, y);
            assert!((0.2..0.2011).contains(&radius_m), "{radius_m}");
        }
    }

    #[test]
    fn a_robot_without_sizes_has_no_footprint() {
        assert!(check(&[]).is_empty());
        assert!(check(&[(Shape::Empty, Pose::IDENTITY)]).is_empty());
    }
}
