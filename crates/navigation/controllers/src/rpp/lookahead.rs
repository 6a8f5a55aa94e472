//! Lookahead point on the plan.
//!
//! Source: `getLookAheadPoint` of `regulated_pure_pursuit_controller.cpp` (Humble, Jazzy) and of
//! `nav2_util/controller_utils.cpp` (main). Pure pursuit: R. C. Coulter, "Implementation of the Pure Pursuit Path
//! Tracking Algorithm", 1992.

use periplus_geometry::{Pose2, Twist2};

use super::PurePursuitParams;
use crate::path::distance_m;

/// Rule by which the lookahead point is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LookaheadRule {
    /// Crossing of the plan with a circle around the robot (Humble, Jazzy).
    Circle,
    /// Distance along the plan (main).
    AlongPath,
}

/// Squared distance of a lookahead point below which the curvature is 0 \[m²\].
const MIN_SQUARED_DISTANCE_M2: f64 = 0.001;

/// Returns the lookahead distance at a velocity \[m\].
#[must_use]
pub fn lookahead_distance_m(params: &PurePursuitParams, velocity: Twist2) -> f64 {
    if !params.use_velocity_scaled_lookahead_dist {
        return params.lookahead_dist_m;
    }
    let scaled_m = velocity.vx_m_s.abs() * params.lookahead_time_s;
    scaled_m.min(params.max_lookahead_dist_m).max(params.min_lookahead_dist_m)
}

/// Returns the curvature of the arc through the origin, along x there, and a point \[1/m\]: 2 y / (x² + y²).
#[must_use]
pub fn curvature_per_m(point: Pose2) -> f64 {
    let squared_m2 = point.x_m * point.x_m + point.y_m * point.y_m;
    if squared_m2 > MIN_SQUARED_DISTANCE_M2 { 2.0 * point.y_m / squared_m2 } else { 0.0 }
}

/// Returns the lookahead point of a plan in the base frame. A plan that ends before has its last pose as the point, or
/// with `extends` a point on the extension of its last segment. None for an empty plan.
#[must_use]
pub fn lookahead_point(
    rule: LookaheadRule,
    plan_in_base: &[Pose2],
    lookahead_m: f64,
    interpolates: bool,
    extends: bool,
) -> Option<Pose2> {
    match rule {
        LookaheadRule::Circle => on_circle(plan_in_base, lookahead_m, interpolates, extends),
        LookaheadRule::AlongPath => along_path(plan_in_base, lookahead_m, extends),
    }
}

fn on_circle(plan: &[Pose2], radius_m: f64, interpolates: bool, extends: bool) -> Option<Pose2> {
    let is_far = |pose: &Pose2| libm::hypot(pose.x_m, pose.y_m) >= radius_m;
    match plan.iter().position(is_far) {
        Some(index) if index > 0 && interpolates => {
            Some(circle_crossing(plan[index - 1], plan[index], radius_m))
        }
        Some(index) => plan.get(index).copied(),
        None => match *plan {
            [.., before, last] if extends => {
                let beyond = extension(before, last, radius_m);
                Some(circle_crossing(last, beyond, radius_m))
            }
            _ => plan.last().copied(),
        },
    }
}

fn along_path(plan: &[Pose2], lookahead_m: f64, extends: bool) -> Option<Pose2> {
    let mut travelled_m = 0.0;
    for pair in plan.windows(2) {
        let step_m = distance_m(pair[0], pair[1]);
        if travelled_m + step_m >= lookahead_m {
            return Some(part_way(pair[0], pair[1], lookahead_m - travelled_m));
        }
        travelled_m += step_m;
    }
    match *plan {
        [.., before, last] if extends => {
            let beyond = extension(before, last, lookahead_m);
            Some(part_way(last, beyond, lookahead_m - travelled_m))
        }
        _ => plan.last().copied(),
    }
}

/// Point at a distance from `start` towards `end`, with that direction as its yaw.
fn part_way(start: Pose2, end: Pose2, away_m: f64) -> Pose2 {
    let (dx_m, dy_m) = (end.x_m - start.x_m, end.y_m - start.y_m);
    let length_m = libm::hypot(dx_m, dy_m);
    let part = if length_m > 0.0 { away_m / length_m } else { 0.0 };
    Pose2::new(start.x_m + part * dx_m, start.y_m + part * dy_m, libm::atan2(dy_m, dx_m))
}

/// Point at a distance behind `last` on the line through both.
fn extension(before: Pose2, last: Pose2, length_m: f64) -> Pose2 {
    let yaw_rad = libm::atan2(last.y_m - before.y_m, last.x_m - before.x_m);
    let (sine, cosine) = libm::sincos(yaw_rad);
    Pose2::new(last.x_m + cosine * length_m, last.y_m + sine * length_m, yaw_rad)
}

/// Point at which the segment from a point inside of a circle around the origin to one outside leaves it.
fn circle_crossing(inside: Pose2, outside: Pose2, radius_m: f64) -> Pose2 {
    let (dx_m, dy_m) = (outside.x_m - inside.x_m, outside.y_m - inside.y_m);
    // |inside + part d|² = r² for a part of at least 0.
    let a = dx_m * dx_m + dy_m * dy_m;
    let half_b = inside.x_m * dx_m + inside.y_m * dy_m;
    let c = inside.x_m * inside.x_m + inside.y_m * inside.y_m - radius_m * radius_m;
    let root = libm::sqrt((half_b * half_b - a * c).max(0.0));
    let part = if a > 0.0 { (root - half_b) / a } else { 0.0 };
    Pose2::new(inside.x_m + part * dx_m, inside.y_m + part * dy_m, libm::atan2(dy_m, dx_m))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn plan(points: &[(f64, f64)]) -> Vec<Pose2> {
        points.iter().map(|(x_m, y_m)| Pose2::new(*x_m, *y_m, 0.0)).collect()
    }

    #[track_caller]
    fn check(rule: LookaheadRule, extends: bool, lookahead_m: f64, expected: (f64, f64)) {
        let plan = plan(&[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]);
        let point = lookahead_point(rule, &plan, lookahead_m, true, extends).unwrap();
        let off_m = libm::hypot(point.x_m - expected.0, point.y_m - expected.1);
        assert!(off_m < 1e-12, "{point:?}");
    }

    #[test]
    fn the_rules_differ_behind_a_corner() {
        check(LookaheadRule::Circle, false, 2.0, (2.0, 0.0));
        check(LookaheadRule::AlongPath, false, 2.0, (2.0, 0.0));
        check(LookaheadRule::Circle, false, 5.0, (3.0, 4.0));
        check(LookaheadRule::AlongPath, false, 5.0, (3.0, 2.0));
        check(LookaheadRule::AlongPath, false, 9.0, (3.0, 4.0));
        check(LookaheadRule::AlongPath, true, 9.0, (3.0, 6.0));
        check(LookaheadRule::Circle, true, 3.0 * 5.0_f64.sqrt(), (3.0, 6.0));
    }

    #[test]
    fn speed_scales_the_distance_within_limits() {
        let params = PurePursuitParams {
            use_velocity_scaled_lookahead_dist: true,
            ..PurePursuitParams::default()
        };
        let distance = |vx| lookahead_distance_m(&params, Twist2::new(vx, 0.0, 0.0));
        assert_eq!([distance(0.0), distance(-0.4), distance(5.0)], [0.3, 0.4 * 1.5, 0.9]);
        assert_eq!(curvature_per_m(Pose2::new(1.0, 1.0, 0.0)), 1.0);
        assert_eq!(curvature_per_m(Pose2::new(0.02, 0.02, 0.0)), 0.0);
    }

    proptest! {
        #[test]
        fn the_point_on_the_circle_is_on_it(
            x_m in 0.0..0.5, y_m in -0.5..0.5, to_x_m in 1.0..3.0, to_y_m in -3.0..3.0,
        ) {
            let plan = plan(&[(x_m, y_m), (to_x_m, to_y_m)]);
            let point = lookahead_point(LookaheadRule::Circle, &plan, 0.8, true, false).unwrap();
            prop_assert!((libm::hypot(point.x_m, point.y_m) - 0.8).abs() < 1e-9);
        }
    }
}
