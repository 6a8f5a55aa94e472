//! Checkers of goal and progress.

use periplus_diagnostics::{Diagnostic, Diagnostics};

use super::CostmapFacts;
use crate::dwb::{DWB, DwbParams};
use crate::goal_checker::{ADAPTIVE_GOAL_CHECKER, AdaptiveGoalParams, GoalChecker};
use crate::progress_checker::SimpleProgressParams;
use crate::{Controller, ProgressChecker};

/// Tolerance of headings that robots hardly meet \[rad\].
const SMALL_YAW_RAD: f64 = 0.01;

/// Reports tolerances of a goal checker that the robot or one of its controllers cannot meet.
pub fn check_goal_checker(
    name: &str,
    checker: &dyn GoalChecker,
    controllers: &[(&str, &dyn Controller)],
    facts: &CostmapFacts,
    diagnostics: &mut Diagnostics,
) {
    let (values, tolerance) = (checker.parameters(), checker.tolerance());
    if let Some(xy_m) = tolerance.xy_m {
        if xy_m < facts.resolution_m {
            diagnostics.push(
                Diagnostic::warning(
                    "small-tolerance",
                    format!(
                        "`{name}`: a tolerance of {xy_m} m is less than a cell of the local costmap ({} m)",
                        facts.resolution_m
                    ),
                )
                .at(values.origin("xy_goal_tolerance"))
                .note("the pose of the robot is not that exact, and the robot may circle around the goal")
                .help(format!("use at least {}", facts.resolution_m)),
            );
        }
        for (controller, dwb) in controllers {
            check_rotate_to_goal(name, xy_m, controller, *dwb, diagnostics);
        }
    }
    if let Some(yaw_rad) = tolerance.yaw_rad.filter(|yaw_rad| *yaw_rad < SMALL_YAW_RAD) {
        diagnostics.push(
            Diagnostic::warning(
                "small-tolerance",
                format!("`{name}.yaw_goal_tolerance` is {yaw_rad} rad"),
            )
            .at(values.origin("yaw_goal_tolerance"))
            .note("robots overshoot such an angle, and rotate to and fro at the goal"),
        );
    }
    if *values.table() == ADAPTIVE_GOAL_CHECKER {
        let params = AdaptiveGoalParams::from_values(values);
        let (fine_m, coarse_m) =
            (params.fine_xy_goal_tolerance_m, params.coarse_xy_goal_tolerance_m);
        if fine_m >= coarse_m {
            diagnostics.push(
                Diagnostic::warning(
                    "wrong-order",
                    format!(
                        "`{name}.fine_xy_goal_tolerance` is {fine_m} m, not less than `coarse_xy_goal_tolerance`, {coarse_m} m"
                    ),
                )
                .at(values.origin("fine_xy_goal_tolerance"))
                .note("it acts as a simple goal checker"),
            );
        }
    }
}

/// Reports a RotateToGoal that rotates outside of the tolerance of the goal checker.
fn check_rotate_to_goal(
    name: &str,
    xy_m: f64,
    controller: &str,
    dwb: &dyn Controller,
    diagnostics: &mut Diagnostics,
) {
    for group in dwb.parameters() {
        if *group.values.table() != DWB {
            continue;
        }
        let params = DwbParams::from_values(group.values);
        let rotates = params.critics.iter().any(|critic| critic.contains("RotateToGoal"));
        if rotates && params.xy_goal_tolerance_m > xy_m {
            diagnostics.push(
                Diagnostic::warning(
                    "other-tolerance",
                    format!(
                        "`{controller}.xy_goal_tolerance` is {} m, and that of `{name}` is {xy_m} m",
                        params.xy_goal_tolerance_m
                    ),
                )
                .at(group.values.origin("xy_goal_tolerance"))
                .note("RotateToGoal stops the robot before it is at the goal, and it rotates there until it has made no progress")
                .help(format!("set `{controller}.xy_goal_tolerance` to {xy_m} or less")),
            );
        }
    }
}

/// Reports a progress checker that a robot with this maximum speed \[m/s\] cannot satisfy.
pub fn check_progress_checker(
    name: &str,
    checker: &ProgressChecker,
    max_speed_m_s: f64,
    diagnostics: &mut Diagnostics,
) {
    let values = checker.parameters();
    let required_m = values
        .number("required_movement_radius")
        .unwrap_or_else(|| SimpleProgressParams::default().required_movement_radius_m);
    let allowance_s = values.number("movement_time_allowance").unwrap_or(f64::INFINITY);
    if required_m > max_speed_m_s * allowance_s {
        diagnostics.push(
            Diagnostic::error(
                "impossible-progress",
                format!(
                    "`{name}` demands more than {required_m} m in {allowance_s} s, and the robot drives at most {max_speed_m_s} m/s"
                ),
            )
            .at(values.origin("required_movement_radius"))
            .note("every goal fails with \"Failed to make progress\"")
            .help("reduce `required_movement_radius` or raise `movement_time_allowance`"),
        );
    }
}
