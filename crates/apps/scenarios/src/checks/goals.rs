//! Assertions about goals.

use periplus_geometry::Pose2;

use super::Verdict;
use crate::file::Scenario;
use crate::report::GoalEnd;
use crate::run::RunRecord;
use crate::tables::{PathRatioParams, ReachedParams};

pub(super) fn reached(params: &ReachedParams, record: &RunRecord) -> Verdict {
    match params.goal_m.as_slice() {
        [] => reached_all(params, record),
        [x, y, ..] => reached_point(params, [*x, *y], record),
        [_] => Verdict::unknown("`goal` needs [x, y]"),
    }
}

/// The robot came near a point.
fn reached_point(params: &ReachedParams, [x, y]: [f64; 2], record: &RunRecord) -> Verdict {
    let before_s = params.before_s.unwrap_or(f64::INFINITY);
    let poses = record.truth.trajectory.poses().iter();
    let distances = poses.filter(|it| it.stamp_s <= before_s).map(|it| {
        let at = it.pose.translation;
        (libm::hypot(at.x - x, at.y - y), it.stamp_s)
    });
    let nearest = distances.min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((distance_m, time_s)) = nearest else {
        return Verdict::unknown("there is no robot");
    };
    let limit_m = params.within_m;
    let message =
        format!("came within {distance_m:.3} m of ({x}, {y}) at {time_s:.2} s (limit {limit_m})");
    Verdict::new(distance_m <= limit_m, distance_m, "m", message)
}

/// The navigator and the truth agree that all goals were reached.
fn reached_all(params: &ReachedParams, record: &RunRecord) -> Verdict {
    if record.goal_event_count == 0 {
        return Verdict::unknown("the scenario has no goals; give `goal: [x, y]`");
    }
    if record.goals.len() < record.goal_event_count {
        let (ended, all) = (record.goals.len(), record.goal_event_count);
        return Verdict::unknown(format!("{ended} of {all} goals were sent before the run ended"));
    }
    let mut largest_m: f64 = 0.0;
    for (index, end) in record.goals.iter().enumerate() {
        let number = index + 1;
        let distance_m = distance_m(end);
        largest_m = largest_m.max(distance_m);
        let fail = |message: String| Verdict::new(false, distance_m, "m", message);
        if !end.is_success {
            return fail(format!("goal {number}: {}, {distance_m:.3} m from it", end.outcome));
        }
        if distance_m > params.within_m {
            let limit_m = params.within_m;
            return fail(format!("goal {number}: {distance_m:.3} m from it (limit {limit_m})"));
        }
        if let Some(before_s) = params.before_s.filter(|before_s| end.end_s > *before_s) {
            return fail(format!(
                "goal {number}: reached at {:.2} s (limit {before_s})",
                end.end_s
            ));
        }
    }
    let count = record.goals.len();
    Verdict::new(true, largest_m, "m", format!("{count} of {count} goals, to {largest_m:.3} m"))
}

fn distance_m(end: &GoalEnd) -> f64 {
    end.pose
        .map_or(f64::INFINITY, |pose| libm::hypot(pose.x_m - end.goal.x_m, pose.y_m - end.goal.y_m))
}

/// Driven length over the straight lines between start and goals.
pub(super) fn path_ratio(
    params: &PathRatioParams,
    scenario: &Scenario,
    record: &RunRecord,
) -> Verdict {
    let mut at: Pose2 = scenario.start();
    let mut straight_m = 0.0;
    for end in record.goals.iter().filter(|end| end.is_success) {
        straight_m += libm::hypot(end.goal.x_m - at.x_m, end.goal.y_m - at.y_m);
        at = end.goal;
    }
    if straight_m <= 0.0 {
        return Verdict::unknown("no goal was reached");
    }
    let ratio = record.truth.length_m / straight_m;
    let message = format!("{:.2} m for {straight_m:.2} m, ratio {ratio:.3}", record.truth.length_m);
    Verdict::new(ratio <= params.max_ratio, ratio, "", message)
}

#[cfg(test)]
mod tests {
    use periplus_evaluation::{StampedPose, Trajectory};

    use super::*;

    /// A robot that drives along x at 1 m/s for 3 s.
    fn record() -> RunRecord {
        let poses = (0..=30).map(|tick| {
            let time_s = f64::from(tick) * 0.1;
            StampedPose::planar(time_s, Pose2::new(time_s, 0.0, 0.0))
        });
        let mut record = RunRecord::default();
        record.truth.trajectory = Trajectory::new(poses);
        record
    }

    fn check(params: &ReachedParams) -> (bool, Option<f64>) {
        let verdict = reached(params, &record());
        (verdict.has_passed, verdict.measured)
    }

    #[test]
    fn a_point_is_reached_within_a_distance_and_a_time() {
        let point = |x: f64, before_s: Option<f64>| ReachedParams {
            goal_m: vec![x, 0.2],
            within_m: 0.25,
            before_s,
        };
        assert_eq!(check(&point(2.0, None)), (true, Some(0.2)));
        assert!(!check(&point(2.0, Some(1.0))).0);
        assert!(!check(&point(4.0, None)).0);
    }

    #[test]
    fn a_goal_that_the_navigator_gave_up_is_not_reached() {
        let goal = Pose2::new(3.0, 0.0, 0.0);
        let end = GoalEnd {
            goal,
            pose: Some(goal),
            outcome: "aborted".into(),
            is_success: false,
            end_s: 3.0,
            time_s: 3.0,
            recoveries: 0,
        };
        let mut record = RunRecord { goal_event_count: 1, goals: vec![end], ..record() };
        let params = ReachedParams::default();
        assert!(!reached(&params, &record).has_passed);
        record.goals[0].is_success = true;
        assert!(reached(&params, &record).has_passed);
        record.goal_event_count = 2;
        assert!(!reached(&params, &record).has_passed);
    }
}
