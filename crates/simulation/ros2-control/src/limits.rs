//! Limits of a commanded speed.

/// Rates of change of a speed: for a rising and a falling speed, forwards and backwards. Negative
/// values are falling rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccelerationLimits {
    /// Maximum rate while the speed is positive, or zero and rising [1/s of it].
    pub max_acceleration: f64,
    /// Minimum rate while the speed is positive [1/s of it].
    pub max_deceleration: f64,
    /// Minimum rate while the speed is negative, or zero and falling [1/s of it].
    pub max_acceleration_reverse: f64,
    /// Maximum rate while the speed is negative [1/s of it].
    pub max_deceleration_reverse: f64,
}

impl AccelerationLimits {
    /// Returns limits that are equal in all phases, as before Jazzy.
    #[must_use]
    pub fn between(min: f64, max: f64) -> Self {
        Self {
            max_acceleration: max,
            max_deceleration: min,
            max_acceleration_reverse: min,
            max_deceleration_reverse: max,
        }
    }
}

/// Limits of a speed, its rate and its jerk; `None` is unlimited.
///
/// Source: `SpeedLimiter` of `diff_drive_controller` (ROS 1, Humble) and `RateLimiter` of
/// `control_toolbox` (Jazzy).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpeedLimiter {
    /// Minimum and maximum speed [m/s or rad/s].
    pub velocity: Option<[f64; 2]>,
    /// Rates of change.
    pub acceleration: Option<AccelerationLimits>,
    /// Minimum and maximum jerk [1/s² of it].
    pub jerk: Option<[f64; 2]>,
    /// True to limit a jerk with the rule of Jazzy: only while the speed moves away from the last
    /// one, and by `jerk * dt²` instead of twice that.
    pub limits_jerk_as_jazzy: bool,
}

impl SpeedLimiter {
    /// Returns the limited speed after the last speed and the one before it, `dt_s` apart: first the
    /// jerk is limited, then the rate, then the speed.
    #[must_use]
    pub fn limited(&self, wanted: f64, last: f64, before_last: f64, dt_s: f64) -> f64 {
        let speed = self.limited_jerk(wanted, last, before_last, dt_s);
        let speed = self.limited_rate(speed, last, dt_s);
        self.velocity.map_or(speed, |[min, max]| clamp(speed, min, max))
    }

    fn limited_rate(&self, wanted: f64, last: f64, dt_s: f64) -> f64 {
        let Some(limits) = &self.acceleration else { return wanted };
        let max =
            if last < 0.0 { limits.max_deceleration_reverse } else { limits.max_acceleration };
        let min =
            if last > 0.0 { limits.max_deceleration } else { limits.max_acceleration_reverse };
        last + clamp(wanted - last, min * dt_s, max * dt_s)
    }

    fn limited_jerk(&self, wanted: f64, last: f64, before_last: f64, dt_s: f64) -> f64 {
        let Some([min, max]) = self.jerk else { return wanted };
        let (change, change_before) = (wanted - last, last - before_last);
        let is_jazzy = self.limits_jerk_as_jazzy;
        if is_jazzy && (change - change_before) * change <= 0.0 {
            return wanted;
        }
        let interval_s2 = dt_s * dt_s * if is_jazzy { 1.0 } else { 2.0 };
        last + change_before + clamp(change - change_before, min * interval_s2, max * interval_s2)
    }
}

/// Clamps without a panic when the bounds are reversed: the maximum then wins.
fn clamp(value: f64, min: f64, max: f64) -> f64 {
    value.max(min).min(max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(limiter: SpeedLimiter, wanted: f64, last: f64, before_last: f64, expected: f64) {
        let found = limiter.limited(wanted, last, before_last, 0.1);
        assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
    }

    #[test]
    fn speeds_rates_and_jerks() {
        let free = SpeedLimiter::default();
        check(free, 3.0, 0.0, 0.0, 3.0);
        check(SpeedLimiter { velocity: Some([-1.0, 2.0]), ..free }, 5.0, 0.0, 0.0, 2.0);
        // 4 m/s² for 0.1 s.
        let acceleration = Some(AccelerationLimits::between(-4.0, 4.0));
        check(SpeedLimiter { acceleration, ..free }, 5.0, 1.0, 1.0, 1.4);
        // Braking from 1 m/s at 2 m/s², but backwards at 1 m/s².
        let acceleration = Some(AccelerationLimits {
            max_acceleration: 4.0,
            max_deceleration: -2.0,
            max_acceleration_reverse: -1.0,
            max_deceleration_reverse: 3.0,
        });
        let brakes = SpeedLimiter { acceleration, ..free };
        check(brakes, -5.0, 1.0, 1.0, 0.8);
        check(brakes, -5.0, 0.0, 0.0, -0.1);
        check(brakes, 5.0, -1.0, -1.0, -0.7);
        // 10 m/s³: 2 * 0.01 s² more change than before, and 0.01 s² in Jazzy.
        let jerk = SpeedLimiter { jerk: Some([-10.0, 10.0]), ..free };
        check(jerk, 5.0, 1.0, 0.8, 1.4);
        check(SpeedLimiter { limits_jerk_as_jazzy: true, ..jerk }, 5.0, 1.0, 0.8, 1.3);
        // In Jazzy braking is not limited by the jerk.
        check(SpeedLimiter { limits_jerk_as_jazzy: true, ..jerk }, 1.0, 1.0, 0.8, 1.0);
    }
}
