//! Speed limits of controllers.

use periplus_controllers::dwb::{DwbParams, KinematicLimits};
use periplus_controllers::mppi::MppiVelocityLimits;
use periplus_controllers::rpp::limited_speed_m_s;

use super::Setting;
use crate::{Case, Differences, Unreadable, number};

/// Limits of a controller: highest and lowest velocity forwards \[m/s\], highest turn rate \[rad/s\].
type Limits = [f64; 3];

/// Limits of the velocity under a speed limit.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let base = given.get("base")?;
    let value = |name: &str| base.get(name)?.number();
    let base = [value("max_linear_vel")?, value("min_linear_vel")?, value("max_angular_vel")?];
    let limit = given.get("speed_limit")?.number()?;
    let is_percentage = given.get("percentage")?.truth()?;
    let controller = given.get("controller")?;
    let [fastest, slowest, turn] = match controller.text()? {
        "mppi" => mppi(base, limit, is_percentage),
        "dwb" => dwb(base, limit, is_percentage),
        "rpp" => rpp(base, limit, is_percentage),
        _ => return Err(controller.unreadable("`mppi`, `dwb` or `rpp`")),
    };
    differences.compare_members(
        &[
            (&["max_linear_vel"], number(fastest)),
            (&["min_linear_vel"], number(slowest)),
            (&["max_angular_vel"], number(turn)),
        ],
        &expect,
    );
    Ok(())
}

fn mppi([fastest, slowest, turn]: Limits, limit: f64, is_percentage: bool) -> Limits {
    let base = MppiVelocityLimits {
        vx_max: fastest as f32,
        vx_min: slowest as f32,
        vy_max: 0.0,
        wz_max: turn as f32,
    };
    let limited = base.limited(limit, is_percentage);
    [limited.vx_max, limited.vx_min, limited.wz_max].map(f64::from)
}

fn dwb([fastest, slowest, turn]: Limits, limit: f64, is_percentage: bool) -> Limits {
    let mut params = DwbParams::default().kinematics;
    params.max_vel_x_m_s = fastest;
    params.min_vel_x_m_s = slowest;
    params.max_speed_xy_m_s = fastest;
    params.max_vel_theta_rad_s = turn;
    let limited = KinematicLimits::new(&params).limited(limit, is_percentage);
    [limited.x.max, limited.x.min, limited.theta.max]
}

fn rpp([fastest, slowest, turn]: Limits, limit: f64, is_percentage: bool) -> Limits {
    [limited_speed_m_s(fastest, limit, is_percentage), slowest, turn]
}
