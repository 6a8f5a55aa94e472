//! Poses of two trajectories at equal times.

use periplus_geometry::Pose;

use crate::trajectory::{StampedPose, Trajectory};

/// Poses of a reference and of an estimate at the same time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosePair {
    /// Stamp of the estimate \[s\].
    pub stamp_s: f64,
    /// True pose.
    pub reference: Pose,
    /// Estimated pose.
    pub estimate: Pose,
}

/// Associates each pose of the trajectory with fewer poses with the pose of the other one that is nearest
/// in time, where both are at most `max_difference_s` apart. Of two equally near poses the earlier one
/// counts. If both trajectories have the same number of poses, those of the estimate are associated.
///
/// The rule of `evo.core.sync.associate_trajectories`.
#[must_use]
pub fn associate(
    reference: &Trajectory,
    estimate: &Trajectory,
    max_difference_s: f64,
) -> Vec<PosePair> {
    let (reference, estimate) = (reference.poses(), estimate.poses());
    if estimate.len() > reference.len() {
        let pair = |from: &StampedPose| {
            let to = nearest(estimate, from.stamp_s, max_difference_s)?;
            Some(PosePair { stamp_s: to.stamp_s, reference: from.pose, estimate: to.pose })
        };
        return reference.iter().filter_map(pair).collect();
    }
    let pair = |from: &StampedPose| {
        let to = nearest(reference, from.stamp_s, max_difference_s)?;
        Some(PosePair { stamp_s: from.stamp_s, reference: to.pose, estimate: from.pose })
    };
    estimate.iter().filter_map(pair).collect()
}

/// Pairs each estimated pose with the reference, interpolated at its stamp. Poses outside of the reference
/// and in its gaps longer than `max_gap_s` are left out.
#[must_use]
pub fn associate_interpolated(
    reference: &Trajectory,
    estimate: &Trajectory,
    max_gap_s: f64,
) -> Vec<PosePair> {
    let pair = |it: &StampedPose| {
        let pose = reference.pose_at(it.stamp_s, max_gap_s)?;
        Some(PosePair { stamp_s: it.stamp_s, reference: pose, estimate: it.pose })
    };
    estimate.poses().iter().filter_map(pair).collect()
}

fn nearest(poses: &[StampedPose], stamp_s: f64, max_difference_s: f64) -> Option<&StampedPose> {
    let after = poses.partition_point(|it| it.stamp_s <= stamp_s);
    let before = after.checked_sub(1).and_then(|index| poses.get(index));
    let difference_s =
        |it: Option<&StampedPose>| it.map_or(f64::INFINITY, |it| (it.stamp_s - stamp_s).abs());
    let next = poses.get(after);
    let nearest = if difference_s(next) < difference_s(before) { next } else { before };
    nearest.filter(|_| difference_s(nearest) <= max_difference_s)
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;

    use super::*;

    fn at(stamps_s: &[f64]) -> Trajectory {
        let pose = |&it: &f64| StampedPose::planar(it, Pose2::new(it, 0.0, 0.0));
        Trajectory::new(stamps_s.iter().map(pose))
    }

    fn check(reference: &[f64], estimate: &[f64], expected: &[[f64; 2]]) {
        let pairs = associate(&at(reference), &at(estimate), 0.25);
        let found: Vec<[f64; 2]> = pairs
            .iter()
            .map(|it| [it.reference.translation.x, it.estimate.translation.x])
            .collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn the_shorter_trajectory_decides() {
        check(&[0.0, 1.0, 2.0], &[0.125, 0.875], &[[0.0, 0.125], [1.0, 0.875]]);
        check(&[0.125, 0.875], &[0.0, 1.0, 2.0], &[[0.125, 0.0], [0.875, 1.0]]);
    }

    #[test]
    fn the_limit_is_inclusive_and_ties_take_the_earlier_pose() {
        check(&[0.0, 1.0, 2.0], &[1.25, 1.5], &[[1.0, 1.25]]);
        check(&[0.0, 0.5, 1.0], &[0.25, 0.75], &[[0.0, 0.25], [0.5, 0.75]]);
    }

    #[test]
    fn empty_trajectories_have_no_pairs() {
        check(&[], &[1.0], &[]);
        check(&[1.0], &[], &[]);
    }

    #[test]
    fn the_reference_is_interpolated() {
        let pairs = associate_interpolated(&at(&[0.0, 1.0, 5.0]), &at(&[0.25, 3.0, 6.0]), 2.0);
        let found: Vec<[f64; 2]> =
            pairs.iter().map(|it| [it.stamp_s, it.reference.translation.x]).collect();
        assert_eq!(found, [[0.25, 0.25]]);
    }
}
