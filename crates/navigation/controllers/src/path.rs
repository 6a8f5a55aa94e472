//! Geometry of plans: lengths, nearest poses, cusps.
//!
//! Source: `nav2_util/geometry_utils.hpp`, `path_utils.cpp`.

use periplus_geometry::{Pose2, normalize_angle};

/// Distance below which two poses count as one position \[m\]; `path_utils.cpp`.
const SAME_POSITION_M: f64 = 1e-4;

/// Returns the distance between the positions of two poses \[m\].
#[must_use]
pub fn distance_m(a: Pose2, b: Pose2) -> f64 {
    libm::hypot(a.x_m - b.x_m, a.y_m - b.y_m)
}

/// Returns the length of a plan \[m\].
#[must_use]
pub fn plan_length_m(plan: &[Pose2]) -> f64 {
    plan.windows(2).map(|pair| distance_m(pair[0], pair[1])).sum()
}

/// Returns the index of the first pose whose distance along the plan from the start exceeds `beyond_m`; the
/// number of poses if there is none.
#[must_use]
pub fn first_beyond(plan: &[Pose2], beyond_m: f64) -> usize {
    let mut travelled_m = 0.0;
    for (index, pair) in plan.windows(2).enumerate() {
        travelled_m += distance_m(pair[0], pair[1]);
        if travelled_m > beyond_m {
            return index + 1;
        }
    }
    plan.len()
}

/// Returns the index of the pose nearest to a position, the last of equally near ones; 0 for an empty plan.
#[must_use]
pub fn nearest_index(plan: &[Pose2], to: Pose2) -> usize {
    let mut nearest = (0, f64::INFINITY);
    for (index, pose) in plan.iter().enumerate() {
        let away_m = distance_m(*pose, to);
        if away_m <= nearest.1 {
            nearest = (index, away_m);
        }
    }
    nearest.0
}

/// Returns the index of the pose after which a plan may only be followed once that pose is reached: after a cusp if
/// `with_cusps`, and after a rotation in place of more than `min_rotation_rad`. None without such a pose.
#[must_use]
pub fn first_constraint(
    plan: &[Pose2],
    with_cusps: bool,
    min_rotation_rad: Option<f64>,
) -> Option<usize> {
    if plan.len() < 3 {
        return None;
    }
    let mut before: Option<(f64, f64)> = None;
    for (index, pair) in plan.windows(2).enumerate() {
        let (dx_m, dy_m) = (pair[1].x_m - pair[0].x_m, pair[1].y_m - pair[0].y_m);
        let is_moving = libm::hypot(dx_m, dy_m) > SAME_POSITION_M;
        if is_moving && with_cusps {
            if before.is_some_and(|(x_m, y_m)| x_m * dx_m + y_m * dy_m < 0.0) {
                return Some(index + 1);
            }
            before = Some((dx_m, dy_m));
        }
        if !is_moving
            && let Some(min_rad) = min_rotation_rad
            && let Some(end) = rotation_end(&plan[index..], min_rad)
        {
            return Some(index + end);
        }
    }
    None
}

/// Returns the index at which a rotation in place at the start of a plan exceeds an angle \[rad\].
fn rotation_end(plan: &[Pose2], min_rotation_rad: f64) -> Option<usize> {
    let mut turned_rad = 0.0;
    for (index, pair) in plan.windows(2).enumerate() {
        if distance_m(pair[0], pair[1]) > SAME_POSITION_M {
            return None;
        }
        turned_rad += normalize_angle(pair[1].yaw_rad - pair[0].yaw_rad).abs();
        if turned_rad > min_rotation_rad {
            return Some(index + 1);
        }
    }
    None
}

/// Returns the distance of the first cusp or rotation in place from the robot \[m\], for a plan in the base frame;
/// none without one. Rotations count from Jazzy on.
#[must_use]
pub fn cusp_distance_m(plan_in_base: &[Pose2], with_rotations: bool) -> Option<f64> {
    let is_turn = |a: Pose2, b: Pose2| distance_m(a, b) == 0.0 && a.yaw_rad != b.yaw_rad;
    let cusp = plan_in_base.windows(3).find(|poses| {
        let [a, b, c] = [poses[0], poses[1], poses[2]];
        let along = (b.x_m - a.x_m) * (c.x_m - b.x_m) + (b.y_m - a.y_m) * (c.y_m - b.y_m);
        along < 0.0 || with_rotations && (is_turn(a, b) || is_turn(b, c))
    })?;
    Some(libm::hypot(cusp[1].x_m, cusp[1].y_m))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn plan(points: &[(f64, f64)]) -> Vec<Pose2> {
        points.iter().map(|(x_m, y_m)| Pose2::new(*x_m, *y_m, 0.0)).collect()
    }

    #[test]
    fn lengths_and_indices() {
        let plan = plan(&[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]);
        assert_eq!(plan_length_m(&plan), 7.0);
        assert_eq!(plan_length_m(&plan[..1]), 0.0);
        assert_eq!(first_beyond(&plan, 2.9), 1);
        assert_eq!(first_beyond(&plan, 3.0), 2, "the distance itself is not beyond");
        assert_eq!(first_beyond(&plan, 7.0), 3);
        assert_eq!(nearest_index(&plan, Pose2::new(2.0, 0.0, 0.0)), 1);
        assert_eq!(nearest_index(&plan, Pose2::new(1.5, 0.0, 0.0)), 1, "the last of equals");
    }

    #[test]
    fn cusps_and_rotations_end_a_segment() {
        let cusp = plan(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.5, 0.1), (1.0, 0.2)]);
        assert_eq!(first_constraint(&cusp, true, None), Some(3));
        assert_eq!(first_constraint(&cusp, false, None), None);
        assert_eq!(cusp_distance_m(&cusp, false), Some(2.0));
        let mut turn = plan(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (1.0, 1.0)]);
        turn[2].yaw_rad = FRAC_PI_2;
        assert_eq!(first_constraint(&turn, true, Some(0.785)), Some(2));
        assert_eq!(first_constraint(&turn, true, Some(2.0)), None);
        assert_eq!(cusp_distance_m(&turn, true), Some(1.0));
        assert_eq!(cusp_distance_m(&turn, false), None);
    }
}
