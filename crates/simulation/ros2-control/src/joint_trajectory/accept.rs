//! Checks of received trajectories.

use super::JointTrajectorySettings;
use crate::{JointTrajectory, TrajectoryPoint};

/// Largest velocity at the last point that counts as zero: the precision of a 32-bit number.
const MAX_END_VELOCITY_RATIO: f64 = 1.192_092_9e-7;

/// Error codes of `control_msgs/action/FollowJointTrajectory`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrajectoryErrorCode {
    /// The points are not valid.
    InvalidGoal,
    /// The joints are not those of the controller.
    InvalidJoints,
    /// The trajectory ends in the past.
    OldHeaderTimestamp,
    /// A joint left the path.
    PathToleranceViolated,
    /// A joint did not reach its goal.
    GoalToleranceViolated,
}

impl TrajectoryErrorCode {
    /// Returns the number in the message.
    #[must_use]
    pub fn number(self) -> i32 {
        match self {
            Self::InvalidGoal => -1,
            Self::InvalidJoints => -2,
            Self::OldHeaderTimestamp => -3,
            Self::PathToleranceViolated => -4,
            Self::GoalToleranceViolated => -5,
        }
    }
}

/// Reason for which a trajectory is not followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrajectoryRejection {
    /// Code.
    pub code: TrajectoryErrorCode,
    /// Reason.
    pub reason: String,
}

fn rejected<T>(code: TrajectoryErrorCode, reason: String) -> Result<T, TrajectoryRejection> {
    Err(TrajectoryRejection { code, reason })
}

/// Returns a trajectory in the order of the controller's joints, with a position at each point.
pub(super) fn accepted(
    settings: &JointTrajectorySettings,
    trajectory: &JointTrajectory,
    before: &TrajectoryPoint,
    now_ns: i64,
) -> Result<JointTrajectory, TrajectoryRejection> {
    let order = order_of(settings, trajectory)?;
    check_points(settings, trajectory)?;
    let start_ns = if trajectory.start_ns == 0 { now_ns } else { trajectory.start_ns };
    let mut points: Vec<TrajectoryPoint> = Vec::new();
    for point in &trajectory.points {
        let last = points.last().unwrap_or(before);
        let mut sorted = TrajectoryPoint {
            positions: sorted(&point.positions, &order, |joint| last.positions[joint]),
            velocities: sorted(&point.velocities, &order, |_| 0.0),
            accelerations: sorted(&point.accelerations, &order, |_| 0.0),
            efforts: sorted(&point.efforts, &order, |_| 0.0),
            time_from_start_ns: point.time_from_start_ns,
        };
        if sorted.positions.is_empty() {
            let since_ns =
                point.time_from_start_ns - points.last().map_or(0, |last| last.time_from_start_ns);
            integrate(last, &mut sorted, since_ns as f64 * 1e-9);
        }
        points.push(sorted);
    }
    let joints = settings.joints.clone();
    let accepted = JointTrajectory { joints, points, start_ns };
    if accepted.end_ns() < now_ns {
        let reason = "the trajectory ends in the past; set the stamp of its header to zero to \
                      start it when it is received";
        return rejected(TrajectoryErrorCode::OldHeaderTimestamp, reason.into());
    }
    Ok(accepted)
}

/// Returns the index of each joint of the controller in the trajectory.
fn order_of(
    settings: &JointTrajectorySettings,
    trajectory: &JointTrajectory,
) -> Result<Vec<Option<usize>>, TrajectoryRejection> {
    let code = TrajectoryErrorCode::InvalidJoints;
    if let Some(unknown) = trajectory.joints.iter().find(|name| !settings.joints.contains(name)) {
        let known = settings.joints.join(", ");
        return rejected(
            code,
            format!("the joint `{unknown}` is none of the controller's: {known}"),
        );
    }
    let order: Vec<Option<usize>> = settings
        .joints
        .iter()
        .map(|joint| trajectory.joints.iter().position(|name| name == joint))
        .collect();
    let missing = settings.joints.iter().zip(&order).find(|(_, place)| place.is_none());
    match missing {
        Some((joint, _)) if !settings.allows_partial_goals || trajectory.joints.is_empty() => {
            rejected(
                code,
                format!(
                    "the joint `{joint}` is missing in the trajectory; set \
                     `allow_partial_joints_goal` to move some of the joints"
                ),
            )
        }
        _ => Ok(order),
    }
}

fn check_points(
    settings: &JointTrajectorySettings,
    trajectory: &JointTrajectory,
) -> Result<(), TrajectoryRejection> {
    let code = TrajectoryErrorCode::InvalidGoal;
    let count = trajectory.joints.len();
    let Some(last) = trajectory.points.last() else {
        return rejected(code, "the trajectory has no points".into());
    };
    let moves = |velocity: &f64| velocity.abs() > MAX_END_VELOCITY_RATIO;
    if !settings.allows_velocity_at_end && last.velocities.iter().any(moves) {
        let reason = "the last point has a velocity; set \
                      `allow_nonzero_velocity_at_trajectory_end` to accept it";
        return rejected(code, reason.into());
    }
    let mut before_ns = None;
    for (index, point) in trajectory.points.iter().enumerate() {
        if before_ns.is_some_and(|before_ns| point.time_from_start_ns <= before_ns) {
            let reason = format!("the time of point {index} is not later than that before it");
            return rejected(code, reason);
        }
        before_ns = Some(point.time_from_start_ns);
        let positions = (&point.positions, !settings.integrates);
        let others = [&point.velocities, &point.accelerations, &point.efforts];
        for (values, is_needed) in
            [positions].into_iter().chain(others.map(|values| (values, false)))
        {
            let fits = values.len() == count || values.is_empty() && !is_needed;
            if !fits || !values.iter().all(|value| value.is_finite()) {
                let given = values.len();
                let reason = format!("point {index} has {given} finite values for {count} joints");
                return rejected(code, reason);
            }
        }
        if point.positions.is_empty()
            && point.velocities.is_empty()
            && point.accelerations.is_empty()
        {
            let reason = format!("point {index} has neither positions nor velocities");
            return rejected(code, reason);
        }
    }
    Ok(())
}

/// Returns values in another order, with a value for those that are missing; empty stays empty.
fn sorted(values: &[f64], order: &[Option<usize>], missing: impl Fn(usize) -> f64) -> Vec<f64> {
    if values.is_empty() {
        return Vec::new();
    }
    let each = order.iter().enumerate();
    each.map(|(joint, place)| place.map_or_else(|| missing(joint), |place| values[place])).collect()
}

/// Adds positions to a point from its velocities, and velocities from its accelerations: the mean of
/// both ends over the time [s].
fn integrate(before: &TrajectoryPoint, point: &mut TrajectoryPoint, dt_s: f64) {
    let at = |values: &[f64], joint: usize| values.get(joint).copied().unwrap_or_default();
    let count = before.positions.len();
    if point.velocities.is_empty() {
        let velocity = |joint: usize| {
            let sum = at(&before.accelerations, joint) + at(&point.accelerations, joint);
            at(&before.velocities, joint) + sum * 0.5 * dt_s
        };
        point.velocities = (0..count).map(velocity).collect();
    }
    let position = |joint: usize| {
        let sum = at(&before.velocities, joint) + at(&point.velocities, joint);
        at(&before.positions, joint) + sum * 0.5 * dt_s
    };
    point.positions = (0..count).map(position).collect();
}
