//! RegulatedPurePursuit.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;

use super::Subject;
use crate::rpp::PurePursuitParams;

/// Relative difference of two scaling factors that counts as none.
const EQUAL_RATIO: f64 = 1e-6;

pub(super) fn check(subject: &Subject<'_>, diagnostics: &mut Diagnostics) {
    let params = PurePursuitParams::from_values(subject.values);
    check_speed(subject, &params, diagnostics);
    check_inflation(subject, &params, diagnostics);
    check_lookahead(subject, &params, diagnostics);
    check_modes(subject, &params, diagnostics);
}

fn check_speed(subject: &Subject<'_>, params: &PurePursuitParams, diagnostics: &mut Diagnostics) {
    let is_old = subject.release < Nav2Release::Main;
    let name = if is_old { "desired_linear_vel" } else { "max_linear_vel" };
    if params.max_speed_m_s() <= 0.0 {
        let text = format!(
            "{} is {}: the robot does not drive",
            subject.full(name),
            params.max_speed_m_s()
        );
        diagnostics.push(subject.error("no-motion", name, text));
    }
    if is_old && subject.values.is_given("max_linear_vel") {
        diagnostics.push(
            subject
                .warning(
                    "other-release",
                    "max_linear_vel",
                    format!("{} has no effect before main", subject.full("max_linear_vel")),
                )
                .help("set `desired_linear_vel`"),
        );
    }
    if !is_old && params.desired_linear_vel_m_s.is_some() {
        diagnostics.push(
            subject
                .hint(
                    "deprecated",
                    "desired_linear_vel",
                    format!("{} is deprecated", subject.full("desired_linear_vel")),
                )
                .help("write `max_linear_vel`"),
        );
    }
    let approach_m = params.approach_velocity_scaling_dist_m;
    if approach_m > subject.facts.extent_m {
        diagnostics.push(
            subject
                .warning(
                    "permanent-slowdown",
                    "approach_velocity_scaling_dist",
                    format!(
                        "{} is {approach_m} m, and the plan ends at the border of the local costmap, {} m ahead: \
                         the robot is always slowed down",
                        subject.full("approach_velocity_scaling_dist"),
                        subject.facts.extent_m
                    ),
                )
                .help("reduce it, or enlarge the local costmap"),
        );
    }
}

fn check_inflation(
    subject: &Subject<'_>,
    params: &PurePursuitParams,
    diagnostics: &mut Diagnostics,
) {
    if !params.use_cost_regulated_linear_velocity_scaling {
        return;
    }
    let name = "inflation_cost_scaling_factor";
    let factor = params.inflation_cost_scaling_factor_per_m;
    if factor <= 0.0 {
        diagnostics.push(
            subject
                .warning(
                    "bad-scaling",
                    name,
                    format!("{} is {factor} and must be above 0", subject.full(name)),
                )
                .note("as in Nav2, the speed is not reduced near obstacles"),
        );
        return;
    }
    let Some(inflation) = subject.facts.inflation else {
        diagnostics.push(
            subject
                .hint(
                    "no-inflation",
                    "use_cost_regulated_linear_velocity_scaling",
                    format!(
                        "{} has no effect, since the local costmap has no inflation layer",
                        subject.full("use_cost_regulated_linear_velocity_scaling")
                    ),
                )
                .help("add an inflation layer to the local costmap"),
        );
        return;
    };
    let scaling = inflation.scaling_per_m;
    if (factor - scaling).abs() > EQUAL_RATIO * scaling.abs() {
        diagnostics.push(
            subject
                .warning(
                    "other-inflation",
                    name,
                    format!(
                        "{} is {factor}, and `cost_scaling_factor` of the inflation layer is {scaling}",
                        subject.full(name)
                    ),
                )
                .note("distances to obstacles are computed from costs with it, so the robot is slowed down too early or too late")
                .replace(
                    subject.values.origin(name),
                    format!("{scaling:?}"),
                    format!("write {scaling:?}, the value of the inflation layer"),
                ),
        );
    }
    let reach_m = inflation.radius_m;
    if params.cost_scaling_dist_m > reach_m {
        diagnostics.push(
            subject
                .hint(
                    "short-inflation",
                    "cost_scaling_dist",
                    format!(
                        "{} is {} m, and costs end {reach_m} m from obstacles (`inflation_radius`)",
                        subject.full("cost_scaling_dist"),
                        params.cost_scaling_dist_m
                    ),
                )
                .note("farther obstacles do not reduce the speed"),
        );
    }
}

fn check_lookahead(
    subject: &Subject<'_>,
    params: &PurePursuitParams,
    diagnostics: &mut Diagnostics,
) {
    let (shortest, longest) = if params.use_velocity_scaled_lookahead_dist {
        (
            ("min_lookahead_dist", params.min_lookahead_dist_m),
            ("max_lookahead_dist", params.max_lookahead_dist_m),
        )
    } else {
        (("lookahead_dist", params.lookahead_dist_m), ("lookahead_dist", params.lookahead_dist_m))
    };
    let radius_m = subject.facts.inscribed_radius_m;
    if shortest.1 < radius_m {
        diagnostics.push(
            subject
                .warning(
                    "short-lookahead",
                    shortest.0,
                    format!(
                        "{} is {} m, within the robot (inscribed radius {radius_m:.2} m)",
                        subject.full(shortest.0),
                        shortest.1
                    ),
                )
                .note("the robot overreacts to small errors, and swings around the plan")
                .help("set it to the distance driven in 1 to 2 s"),
        );
    }
    if shortest.1 > longest.1 {
        let text = format!(
            "{} is {} m, more than {}, {} m",
            subject.full(shortest.0),
            shortest.1,
            subject.full(longest.0),
            longest.1
        );
        diagnostics.push(subject.error("empty-range", shortest.0, text));
    }
    if longest.1 > subject.facts.extent_m {
        diagnostics.push(
            subject
                .warning(
                    "long-lookahead",
                    longest.0,
                    format!(
                        "{} is {} m, and the plan ends at the border of the local costmap, {} m ahead",
                        subject.full(longest.0),
                        longest.1,
                        subject.facts.extent_m
                    ),
                )
                .help("reduce it, or enlarge the local costmap"),
        );
    }
    let min_m = params.min_distance_to_obstacle_m;
    if params.use_collision_detection && min_m > longest.1 {
        diagnostics.push(subject.warning(
            "capped-distance",
            "min_distance_to_obstacle",
            format!(
                "{} is {min_m} m, and the collision check ends at {}, {} m",
                subject.full("min_distance_to_obstacle"),
                subject.full(longest.0),
                longest.1
            ),
        ));
    }
}

fn check_modes(subject: &Subject<'_>, params: &PurePursuitParams, diagnostics: &mut Diagnostics) {
    if params.use_rotate_to_heading && params.allow_reversing {
        let effect = if subject.release == Nav2Release::Humble {
            "as in Nav2, the robot does not drive backwards"
        } else {
            "the robot rotates to a plan behind it instead of driving backwards"
        };
        diagnostics.push(
            subject
                .warning(
                    "exclusive-modes",
                    "allow_reversing",
                    format!(
                        "{} and {} are both true",
                        subject.full("use_rotate_to_heading"),
                        subject.full("allow_reversing")
                    ),
                )
                .note(effect)
                .help("set `use_rotate_to_heading` to false to drive backwards"),
        );
    }
    if params.interpolate_curvature_after_goal && !params.use_fixed_curvature_lookahead {
        diagnostics.push(subject.warning(
            "without-effect",
            "interpolate_curvature_after_goal",
            format!(
                "{} has no effect while {} is false",
                subject.full("interpolate_curvature_after_goal"),
                subject.full("use_fixed_curvature_lookahead")
            ),
        ));
    }
    if params.allow_obstacle_checking_beyond_goal
        && (!params.use_velocity_scaled_lookahead_dist || params.min_distance_to_obstacle_m <= 0.0)
    {
        diagnostics.push(subject.warning(
            "without-effect",
            "allow_obstacle_checking_beyond_goal",
            format!(
                "{} has no effect without `use_velocity_scaled_lookahead_dist` and a `min_distance_to_obstacle` above 0",
                subject.full("allow_obstacle_checking_beyond_goal")
            ),
        ));
    }
    if params.use_rotate_to_heading
        && (params.rotate_to_heading_angular_vel_rad_s <= 0.0
            || params.max_angular_accel_rad_s2 <= 0.0)
    {
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
