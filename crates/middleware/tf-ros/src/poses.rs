//! Conversion of poses to and from messages.

use std::fmt;

use periplus_geometry::{DQuat, Pose, Pose2};
use periplus_msgs::geometry_msgs::{
    self, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion,
};
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

/// Converts a pose with the covariance of x, y, z, roll, pitch and yaw, row by row.
#[must_use]
pub fn pose_with_covariance(
    pose: impl Into<Pose>,
    covariance: [f64; 36],
    time_ns: i64,
    frame: &str,
) -> PoseWithCovarianceStamped {
    PoseWithCovarianceStamped {
        header: Header::at(time_ns, frame),
        pose: PoseWithCovariance { pose: self::pose(pose), covariance },
    }
}

/// Maximum difference of the norm of a quaternion from 1.
const MAX_NORM_ERROR: f64 = 0.01;

/// Pose of a message that is not a pose of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InvalidPose {
    /// A coordinate x or y \[m\] is not finite.
    Position(f64, f64),
    /// The norm of the quaternion x, y, z, w is not 1.
    Orientation([f64; 4]),
}

impl fmt::Display for InvalidPose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Position(x, y) => write!(f, "its position ({x}, {y}) is not finite"),
            Self::Orientation(xyzw @ [x, y, z, w]) => write!(
                f,
                "its orientation ({x}, {y}, {z}, {w}) is not a rotation: the norm of the quaternion is \
                 {:.3}, not 1",
                DQuat::from_array(xyzw).length()
            ),
        }
    }
}

impl std::error::Error for InvalidPose {}

/// Converts the pose of a message to a planar one.
///
/// # Errors
/// When the position is not finite, or the orientation is not a rotation.
pub fn pose2(pose: &geometry_msgs::Pose) -> Result<Pose2, InvalidPose> {
    let geometry_msgs::Pose { position, orientation: q } = pose;
    let rotation = DQuat::from_xyzw(q.x, q.y, q.z, q.w);
    // NaN is invalid, too.
    let is_rotation = (rotation.length() - 1.0).abs() < MAX_NORM_ERROR;
    if !is_rotation {
        return Err(InvalidPose::Orientation(rotation.to_array()));
    }
    if !position.x.is_finite() || !position.y.is_finite() {
        return Err(InvalidPose::Position(position.x, position.y));
    }
    let xyz = [position.x, position.y, position.z];
    Ok(Pose2::from(Pose::from_xyz_quaternion(xyz, rotation)))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_round_trip_and_invalid_rotations_are_errors() {
        let map_from_base = Pose2::new(1.0, -2.0, 3.0);
        let back = pose2(&pose(map_from_base)).unwrap_or_default();
        assert!((back.yaw_rad - 3.0).abs() < 1e-12 && back.x_m == 1.0, "{back:?}");
        let mut invalid = pose(map_from_base);
        invalid.orientation = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 0.0 };
        assert!(pose2(&invalid).is_err_and(|error| error.to_string().ends_with("is 0.000, not 1")));
        invalid.orientation.w = f64::NAN;
        assert!(pose2(&invalid).is_err());
    }
}
