//! Joints.

use periplus_diagnostics::Origin;

use super::{Extra, Placement};

/// How a joint moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum JointType {
    /// Not at all.
    #[default]
    Fixed,
    /// It turns within limits.
    Revolute,
    /// It turns without limits.
    Continuous,
    /// It slides within limits.
    Prismatic,
    /// It moves in a plane across its axis.
    Planar,
    /// It moves freely.
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

    /// Whether it moves along or about an axis.
    #[must_use]
    pub fn has_axis(self) -> bool {
        !matches!(self, Self::Fixed | Self::Floating)
    }
}

/// What holds two links together. Positions are metres for a prismatic joint, radians otherwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joint {
    /// Its name, unique among the joints.
    pub name: String,
    /// How it moves.
    pub kind: JointType,
    /// The link above.
    pub parent: String,
    /// The link below, whose frame at position zero is the joint's.
    pub child: String,
    /// The joint's frame in the parent link's, at position zero.
    pub parent_from_joint: Placement,
    /// Direction of the axis in the joint's frame, as written; x where the file says nothing.
    pub axis: Option<([f64; 3], Extra)>,
    /// Limits.
    pub limit: Option<Limit>,
    /// Damping and friction.
    pub dynamics: Option<Dynamics>,
    /// The joint that it follows.
    pub mimic: Option<Mimic>,
    /// Where its position is known.
    pub calibration: Option<Calibration>,
    /// Soft limits.
    pub safety_controller: Option<SafetyController>,
    /// What nobody here interprets.
    pub extra: Extra,
    /// Where it was read.
    pub origin: Origin,
    /// Where the name of the parent stands.
    pub parent_origin: Origin,
    /// Where the name of the child stands.
    pub child_origin: Origin,
}

/// The x axis, which holds where a joint gives none.
pub(crate) const DEFAULT_AXIS: [f64; 3] = [1.0, 0.0, 0.0];

impl Joint {
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
    /// Greatest force [N or N m].
    pub effort: f64,
    /// Greatest speed [m/s or rad/s].
    pub velocity: f64,
    /// What nobody here interprets.
    pub extra: Extra,
    /// Where it was read.
    pub origin: Origin,
}

/// Resistance to motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dynamics {
    /// Viscous damping [N s/m or N m s/rad].
    pub damping: f64,
    /// Static friction [N or N m].
    pub friction: f64,
    /// What nobody here interprets.
    pub extra: Extra,
}

/// `position = multiplier * other + offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mimic {
    /// The joint that leads.
    pub joint: String,
    /// Ratio.
    pub multiplier: f64,
    /// Added [m or rad].
    pub offset: f64,
    /// What nobody here interprets.
    pub extra: Extra,
    /// Where the name of the leader stands.
    pub origin: Origin,
}

/// Where a reference switch changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Calibration {
    /// Position of the rising edge [m or rad].
    pub rising: Option<f64>,
    /// Position of the falling edge [m or rad].
    pub falling: Option<f64>,
    /// What nobody here interprets.
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
    /// What nobody here interprets.
    pub extra: Extra,
}
