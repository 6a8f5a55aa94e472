//! Segments of a path with the errors of odometry over them.

use periplus_geometry::{Pose2, normalize_angle};

/// Pose of the base at a stamp by odometry, and by a reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferencedOdometry {
    /// Stamp \[s\].
    pub stamp_s: f64,
    /// Pose by odometry.
    pub odom_from_base: Pose2,
    /// Pose by the reference, for example SLAM.
    pub map_from_base: Pose2,
}

/// Distance between the starts of segments relative to the length of the shortest.
const START_STEP_RATIO: f64 = 0.25;

/// Maximum length of a segment relative to its nominal length: longer ones jump over a gap.
const MAX_LENGTH_RATIO: f64 = 1.5;

/// Number of terms of the variance of an error.
pub(crate) const TERM_COUNT: usize = 8;

/// Terms of the expected squared errors of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Terms {
    pub(crate) position: [f64; TERM_COUNT],
    pub(crate) heading: [f64; TERM_COUNT],
}

/// Segment of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    from: usize,
    to: usize,
    /// Length of the path before the segment \[m\].
    pub(crate) start_m: f64,
}

/// Path by odometry.
pub(crate) struct OdometryPath<'a> {
    poses: &'a [Pose2],
    /// Signed distances and rotations between neighbouring poses \[m\], \[rad\].
    steps: Vec<(f64, f64)>,
    /// Length of the path up to each pose \[m\].
    lengths_m: Vec<f64>,
}

impl<'a> OdometryPath<'a> {
    pub(crate) fn new(poses: &'a [Pose2]) -> Self {
        let step = |pair: &[Pose2]| {
            let step = (pair[0].inverse() * pair[1]).normalized();
            // Sideways motion is not of a differential drive; it counts as distance.
            (libm::hypot(step.x_m, step.y_m).copysign(step.x_m), step.yaw_rad)
        };
        let steps: Vec<(f64, f64)> = poses.windows(2).map(step).collect();
        let mut lengths_m = vec![0.0];
        let mut length_m = 0.0;
        for (distance_m, _) in &steps {
            length_m += distance_m.abs();
            lengths_m.push(length_m);
        }
        Self { poses, steps, lengths_m }
    }

    /// Length of the path \[m\].
    pub(crate) fn length_m(&self) -> f64 {
        self.lengths_m.last().copied().unwrap_or(0.0)
    }

    /// Segments of a length, which overlap.
    pub(crate) fn segments(&self, length_m: f64, shortest_m: f64) -> Vec<Segment> {
        let step_m = START_STEP_RATIO * shortest_m;
        let at = |length_m: f64| self.lengths_m.partition_point(|it| *it < length_m);
        let count = ((self.length_m() - length_m) / step_m).ceil().max(0.0) as usize;
        let segment = |index: usize| {
            let start_m = index as f64 * step_m;
            let (from, to) = (at(start_m), at(start_m + length_m));
            let found_m = self.lengths_m.get(to)? - self.lengths_m.get(from)?;
            (from < to && found_m < MAX_LENGTH_RATIO * length_m).then_some(Segment {
                from,
                to,
                start_m,
            })
        };
        (0..count).filter_map(segment).collect()
    }

    /// Terms of the expected squared errors: constant of the heading, its random walks per metre and per
    /// radian, its gains per net rotation and per length; constant of the position, and its random walks per
    /// metre and per radian. An error of the heading turns the rest of the segment, so that each of its terms
    /// is also one of the position, with the lever arm to the end.
    pub(crate) fn terms(&self, segment: &Segment) -> Terms {
        let end = self.poses[segment.to];
        let (mut distance_m, mut turn_rad, mut net_turn_rad) = (0.0, 0.0, 0.0);
        let (mut walk_distance, mut walk_turn) = (0.0, 0.0);
        let (mut gain_turn, mut gain_distance) = ([0.0; 2], [0.0; 2]);
        for index in segment.from..segment.to {
            let (step_m, step_rad) = self.steps[index];
            let (a, b) = (self.poses[index], self.poses[index + 1]);
            let arm = [end.x_m - 0.5 * (a.x_m + b.x_m), end.y_m - 0.5 * (a.y_m + b.y_m)];
            let square = arm[0] * arm[0] + arm[1] * arm[1];
            distance_m += step_m.abs();
            turn_rad += step_rad.abs();
            net_turn_rad += step_rad;
            walk_distance += step_m.abs() * square;
            walk_turn += step_rad.abs() * square;
            for axis in 0..2 {
                gain_turn[axis] += step_rad * arm[axis];
                gain_distance[axis] += step_m.abs() * arm[axis];
            }
        }
        let square = |it: [f64; 2]| it[0] * it[0] + it[1] * it[1];
        Terms {
            heading: [
                1.0,
                distance_m,
                turn_rad,
                net_turn_rad * net_turn_rad,
                distance_m * distance_m,
                0.0,
                0.0,
                0.0,
            ],
            position: [
                0.0,
                walk_distance,
                walk_turn,
                square(gain_turn),
                square(gain_distance),
                1.0,
                distance_m,
                turn_rad,
            ],
        }
    }
}

/// Squared errors of position \[m²\] and heading \[rad²\] of odometry over a segment.
pub(crate) fn squared_errors(pairs: &[ReferencedOdometry], segment: &Segment) -> [f64; 2] {
    let (from, to) = (pairs[segment.from], pairs[segment.to]);
    let expected = from.map_from_base.inverse() * to.map_from_base;
    let found = from.odom_from_base.inverse() * to.odom_from_base;
    let (x_m, y_m) = (found.x_m - expected.x_m, found.y_m - expected.y_m);
    let yaw_rad = normalize_angle(found.yaw_rad - expected.yaw_rad);
    [x_m * x_m + y_m * y_m, yaw_rad * yaw_rad]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_heading_moves_the_end_by_the_lever_arm() {
        // Two metres ahead after a turn of 1 rad on the spot.
        let poses = [Pose2::new(0.0, 0.0, -1.0), Pose2::IDENTITY, Pose2::new(2.0, 0.0, 0.0)];
        let path = OdometryPath::new(&poses);
        let segments = path.segments(2.0, 2.0);
        assert!(segments.is_empty(), "the path ends before a full segment: {segments:?}");
        let terms = path.terms(&Segment { from: 0, to: 2, start_m: 0.0 });
        assert_eq!(terms.heading, [1.0, 2.0, 1.0, 1.0, 4.0, 0.0, 0.0, 0.0]);
        // The turn has an arm of 2 m, the path one of 1 m in the mean.
        assert_eq!(terms.position, [0.0, 2.0, 4.0, 4.0, 4.0, 1.0, 2.0, 1.0]);
    }

    #[test]
    fn errors_are_those_of_the_segment_alone() {
        // Odometry has turned by 90 degrees before, and is 10 cm short.
        let pair = |odom, map| ReferencedOdometry {
            stamp_s: 0.0,
            odom_from_base: odom,
            map_from_base: map,
        };
        let quarter = std::f64::consts::FRAC_PI_2;
        let pairs = [
            pair(Pose2::new(5.0, 1.0, quarter), Pose2::IDENTITY),
            pair(Pose2::new(5.0, 1.9, quarter + 0.1), Pose2::new(1.0, 0.0, 0.0)),
        ];
        let [position, heading] = squared_errors(&pairs, &Segment { from: 0, to: 1, start_m: 0.0 });
        assert!((position - 0.01).abs() < 1e-12 && (heading - 0.01).abs() < 1e-12);
    }

    #[test]
    fn segments_over_gaps_are_left_out() {
        let at = |x_m: f64| Pose2::new(x_m, 0.0, 0.0);
        let poses: Vec<Pose2> = (0..40).map(|it| at(0.1 * f64::from(it))).collect();
        let path = OdometryPath::new(&poses);
        assert_eq!(path.segments(1.0, 1.0).len(), 12);
        let gap: Vec<Pose2> =
            poses.iter().map(|it| if it.x_m > 2.0 { at(it.x_m + 3.0) } else { *it }).collect();
        let path = OdometryPath::new(&gap);
        let longest = path.segments(1.0, 1.0).into_iter().map(|it| path.terms(&it).heading[1]);
        assert!(longest.fold(0.0, f64::max) < 1.5);
    }
}
