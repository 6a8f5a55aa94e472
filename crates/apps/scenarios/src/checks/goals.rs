//! Assertions about goals.

use periplus_evaluation::{GoalRun, shortest_path_m};
use periplus_geometry::Pose2;
use periplus_session::SimulationSession;

use super::Verdict;
use crate::file::Scenario;
use crate::report::GoalEnd;
use crate::run::RunRecord;
use crate::tables::{PathRatioParams, ReachedParams, SplParams};

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

/// Success weighted by path length, over all goals of the events.
pub(super) fn spl(
    params: &SplParams,
    scenario: &Scenario,
    session: &mut SimulationSession,
    record: &RunRecord,
) -> Verdict {
    if record.goal_event_count == 0 {
        return Verdict::unknown("the scenario has no goals");
    }
    let simulation = session.simulation_mut();
    let radius_m = simulation.robot_footprint_m().map_or(0.0, |it| inscribed_radius_m(&it));
    let Some(map) = record.grid.and_then(|grid| simulation.truth_map(grid)) else {
        return Verdict::unknown("there is no robot");
    };
    let shortest_m = |from: Pose2, to: Pose2| {
        shortest_path_m(&map, radius_m, [from.x_m, from.y_m], [to.x_m, to.y_m])
    };
    match goal_runs(params.within_m, scenario.start(), record, shortest_m) {
        Ok(runs) => {
            let value = periplus_evaluation::spl(&runs).unwrap_or(0.0);
            let limit = params.min_ratio;
            let parts: Vec<String> = runs.iter().map(text).collect();
            let message = format!("SPL {value:.3} (limit {limit}): {}", parts.join(", "));
            Verdict::new(value >= limit, value, "", message)
        }
        Err(message) => Verdict::unknown(message),
    }
}

fn text(run: &GoalRun) -> String {
    if run.is_success {
        format!("{:.2} m for {:.2} m", run.length_m, run.shortest_m)
    } else {
        "not reached".to_owned()
    }
}

/// Runs to all goals of the events; one that was not sent is a run without success. Lengths are those of the true path
/// from the sending of a goal to its end.
fn goal_runs(
    within_m: f64,
    start: Pose2,
    record: &RunRecord,
    shortest_m: impl Fn(Pose2, Pose2) -> Option<f64>,
) -> Result<Vec<GoalRun>, String> {
    let poses = record.truth.trajectory.poses();
    let mut at = start;
    let mut runs = Vec::new();
    for (index, end) in record.goals.iter().enumerate() {
        let is_success = end.is_success && distance_m(end) <= within_m;
        let begin_s = end.end_s - end.time_s;
        let driven = poses.iter().filter(|it| it.stamp_s >= begin_s && it.stamp_s <= end.end_s);
        let points: Vec<_> = driven.map(|it| it.pose.translation).collect();
        let steps = points.windows(2).map(|it| libm::hypot(it[1].x - it[0].x, it[1].y - it[0].y));
        let length_m = steps.sum();
        // Only the length of a run that reaches its goal counts.
        let shortest_m = if is_success {
            let Pose2 { x_m, y_m, .. } = end.goal;
            shortest_m(at, end.goal).ok_or_else(|| {
                format!(
                    "the true map has no path to goal {} at ({x_m}, {y_m}): give `region`",
                    index + 1
                )
            })?
        } else {
            0.0
        };
        runs.push(GoalRun { is_success, length_m, shortest_m });
        at = end.pose.unwrap_or(at);
    }
    while runs.len() < record.goal_event_count {
        runs.push(GoalRun { is_success: false, length_m: 0.0, shortest_m: 0.0 });
    }
    Ok(runs)
}

/// Radius of the largest circle about the origin inside a convex footprint \[m\].
fn inscribed_radius_m(footprint_m: &[[f64; 2]]) -> f64 {
    let next = footprint_m.iter().cycle().skip(1);
    let edges = footprint_m.iter().zip(next).map(|([ax, ay], [bx, by])| {
        let (dx, dy) = (bx - ax, by - ay);
        let squared = dx * dx + dy * dy;
        let along =
            if squared > 0.0 { (-(ax * dx + ay * dy) / squared).clamp(0.0, 1.0) } else { 0.0 };
        libm::hypot(ax + along * dx, ay + along * dy)
    });
    let nearest = edges.fold(f64::INFINITY, f64::min);
    if nearest.is_finite() { nearest } else { 0.0 }
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

    #[test]
    fn spl_weighs_each_goal_by_its_path() {
        let end = |x: f64, end_s: f64, is_success: bool| GoalEnd {
            goal: Pose2::new(x, 0.0, 0.0),
            pose: Some(Pose2::new(end_s, 0.0, 0.0)),
            outcome: String::new(),
            is_success,
            end_s,
            time_s: 1.0,
            recoveries: 0,
        };
        // 1 m driven for 1 m; 1 m driven for a shortest path of 0.5 m; aborted; never sent.
        let goals = vec![end(1.0, 1.0, true), end(2.0, 2.0, true), end(3.0, 3.0, false)];
        let record = RunRecord { goal_event_count: 4, goals, ..record() };
        let shortest_m = |_: Pose2, to: Pose2| Some(if to.x_m < 1.5 { 1.0 } else { 0.5 });
        let runs = goal_runs(0.3, Pose2::IDENTITY, &record, shortest_m).unwrap();
        assert!((runs[1].length_m - 1.0).abs() < 1e-9, "{runs:?}");
        let value = periplus_evaluation::spl(&runs).unwrap();
        assert!((value - (1.0 + 0.5) / 4.0).abs() < 1e-9, "{value}");
        assert!(goal_runs(0.3, Pose2::IDENTITY, &record, |_, _| None).is_err());
        // Success that the truth does not confirm is none.
        assert!(
            !goal_runs(
                0.3,
                Pose2::IDENTITY,
                &RunRecord { goals: vec![end(9.0, 1.0, true)], ..record },
                shortest_m
            )
            .unwrap()[0]
                .is_success
        );
    }

    #[test]
    fn the_circle_inside_a_footprint_touches_its_nearest_side() {
        let box_m = [[-0.3, -0.2], [0.5, -0.2], [0.5, 0.2], [-0.3, 0.2]];
        assert_eq!(inscribed_radius_m(&box_m), 0.2);
        assert_eq!(inscribed_radius_m(&[]), 0.0);
    }
}
