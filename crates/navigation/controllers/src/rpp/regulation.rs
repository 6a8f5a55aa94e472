//! Rules that reduce the speed.
//!
//! Source: `regulation_functions.hpp`, `applyConstraints` and `rotateToHeading` of
//! `regulated_pure_pursuit_controller.cpp`.

use periplus_costmap::cost;
use periplus_geometry::Pose2;

use super::PurePursuitParams;
use crate::path::plan_length_m;

/// Rule that decided about a speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedRule {
    /// The maximum speed or a speed limit.
    Maximum,
    /// The radius of the curve (`regulated_linear_scaling_min_radius`).
    Curvature,
    /// The distance to obstacles (`cost_scaling_dist`).
    Cost,
    /// The minimum speed (`regulated_linear_scaling_min_speed`).
    Minimum,
    /// The distance to the end of the plan (`approach_velocity_scaling_dist`).
    Approach,
}

/// Inputs of the rules in a cycle.
#[derive(Clone, Copy, Debug)]
pub struct RegulationInput<'a> {
    /// Speed before the rules \[m/s\].
    pub speed_m_s: f64,
    /// Maximum speed, with a speed limit \[m/s\].
    pub max_speed_m_s: f64,
    /// Curvature of the path \[1/m\].
    pub curvature_per_m: f64,
    /// Cost at the pose of the robot.
    pub pose_cost: u8,
    /// Inscribed radius of the footprint \[m\].
    pub inscribed_radius_m: f64,
    /// Plan in the base frame.
    pub plan_in_base: &'a [Pose2],
    /// 1 forwards, -1 backwards.
    pub direction: f64,
}

/// Regulated velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regulation {
    /// Speed by the rule of curvature alone \[m/s\].
    pub curvature_speed_m_s: f64,
    /// Speed by the rule of cost alone \[m/s\].
    pub cost_speed_m_s: f64,
    /// Velocity, negative backwards \[m/s\].
    pub linear_m_s: f64,
    /// Turn rate along the curve \[rad/s\].
    pub angular_rad_s: f64,
    /// Rule that decided.
    pub rule: SpeedRule,
}

/// Applies all rules: the minimum of those of curvature and cost, at least the minimum speed, then the approach.
#[must_use]
pub fn regulate(params: &PurePursuitParams, input: &RegulationInput<'_>) -> Regulation {
    let full_m_s = input.speed_m_s;
    let curvature_speed_m_s = if params.use_regulated_linear_velocity_scaling {
        let min_radius_m = params.regulated_linear_scaling_min_radius_m;
        curvature_speed_m_s(full_m_s, input.curvature_per_m, min_radius_m)
    } else {
        full_m_s
    };
    let cost_speed_m_s = if params.use_cost_regulated_linear_velocity_scaling {
        cost_speed_m_s(params, full_m_s, input.pose_cost, input.inscribed_radius_m)
    } else {
        full_m_s
    };
    let mut rule = if cost_speed_m_s < curvature_speed_m_s.min(full_m_s) {
        SpeedRule::Cost
    } else if curvature_speed_m_s < full_m_s {
        SpeedRule::Curvature
    } else {
        SpeedRule::Maximum
    };
    let mut speed_m_s = cost_speed_m_s.min(curvature_speed_m_s);
    let min_speed_m_s = params.regulated_linear_scaling_min_speed_m_s;
    if speed_m_s < min_speed_m_s {
        (speed_m_s, rule) = (min_speed_m_s, SpeedRule::Minimum);
    }
    let approach_m_s = approach_speed_m_s(params, speed_m_s, input.plan_in_base);
    if approach_m_s < speed_m_s {
        (speed_m_s, rule) = (approach_m_s, SpeedRule::Approach);
    }
    speed_m_s = speed_m_s.abs();
    if speed_m_s > input.max_speed_m_s {
        (speed_m_s, rule) = (input.max_speed_m_s, SpeedRule::Maximum);
    }
    let linear_m_s = input.direction * speed_m_s;
    Regulation {
        curvature_speed_m_s,
        cost_speed_m_s,
        linear_m_s,
        angular_rad_s: linear_m_s * input.curvature_per_m,
        rule,
    }
}

/// Speed in proportion to the radius of a curve, below a minimum radius.
fn curvature_speed_m_s(full_m_s: f64, curvature_per_m: f64, min_radius_m: f64) -> f64 {
    let radius_m = (1.0 / curvature_per_m).abs();
    if radius_m < min_radius_m { full_m_s * radius_m / min_radius_m } else { full_m_s }
}

/// Speed in proportion to the distance to obstacles, which follows from the cost by the law of the inflation layer:
/// cost = 253 exp(-s (d - r)) for the scaling s and the inscribed radius r.
fn cost_speed_m_s(
    params: &PurePursuitParams,
    full_m_s: f64,
    pose_cost: u8,
    inscribed_radius_m: f64,
) -> f64 {
    if matches!(pose_cost, cost::FREE | cost::UNKNOWN) {
        return full_m_s;
    }
    let scaling_per_m = params.inflation_cost_scaling_factor_per_m;
    let ratio = f64::from(pose_cost) / f64::from(cost::INSCRIBED);
    let distance_m = inscribed_radius_m - libm::log(ratio) / scaling_per_m;
    if distance_m < params.cost_scaling_dist_m {
        full_m_s * params.cost_scaling_gain * distance_m / params.cost_scaling_dist_m
    } else {
        full_m_s
    }
}

/// Speed in proportion to the distance to the end of the plan, once the rest of the plan is short.
fn approach_speed_m_s(params: &PurePursuitParams, speed_m_s: f64, plan_in_base: &[Pose2]) -> f64 {
    let scaling_m = params.approach_velocity_scaling_dist_m;
    let factor = match plan_in_base.last() {
        Some(last) if plan_length_m(plan_in_base) < scaling_m => {
            libm::hypot(last.x_m, last.y_m) / scaling_m
        }
        _ => 1.0,
    };
    speed_m_s.min((speed_m_s * factor).max(params.min_approach_linear_velocity_m_s))
}

/// Limits of a rotation in place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationLimits {
    /// Turn rate \[rad/s\].
    pub rate_rad_s: f64,
    /// Angular acceleration \[rad/s²\].
    pub acceleration_rad_s2: f64,
    /// Period of the control loop \[s\].
    pub period_s: f64,
}

impl RotationLimits {
    /// Returns the turn rate towards an angle \[rad/s\]: reachable from the present rate within a period, and low
    /// enough to stop at the angle.
    #[must_use]
    pub fn turn_rate_rad_s(&self, angle_rad: f64, present_rad_s: f64) -> f64 {
        let sign = if angle_rad > 0.0 { 1.0 } else { -1.0 };
        let step_rad_s = self.acceleration_rad_s2 * self.period_s;
        let rate_rad_s = (sign * self.rate_rad_s)
            .max(present_rad_s - step_rad_s)
            .min(present_rad_s + step_rad_s);
        let stopping_rad_s = libm::sqrt(2.0 * self.acceleration_rad_s2 * angle_rad.abs());
        if rate_rad_s.abs() > stopping_rad_s { sign * stopping_rad_s } else { rate_rad_s }
    }
}

/// Returns the maximum speed under a speed limit: 0 for none, a percentage, or metres a second.
#[must_use]
pub fn limited_speed_m_s(base_m_s: f64, limit: f64, is_percentage: bool) -> f64 {
    if limit == 0.0 {
        base_m_s
    } else if is_percentage {
        base_m_s * limit / 100.0
    } else {
        limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plan straight ahead, with a length and the distance of its end from the robot.
    fn check(curvature_per_m: f64, pose_cost: u8, end_m: f64, expected: (f64, SpeedRule)) {
        let params = PurePursuitParams::default();
        let plan_in_base = [Pose2::IDENTITY, Pose2::new(end_m, 0.0, 0.0)];
        let found = regulate(
            &params,
            &RegulationInput {
                speed_m_s: 0.5,
                max_speed_m_s: 0.5,
                curvature_per_m,
                pose_cost,
                inscribed_radius_m: 0.2,
                plan_in_base: &plan_in_base,
                direction: 1.0,
            },
        );
        assert!((found.linear_m_s - expected.0).abs() < 1e-9, "{found:?}");
        assert_eq!(found.rule, expected.1);
        assert!((found.angular_rad_s - found.linear_m_s * curvature_per_m).abs() < 1e-12);
    }

    #[test]
    fn each_rule_reduces_the_speed() {
        check(0.0, 0, 2.0, (0.5, SpeedRule::Maximum));
        check(0.0, 255, 2.0, (0.5, SpeedRule::Maximum));
        check(1.0 / 0.6, 0, 2.0, (0.5 * 0.6 / 0.9, SpeedRule::Curvature));
        check(10.0, 0, 2.0, (0.25, SpeedRule::Minimum));
        // Inscribed: the obstacle is at the inscribed radius of 0.2 m, a third of 0.6 m.
        check(0.0, 253, 2.0, (0.25, SpeedRule::Minimum));
        check(0.0, 150, 2.0, (0.311_876_165_2, SpeedRule::Cost));
        check(0.0, 0, 0.3, (0.25, SpeedRule::Approach));
        check(0.0, 0, 0.01, (0.05, SpeedRule::Approach));
    }

    #[test]
    fn rotations_can_stop_at_the_angle() {
        let limits = RotationLimits { rate_rad_s: 1.8, acceleration_rad_s2: 3.2, period_s: 0.05 };
        assert_eq!(limits.turn_rate_rad_s(3.0, 0.0), 3.2 * 0.05);
        assert_eq!(limits.turn_rate_rad_s(3.0, 1.8), 1.8);
        assert!((limits.turn_rate_rad_s(0.4, 1.75) - 1.6).abs() < 1e-12);
        assert!((limits.turn_rate_rad_s(1.0, -1.0) + 0.84).abs() < 1e-12);
        assert_eq!(limits.turn_rate_rad_s(-3.0, -1.8), -1.8);
    }

    #[test]
    fn speed_limits() {
        assert_eq!(limited_speed_m_s(0.5, 0.0, true), 0.5);
        assert_eq!(limited_speed_m_s(0.5, 40.0, true), 0.2);
        assert_eq!(limited_speed_m_s(0.5, 0.3, false), 0.3);
    }
}
