//! Conversion of poses to messages.

use periplus_geometry::{DQuat, Pose};
use periplus_msgs::geometry_msgs::{self, Quaternion};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs;

/// Converts a 2D or 3D pose.
#[must_use]
pub fn pose(pose: impl Into<Pose>) -> geometry_msgs::Pose {
    let Pose { translation, rotation } = pose.into();
    geometry_msgs::Pose {
        position: geometry_msgs::Point { x: translation.x, y: translation.y, z: translation.z },
        orientation: quaternion(rotation),
    }
}

fn quaternion(rotation: DQuat) -> Quaternion {
    Quaternion { x: rotation.x, y: rotation.y, z: rotation.z, w: rotation.w }
}

/// Creates a stamped transform.
#[must_use]
pub fn transform(
    parent: &str,
    child: &str,
    parent_from_child: impl Into<Pose>,
    time_ns: i64,
) -> tf2_msgs::TFMessage {
    let Pose { translation, rotation } = parent_from_child.into();
    tf2_msgs::TFMessage {
        transforms: vec![geometry_msgs::TransformStamped {
            header: Header::at(time_ns, parent),
            child_frame_id: child.to_owned(),
            transform: geometry_msgs::Transform {
                translation: geometry_msgs::Vector3 {
                    x: translation.x,
                    y: translation.y,
                    z: translation.z,
                },
                rotation: quaternion(rotation),
            },
        }],
    }
}
