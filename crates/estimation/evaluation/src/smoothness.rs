//! Smoothness of a driven path.

use periplus_geometry::{DVec3, normalize_angle};

use crate::trajectory::Trajectory;

/// Sampling of a path for [`Smoothness`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothnessSampling {
    /// Distance of the positions between which curvature is computed \[m\] (default 0.1).
    pub step_m: f64,
    /// Time between the positions of which jerk is computed \[s\] (default 0.2).
    pub period_s: f64,
}

impl Default for SmoothnessSampling {
    fn default() -> Self {
        Self { step_m: 0.1, period_s: 0.2 }
    }
}

/// Smoothness of a path in the plane; 0 for a line or an arc at constant speed.
///
/// Curvature is the change of direction between successive steps divided by the step; a reversal is a change
/// of half a turn. Jerk is the third difference of the position divided by the cube of the period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Smoothness {
    /// Mean of the absolute change of curvature along the path \[1/m²\]; none for less than four steps.
    pub curvature_change_mean_per_m2: Option<f64>,
    /// Root mean square of the change of curvature along the path \[1/m²\].
    pub curvature_change_rms_per_m2: Option<f64>,
    /// Mean of the jerk \[m/s³\]; none for less than four periods.
    pub jerk_mean_m_s3: Option<f64>,
    /// Root mean square of the jerk \[m/s³\].
    pub jerk_rms_m_s3: Option<f64>,
}

impl Smoothness {
    /// Returns the smoothness of a trajectory. Heights are not used.
    #[must_use]
    pub fn of(trajectory: &Trajectory, sampling: SmoothnessSampling) -> Self {
        let changes = curvature_changes(&by_distance(trajectory, sampling.step_m), sampling.step_m);
        let jerks = jerks(&by_time(trajectory, sampling.period_s), sampling.period_s);
        Self {
            curvature_change_mean_per_m2: mean(&changes),
            curvature_change_rms_per_m2: rms(&changes),
            jerk_mean_m_s3: mean(&jerks),
            jerk_rms_m_s3: rms(&jerks),
        }
    }
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

fn rms(values: &[f64]) -> Option<f64> {
    let squares: Vec<f64> = values.iter().map(|it| it * it).collect();
    mean(&squares).map(f64::sqrt)
}

/// Maximum number of samples of a path, a limit for tiny steps.
const MAX_SAMPLE_COUNT: f64 = 1e7;

/// Number of the last sample of a length.
fn last_sample(length: f64, step: f64) -> Option<usize> {
    // The last sample counts in spite of rounding.
    let count = (length / step + 1e-9).floor();
    (count.is_finite() && (0.0..=MAX_SAMPLE_COUNT).contains(&count)).then_some(count as usize)
}

/// Positions in the plane at equal distances along the path \[m\].
fn by_distance(trajectory: &Trajectory, step_m: f64) -> Vec<DVec3> {
    let distances_m = trajectory.distances_m();
    let poses = trajectory.poses();
    let last = distances_m.last().and_then(|length_m| last_sample(*length_m, step_m));
    let Some(last) = last else { return Vec::new() };
    let position = |number: usize| {
        let distance_m = number as f64 * step_m;
        let after = distances_m.partition_point(|it| *it < distance_m).min(poses.len() - 1);
        let Some(before) = after.checked_sub(1) else { return poses[0].pose.translation };
        let (from, to) = (poses[before].pose.translation, poses[after].pose.translation);
        let part = (distance_m - distances_m[before]) / (distances_m[after] - distances_m[before]);
        from.lerp(to, part.clamp(0.0, 1.0))
    };
    (0..=last).map(position).collect()
}

/// Positions at equal times \[m\].
fn by_time(trajectory: &Trajectory, period_s: f64) -> Vec<DVec3> {
    let last = trajectory.duration_s().and_then(|duration_s| last_sample(duration_s, period_s));
    let (Some(last), Some(first)) = (last, trajectory.poses().first()) else { return Vec::new() };
    let end_s = trajectory.poses().last().map_or(first.stamp_s, |it| it.stamp_s);
    let position = |number: usize| {
        let stamp_s = (first.stamp_s + number as f64 * period_s).min(end_s);
        trajectory.pose_at(stamp_s, f64::INFINITY).map(|it| it.translation)
    };
    (0..=last).filter_map(position).collect()
}

fn curvature_changes(positions: &[DVec3], step_m: f64) -> Vec<f64> {
    let direction = |it: &[DVec3]| libm::atan2(it[1].y - it[0].y, it[1].x - it[0].x);
    let directions: Vec<f64> = positions.windows(2).map(direction).collect();
    let curvature = |it: &[f64]| normalize_angle(it[1] - it[0]) / step_m;
    let curvatures: Vec<f64> = directions.windows(2).map(curvature).collect();
    curvatures.windows(2).map(|it| (it[1] - it[0]).abs() / step_m).collect()
}

fn jerks(positions: &[DVec3], period_s: f64) -> Vec<f64> {
    let jerk = |it: &[DVec3]| {
        let difference = it[3] - it[0] - 3.0 * (it[2] - it[1]);
        libm::hypot(difference.x, difference.y) / (period_s * period_s * period_s)
    };
    positions.windows(4).map(jerk).collect()
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;

    use super::*;
    use crate::trajectory::StampedPose;

    fn smoothness(count: usize, position: impl Fn(f64) -> [f64; 2]) -> Smoothness {
        let pose = |number: usize| {
            let stamp_s = number as f64 / 64.0;
            let [x_m, y_m] = position(stamp_s);
            StampedPose::planar(stamp_s, Pose2::new(x_m, y_m, 0.0))
        };
        let sampling = SmoothnessSampling { step_m: 0.25, period_s: 0.25 };
        Smoothness::of(&Trajectory::new((0..count).map(pose)), sampling)
    }

    #[test]
    fn a_line_at_constant_speed_is_smooth() {
        let found = smoothness(257, |t| [2.0 * t, t]);
        assert!(found.curvature_change_rms_per_m2.unwrap() < 1e-6, "{found:?}");
        assert!(found.jerk_rms_m_s3.unwrap() < 1e-6, "{found:?}");
    }

    #[test]
    fn a_corner_changes_the_curvature_twice() {
        // Two metres along x and two along y: 16 steps, 14 changes, of which two are a quarter turn over the
        // square of the step.
        let found = smoothness(257, |t| [t.min(2.0), (t - 2.0).max(0.0)]);
        let change = std::f64::consts::FRAC_PI_2 / 0.0625;
        let expected = [2.0 * change / 14.0, change * (2.0_f64 / 14.0).sqrt()];
        assert!((found.curvature_change_mean_per_m2.unwrap() - expected[0]).abs() < 1e-6);
        assert!((found.curvature_change_rms_per_m2.unwrap() - expected[1]).abs() < 1e-6);
    }

    #[test]
    fn the_third_derivative_of_a_cube_is_six() {
        let found = smoothness(129, |t| [t * t * t, 0.0]);
        assert!((found.jerk_mean_m_s3.unwrap() - 6.0).abs() < 1e-6, "{found:?}");
        assert!((found.jerk_rms_m_s3.unwrap() - 6.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn short_paths_have_no_smoothness() {
        assert_eq!(smoothness(0, |_| [0.0; 2]), Smoothness::default());
        let still = smoothness(65, |_| [1.0; 2]);
        assert_eq!((still.curvature_change_mean_per_m2, still.jerk_mean_m_s3), (None, Some(0.0)));
    }
}
