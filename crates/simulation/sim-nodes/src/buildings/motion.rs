//! Speed along a line within limits.

/// Limits of a motion along a line or about an axis, in metres or radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MotionLimits {
    /// Largest speed \[m/s or rad/s\].
    pub(crate) speed: f64,
    /// Acceleration, and deceleration before the target \[m/s² or rad/s²\].
    pub(crate) acceleration: f64,
    /// Largest deceleration, where the target comes too soon for the other \[m/s² or rad/s²\].
    pub(crate) max_acceleration: f64,
}

impl MotionLimits {
    /// Returns the speed after a step on the way to a target at a signed distance: a trapezoidal profile that ends at
    /// rest there.
    pub(crate) fn next_speed(&self, distance: f64, speed: f64, step_s: f64) -> f64 {
        let brake = (speed.abs() - self.max_acceleration * step_s).max(0.0).copysign(speed);
        if distance == 0.0 || distance * speed < 0.0 {
            return brake;
        }
        let (rest, now) = (distance.abs(), speed.abs());
        // From v² = 2 a s.
        let needed = now * now / (2.0 * rest);
        let next = if needed >= self.acceleration {
            now - needed.min(self.max_acceleration) * step_s
        } else if now > self.speed {
            (now - self.acceleration * step_s).max(self.speed)
        } else {
            (now + self.acceleration * step_s).min(self.speed).min(rest / step_s)
        };
        next.max(0.0).copysign(distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: MotionLimits =
        MotionLimits { speed: 0.5, acceleration: 0.25, max_acceleration: 1.0 };

    #[test]
    fn a_target_is_reached_by_a_trapezoid() {
        let check = |distance: f64, time_s: f64| {
            let (mut at, mut speed, mut fastest) = (0.0_f64, 0.0_f64, 0.0_f64);
            for step in 0..100_000 {
                let rest = distance - at;
                if rest.abs() < 0.001 && speed.abs() < 0.03 {
                    let found_s = f64::from(step) * 0.001;
                    assert!((found_s - time_s).abs() < 0.15, "{distance}: {found_s} s");
                    assert!(fastest <= 0.5 + 1e-9, "{distance}: {fastest}");
                    return;
                }
                speed = LIMITS.next_speed(rest, speed, 0.001);
                fastest = fastest.max(speed.abs());
                at += speed * 0.001;
            }
            panic!("{distance} is not reached: {at}");
        };
        // 2 s to 0.5 m/s, 2 s back, and 1 m at 0.5 m/s.
        check(2.0, 6.0);
        check(-2.0, 6.0);
        // Half of 0.25 m at 0.25 m/s²: 1 s, and back.
        check(0.25, 2.0);
    }

    #[test]
    fn without_a_distance_it_brakes() {
        assert_eq!(LIMITS.next_speed(0.0, 0.5, 0.1), 0.4);
        assert_eq!(LIMITS.next_speed(1.0, -0.05, 0.1), 0.0);
        assert_eq!(LIMITS.next_speed(0.0, 0.0, 0.1), 0.0);
    }
}
