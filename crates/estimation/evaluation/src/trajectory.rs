//! Poses over time.

use periplus_geometry::{Pose, Pose2};

/// A pose at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StampedPose {
    /// Stamp \[s\].
    pub stamp_s: f64,
    /// `world_from_body`; the world is the fixed frame of the trajectory (`map`, `odom`).
    pub pose: Pose,
}

impl StampedPose {
    /// Pose in the plane at a time \[s\].
    #[must_use]
    pub fn planar(stamp_s: f64, pose: Pose2) -> Self {
        Self { stamp_s, pose: pose.into() }
    }
}

/// Poses in order of their stamps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    poses: Vec<StampedPose>,
}

impl Trajectory {
    /// Trajectory of poses in any order. Poses with numbers that are not finite are dropped; poses with
    /// equal stamps keep their order.
    #[must_use]
    pub fn new(poses: impl IntoIterator<Item = StampedPose>) -> Self {
        let is_finite = |it: &StampedPose| it.stamp_s.is_finite() && it.pose.is_finite();
        let mut poses: Vec<StampedPose> = poses.into_iter().filter(is_finite).collect();
        poses.sort_by(|a, b| a.stamp_s.total_cmp(&b.stamp_s));
        Self { poses }
    }

    /// Poses in order of their stamps.
    #[must_use]
    pub fn poses(&self) -> &[StampedPose] {
        &self.poses
    }

    /// Returns the sum of the distances between successive poses \[m\]; none without poses.
    #[must_use]
    pub fn length_m(&self) -> Option<f64> {
        if self.poses.is_empty() { None } else { self.distances_m().last().copied() }
    }

    /// Returns the path length from the first pose to each pose \[m\].
    #[must_use]
    pub fn distances_m(&self) -> Vec<f64> {
        distances_m(self.poses.iter().map(|it| it.pose))
    }

    /// Returns the time from the first to the last pose \[s\]; none without poses.
    #[must_use]
    pub fn duration_s(&self) -> Option<f64> {
        Some(self.poses.last()?.stamp_s - self.poses.first()?.stamp_s)
    }

    /// Returns the pose at a time \[s\]: between two poses the position is interpolated linearly and the
    /// orientation by slerp. None outside the trajectory, and in gaps longer than `max_gap_s`.
    #[must_use]
    pub fn pose_at(&self, stamp_s: f64, max_gap_s: f64) -> Option<Pose> {
        let after = self.poses.partition_point(|it| it.stamp_s < stamp_s);
        let next = self.poses.get(after)?;
        if next.stamp_s == stamp_s {
            return Some(next.pose);
        }
        let last = self.poses.get(after.checked_sub(1)?)?;
        let gap_s = next.stamp_s - last.stamp_s;
        if gap_s > max_gap_s {
            return None;
        }
        let part = (stamp_s - last.stamp_s) / gap_s;
        let translation = last.pose.translation.lerp(next.pose.translation, part);
        Some(Pose { translation, rotation: last.pose.rotation.slerp(next.pose.rotation, part) })
    }
}

/// Returns the path length from the first pose to each pose \[m\].
pub(crate) fn distances_m(poses: impl Iterator<Item = Pose>) -> Vec<f64> {
    let mut sum_m = 0.0;
    let mut last: Option<Pose> = None;
    let distance = |pose: Pose| {
        sum_m += last.map_or(0.0, |last| last.translation.distance(pose.translation));
        last = Some(pose);
        sum_m
    };
    poses.map(distance).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line() -> Trajectory {
        let pose = |(stamp_s, x_m)| StampedPose::planar(stamp_s, Pose2::new(x_m, 0.0, 0.0));
        Trajectory::new([(2.0, 3.0), (0.0, 0.0), (1.0, 1.0), (9.0, 3.0)].map(pose))
    }

    #[test]
    fn poses_are_sorted_and_measured() {
        assert_eq!(line().distances_m(), [0.0, 1.0, 3.0, 3.0]);
        assert_eq!((line().length_m(), line().duration_s()), (Some(3.0), Some(9.0)));
        assert_eq!(
            (Trajectory::default().length_m(), Trajectory::default().duration_s()),
            (None, None)
        );
    }

    #[test]
    fn poses_are_interpolated_within_gaps() {
        let check = |stamp_s: f64, expected: Option<f64>| {
            assert_eq!(
                line().pose_at(stamp_s, 5.0).map(|it| it.translation.x),
                expected,
                "{stamp_s}"
            );
        };
        check(1.0, Some(1.0));
        check(1.5, Some(2.0));
        check(-0.1, None);
        check(5.0, None);
        check(9.0, Some(3.0));
        check(9.1, None);
    }

    #[test]
    fn poses_that_are_not_finite_are_dropped() {
        let poses = [f64::NAN, 1.0].map(|x_m| StampedPose::planar(0.0, Pose2::new(x_m, 0.0, 0.0)));
        assert_eq!(Trajectory::new(poses).poses().len(), 1);
    }
}
