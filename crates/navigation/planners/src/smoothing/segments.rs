//! Parts of a path that are driven in one direction, and the yaws along them.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::Range;

use periplus_geometry::{Pose2, normalize_angle};

/// Size of a displacement that is none \[m\].
const NO_DISPLACEMENT_M: f64 = 1e-4;
/// Size of a turn that is none \[rad\].
const NO_TURN_RAD: f64 = 1e-4;

/// Returns the parts between cusps and rotations in place, as ranges of poses; a part ends with the pose with
/// which the next one begins.
pub(crate) fn directional_segments(path: &[Pose2]) -> Vec<Range<usize>> {
    let mut segments = Vec::new();
    let mut start = 0;
    for (index, triple) in path.windows(3).enumerate() {
        let (before, at, after) = (triple[0], triple[1], triple[2]);
        let (to_x, to_y) = (at.x_m - before.x_m, at.y_m - before.y_m);
        let (from_x, from_y) = (after.x_m - at.x_m, after.y_m - at.y_m);
        let is_cusp = to_x * from_x + to_y * from_y < 0.0;
        let turn_rad = normalize_angle(after.yaw_rad - at.yaw_rad);
        let is_rotation = from_x.abs() < NO_DISPLACEMENT_M
            && from_y.abs() < NO_DISPLACEMENT_M
            && turn_rad.abs() > NO_TURN_RAD;
        if is_cusp || is_rotation {
            segments.push(start..index + 2);
            start = index + 1;
        }
    }
    segments.push(start..path.len());
    segments
}

/// Returns true if a part of a path is driven backwards: its second pose points away from the third. A
/// holonomic robot has no backwards.
pub(crate) fn is_reversing(path: &[Pose2], is_holonomic: bool) -> bool {
    let [_, second, third, ..] = path else { return false };
    let direction_rad = libm::atan2(third.y_m - second.y_m, third.x_m - second.x_m);
    !is_holonomic && normalize_angle(direction_rad - second.yaw_rad).abs() > FRAC_PI_2
}

/// Sets the yaws of all poses but the last to the direction of the next pose, or against it. Poses that
/// coincide with the next keep theirs.
pub(crate) fn set_yaws_along(path: &mut [Pose2], is_reversing: bool) {
    for index in 1..path.len() {
        let (x_m, y_m) = (path[index].x_m, path[index].y_m);
        let pose = &mut path[index - 1];
        let (dx_m, dy_m) = (x_m - pose.x_m, y_m - pose.y_m);
        if dx_m.abs() >= NO_DISPLACEMENT_M || dy_m.abs() >= NO_DISPLACEMENT_M {
            let turn_rad = if is_reversing { PI } else { 0.0 };
            pose.yaw_rad = normalize_angle(libm::atan2(dy_m, dx_m) + turn_rad);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(path: &[[f64; 3]], segments: &[[usize; 2]]) {
        let path: Vec<Pose2> = path.iter().map(|[x, y, yaw]| Pose2::new(*x, *y, *yaw)).collect();
        let found: Vec<[usize; 2]> =
            directional_segments(&path).into_iter().map(|part| [part.start, part.end]).collect();
        assert_eq!(found, segments);
    }

    #[test]
    fn paths_are_split_at_cusps_and_rotations() {
        let forwards = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
        check(&forwards, &[[0, 4]]);
        let cusp = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.1, 0.0]];
        check(&cusp, &[[0, 3], [2, 4]]);
        let turn = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
        check(&turn, &[[0, 2], [1, 4]]);
        check(&forwards[..1], &[[0, 1]]);
        check(&[], &[[0, 0]]);
    }

    #[test]
    fn backwards_is_seen_by_the_second_pose() {
        let mut path = [3.0, 2.0, 1.0, 0.0].map(|x| Pose2::new(x, 0.0, 0.0));
        assert!(is_reversing(&path, false) && !is_reversing(&path, true));
        set_yaws_along(&mut path, true);
        assert!(path.iter().all(|pose| pose.yaw_rad.abs() < 1e-12), "{path:?}");
    }
}
