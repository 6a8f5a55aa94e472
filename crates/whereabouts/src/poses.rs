//! Poses as messages carry them.

use periplus_base::{DQuat, Pose, Pose2};
use periplus_msgs::geometry_msgs::{self, Quaternion};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs;

/// A pose on the ground.
#[must_use]
pub fn pose(pose: Pose2) -> geometry_msgs::Pose {
    let Pose { translation, rotation } = Pose::from(pose);
    geometry_msgs::Pose {
        position: geometry_msgs::Point { x: translation.x, y: translation.y, z: translation.z },
        orientation: quaternion(rotation),
    }
}

fn quaternion(rotation: DQuat) -> Quaternion {
    Quaternion { x: rotation.x, y: rotation.y, z: rotation.z, w: rotation.w }
}

/// Where a frame is in another.
#[must_use]
pub fn transform(
    parent: &str,
    child: &str,
    parent_from_child: Pose2,
    time_ns: i64,
) -> tf2_msgs::TFMessage {
    let Pose { translation, rotation } = Pose::from(parent_from_child);
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
