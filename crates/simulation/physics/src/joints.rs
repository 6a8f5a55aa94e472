//! Joints: constraints, commands and state.

mod drive;
mod make;

use periplus_geometry::Pose;
use rapier3d_f64::dynamics::GenericJoint;

pub(crate) use make::{Axes, axes_of};

/// Proportional gain of position commands [1/s].
pub(crate) const POSITION_GAIN_PER_S: f64 = 50.0;

/// Command of an axis, valid until the next one. Newtons and metres for a prismatic axis, newton
/// metres and radians for a revolute one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum JointCommand {
    /// No command: only damping, friction and spring act.
    #[default]
    Free,
    /// Holds a speed.
    Velocity {
        /// Speed [m/s or rad/s], clamped to the axis' own limit.
        target: f64,
        /// Maximum effort [N or N m], besides the axis' own limit.
        max_effort: f64,
    },
    /// Moves to a position and holds it: the speed is 50 times the error, within limits.
    Position {
        /// Position [m or rad], clamped to the axis' own limits.
        target: f64,
        /// Maximum speed [m/s or rad/s], besides the axis' own limit.
        max_speed: f64,
        /// Maximum effort [N or N m], besides the axis' own limit.
        max_effort: f64,
    },
    /// Applies an effort [N or N m], clamped to the axis' own limit.
    Effort(f64),
}

/// State of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisState {
    /// Displacement from the pose in the file; full turns are counted [m or rad].
    pub position: f64,
    /// Speed [m/s or rad/s].
    pub velocity: f64,
    /// Effort of the motor (or the command) in the last step [N or N m].
    pub effort: f64,
}

/// `position = multiplier * leader + offset`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MimicCoupling {
    pub(crate) leader: usize,
    pub(crate) multiplier: f64,
    pub(crate) offset: f64,
}

/// One degree of freedom between two bodies. Its frames have the axis along x.
#[derive(Clone, Debug)]
pub(crate) struct AxisRecord {
    pub(crate) slides: bool,
    pub(crate) body1: usize,
    pub(crate) body2: usize,
    pub(crate) body1_from_axis: Pose,
    pub(crate) body2_from_axis: Pose,
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) effort: f64,
    pub(crate) velocity: f64,
    pub(crate) mimics: Option<MimicCoupling>,
    pub(crate) data: GenericJoint,
    pub(crate) command: JointCommand,
    /// True if it is held in place and ignores commands.
    pub(crate) is_seized: bool,
    pub(crate) state: AxisState,
    /// True if the last exact step moved it.
    pub(crate) changed: bool,
}

/// A constraint without commands.
#[derive(Clone, Debug)]
pub(crate) struct Constraint {
    pub(crate) body1: usize,
    pub(crate) body2: usize,
    pub(crate) data: GenericJoint,
}
