//! Velocities in the plane.

use serde::{Deserialize, Serialize};

/// Velocity of a body in the plane, in its own frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Twist2 {
    /// Velocity forwards \[m/s\].
    pub vx_m_s: f64,
    /// Velocity to the left \[m/s\].
    pub vy_m_s: f64,
    /// Turn rate to the left \[rad/s\].
    pub wz_rad_s: f64,
}

impl Twist2 {
    /// No motion.
    pub const ZERO: Self = Self::new(0.0, 0.0, 0.0);

    /// Velocity from its parts \[m/s, m/s, rad/s\].
    #[must_use]
    pub const fn new(vx_m_s: f64, vy_m_s: f64, wz_rad_s: f64) -> Self {
        Self { vx_m_s, vy_m_s, wz_rad_s }
    }

    /// Returns the magnitude of the translation \[m/s\].
    #[must_use]
    pub fn speed_m_s(self) -> f64 {
        libm::hypot(self.vx_m_s, self.vy_m_s)
    }

    /// Returns the velocity multiplied by a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self::new(self.vx_m_s * factor, self.vy_m_s * factor, self.wz_rad_s * factor)
    }

    /// Returns true if all parts are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.vx_m_s.is_finite() && self.vy_m_s.is_finite() && self.wz_rad_s.is_finite()
    }
}
