//! Pairs of poses over which relative errors are computed.

use periplus_geometry::Pose;

use crate::trajectory::distances_m;

/// Distance of the two poses of a relative error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RelativeDelta {
    /// Number of poses, at least 1.
    Frames(usize),
    /// Path length \[m\].
    Metres(f64),
    /// Rotation \[rad\].
    Radians(f64),
}

/// Selection of pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairSelection {
    /// Distance of the two poses.
    pub delta: RelativeDelta,
    /// True for a pair from every pose, false for consecutive pairs without overlap.
    pub all_pairs: bool,
    /// Tolerance of distances and rotations relative to `delta`, with `all_pairs` (default 0.1).
    pub tolerance_ratio: f64,
}

impl Default for PairSelection {
    fn default() -> Self {
        Self { delta: RelativeDelta::Frames(1), all_pairs: false, tolerance_ratio: 0.1 }
    }
}

impl PairSelection {
    /// Returns the indices of the two poses of each pair.
    ///
    /// The rules of `evo`: consecutive pairs begin where the pair before ended, at the first pose at which
    /// path length or summed rotation reach `delta`. With `all_pairs`, the second pose is the one after
    /// `delta` poses, the one whose path length from the first is nearest to `delta`, or each one whose
    /// rotation from the first is within the tolerance.
    #[must_use]
    pub fn indices(&self, poses: &[Pose]) -> Vec<(usize, usize)> {
        match (self.delta, self.all_pairs) {
            (RelativeDelta::Frames(count), true) => {
                (count.max(1)..poses.len()).map(|to| (to - count.max(1), to)).collect()
            }
            (RelativeDelta::Frames(count), false) => {
                let ends: Vec<usize> = (0..poses.len()).step_by(count.max(1)).collect();
                ends.windows(2).map(|it| (it[0], it[1])).collect()
            }
            (RelativeDelta::Metres(delta_m), true) => {
                let distances_m = distances_m(poses.iter().copied());
                nearest_pairs(&distances_m, delta_m, delta_m * self.tolerance_ratio)
            }
            (RelativeDelta::Metres(delta_m), false) => {
                consecutive(poses, delta_m, |a, b| a.translation.distance(b.translation))
            }
            (RelativeDelta::Radians(delta_rad), true) => {
                let tolerance_rad = delta_rad * self.tolerance_ratio;
                let range_rad = delta_rad - tolerance_rad..=delta_rad + tolerance_rad;
                let is_pair = |&(from, to): &(usize, usize)| {
                    range_rad.contains(&poses[from].distance_to(poses[to]).1)
                };
                let count = poses.len();
                let all = (0..count).flat_map(|from| (from + 1..count).map(move |to| (from, to)));
                all.filter(is_pair).collect()
            }
            (RelativeDelta::Radians(delta_rad), false) => {
                consecutive(poses, delta_rad, |a, b| a.distance_to(b).1)
            }
        }
    }
}

fn consecutive(
    poses: &[Pose],
    delta: f64,
    step: impl Fn(Pose, Pose) -> f64,
) -> Vec<(usize, usize)> {
    let (mut from, mut sum) = (0, 0.0);
    let mut pairs = Vec::new();
    for (index, pose) in poses.windows(2).enumerate() {
        sum += step(pose[0], pose[1]);
        if sum >= delta {
            pairs.push((from, index + 1));
            (from, sum) = (index + 1, 0.0);
        }
    }
    pairs
}

/// Distances grow, so that the nearest one is beside the first that reaches `delta_m`.
fn nearest_pairs(distances_m: &[f64], delta_m: f64, tolerance_m: f64) -> Vec<(usize, usize)> {
    let pair = |from: usize| {
        let later = distances_m.get(from + 1..)?;
        let away = |it: f64| (it - distances_m[from] - delta_m).abs();
        let after = later.partition_point(|it| it - distances_m[from] < delta_m);
        let before = after.checked_sub(1).and_then(|index| {
            // The first of poses at the same distance.
            let distance = later[index];
            let first = later.partition_point(|it| *it < distance);
            Some((first, away(*later.get(first)?)))
        });
        let after = later.get(after).map(|it| (after, away(*it)));
        let (index, away) = match (before, after) {
            (Some(before), Some(after)) if after.1 < before.1 => after,
            (Some(before), _) => before,
            (None, after) => after?,
        };
        (away <= tolerance_m).then_some((from, from + 1 + index))
    };
    (0..distances_m.len()).filter_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use proptest::prelude::*;

    use super::*;

    fn check(delta: RelativeDelta, all_pairs: bool, expected: &[(usize, usize)]) {
        // Along x, with a turn of a tenth at each pose.
        let poses = [(0.0, 0.0), (1.0, 0.1), (2.0, 0.2), (2.0, 0.3), (4.0, 0.4)]
            .map(|(x_m, yaw_rad)| Pose::from(Pose2::new(x_m, 0.0, yaw_rad)));
        let pairs = PairSelection { delta, all_pairs, ..PairSelection::default() };
        assert_eq!(pairs.indices(&poses), expected, "{delta:?} {all_pairs}");
        assert_eq!(pairs.indices(&[]), []);
    }

    #[test]
    fn pairs_by_frames() {
        check(RelativeDelta::Frames(2), false, &[(0, 2), (2, 4)]);
        check(RelativeDelta::Frames(2), true, &[(0, 2), (1, 3), (2, 4)]);
        check(RelativeDelta::Frames(9), true, &[]);
        check(RelativeDelta::Frames(0), false, &[(0, 1), (1, 2), (2, 3), (3, 4)]);
    }

    #[test]
    fn pairs_by_path() {
        check(RelativeDelta::Metres(1.5), false, &[(0, 2), (2, 4)]);
        check(RelativeDelta::Metres(2.0), true, &[(0, 2), (2, 4), (3, 4)]);
        check(RelativeDelta::Metres(3.0), true, &[(1, 4)]);
    }

    #[test]
    fn pairs_by_rotation() {
        check(RelativeDelta::Radians(0.19), false, &[(0, 2), (2, 4)]);
        check(RelativeDelta::Radians(0.3), true, &[(0, 3), (1, 4)]);
    }

    proptest! {
        #[test]
        fn the_nearest_pair_is_that_of_a_search(
            steps in prop::collection::vec(0.0..1.0_f64, 0..30),
            delta_m in 0.0..4.0_f64,
        ) {
            let mut distances = vec![0.0];
            for step in steps {
                // Some steps of exactly zero.
                distances.push(distances[distances.len() - 1] + (step - 0.2).max(0.0));
            }
            let mut expected = Vec::new();
            for from in 0..distances.len() {
                let away = |to: usize| (distances[to] - distances[from] - delta_m).abs();
                let best = (from + 1..distances.len()).min_by(|a, b| away(*a).total_cmp(&away(*b)));
                expected.extend(best.filter(|to| away(*to) <= 0.3).map(|to| (from, to)));
            }
            prop_assert_eq!(nearest_pairs(&distances, delta_m, 0.3), expected);
        }
    }
}
