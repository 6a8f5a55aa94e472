//! Assertions about estimates of the pose.

use periplus_evaluation::{
    ErrorStatistics, PosePair, StampedPose, Trajectory, associate_interpolated,
};

use super::Verdict;
use crate::run::RunRecord;
use crate::tables::{
    ErrorStatistic, LocalizationErrorParams, OdometryErrorParams, TrackingErrorParams,
};

/// Longest gap of the true trajectory between whose poses it is interpolated \[s\].
const MAX_GAP_S: f64 = 0.1;

fn value(statistics: &ErrorStatistics, statistic: ErrorStatistic) -> f64 {
    match statistic {
        ErrorStatistic::Max => statistics.max,
        ErrorStatistic::Rms => statistics.rmse,
        ErrorStatistic::Mean => statistics.mean,
    }
}

fn judged(
    name: &str,
    statistics: Option<ErrorStatistics>,
    statistic: ErrorStatistic,
    max_m: f64,
) -> Verdict {
    let Some(statistics) = statistics else {
        return Verdict::unknown(format!("there is no {name}"));
    };
    let error_m = value(&statistics, statistic);
    let word = match statistic {
        ErrorStatistic::Max => "largest",
        ErrorStatistic::Rms => "rms",
        ErrorStatistic::Mean => "mean",
    };
    let message = format!("{word} {name} {error_m:.3} m (limit {max_m})");
    Verdict::new(error_m <= max_m, error_m, "m", message)
}

fn pairs(truth: &Trajectory, estimate: &Trajectory, from_s: f64) -> Vec<PosePair> {
    let poses = estimate.poses().iter().filter(|it| it.stamp_s >= from_s);
    let estimate = Trajectory::new(poses.copied().collect::<Vec<StampedPose>>());
    associate_interpolated(truth, &estimate, MAX_GAP_S)
}

/// Distance in the plane between two poses \[m\].
fn distance_m(pair: &PosePair) -> f64 {
    let between = pair.estimate.translation - pair.reference.translation;
    libm::hypot(between.x, between.y)
}

/// Errors of the estimated position in the map \[m\].
pub(super) fn localization_statistics(record: &RunRecord, from_s: f64) -> Option<ErrorStatistics> {
    let pairs = pairs(&record.truth.trajectory, &record.estimates.localization, from_s);
    ErrorStatistics::of(&pairs.iter().map(distance_m).collect::<Vec<f64>>())
}

/// Errors of the position by odometry \[m\], with equal poses at the first time.
pub(super) fn odometry_statistics(record: &RunRecord, from_s: f64) -> Option<ErrorStatistics> {
    let pairs = pairs(&record.truth.trajectory, &record.estimates.odometry, from_s);
    let first = pairs.first()?;
    let world_from_odom = first.reference * first.estimate.inverse();
    let in_world = |it: &PosePair| PosePair { estimate: world_from_odom * it.estimate, ..*it };
    let errors_m = pairs.iter().map(|pair| distance_m(&in_world(pair)));
    ErrorStatistics::of(&errors_m.collect::<Vec<f64>>())
}

pub(super) fn localization_error(params: &LocalizationErrorParams, record: &RunRecord) -> Verdict {
    let statistics = localization_statistics(record, params.from_s);
    judged("error of the estimated position", statistics, params.statistic, params.max_m)
}

pub(super) fn odometry_error(params: &OdometryErrorParams, record: &RunRecord) -> Verdict {
    let statistics = odometry_statistics(record, params.from_s);
    judged("error of odometry", statistics, params.statistic, params.max_m)
}

pub(super) fn tracking_error(params: &TrackingErrorParams, record: &RunRecord) -> Verdict {
    let statistics = ErrorStatistics::of(&record.estimates.tracking_errors_m);
    judged("distance from the path", statistics, params.statistic, params.max_m)
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;

    use super::*;

    fn line(offset_m: impl Fn(f64) -> f64) -> Trajectory {
        Trajectory::new((0..=40).map(|tick| {
            let time_s = f64::from(tick) * 0.1;
            StampedPose::planar(time_s, Pose2::new(time_s, offset_m(time_s), 0.0))
        }))
    }

    /// A robot along x; localization is 0.1 m beside it, from 2 s on 0.3 m; odometry begins elsewhere and drifts by
    /// 0.05 m/s.
    fn record() -> RunRecord {
        let mut record = RunRecord::default();
        record.truth.trajectory = line(|_| 0.0);
        record.estimates.localization = line(|time_s| if time_s < 1.95 { 0.1 } else { 0.3 });
        record.estimates.odometry = line(|time_s| 5.0 + 0.05 * time_s);
        record
    }

    #[test]
    fn errors_are_distances_at_equal_times() {
        let of = |from_s: f64| localization_statistics(&record(), from_s).unwrap();
        assert!((of(0.0).max - 0.3).abs() < 1e-9 && (of(0.0).min - 0.1).abs() < 1e-9);
        assert!((of(2.0).mean - 0.3).abs() < 1e-9);
    }

    #[test]
    fn odometry_counts_from_its_first_pose() {
        let statistics = odometry_statistics(&record(), 0.0).unwrap();
        assert!((statistics.max - 0.2).abs() < 1e-9, "{}", statistics.max);
    }

    #[test]
    fn an_assertion_without_an_estimate_fails() {
        let params = LocalizationErrorParams { max_m: 1.0, ..LocalizationErrorParams::default() };
        assert!(localization_error(&params, &record()).has_passed);
        assert!(!localization_error(&params, &RunRecord::default()).has_passed);
    }
}
