//! Control law of Graceful.

use periplus_controllers::graceful::{EgoPolar, SmoothControlLaw};
use periplus_costmap::Nav2Release;
use serde_json::json;

use super::{pose, release_of};
use crate::kinds::Setting;
use crate::{Case, Differences, Unreadable};

/// Velocity towards a target.
pub(in crate::kinds) fn check_law(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let number = |name: &str| given.get(name)?.number();
    let deceleration_m_s2 = number("deceleration_max")?;
    let law = SmoothControlLaw {
        k_phi: number("k_phi")?,
        k_delta: number("k_delta")?,
        beta: number("beta")?,
        lambda: number("lambda")?,
        slowdown_radius_m: number("slowdown_radius")?,
        deceleration_m_s2: match release_of(distro)? {
            Nav2Release::Main => deceleration_m_s2,
            _ => f64::INFINITY,
        },
        min_speed_m_s: number("v_linear_min")?,
        max_speed_m_s: number("v_linear_max")?,
        max_rate_rad_s: number("v_angular_max")?,
    };
    let (target, robot) = (pose(&given.get("target")?)?, pose(&given.get("current")?)?);
    let is_backward = given.get("backward")?.truth()?;
    let seen = EgoPolar::new(target, robot, is_backward);
    let found = law.velocity(target, robot, is_backward);
    differences.compare_members(
        &[
            (&["r"], json!(seen.r_m)),
            (&["phi"], json!(seen.phi_rad)),
            (&["delta"], json!(seen.delta_rad)),
            (&["curvature"], json!(law.curvature_per_m(seen, is_backward))),
            (&["linear_vel"], json!(found.vx_m_s)),
            (&["angular_vel"], json!(found.wz_rad_s)),
        ],
        &case.expect(),
    );
    Ok(())
}
