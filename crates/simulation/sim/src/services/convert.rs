//! Conversion of poses, velocities and colours to and from messages.

use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_msgs::geometry_msgs::{self, Point, Quaternion, Twist, Vector3};
use periplus_msgs::std_msgs::ColorRGBA;
use periplus_physics::limits::is_pose;
use periplus_scene::Colour;

/// Error for an invalid pose, see [`pose`].
pub(super) const BAD_POSE: &str =
    "the pose contains a value that is not finite, or a position beyond 1e7 m";

/// Returns `None` for a value that is not finite or beyond
/// [`MAX_POSITION_M`](periplus_physics::limits). A zero quaternion is the identity, as in Gazebo.
pub(super) fn pose(message: &geometry_msgs::Pose) -> Option<Pose> {
    let (at, turned) = (&message.position, &message.orientation);
    let turned = DQuat::from_xyzw(turned.x, turned.y, turned.z, turned.w);
    let turned = if turned.length_squared() == 0.0 { DQuat::IDENTITY } else { turned };
    let pose = Pose::from_xyz_quaternion([at.x, at.y, at.z], turned);
    is_pose(pose).then_some(pose)
}

pub(super) fn pose_message(pose: Pose) -> geometry_msgs::Pose {
    let (at, turned) = (pose.translation, pose.rotation);
    geometry_msgs::Pose {
        position: Point { x: at.x, y: at.y, z: at.z },
        orientation: Quaternion { x: turned.x, y: turned.y, z: turned.z, w: turned.w },
    }
}

pub(super) fn vector(message: &Vector3) -> DVec3 {
    DVec3::new(message.x, message.y, message.z)
}

pub(super) fn vector_message(vector: DVec3) -> Vector3 {
    Vector3 { x: vector.x, y: vector.y, z: vector.z }
}

/// Converts velocities \[m/s, rad/s\].
pub(super) fn twist_message(linear_m_s: DVec3, angular_rad_s: DVec3) -> Twist {
    Twist { linear: vector_message(linear_m_s), angular: vector_message(angular_rad_s) }
}

pub(super) fn colour(message: &ColorRGBA) -> Colour {
    Colour([message.r, message.g, message.b, message.a].map(f64::from))
}

#[expect(clippy::cast_possible_truncation, reason = "messages carry colours in single precision")]
pub(super) fn colour_message(Colour([r, g, b, a]): Colour) -> ColorRGBA {
    ColorRGBA { r: r as f32, g: g as f32, b: b as f32, a: a as f32 }
}
