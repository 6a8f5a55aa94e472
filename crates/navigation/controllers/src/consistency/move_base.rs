//! Local planners of ROS 1.

use periplus_diagnostics::Diagnostics;

use super::Subject;
use crate::ros1::{DwaPlannerParams, TrajectoryPlannerParams};

fn check_tolerance(subject: &Subject<'_>, tolerance_m: f64, diagnostics: &mut Diagnostics) {
    if tolerance_m < subject.facts.resolution_m {
        diagnostics.push(
            subject
                .warning(
                    "small-tolerance",
                    "xy_goal_tolerance",
                    format!(
                        "{} is {tolerance_m} m, less than a cell of the local costmap ({} m)",
                        subject.full("xy_goal_tolerance"),
                        subject.facts.resolution_m
                    ),
                )
                .note("distances to the goal are measured in cells, so the robot may circle around it"),
        );
    }
}

pub(super) fn check_dwa(subject: &Subject<'_>, diagnostics: &mut Diagnostics) {
    let params = DwaPlannerParams::from_values(subject.values);
    check_tolerance(subject, params.xy_goal_tolerance_m, diagnostics);
    let (min_m_s, max_m_s) = (params.min_vel_trans_m_s, params.max_vel_trans_m_s);
    if max_m_s >= 0.0 && min_m_s > max_m_s {
        let text = format!(
            "{} is {min_m_s} m/s, more than `max_vel_trans`, {max_m_s} m/s: the robot can only rotate",
            subject.full("min_vel_trans")
        );
        diagnostics.push(subject.error("empty-range", "min_vel_trans", text));
    }
    let fastest_m_s = params.max_vel_x_m_s.max(params.max_vel_y_m_s).max(-params.min_vel_x_m_s);
    if fastest_m_s < min_m_s {
        let text = format!(
            "`max_vel_x` is {} m/s, less than {}, {min_m_s} m/s: the robot can only rotate",
            params.max_vel_x_m_s,
            subject.full("min_vel_trans")
        );
        diagnostics.push(subject.error("empty-range", "max_vel_x", text));
    }
    let period_s = subject.facts.control_period_s;
    let (start_m_s, start_rad_s) =
        (params.acc_lim_x_m_s2 * period_s, params.acc_lim_theta_rad_s2 * period_s);
    if params.use_dwa && start_m_s < min_m_s && start_rad_s < params.min_vel_theta_rad_s {
        diagnostics.push(
            subject
                .error(
                    "cannot-start",
                    "min_vel_trans",
                    format!(
                        "within a control period of {period_s} s a robot at rest reaches {start_m_s:.3} m/s and \
                         {start_rad_s:.3} rad/s, less than {} and `min_vel_theta`",
                        subject.full("min_vel_trans")
                    ),
                )
                .note("no velocity is valid for a robot at rest, so it never starts")
                .help(format!("set `min_vel_trans` to {start_m_s:.3} or less, or raise `acc_lim_x`")),
        );
    }
    if params.min_vel_theta_rad_s > params.max_vel_theta_rad_s {
        let text = format!(
            "{} is {} rad/s, more than `max_vel_theta`, {} rad/s",
            subject.full("min_vel_theta"),
            params.min_vel_theta_rad_s,
            params.max_vel_theta_rad_s
        );
        diagnostics.push(subject.error("empty-range", "min_vel_theta", text));
    }
}

pub(super) fn check_rollout(subject: &Subject<'_>, diagnostics: &mut Diagnostics) {
    let params = TrajectoryPlannerParams::from_values(subject.values);
    check_tolerance(subject, params.xy_goal_tolerance_m, diagnostics);
    if params.escape_vel_m_s >= 0.0 {
        diagnostics.push(
            subject
                .warning(
                    "positive-escape",
                    "escape_vel",
                    format!("{} is {}", subject.full("escape_vel"), params.escape_vel_m_s),
                )
                .note("a robot that is stuck drives forwards instead of backwards")
                .help("write a negative velocity, such as -0.1"),
        );
    }
    if params.min_vel_x_m_s > params.max_vel_x_m_s || params.max_vel_x_m_s <= 0.0 {
        let text = format!(
            "{} is {} m/s, and `min_vel_x` is {} m/s",
            subject.full("max_vel_x"),
            params.max_vel_x_m_s,
            params.min_vel_x_m_s
        );
        diagnostics.push(subject.error("empty-range", "max_vel_x", text));
    }
}
