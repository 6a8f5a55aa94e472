//! Graceful and RotationShim.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;

use super::Subject;
use crate::RotationShimParams;
use crate::graceful::GracefulParams;

pub(super) fn check(subject: &Subject<'_>, diagnostics: &mut Diagnostics) {
    let params = GracefulParams::from_values(subject.values);
    if params.initial_rotation && params.allow_backward {
        diagnostics.push(
            subject
                .warning(
                    "exclusive-modes",
                    "allow_backward",
                    format!(
                        "{} and {} are both true",
                        subject.full("initial_rotation"),
                        subject.full("allow_backward")
                    ),
                )
                .note("as in Nav2, the robot does not drive backwards")
                .help("set `initial_rotation` to false to drive backwards"),
        );
    }
    let (min_m_s, max_m_s) = (params.v_linear_min_m_s, params.v_linear_max_m_s);
    if max_m_s <= 0.0 || min_m_s > max_m_s {
        diagnostics.push(subject.error(
            "no-motion",
            "v_linear_max",
            format!(
                "{} is {max_m_s} m/s, and {} is {min_m_s} m/s",
                subject.full("v_linear_max"),
                subject.full("v_linear_min")
            ),
        ));
    }
    if params.v_angular_max_rad_s <= 0.0 {
        let text = format!("{} is 0: the robot cannot turn", subject.full("v_angular_max"));
        diagnostics.push(subject.error("no-rotation", "v_angular_max", text));
    }
    let (name, reach_m) = if subject.release == Nav2Release::Humble {
        ("motion_target_dist", params.motion_target_dist_m)
    } else {
        ("max_lookahead", params.max_lookahead_m)
    };
    if reach_m > subject.facts.extent_m {
        diagnostics.push(
            subject
                .warning(
                    "long-lookahead",
                    name,
                    format!(
                        "{} is {reach_m} m, and the plan ends at the border of the local costmap, {} m ahead",
                        subject.full(name),
                        subject.facts.extent_m
                    ),
                )
                .help("reduce it, or enlarge the local costmap"),
        );
    }
    if reach_m < subject.facts.inscribed_radius_m {
        diagnostics.push(subject.warning(
            "short-lookahead",
            name,
            format!(
                "{} is {reach_m} m, within the robot (inscribed radius {:.2} m)",
                subject.full(name),
                subject.facts.inscribed_radius_m
            ),
        ));
    }
}

pub(super) fn check_shim(subject: &Subject<'_>, diagnostics: &mut Diagnostics) {
    let params = RotationShimParams::from_values(subject.values);
    let (begin_rad, end_rad) =
        (params.angular_dist_threshold_rad, params.angular_disengage_threshold_rad);
    if end_rad > begin_rad {
        diagnostics.push(
            subject
                .warning(
                    "wrong-order",
                    "angular_disengage_threshold",
                    format!(
                        "{} is {end_rad} rad, more than {}, {begin_rad} rad",
                        subject.full("angular_disengage_threshold"),
                        subject.full("angular_dist_threshold")
                    ),
                )
                .note("rotations end before they begin")
                .help("set it to about half of `angular_dist_threshold`"),
        );
    }
    if params.rotate_to_heading_angular_vel_rad_s <= 0.0 || params.max_angular_accel_rad_s2 <= 0.0 {
        diagnostics.push(
            subject
                .error(
                    "no-rotation",
                    "rotate_to_heading_angular_vel",
                    format!("`{}` cannot rotate in place", subject.name),
                )
                .note("`rotate_to_heading_angular_vel` and `max_angular_accel` must be above 0"),
        );
    }
}
