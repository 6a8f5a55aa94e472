//! Default world, and the height of a robot above the floor.

use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_scene::{Model, Shape};

/// Initial distance of a robot from the floor \[m\]: solvers handle a small drop better than a
/// penetration.
const CLEARANCE_M: f64 = 1e-4;

/// Returns the pose of a model whose lowest collision touches the plane z = 0, at x, y \[m\] and yaw
/// \[rad\]. A model that is fixed to the world keeps its height.
pub(crate) fn standing(model: &Model, x_m: f64, y_m: f64, yaw_rad: f64) -> Pose {
    let lowest = lowest_m(model, Pose::IDENTITY).filter(|lowest| lowest.is_finite());
    let z_m = if is_fixed(model) { 0.0 } else { CLEARANCE_M - lowest.unwrap_or(CLEARANCE_M) };
    Pose::from_xyz_rpy([x_m, y_m, z_m], Rpy { roll: 0.0, pitch: 0.0, yaw: yaw_rad })
}

/// Returns true if the world holds a model, as that of a description whose root is the link `world`.
fn is_fixed(model: &Model) -> bool {
    model.is_static || model.joints.iter().any(|joint| joint.parent == "world")
}

/// Returns the lowest point of all collisions of a model, in the frame of `up_from_model`. Shapes
/// from files are ignored: robots touch the floor with wheels.
fn lowest_m(model: &Model, up_from_model: Pose) -> Option<f64> {
    let own = model.links.iter().flat_map(|link| {
        link.collisions.iter().filter_map(move |collision| {
            let up_from_shape =
                up_from_model * link.model_from_link * collision.link_from_collision;
            let reach = reach_down_m(&collision.shape, up_from_shape)?;
            Some(up_from_shape.translation.z - reach)
        })
    });
    let nested = model
        .models
        .iter()
        .filter_map(|inner| lowest_m(inner, up_from_model * inner.parent_from_model));
    own.chain(nested).reduce(f64::min)
}

/// Returns the radius of the smallest circle about a model's frame that contains all collisions,
/// seen from above \[m\], with each collision replaced by its bounding sphere. Shapes from files are
/// ignored.
pub(crate) fn radius_m(model: &Model, base_from_model: Pose) -> Option<f64> {
    let own = model.links.iter().flat_map(|link| {
        link.collisions.iter().filter_map(move |collision| {
            let base_from_shape =
                base_from_model * link.model_from_link * collision.link_from_collision;
            let middle = base_from_shape.translation;
            Some(
                libm::hypot(middle.x, middle.y) + reach_aside_m(&collision.shape, base_from_shape)?,
            )
        })
    });
    let nested = model
        .models
        .iter()
        .filter_map(|inner| radius_m(inner, base_from_model * inner.parent_from_model));
    own.chain(nested).filter(|radius_m| radius_m.is_finite()).reduce(f64::max)
}

/// Returns the maximum horizontal extent of a shape from its centre \[m\].
fn reach_aside_m(shape: &Shape, base_from_shape: Pose) -> Option<f64> {
    let reach_along = |axis: DVec3| {
        let axis_of_shape = base_from_shape.rotation.conjugate() * axis;
        let up_from_shape = Pose { rotation: turn_up(axis_of_shape), ..Pose::IDENTITY };
        reach_down_m(shape, up_from_shape)
    };
    Some(libm::hypot(reach_along(DVec3::X)?, reach_along(DVec3::Y)?))
}

/// Returns the rotation of a shape's axis to z.
fn turn_up(axis: DVec3) -> periplus_geometry::DQuat {
    periplus_geometry::DQuat::from_rotation_arc(axis.normalize_or(DVec3::Z), DVec3::Z)
}

/// Returns the extent of a shape below its centre \[m\].
fn reach_down_m(shape: &Shape, up_from_shape: Pose) -> Option<f64> {
    reach_m(shape, up_from_shape.rotation.conjugate() * DVec3::Z)
}

/// Returns the extent of a shape from its centre along a unit vector in the frame of the shape \[m\]; `None` for a
/// shape without an analytic extent.
pub(crate) fn reach_m(shape: &Shape, up: DVec3) -> Option<f64> {
    let round = (1.0 - up.z * up.z).max(0.0).sqrt();
    match *shape {
        Shape::Box { size_m } => Some((up.abs() * size_m * 0.5).element_sum()),
        Shape::Sphere { radius_m } => Some(radius_m),
        Shape::Cylinder { radius_m, length_m } | Shape::Cone { radius_m, length_m } => {
            Some(up.z.abs() * length_m * 0.5 + round * radius_m)
        }
        Shape::Capsule { radius_m, length_m } => Some(up.z.abs() * length_m * 0.5 + radius_m),
        Shape::Ellipsoid { radii_m } => Some((up * radii_m).length()),
        _ => None,
    }
}

/// World file of a plane with a sun, for robots without a world.
pub(crate) const DEFAULT_WORLD_SDF: &str = r#"<?xml version="1.0"?>
<sdf version="1.9">
  <world name="default">
    <include><uri>model://sun</uri></include>
    <include><uri>model://ground_plane</uri></include>
  </world>
</sdf>
"#;
