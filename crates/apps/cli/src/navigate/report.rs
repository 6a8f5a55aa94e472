//! Report of a navigated run.

use std::io::{self, Write};

use periplus_geometry::Pose2;
use periplus_session::SimulationSession;
use periplus_session::nodes::{GoalOutcome, GoalReport, pose_text};
use periplus_sim::{ArrivalClock, DriveCollision};
use serde_json::{Value, json};

use super::NavigateTask;

/// Maximum number of collisions that the text lists; JSON has all.
const MOST_COLLISIONS: usize = 20;

/// The report as JSON.
pub(super) fn to_json(session: &SimulationSession, task: &NavigateTask) -> Value {
    let goals = task.goals.reports().iter().zip(&task.given);
    let goals: Vec<Value> = goals.map(|(report, goal)| goal_to_json(report, *goal)).collect();
    let score = task.score.as_ref().map(|score| {
        json!({
            "length_m": score.length_m,
            "min_clearance_m": score.min_clearance_m.is_finite().then_some(score.min_clearance_m),
            "collisions": score.collisions.len(),
            "collided_at": score.collisions.iter().map(|at| json!({
                "time_s": at.time_s,
                "pose": [at.pose.x_m, at.pose.y_m, at.pose.yaw_rad],
            })).collect::<Vec<Value>>(),
            "end_pose": score.pose.map(|pose| [pose.x_m, pose.y_m, pose.yaw_rad]),
            "arrival_s": task.arrival.as_ref().map(ArrivalClock::time_s),
        })
    });
    json!({ "goals": goals, "truth": score, "run": session.report().to_json() })
}

/// A goal as the user has given it, and its report, as JSON.
pub(super) fn goal_to_json(report: &GoalReport, goal: Pose2) -> Value {
    let (code, message) = match &report.outcome {
        GoalOutcome::Aborted { code, message } => (*code, message.as_str()),
        _ => (0, ""),
    };
    json!({
        "goal": [goal.x_m, goal.y_m, goal.yaw_rad],
        "is_reached": report.outcome == GoalOutcome::Reached,
        "outcome": report.outcome.to_string(),
        "error_code": code,
        "error_msg": message,
        "time_s": report.time_s,
        "recoveries": report.recoveries,
    })
}

/// Prints the report.
///
/// # Errors
/// A failed write.
pub(super) fn print(
    session: &SimulationSession,
    task: &NavigateTask,
    out: &mut dyn Write,
) -> io::Result<()> {
    session.report().write_text(out)?;
    for (index, (report, goal)) in task.goals.reports().iter().zip(&task.given).enumerate() {
        write!(
            out,
            "  goal {} of {} at {}: {}",
            index + 1,
            task.goals.goal_count(),
            pose_text(*goal),
            report.outcome
        )?;
        write!(out, " after {:.1} s", report.time_s)?;
        match report.recoveries {
            0 => writeln!(out)?,
            1 => writeln!(out, ", 1 recovery")?,
            several => writeln!(out, ", {several} recoveries")?,
        }
    }
    if let Some(score) = &task.score {
        let clearance = match score.min_clearance_m {
            distance_m if distance_m.is_finite() => format!("at least {distance_m:.2} m"),
            _ => "unlimited".to_owned(),
        };
        writeln!(
            out,
            "  drove {:.2} m, clearance {clearance}, {} collisions",
            score.length_m,
            score.collisions.len()
        )?;
        for DriveCollision { time_s, pose } in score.collisions.iter().take(MOST_COLLISIONS) {
            writeln!(
                out,
                "  collision at {time_s:.1} s, robot at {} in the world",
                pose_text(*pose)
            )?;
        }
    }
    if let Some(clock) = &task.arrival {
        match clock.time_s() {
            Some(time_s) => {
                writeln!(out, "  arrived at the last goal {time_s:.2} s after the first motion")?;
            }
            None => writeln!(out, "  did not arrive at the last goal")?,
        }
    }
    if let Some(error) = task.navigation.status().and_then(|status| status.last_error) {
        writeln!(out, "  last error of a server: {error}")?;
    }
    Ok(())
}
