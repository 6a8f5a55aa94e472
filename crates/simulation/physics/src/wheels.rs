//! Detection of wheels.

use periplus_geometry::{DVec3, Pose};
use periplus_scene::Shape;

/// A wheel: a ball whose contacts count only on the tread, around a core with contacts at its flat
/// sides only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wheel {
    pub(crate) radius_m: f64,
    pub(crate) half_width_m: f64,
}

/// Maximum distance of a joint's axis from the centre of the shape, relative to the radius.
const MAX_OFFSET_RATIO: f64 = 1e-3;
/// Maximum sine of the angle between a joint's axis and the shape's.
const MAX_LEAN_RATIO: f64 = 1e-3;

/// Returns the wheel if a shape turns about its own axis: the joint's axis, given by a point and a
/// unit direction in the link's frame, is the cylinder's axis or passes through the centre of the
/// ball.
pub(crate) fn wheel(
    shape: &Shape,
    link_from_collision: Pose,
    (point_in_link, axis_in_link): (DVec3, DVec3),
) -> Option<Wheel> {
    let (radius_m, half_width_m) = match *shape {
        Shape::Cylinder { radius_m, length_m } => {
            let along = link_from_collision.rotation * DVec3::Z;
            if along.cross(axis_in_link).length() > MAX_LEAN_RATIO {
                return None;
            }
            (radius_m, length_m / 2.0)
        }
        // A ball already has a single contact point.
        _ => return None,
    };
    let aside = link_from_collision.translation - point_in_link;
    let off = aside.cross(axis_in_link).length();
    (off <= MAX_OFFSET_RATIO * radius_m).then_some(Wheel { radius_m, half_width_m })
}
