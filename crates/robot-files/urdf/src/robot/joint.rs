//! Joints.

use periplus_diagnostics::Origin;

use super::{Extra, UrdfOrigin};

/// Type of motion of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum JointType {
    /// No motion.
    #[default]
    Fixed,
    /// Rotation within limits.
    Revolute,
    /// Rotation without limits.
    Continuous,
    /// Translation within limits.
    Prismatic,
    /// Motion in the plane perpendicular to its axis.
    Planar,
    /// Free motion.
    Floating,
}

impl JointType {
    /// All of them, with their names in files.
    pub const ALL: [(&'static str, Self); 6] = [
        ("fixed", Self::Fixed),
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("planar", Self::Planar),
        ("floating", Self::Floating),
    ];

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("fixed", |(name, _)| name)
    }

    /// Returns true if it moves along or about an axis.
    #[must_use]
    pub fn has_axis(self) -> bool {
        !matches!(self, Self::Fixed | Self::Floating)
    }
}

/// Connection of two links. Positions are in metres for a prismatic joint, in radians otherwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UrdfJoint {
    /// Its name, unique among the joints.
    pub name: String,
    /// Type of motion.
    pub kind: JointType,
    /// Parent link.
    pub parent: String,
    /// Child link. At position zero its frame is the joint's.
    pub child: String,
    /// Joint frame in the parent link's frame, at position zero.
    pub parent_from_joint: UrdfOrigin,
    /// Direction of the axis in the joint frame, as written; the default is x.
    pub axis: Option<([f64; 3], Extra)>,
    /// Limits.
    pub limit: Option<Limit>,
    /// Damping and friction.
    pub dynamics: Option<Dynamics>,
    /// Joint that it follows.
    pub mimic: Option<UrdfMimic>,
    /// Positions of a reference switch.
    pub calibration: Option<JointCalibration>,
    /// Soft limits.
    pub safety_controller: Option<SafetyController>,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
    /// Source location of the name of the parent.
    pub parent_origin: Origin,
    /// Source location of the name of the child.
    pub child_origin: Origin,
}

/// Default axis.
pub(crate) const DEFAULT_AXIS: [f64; 3] = [1.0, 0.0, 0.0];

impl UrdfJoint {
    /// The axis as written, or x.
    #[must_use]
    pub fn axis_xyz(&self) -> [f64; 3] {
        self.axis.as_ref().map_or(DEFAULT_AXIS, |(xyz, _)| *xyz)
    }
}

/// Limits of motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limit {
    /// Lowest position [m or rad].
    pub lower: f64,
    /// Highest position [m or rad].
    pub upper: f64,
    /// Maximum force or torque [N or N m].
    pub effort: f64,
    /// Maximum speed [m/s or rad/s].
    pub velocity: f64,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// Resistance to motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dynamics {
    /// Viscous damping [N s/m or N m s/rad].
    pub damping: f64,
    /// Static friction [N or N m].
    pub friction: f64,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
}

/// `position = multiplier * other + offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfMimic {
    /// Joint that it follows.
    pub joint: String,
    /// Ratio.
    pub multiplier: f64,
    /// Offset [m or rad].
    pub offset: f64,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location of the name of the joint that it follows.
    pub origin: Origin,
}

/// Positions at which a reference switch changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointCalibration {
    /// Position of the rising edge [m or rad].
    pub rising: Option<f64>,
    /// Position of the falling edge [m or rad].
    pub falling: Option<f64>,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
}

/// Soft limits of a controller.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SafetyController {
    /// Lowest position [m or rad].
    pub soft_lower_limit: f64,
    /// Highest position [m or rad].
    pub soft_upper_limit: f64,
    /// Speed per distance to the limit [1/s].
    pub k_position: f64,
    /// Force per excess speed [N s/m or N m s/rad].
    pub k_velocity: f64,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
}
