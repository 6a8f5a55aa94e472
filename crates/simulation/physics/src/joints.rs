//! Joints: what they hold, what drives them, and where they are.

mod drive;
mod make;

use periplus_geometry::Pose;
use rapier3d_f64::dynamics::GenericJoint;

pub(crate) use make::{Axes, axes_of};

/// How fast a position command closes its error [1/s].
pub(crate) const POSITION_GAIN: f64 = 50.0;

/// What an axis is told to do, until told otherwise. Newtons and metres along a sliding axis,
/// newton metres and radians about a turning one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Command {
    /// Nothing: only its damping, friction and spring act.
    #[default]
    Free,
    /// To keep a speed.
    Velocity {
        /// The speed [m/s or rad/s], held to the axis' own limit.
        target: f64,
        /// Greatest effort [N or N m], beside the axis' own limit.
        max_effort: f64,
    },
    /// To go to a position and hold it: its speed is 50 times the way that is left, within limits.
    Position {
        /// The position [m or rad], held to the axis' own limits.
        target: f64,
        /// Greatest speed [m/s or rad/s], beside the axis' own limit.
        max_speed: f64,
        /// Greatest effort [N or N m], beside the axis' own limit.
        max_effort: f64,
    },
    /// To push with an effort [N or N m], held to the axis' own limit.
    Effort(f64),
}

/// Where an axis is and what drives it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisState {
    /// Way from where the file put it; turns are counted, not folded [m or rad].
    pub position: f64,
    /// Speed [m/s or rad/s].
    pub velocity: f64,
    /// What the motor (or the commanded effort) gave in the last step [N or N m].
    pub effort: f64,
}

/// `position = multiplier * leader + offset`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Follow {
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
    pub(crate) follows: Option<Follow>,
    pub(crate) data: GenericJoint,
    pub(crate) command: Command,
    pub(crate) state: AxisState,
    /// Whether the last exact step moved it.
    pub(crate) changed: bool,
}

/// A constraint that nobody commands.
#[derive(Clone, Debug)]
pub(crate) struct Hold {
    pub(crate) body1: usize,
    pub(crate) body2: usize,
    pub(crate) data: GenericJoint,
}
