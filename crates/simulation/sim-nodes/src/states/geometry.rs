//! Poses as messages.

use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_msgs::geometry_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_physics::Twist;

pub(crate) fn vector(vector: DVec3) -> geometry_msgs::Vector3 {
    geometry_msgs::Vector3 { x: vector.x, y: vector.y, z: vector.z }
}

pub(crate) fn from_vector(vector: &geometry_msgs::Vector3) -> DVec3 {
    DVec3::new(vector.x, vector.y, vector.z)
}

pub(crate) fn quaternion(rotation: DQuat) -> geometry_msgs::Quaternion {
    geometry_msgs::Quaternion { x: rotation.x, y: rotation.y, z: rotation.z, w: rotation.w }
}

pub(crate) fn pose(pose: Pose) -> geometry_msgs::Pose {
    let DVec3 { x, y, z } = pose.translation;
    geometry_msgs::Pose {
        position: geometry_msgs::Point { x, y, z },
        orientation: quaternion(pose.rotation),
    }
}

/// Motion on the plane; the rest is zero.
pub(crate) fn planar_twist(twist: Twist) -> geometry_msgs::Twist {
    geometry_msgs::Twist {
        linear: vector(DVec3::new(twist.x_m_s, twist.y_m_s, 0.0)),
        angular: vector(DVec3::new(0.0, 0.0, twist.yaw_rad_s)),
    }
}

pub(crate) fn transform(
    time_ns: i64,
    parent: &str,
    child: &str,
    parent_from_child: Pose,
) -> geometry_msgs::TransformStamped {
    geometry_msgs::TransformStamped {
        header: Header::at(time_ns, parent),
        child_frame_id: child.into(),
        transform: geometry_msgs::Transform {
            translation: vector(parent_from_child.translation),
            rotation: quaternion(parent_from_child.rotation),
        },
    }
}
