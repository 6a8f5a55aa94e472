//! Velocities that are reachable within a period (main).
//!
//! Source: `dynamic_window_pure_pursuit_functions.hpp`; F. Ohnishi, M. Takahashi, "Dynamic Window Pure Pursuit", 2026
//! (as cited there).

use periplus_geometry::Twist2;

use super::PurePursuitParams;

/// Speed below which an axis counts as standing still \[m/s or rad/s\].
const STANDSTILL_M_S: f64 = 1e-3;

/// Curvature below which a path is straight \[1/m\].
const STRAIGHT_PER_M: f64 = 1e-3;

/// Difference of distances to the line of the curvature below which two corners are equal \[m/s\].
const EQUAL_M_S: f64 = 1e-3;

/// Range of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct VelocityRange {
    min: f64,
    max: f64,
}

impl VelocityRange {
    /// Velocities within the limits that are reachable from the present one; decelerations are negative.
    fn reachable(present: f64, limits: Self, accel: f64, decel: f64, period_s: f64) -> Self {
        let (lower, upper) = if present > STANDSTILL_M_S {
            (decel, accel)
        } else if present < -STANDSTILL_M_S {
            (-accel, -decel)
        } else {
            (-accel, accel)
        };
        Self {
            min: (present + lower * period_s).max(limits.min),
            max: (present + upper * period_s).min(limits.max),
        }
    }

    /// Limits the range to the velocities between 0 and a regulated one; outside of these the nearest end remains.
    fn regulated(self, regulated: f64) -> Self {
        let (lowest, highest) = (regulated.min(0.0), regulated.max(0.0));
        let (min, max) = (self.min.max(lowest), self.max.min(highest));
        if min <= max {
            Self { min, max }
        } else if min > highest {
            Self { min, max: min }
        } else {
            Self { min: max, max }
        }
    }

    fn contains(self, value: f64) -> bool {
        value >= self.min && value <= self.max
    }

    /// The value nearest to 0.
    fn nearest_to_zero(self) -> f64 {
        if self.contains(0.0) {
            0.0
        } else if self.min.abs() <= self.max.abs() {
            self.min
        } else {
            self.max
        }
    }
}

/// Returns the velocity within the dynamic window that follows a curvature best: on the line turn rate = curvature x
/// velocity with the highest velocity in the direction of travel, or else nearest to that line.
#[must_use]
pub fn dynamic_window_velocity(
    params: &PurePursuitParams,
    max_speed_m_s: f64,
    present: Twist2,
    regulated_m_s: f64,
    curvature_per_m: f64,
    direction: f64,
    period_s: f64,
) -> Twist2 {
    let linear = VelocityRange::reachable(
        present.vx_m_s,
        VelocityRange { min: params.min_linear_vel_m_s, max: max_speed_m_s },
        params.max_linear_accel_m_s2,
        params.max_linear_decel_m_s2,
        period_s,
    )
    .regulated(regulated_m_s);
    let angular = VelocityRange::reachable(
        present.wz_rad_s,
        VelocityRange { min: params.min_angular_vel_rad_s, max: params.max_angular_vel_rad_s },
        params.max_angular_accel_rad_s2,
        params.max_angular_decel_rad_s2,
        period_s,
    );
    let (linear_m_s, angular_rad_s) = best(linear, angular, curvature_per_m, direction);
    Twist2::new(linear_m_s, 0.0, angular_rad_s)
}

fn best(
    linear: VelocityRange,
    angular: VelocityRange,
    curvature_per_m: f64,
    direction: f64,
) -> (f64, f64) {
    if curvature_per_m.abs() < STRAIGHT_PER_M {
        let linear_m_s = if direction >= 0.0 { linear.max } else { linear.min };
        return (linear_m_s, angular.nearest_to_zero());
    }
    let crossings = [
        (linear.min, curvature_per_m * linear.min),
        (linear.max, curvature_per_m * linear.max),
        (angular.min / curvature_per_m, angular.min),
        (angular.max / curvature_per_m, angular.max),
    ];
    let mut found: Option<(f64, f64)> = None;
    for (linear_m_s, angular_rad_s) in crossings {
        if linear.contains(linear_m_s)
            && angular.contains(angular_rad_s)
            && found.is_none_or(|(best_m_s, _)| linear_m_s * direction > best_m_s * direction)
        {
            found = Some((linear_m_s, angular_rad_s));
        }
    }
    found.unwrap_or_else(|| nearest_corner(linear, angular, curvature_per_m, direction))
}

/// The corner of the window nearest to the line of the curvature; the faster of equally near ones.
fn nearest_corner(
    linear: VelocityRange,
    angular: VelocityRange,
    curvature_per_m: f64,
    direction: f64,
) -> (f64, f64) {
    let corners = [
        (linear.min, angular.min),
        (linear.min, angular.max),
        (linear.max, angular.min),
        (linear.max, angular.max),
    ];
    let norm = libm::sqrt(curvature_per_m * curvature_per_m + 1.0);
    let mut nearest = (f64::INFINITY, corners[0]);
    for corner in corners {
        let away = (curvature_per_m * corner.0 - corner.1).abs() / norm;
        let is_faster = corner.0 * direction > nearest.1.0 * direction;
        if away < nearest.0 || (away - nearest.0).abs() <= EQUAL_M_S && is_faster {
            nearest = (away, corner);
        }
    }
    nearest.1
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[track_caller]
    fn check(present: (f64, f64), regulated: f64, curvature: f64, expected: (f64, f64)) {
        let params = PurePursuitParams::default();
        let present = Twist2::new(present.0, 0.0, present.1);
        let found = dynamic_window_velocity(&params, 0.5, present, regulated, curvature, 1.0, 0.05);
        let (v, w) = (found.vx_m_s, found.wz_rad_s);
        assert!((v - expected.0).abs() < 1e-12 && (w - expected.1).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn velocities_change_within_the_accelerations() {
        check((0.0, 0.0), 0.5, 0.0, (0.125, 0.0));
        check((0.5, 0.0), 0.5, 0.0, (0.5, 0.0));
        check((0.5, 0.0), 0.3, 0.0, (0.375, 0.0));
        check((0.5, 1.0), 0.5, 0.0, (0.5, 0.84));
        // From rest at most 0.16 rad/s: half of 0.125 m/s at a curvature of 2.56.
        check((0.0, 0.0), 0.5, 2.56, (0.0625, 0.16));
        // No crossing: the slowest and most curved corner is the nearest.
        check((0.5, 0.0), 0.5, 2.0, (0.375, 0.16));
    }

    proptest! {
        #[test]
        fn velocities_stay_within_the_limits(
            v in -0.5..0.5, w in -2.5..2.5, regulated in 0.0..0.5, curvature in -5.0..5.0_f64,
        ) {
            let params = PurePursuitParams::default();
            let present = Twist2::new(v, 0.0, w);
            let found =
                dynamic_window_velocity(&params, 0.5, present, regulated, curvature, 1.0, 0.05);
            prop_assert!((found.vx_m_s - v).abs() <= 2.5 * 0.05 + 1e-12);
            prop_assert!((found.wz_rad_s - w).abs() <= 3.2 * 0.05 + 1e-12);
        }
    }
}
