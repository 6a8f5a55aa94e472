//! Conversion of trajectories and tolerances.

use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::control_msgs::{FollowJointTrajectoryGoal, JointTolerance};
use periplus_msgs::trajectory_msgs;
use periplus_ros2_control::{GoalTolerances, JointTolerances, JointTrajectory, TrajectoryPoint};

/// Returns the trajectory of a message.
pub(super) fn trajectory(message: &trajectory_msgs::JointTrajectory) -> JointTrajectory {
    let point = |point: &trajectory_msgs::JointTrajectoryPoint| TrajectoryPoint {
        positions: point.positions.clone(),
        velocities: point.velocities.clone(),
        accelerations: point.accelerations.clone(),
        efforts: point.effort.clone(),
        time_from_start_ns: point.time_from_start.ns(),
    };
    JointTrajectory {
        joints: message.joint_names.clone(),
        points: message.points.iter().map(point).collect(),
        start_ns: message.header.stamp.ns(),
    }
}

/// Returns a point as a message.
pub(super) fn point(point: &TrajectoryPoint) -> trajectory_msgs::JointTrajectoryPoint {
    let ns = point.time_from_start_ns;
    trajectory_msgs::JointTrajectoryPoint {
        positions: point.positions.clone(),
        velocities: point.velocities.clone(),
        accelerations: point.accelerations.clone(),
        effort: point.efforts.clone(),
        time_from_start: duration(ns),
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "seconds of a trajectory, and a remainder below 1e9"
)]
fn duration(ns: i64) -> Duration {
    Duration {
        sec: ns.div_euclid(1_000_000_000) as i32,
        nanosec: ns.rem_euclid(1_000_000_000) as u32,
    }
}

/// Returns the tolerances of a goal: positive values replace the defaults, negative ones remove them.
pub(super) fn tolerances(
    defaults: &GoalTolerances,
    joints: &[String],
    goal: &FollowJointTrajectoryGoal,
) -> GoalTolerances {
    let changed = |defaults: &[JointTolerances], given: &[JointTolerance]| {
        let one = |(index, joint): (usize, &String)| {
            let default = defaults.get(index).copied().unwrap_or_default();
            let Some(given) = given.iter().find(|given| given.name == *joint) else {
                return default;
            };
            JointTolerances {
                position: replaced(default.position, given.position),
                velocity: replaced(default.velocity, given.velocity),
            }
        };
        joints.iter().enumerate().map(one).collect()
    };
    #[expect(clippy::cast_precision_loss, reason = "seconds")]
    let goal_time_s = goal.goal_time_tolerance.ns() as f64 * 1e-9;
    GoalTolerances {
        path: changed(&defaults.path, &goal.path_tolerance),
        goal: changed(&defaults.goal, &goal.goal_tolerance),
        goal_time_s: replaced(defaults.goal_time_s, goal_time_s),
    }
}

fn replaced(default: f64, given: f64) -> f64 {
    if given > 0.0 {
        given
    } else if given < 0.0 {
        0.0
    } else {
        default
    }
}
