//! DWB.

use periplus_diagnostics::Diagnostics;

use super::Subject;
use crate::dwb::{DwbParams, KinematicParams};

pub(super) fn check(subject: &Subject<'_>, diagnostics: &mut Diagnostics) {
    let params = DwbParams::from_values(subject.values);
    check_limits(subject, &params.kinematics, diagnostics);
    check_trajectories(subject, &params, diagnostics);
    check_critics(subject, &params, diagnostics);
}

fn check_limits(subject: &Subject<'_>, limits: &KinematicParams, diagnostics: &mut Diagnostics) {
    let axes = [
        (
            "x",
            limits.min_vel_x_m_s,
            limits.max_vel_x_m_s,
            limits.acc_lim_x_m_s2,
            limits.decel_lim_x_m_s2,
        ),
        (
            "y",
            limits.min_vel_y_m_s,
            limits.max_vel_y_m_s,
            limits.acc_lim_y_m_s2,
            limits.decel_lim_y_m_s2,
        ),
        (
            "theta",
            -limits.max_vel_theta_rad_s,
            limits.max_vel_theta_rad_s,
            limits.acc_lim_theta_rad_s2,
            limits.decel_lim_theta_rad_s2,
        ),
    ];
    if axes.iter().all(|(_, min, max, ..)| *min == 0.0 && *max == 0.0) {
        diagnostics.push(
            subject
                .error(
                    "no-motion",
                    "max_vel_x",
                    format!("all velocity limits of `{}` are 0: the robot cannot move", subject.name),
                )
                .note("DWB's limits are 0 unless they are set")
                .help("set `max_vel_x`, `max_vel_theta`, `max_speed_xy`, `acc_lim_x`, `acc_lim_theta`, `decel_lim_x` and `decel_lim_theta` to those of the robot"),
        );
        return;
    }
    for (axis, min, max, acceleration, deceleration) in axes {
        if min == 0.0 && max == 0.0 {
            continue;
        }
        let (acc, decel) = (format!("acc_lim_{axis}"), format!("decel_lim_{axis}"));
        if min > max {
            let name = format!("min_vel_{axis}");
            let text =
                format!("{} is {min}, more than `max_vel_{axis}`, {max}", subject.full(&name));
            diagnostics.push(subject.error("empty-range", &name, text));
        }
        if acceleration <= 0.0 {
            let text = format!(
                "{} is {acceleration}: the velocity along {axis} never rises",
                subject.full(&acc)
            );
            diagnostics.push(subject.error("no-acceleration", &acc, text));
        }
        if deceleration > 0.0 {
            diagnostics.push(
                subject
                    .error(
                        "positive-deceleration",
                        &decel,
                        format!("{} is {deceleration} and must be negative", subject.full(&decel)),
                    )
                    .replace(
                        subject.values.origin(&decel),
                        format!("{:?}", -deceleration),
                        format!("write {:?}", -deceleration),
                    ),
            );
        } else if deceleration == 0.0 {
            let text =
                format!("{} is 0: the velocity along {axis} never falls", subject.full(&decel));
            diagnostics.push(subject.error("no-deceleration", &decel, text));
        }
    }
    let fastest_m_s = limits.max_vel_x_m_s.max(limits.max_vel_y_m_s).max(-limits.min_vel_x_m_s);
    if limits.max_speed_xy_m_s == 0.0 && fastest_m_s > 0.0 {
        diagnostics.push(
            subject
                .error(
                    "no-motion",
                    "max_speed_xy",
                    format!("{} is 0: the robot can only rotate", subject.full("max_speed_xy")),
                )
                .help(format!(
                    "set it to the greatest speed, {fastest_m_s}, or to -1 for no limit"
                )),
        );
    }
    if limits.max_speed_xy_m_s > 0.0 && limits.min_speed_xy_m_s > limits.max_speed_xy_m_s {
        let text = format!(
            "{} is {}, more than `max_speed_xy`, {}",
            subject.full("min_speed_xy"),
            limits.min_speed_xy_m_s,
            limits.max_speed_xy_m_s
        );
        diagnostics.push(subject.error("empty-range", "min_speed_xy", text));
    }
}

fn check_trajectories(subject: &Subject<'_>, params: &DwbParams, diagnostics: &mut Diagnostics) {
    let (limits, trajectories) = (&params.kinematics, &params.trajectories);
    let speed_m_s = match limits.max_speed_xy_m_s {
        ..=0.0 => limits.max_vel_x_m_s,
        speed_m_s => speed_m_s.min(limits.max_vel_x_m_s.max(limits.max_vel_y_m_s)),
    };
    let length_m = speed_m_s * trajectories.sim_time_s;
    if length_m > subject.facts.extent_m {
        diagnostics.push(
            subject
                .warning(
                    "long-trajectories",
                    "sim_time",
                    format!(
                        "trajectories of {} s at {speed_m_s} m/s are {length_m:.1} m long, and the local costmap ends {} m ahead",
                        trajectories.sim_time_s, subject.facts.extent_m
                    ),
                )
                .note("trajectories that leave it are invalid (\"Trajectory Goes Off Grid.\")")
                .help("reduce `sim_time`, or enlarge the local costmap"),
        );
    }
    let step_m = trajectories.linear_granularity_m;
    let size_m = 2.0 * subject.facts.inscribed_radius_m;
    if !trajectories.discretize_by_time && step_m > size_m {
        diagnostics.push(
            subject
                .warning(
                    "coarse-trajectories",
                    "linear_granularity",
                    format!(
                        "{} is {step_m} m, more than the robot is wide ({size_m:.2} m)",
                        subject.full("linear_granularity")
                    ),
                )
                .note("trajectories pass over obstacles between their poses")
                .help(format!(
                    "set it to the resolution of the local costmap, {}",
                    subject.facts.resolution_m
                )),
        );
    }
}

fn check_critics(subject: &Subject<'_>, params: &DwbParams, diagnostics: &mut Diagnostics) {
    let has = |name: &str| params.critics.iter().any(|critic| critic.contains(name));
    if !has("BaseObstacle") && !has("ObstacleFootprint") {
        diagnostics.push(
            subject
                .warning(
                    "no-obstacle-critic",
                    "critics",
                    format!("{} has no critic of obstacles", subject.full("critics")),
                )
                .note("the robot drives into obstacles")
                .help("add `BaseObstacle`, or `ObstacleFootprint` for robots that are not round"),
        );
    } else if !has("ObstacleFootprint") && !subject.facts.is_circular {
        diagnostics.push(
            subject
                .hint(
                    "centre-only",
                    "critics",
                    "BaseObstacle checks the centre of the robot only, and this robot has a footprint"
                        .to_owned(),
                )
                .note("corners beyond the inscribed radius may touch obstacles")
                .help("add `ObstacleFootprint`"),
        );
    }
}
