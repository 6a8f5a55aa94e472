//! What is a wheel.

use periplus_geometry::{DVec3, Pose};
use periplus_scene::Shape;

/// A tyre: a ball whose contacts count only on the tread, around a core that touches with its flat
/// sides only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wheel {
    pub(crate) radius_m: f64,
    pub(crate) half_width_m: f64,
}

/// How far a joint's axis may be from the middle of the shape [share of the radius].
const OFF_CENTRE: f64 = 1e-3;
/// How far a joint's axis may lean against the shape's [sine].
const LEAN: f64 = 1e-3;

/// Whether a shape turns about its own axis: the joint's axis, given by a point and a unit direction
/// in the link's frame, is the cylinder's axis, or goes through the middle of the ball.
pub(crate) fn wheel(
    shape: &Shape,
    link_from_collision: Pose,
    (point_in_link, axis_in_link): (DVec3, DVec3),
) -> Option<Wheel> {
    let (radius_m, half_width_m) = match *shape {
        Shape::Cylinder { radius_m, length_m } => {
            let along = link_from_collision.rotation * DVec3::Z;
            if along.cross(axis_in_link).length() > LEAN {
                return None;
            }
            (radius_m, length_m / 2.0)
        }
        // A ball touches with one point as it is.
        _ => return None,
    };
    let aside = link_from_collision.translation - point_in_link;
    let off = aside.cross(axis_in_link).length();
    (off <= OFF_CENTRE * radius_m).then_some(Wheel { radius_m, half_width_m })
}
