//! Limits of a commanded speed.

/// Bounds of a speed, acceleration and jerk; unbounded by default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedLimits {
    /// Minimum and maximum speed [m/s or rad/s].
    pub velocity: [f64; 2],
    /// Minimum and maximum acceleration [1/s of it].
    pub acceleration: [f64; 2],
    /// Minimum and maximum jerk [1/s² of it].
    pub jerk: [f64; 2],
}

impl Default for SpeedLimits {
    fn default() -> Self {
        let free = [f64::NEG_INFINITY, f64::INFINITY];
        Self { velocity: free, acceleration: free, jerk: free }
    }
}

impl SpeedLimits {
    /// Returns the bounded speed after the last speed and the one before it, `dt_s` apart: first the
    /// jerk, then the acceleration, then the speed is bounded.
    #[must_use]
    pub fn limited(&self, wanted: f64, last: f64, before_last: f64, dt_s: f64) -> f64 {
        if dt_s <= 0.0 {
            return last;
        }
        let clamp = |value: f64, [low, high]: [f64; 2]| value.max(low).min(high);
        let acceleration_before = (last - before_last) / dt_s;
        let jerk = clamp(((wanted - last) / dt_s - acceleration_before) / dt_s, self.jerk);
        let acceleration = clamp(acceleration_before + jerk * dt_s, self.acceleration);
        clamp(last + acceleration * dt_s, self.velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn none_bounds_nothing() {
        assert!((SpeedLimits::default().limited(3.0, 1.0, 0.0, 0.1) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn speed_acceleration_and_jerk() {
        let free = SpeedLimits::default();
        let velocity = SpeedLimits { velocity: [-1.0, 2.0], ..free };
        assert_eq!(velocity.limited(5.0, 0.0, 0.0, 0.1), 2.0);
        assert_eq!(velocity.limited(-5.0, 0.0, 0.0, 0.1), -1.0);
        // 4 m/s² for 0.1 s.
        let acceleration = SpeedLimits { acceleration: [-4.0, 4.0], ..free };
        assert!((acceleration.limited(5.0, 1.0, 1.0, 0.1) - 1.4).abs() < 1e-12);
        // 10 m/s³ for 0.1 s is 1 m/s² more than before, for 0.1 s.
        let jerk = SpeedLimits { jerk: [-10.0, 10.0], ..free };
        assert!((jerk.limited(5.0, 1.0, 0.8, 0.1) - 1.3).abs() < 1e-12);
    }
}
