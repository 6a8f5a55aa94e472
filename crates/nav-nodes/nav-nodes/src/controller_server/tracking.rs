//! Position of the robot relative to its path.

use periplus_controllers::path::{distance_m, plan_length_m};
use periplus_geometry::{Pose2, normalize_angle};

/// Deviation from a path.
///
/// Source: `nav2_util/path_utils.cpp`, `controller_server.cpp` (main).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PathDeviation {
    /// Index of the first pose of the nearest segment.
    pub(super) segment: usize,
    /// Distance to it, positive on its left \[m\].
    pub(super) distance_m: f64,
    /// Direction of the segment minus that of the robot \[rad\].
    pub(super) heading_rad: f64,
    /// Length of the path from the segment on \[m\].
    pub(super) remaining_m: f64,
}

/// Finds the nearest segment of a path from the segment `first` on, within a length of path \[m\]. None for a path with
/// less than two poses.
pub(super) fn deviation(
    plan: &[Pose2],
    robot: Pose2,
    first: usize,
    window_m: f64,
) -> Option<PathDeviation> {
    let mut traversed_m = 0.0;
    let mut nearest: Option<(usize, f64)> = None;
    for (index, pair) in plan.windows(2).enumerate().skip(first) {
        if traversed_m > window_m {
            break;
        }
        let away_m = distance_to_segment_m(robot, pair[0], pair[1]);
        if nearest.is_none_or(|(_, nearest_m)| away_m < nearest_m) {
            nearest = Some((index, away_m));
        }
        traversed_m += distance_m(pair[0], pair[1]);
    }
    let (segment, away_m) = nearest?;
    let (start, end) = (plan[segment], plan[segment + 1]);
    let (dx_m, dy_m) = (end.x_m - start.x_m, end.y_m - start.y_m);
    let cross = dx_m * (robot.y_m - start.y_m) - dy_m * (robot.x_m - start.x_m);
    let direction_rad = libm::atan2(dy_m, dx_m);
    Some(PathDeviation {
        segment,
        distance_m: if cross >= 0.0 { away_m } else { -away_m },
        heading_rad: normalize_angle(direction_rad - robot.yaw_rad),
        remaining_m: plan_length_m(&plan[segment..]),
    })
}

fn distance_to_segment_m(point: Pose2, start: Pose2, end: Pose2) -> f64 {
    let (dx_m, dy_m) = (end.x_m - start.x_m, end.y_m - start.y_m);
    let squared_m2 = dx_m * dx_m + dy_m * dy_m;
    let along = (point.x_m - start.x_m) * dx_m + (point.y_m - start.y_m) * dy_m;
    let part = if squared_m2 > 0.0 { (along / squared_m2).clamp(0.0, 1.0) } else { 0.0 };
    let foot = Pose2::new(start.x_m + part * dx_m, start.y_m + part * dy_m, 0.0);
    distance_m(point, foot)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn check(
        robot: (f64, f64, f64),
        first: usize,
        window_m: f64,
        expected: (usize, f64, f64, f64),
    ) {
        // Two metres east, then one north.
        let plan = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0)];
        let plan = plan.map(|(x_m, y_m)| Pose2::new(x_m, y_m, 0.0));
        let robot = Pose2::new(robot.0, robot.1, robot.2);
        let found = deviation(&plan, robot, first, window_m).unwrap();
        let (segment, distance_m, heading_rad, remaining_m) = expected;
        assert_eq!(found, PathDeviation { segment, distance_m, heading_rad, remaining_m });
    }

    #[test]
    fn the_nearest_segment_is_found_within_the_window() {
        check((0.5, 0.5, 0.0), 0, 9.0, (0, 0.5, 0.0, 3.0));
        check((1.5, -0.25, 0.0), 0, 9.0, (1, -0.25, 0.0, 2.0));
        check((1.5, 0.75, 0.0), 0, 9.0, (2, 0.5, FRAC_PI_2, 1.0));
        check((1.5, 0.75, 0.0), 0, 0.5, (0, 0.9013878188659973, 0.0, 3.0));
        check((0.5, 0.0, 0.0), 1, 9.0, (1, 0.5, 0.0, 2.0));
        assert_eq!(deviation(&[Pose2::IDENTITY], Pose2::IDENTITY, 0, 1.0), None);
    }
}
