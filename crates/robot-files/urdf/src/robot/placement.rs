//! Poses as written.

use periplus_geometry::{DQuat, Pose, Rpy};

use super::Extra;

/// An `<origin>`: a pose as written, so that writing it again changes nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UrdfOrigin {
    /// Translation [m].
    pub xyz_m: [f64; 3],
    /// Rotation.
    pub rotation: Rotation,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
}

/// Rotation as written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rotation {
    /// Roll, pitch, yaw about fixed axes [rad].
    Rpy([f64; 3]),
    /// A quaternion x, y, z, w (`quat_xyzw`, URDF 1.2).
    Quaternion([f64; 4]),
}

impl Default for Rotation {
    fn default() -> Self {
        Self::Rpy([0.0; 3])
    }
}

impl UrdfOrigin {
    /// The same as a pose.
    #[must_use]
    pub fn pose(&self) -> Pose {
        match self.rotation {
            Rotation::Rpy([roll, pitch, yaw]) => {
                Pose::from_xyz_rpy(self.xyz_m, Rpy { roll, pitch, yaw })
            }
            Rotation::Quaternion(xyzw) => {
                Pose::from_xyz_quaternion(self.xyz_m, DQuat::from_array(xyzw))
            }
        }
    }

    /// Converts a pose to roll, pitch and yaw, which every reader supports.
    #[must_use]
    pub fn from_pose(pose: Pose) -> Self {
        let Rpy { roll, pitch, yaw } = pose.rpy();
        Self {
            xyz_m: pose.translation.to_array(),
            rotation: Rotation::Rpy([roll, pitch, yaw]),
            extra: Extra::default(),
        }
    }
}
