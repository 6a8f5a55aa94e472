//! Wheel angles over time, and the motion that follows from them.

use periplus_geometry::Pose2;

/// Angles of both wheels at a time, as in `sensor_msgs/JointState`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelSample {
    /// Stamp \[s\].
    pub stamp_s: f64,
    /// Angle of the left wheel \[rad\], not limited to a turn.
    pub left_rad: f64,
    /// Angle of the right wheel \[rad\].
    pub right_rad: f64,
}

/// Parameters of a differential drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DifferentialDrive {
    /// Radius of the left wheel \[m\].
    pub left_radius_m: f64,
    /// Radius of the right wheel \[m\].
    pub right_radius_m: f64,
    /// Distance of the wheels \[m\].
    pub wheel_distance_m: f64,
}

impl DifferentialDrive {
    /// Returns the motion while the wheels turn at constant speeds by these angles \[rad\]: an arc.
    #[must_use]
    pub fn motion(&self, left_rad: f64, right_rad: f64) -> Pose2 {
        let (left_m, right_m) = (self.left_radius_m * left_rad, self.right_radius_m * right_rad);
        let yaw_rad = (right_m - left_m) / self.wheel_distance_m;
        arc(0.5 * (left_m + right_m), yaw_rad)
    }

    /// Returns the angles of both wheels for a motion along an arc \[rad\]: [`Self::motion`] reversed.
    #[must_use]
    pub fn wheel_angles(&self, length_m: f64, yaw_rad: f64) -> (f64, f64) {
        let half_m = 0.5 * self.wheel_distance_m * yaw_rad;
        ((length_m - half_m) / self.left_radius_m, (length_m + half_m) / self.right_radius_m)
    }
}

/// Pose at the end of an arc from the origin along x.
fn arc(length_m: f64, yaw_rad: f64) -> Pose2 {
    let (sine, cosine) = sine_ratios(yaw_rad);
    Pose2::new(length_m * sine, length_m * cosine, yaw_rad)
}

/// Returns sin(a)/a and (1 - cos(a))/a.
pub(crate) fn sine_ratios(angle_rad: f64) -> (f64, f64) {
    if angle_rad.abs() < 1e-4 {
        // Series up to the third order, exact to a double below this angle.
        return (1.0 - angle_rad * angle_rad / 6.0, 0.5 * angle_rad);
    }
    let (sine, cosine) = libm::sincos(angle_rad);
    (sine / angle_rad, (1.0 - cosine) / angle_rad)
}

/// Ratio of the time between two samples to the usual one above which the recording has a gap. Half of the
/// recording is in times up to the usual one.
const GAP_RATIO: f64 = 5.0;

/// Wheel angles in order of time, interpolated linearly between samples, but not in gaps: times more than five
/// times as long as usual, in which the wheels turned.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WheelTrack {
    samples: Vec<WheelSample>,
    /// Shortest time between samples that is a gap \[s\].
    gap_s: f64,
}

impl WheelTrack {
    /// Track of samples in any order. Samples that are not finite are dropped, and of equal stamps all but
    /// the first.
    #[must_use]
    pub fn new(samples: impl IntoIterator<Item = WheelSample>) -> Self {
        let is_finite = |it: &WheelSample| {
            it.stamp_s.is_finite() && it.left_rad.is_finite() && it.right_rad.is_finite()
        };
        let mut samples: Vec<WheelSample> = samples.into_iter().filter(is_finite).collect();
        samples.sort_by(|a, b| a.stamp_s.total_cmp(&b.stamp_s));
        samples.dedup_by_key(|it| it.stamp_s);
        let mut steps_s: Vec<f64> =
            samples.windows(2).map(|it| it[1].stamp_s - it[0].stamp_s).collect();
        steps_s.sort_by(f64::total_cmp);
        let half_s = 0.5 * steps_s.iter().sum::<f64>();
        let mut sum_s = 0.0;
        let usual_s = steps_s.into_iter().find(|it| {
            sum_s += it;
            sum_s >= half_s
        });
        Self { samples, gap_s: GAP_RATIO * usual_s.unwrap_or(0.0) }
    }

    /// Track of wheels that would have turned as odometry has it, for recordings without wheel angles: stamps
    /// \[s\] and poses, and the drive with which odometry was computed. Poses are taken in order of time; the robot
    /// follows an arc between two.
    #[must_use]
    pub fn from_odometry(
        poses: impl IntoIterator<Item = (f64, Pose2)>,
        drive: &DifferentialDrive,
    ) -> Self {
        let is_finite = |it: &(f64, Pose2)| it.0.is_finite() && it.1.is_finite();
        let mut poses: Vec<(f64, Pose2)> = poses.into_iter().filter(is_finite).collect();
        poses.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut last: Option<Pose2> = None;
        let (mut left_rad, mut right_rad) = (0.0, 0.0);
        Self::new(poses.into_iter().map(|(stamp_s, pose)| {
            if let Some(last) = last.replace(pose) {
                let step = (last.inverse() * pose).normalized();
                let chord_m = libm::hypot(step.x_m, step.y_m).copysign(step.x_m);
                let (sine, cosine) = sine_ratios(step.yaw_rad);
                let length_m = chord_m / libm::hypot(sine, cosine);
                let (left, right) = drive.wheel_angles(length_m, step.yaw_rad);
                (left_rad, right_rad) = (left_rad + left, right_rad + right);
            }
            WheelSample { stamp_s, left_rad, right_rad }
        }))
    }

    /// Samples in order of time.
    #[must_use]
    pub fn samples(&self) -> &[WheelSample] {
        &self.samples
    }

    /// Returns the angles of both wheels at a time \[rad\]; none outside the track and in a gap.
    #[must_use]
    pub fn angles_at(&self, stamp_s: f64) -> Option<(f64, f64)> {
        let after = self.samples.partition_point(|it| it.stamp_s < stamp_s);
        let next = self.samples.get(after)?;
        if next.stamp_s == stamp_s {
            return Some((next.left_rad, next.right_rad));
        }
        let last = self.samples.get(after.checked_sub(1)?)?;
        let is_at_rest = last.left_rad == next.left_rad && last.right_rad == next.right_rad;
        if next.stamp_s - last.stamp_s > self.gap_s && !is_at_rest {
            return None;
        }
        let part = (stamp_s - last.stamp_s) / (next.stamp_s - last.stamp_s);
        let between = |from: f64, to: f64| from + part * (to - from);
        Some((between(last.left_rad, next.left_rad), between(last.right_rad, next.right_rad)))
    }

    /// Returns the motion of a drive from one time to a later one \[s\], `from_from_to`; none if one is outside the
    /// track or in a gap.
    #[must_use]
    pub fn motion(&self, drive: &DifferentialDrive, from_s: f64, to_s: f64) -> Option<Pose2> {
        let (mut left, mut right) = self.angles_at(from_s)?;
        let last = self.angles_at(to_s)?;
        let first = self.samples.partition_point(|it| it.stamp_s <= from_s);
        let end = self.samples.partition_point(|it| it.stamp_s < to_s).max(first);
        let mut pose = Pose2::IDENTITY;
        let between = self.samples.get(first..end)?.iter().map(|it| (it.left_rad, it.right_rad));
        for (next_left, next_right) in between.chain([last]) {
            pose = pose * drive.motion(next_left - left, next_right - right);
            (left, right) = (next_left, next_right);
        }
        Some(pose)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    const DRIVE: DifferentialDrive =
        DifferentialDrive { left_radius_m: 0.1, right_radius_m: 0.1, wheel_distance_m: 0.5 };

    fn near(a: Pose2, b: [f64; 3]) -> bool {
        (a.x_m - b[0]).abs() + (a.y_m - b[1]).abs() + (a.yaw_rad - b[2]).abs() < 1e-9
    }

    #[test]
    fn wheels_roll_along_lines_and_arcs() {
        assert!(near(DRIVE.motion(10.0, 10.0), [1.0, 0.0, 0.0]));
        // A quarter of a circle of one metre.
        let (left, right) = DRIVE.wheel_angles(FRAC_PI_2, FRAC_PI_2);
        assert!(near(DRIVE.motion(left, right), [1.0, 1.0, FRAC_PI_2]));
        // In place.
        let (left, right) = DRIVE.wheel_angles(0.0, 1.0);
        assert!((left + 2.5).abs() < 1e-12 && (right - 2.5).abs() < 1e-12);
        assert!(near(DRIVE.motion(left, right), [0.0, 0.0, 1.0]));
    }

    #[test]
    fn wheels_of_odometry_repeat_it() {
        let quarter = Pose2::new(1.0, 1.0, FRAC_PI_2);
        let poses =
            [(1.0, quarter), (0.0, Pose2::IDENTITY), (2.0, quarter * Pose2::new(-0.5, 0.0, 0.0))];
        let track = WheelTrack::from_odometry(poses, &DRIVE);
        assert!(near(track.motion(&DRIVE, 0.0, 1.0).unwrap(), [1.0, 1.0, FRAC_PI_2]));
        assert!(near(track.motion(&DRIVE, 1.0, 2.0).unwrap(), [-0.5, 0.0, 0.0]));
    }

    #[test]
    fn angles_in_a_gap_are_not_known() {
        let sample = |stamp_s: f64, angle_rad| WheelSample {
            stamp_s,
            left_rad: angle_rad,
            right_rad: angle_rad,
        };
        let track = WheelTrack::new([
            sample(0.0, 0.0),
            sample(1.0, 1.0),
            sample(2.0, 2.0),
            sample(3.0, 3.0),
            sample(9.0, 4.0),
            sample(15.0, 4.0),
            sample(16.0, 5.0),
            sample(17.0, 6.0),
            sample(18.0, 7.0),
            sample(18.001, 7.001),
            sample(19.0, 8.0),
            sample(19.001, 8.001),
            sample(20.0, 9.0),
            sample(21.0, 9.0),
            sample(22.0, 9.0),
            sample(23.0, 9.0),
            sample(24.0, 9.0),
        ]);
        assert_eq!(track.angles_at(2.5), Some((2.5, 2.5)));
        // Somewhere in six seconds the wheels turned; in the next six they were at rest.
        assert_eq!(track.angles_at(8.0), None);
        assert_eq!(track.angles_at(12.0), Some((4.0, 4.0)));
        assert!(near(track.motion(&DRIVE, 1.0, 9.0).unwrap(), [0.3, 0.0, 0.0]));
    }

    #[test]
    fn motions_follow_the_samples() {
        let (left, right) = DRIVE.wheel_angles(FRAC_PI_2, FRAC_PI_2);
        let sample = |(stamp_s, left_rad, right_rad)| WheelSample { stamp_s, left_rad, right_rad };
        // Straight for a metre, then the quarter of a circle.
        let samples =
            [(2.0, 10.0 + left, 10.0 + right), (0.0, 0.0, 0.0), (1.0, 10.0, 10.0), (1.0, 9.0, 9.0)];
        let track = WheelTrack::new(samples.map(sample));
        assert!(near(track.motion(&DRIVE, 0.0, 2.0).unwrap(), [2.0, 1.0, FRAC_PI_2]));
        assert!(near(track.motion(&DRIVE, 0.25, 0.75).unwrap(), [0.5, 0.0, 0.0]));
        assert_eq!((track.motion(&DRIVE, 0.0, 2.1), track.motion(&DRIVE, -1.0, 1.0)), (None, None));
        assert_eq!(WheelTrack::default().angles_at(0.0), None);
    }
}
