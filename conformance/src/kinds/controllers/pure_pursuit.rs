//! Rules of RegulatedPurePursuit.

use periplus_controllers::rpp::{
    LookaheadRule, PurePursuitParams, REGULATED_PURE_PURSUIT, RegulationInput, RotationLimits,
    curvature_per_m, lookahead_distance_m, lookahead_point, regulate,
};
use periplus_geometry::Twist2;
use serde_json::json;

use super::{path, values_of};
use crate::kinds::Setting;
use crate::{Case, Differences, Unreadable};

/// Speed by curvature, cost and distance to the goal.
pub(in crate::kinds) fn check_regulation(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let values = values_of(&REGULATED_PURE_PURSUIT, &[], &given.get("params")?)?;
    let params = PurePursuitParams::from_values(&values);
    let plan_in_base = path(&given.get("path")?)?;
    let found = regulate(
        &params,
        &RegulationInput {
            speed_m_s: given.get("linear_vel")?.number()?,
            max_speed_m_s: params.max_speed_m_s(),
            curvature_per_m: given.get("curvature")?.number()?,
            pose_cost: given.get("pose_cost")?.byte()?,
            inscribed_radius_m: given.get("inscribed_radius")?.number()?,
            plan_in_base: &plan_in_base,
            direction: given.get("sign")?.number()?,
        },
    );
    differences.compare_members(
        &[
            (&["curvature_vel"], json!(found.curvature_speed_m_s)),
            (&["cost_vel"], json!(found.cost_speed_m_s)),
            (&["linear_vel"], json!(found.linear_m_s)),
            (&["angular_vel"], json!(found.angular_rad_s)),
        ],
        &case.expect(),
    );
    Ok(())
}

/// Lookahead point on a path.
pub(in crate::kinds) fn check_lookahead(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let rule = given.get("rule")?;
    let rule = match rule.text()? {
        "along_path" => LookaheadRule::AlongPath,
        "euclidean" => LookaheadRule::Circle,
        _ => return Err(rule.unreadable("`along_path` or `euclidean`")),
    };
    let values = values_of(&REGULATED_PURE_PURSUIT, &[], &given.get("params")?)?;
    let params = PurePursuitParams::from_values(&values);
    let velocity = Twist2::new(given.get("speed")?.number()?, 0.0, 0.0);
    let lookahead_m = lookahead_distance_m(&params, velocity);
    let plan = given.get("path")?;
    let Some(point) = lookahead_point(rule, &path(&plan)?, lookahead_m, true, false) else {
        return Err(plan.unreadable("at least one point"));
    };
    differences.compare_members(
        &[
            (&["lookahead_dist"], json!(lookahead_m)),
            (&["carrot"], json!([point.x_m, point.y_m])),
            (&["curvature"], json!(curvature_per_m(point))),
        ],
        &case.expect(),
    );
    Ok(())
}

/// Turn rate of a rotation in place.
pub(in crate::kinds) fn check_rotation(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let number = |name: &str| given.get(name)?.number();
    let limits = RotationLimits {
        rate_rad_s: number("rotate_to_heading_angular_vel")?,
        acceleration_rad_s2: number("max_angular_accel")?,
        period_s: 1.0 / number("controller_frequency")?,
    };
    let rate = limits.turn_rate_rad_s(number("angle")?, number("current_angular_vel")?);
    differences.compare_members(&[(&["angular_vel"], json!(rate))], &case.expect());
    Ok(())
}
