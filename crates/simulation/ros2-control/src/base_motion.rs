//! Motion of a robot's base that follows from its wheel commands.

/// Velocity in the plane, in the robot's own frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanarTwist {
    /// Forward [m/s].
    pub x_m_s: f64,
    /// To the left [m/s].
    pub y_m_s: f64,
    /// Yaw rate, counterclockwise [rad/s].
    pub yaw_rad_s: f64,
}

impl PlanarTwist {
    /// Returns true if all numbers are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.x_m_s.is_finite() && self.y_m_s.is_finite() && self.yaw_rad_s.is_finite()
    }
}

/// Motion of the base that rolling wheels without slip give, for a simulation without physics.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseMotion {
    /// Velocity of the centre.
    pub twist: PlanarTwist,
    /// Point of the robot that has this velocity.
    pub centre: MotionCentre,
}

/// Point of a robot, given by its joints.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionCentre {
    /// Midpoint of the wheels on these joints.
    Joints(Vec<String>),
    /// Behind a joint along the robot's x axis.
    Behind {
        /// Name of the joint.
        joint: String,
        /// Distance [m].
        distance_m: f64,
    },
}
