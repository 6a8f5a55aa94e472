//! Planar motion without physics.

use periplus_geometry::{DQuat, DVec3, Pose, Pose2, Twist2};

/// A velocity in a robot's own frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Forward [m/s].
    pub x_m_s: f64,
    /// To the left [m/s].
    pub y_m_s: f64,
    /// Yaw rate, counterclockwise [rad/s].
    pub yaw_rad_s: f64,
}

/// Planar pose of a robot that executes its commands exactly: it follows the arc of its twist for
/// any step length. A differential drive never moves sideways (`y_m_s` = 0); an omnidirectional one
/// can.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Kinematic {
    /// Position along the plane's x [m].
    pub x_m: f64,
    /// Position along the plane's y [m].
    pub y_m: f64,
    /// Heading, unwrapped: full turns are counted [rad].
    pub yaw_rad: f64,
}

impl Kinematic {
    /// Advances by a constant twist over a time [s].
    ///
    /// The formula is that of [`Pose2::advanced`].
    #[must_use]
    pub fn advanced(self, twist: Twist, dt_s: f64) -> Self {
        let start = Pose2::new(self.x_m, self.y_m, self.yaw_rad);
        let twist = Twist2::new(twist.x_m_s, twist.y_m_s, twist.yaw_rad_s);
        let Pose2 { x_m, y_m, yaw_rad } = start.advanced(twist, dt_s);
        Self { x_m, y_m, yaw_rad }
    }

    /// Returns the robot's pose at height zero.
    #[must_use]
    pub fn pose(self) -> Pose {
        let (sine, cosine) = libm::sincos(self.yaw_rad / 2.0);
        Pose {
            translation: DVec3::new(self.x_m, self.y_m, 0.0),
            rotation: DQuat::from_xyzw(0.0, 0.0, sine, cosine),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use proptest::prelude::*;

    use super::*;

    fn near(a: Kinematic, b: Kinematic) -> bool {
        (a.x_m - b.x_m).abs() < 1e-9
            && (a.y_m - b.y_m).abs() < 1e-9
            && (a.yaw_rad - b.yaw_rad).abs() < 1e-9
    }

    #[test]
    fn a_quarter_circle_of_one_metre() {
        let twist = Twist { x_m_s: FRAC_PI_2, yaw_rad_s: FRAC_PI_2, ..Twist::default() };
        let end = Kinematic::default().advanced(twist, 1.0);
        assert!(near(end, Kinematic { x_m: 1.0, y_m: 1.0, yaw_rad: FRAC_PI_2 }), "{end:?}");
    }

    #[test]
    fn a_full_circle_ends_where_it_began() {
        let twist = Twist { x_m_s: 0.3, y_m_s: -0.2, yaw_rad_s: 2.0 * PI };
        let end = Kinematic::default().advanced(twist, 1.0);
        assert!(near(end, Kinematic { yaw_rad: 2.0 * PI, ..Kinematic::default() }), "{end:?}");
    }

    proptest! {
        #[test]
        fn one_long_step_is_many_short_ones(x in -1.0..1.0f64, y in -1.0..1.0f64, w in -2.0..2.0f64) {
            let twist = Twist { x_m_s: x, y_m_s: y, yaw_rad_s: w };
            let long = Kinematic::default().advanced(twist, 1.0);
            let short = (0..1000).fold(Kinematic::default(), |at, _| at.advanced(twist, 0.001));
            prop_assert!(near(long, short), "{long:?} {short:?}");
        }
    }
}
