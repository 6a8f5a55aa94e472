//! Replacement of TebLocalPlannerROS.
//!
//! TEB optimizes poses and times as a graph; it is not part of Periplus. Its parameters are accepted, and a controller
//! that suits the robot drives with its limits: RegulatedPurePursuit for robots with a minimum turning radius, else
//! DWAPlannerROS.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_params::{ParamValue, ParamValues};

use super::{DWA_PLANNER, DwaPlanner, TEB_PLANNER, TebPlannerParams};
use crate::rpp::{REGULATED_PURE_PURSUIT, RegulatedPurePursuit};
use crate::{Controller, PluginSetup};

/// Minimum speed of translation of the replacement, at most \[m/s\].
const MAX_MIN_SPEED_M_S: f64 = 0.1;

/// Minimum turn rate of the replacement, at most \[rad/s\].
const MAX_MIN_TURN_RATE_RAD_S: f64 = 0.4;

/// Range of the lookahead distance of the replacement \[m\].
const LOOKAHEAD_RANGE_M: [f64; 2] = [0.3, 1.5];

/// Controller that drives in place of TEB.
#[derive(Clone, Debug, PartialEq)]
pub enum TebReplacement {
    /// DWAPlannerROS with these values of [`DWA_PLANNER`].
    Dwa(ParamValues),
    /// RegulatedPurePursuit with these values of [`REGULATED_PURE_PURSUIT`].
    PurePursuit(ParamValues),
}

impl TebReplacement {
    /// Selects the controller for parameters of TEB and a period of the control loop \[s\].
    #[must_use]
    pub fn new(params: &TebPlannerParams, period_s: f64) -> Self {
        if params.min_turning_radius_m > 0.0 || params.cmd_angle_instead_rotvel {
            Self::PurePursuit(pure_pursuit_values(params))
        } else {
            Self::Dwa(dwa_values(params, period_s))
        }
    }

    /// Returns the name of the controller.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Dwa(_) => "DWAPlannerROS",
            Self::PurePursuit(_) => "RegulatedPurePursuitController",
        }
    }

    /// Returns the warning that another controller drives.
    #[must_use]
    pub fn warning(&self, setup: &PluginSetup<'_>) -> Diagnostic {
        let (name, group) = (self.name(), setup.name);
        let warning = Diagnostic::warning(
            "teb-replaced",
            format!("`{group}`: TebLocalPlannerROS is not supported, and {name} drives in place of it"),
        )
        .at(setup.class_origin)
        .note("it uses the velocity and acceleration limits and the tolerances of the goal; weights, homotopy classes and dynamic obstacles have no effect");
        match self {
            Self::Dwa(_) => warning.help(
                "to choose its other parameters, set `base_local_planner: dwa_local_planner/DWAPlannerROS`",
            ),
            Self::PurePursuit(_) => warning
                .note("it stops for obstacles and does not drive around them, since the plan of the robot with a minimum turning radius must be driven as it is")
                .help("use a global planner that knows the minimum turning radius, such as SmacPlannerHybrid"),
        }
    }

    /// Creates the controller for a period of the control loop \[s\].
    #[must_use]
    pub fn build(self, period_s: f64) -> Box<dyn Controller> {
        match self {
            Self::Dwa(values) => Box::new(DwaPlanner::new(values, period_s)),
            Self::PurePursuit(values) => {
                Box::new(RegulatedPurePursuit::new(values, Nav2Release::Jazzy, period_s))
            }
        }
    }
}

/// Creates the replacement from parameters of [`TEB_PLANNER`], with a warning.
pub(crate) fn create(
    setup: &PluginSetup<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Controller>> {
    let params = TebPlannerParams::from_values(&setup.read(&TEB_PLANNER, diagnostics));
    let replacement = TebReplacement::new(&params, setup.control_period_s);
    diagnostics.push(replacement.warning(setup));
    Some(replacement.build(setup.control_period_s))
}

/// Maximum speed of translation \[m/s\].
fn max_speed_m_s(params: &TebPlannerParams) -> f64 {
    if params.max_vel_trans_m_s > 0.0 { params.max_vel_trans_m_s } else { params.max_vel_x_m_s }
}

fn set_all(values: &mut ParamValues, numbers: &[(&str, f64)]) {
    for (name, number) in numbers {
        values.set(name, ParamValue::Number(*number));
    }
}

fn dwa_values(params: &TebPlannerParams, period_s: f64) -> ParamValues {
    // Minimum velocities that a robot at rest does not reach within a period would keep it there.
    let mut values = ParamValues::defaults(&DWA_PLANNER);
    let max_m_s = max_speed_m_s(params);
    let backwards_m_s = params.max_vel_x_backwards_m_s;
    let min_x_m_s = if params.allow_init_with_backwards_motion { -backwards_m_s } else { 0.0 };
    set_all(
        &mut values,
        &[
            ("max_vel_trans", max_m_s),
            ("min_vel_trans", MAX_MIN_SPEED_M_S.min(params.acc_lim_x_m_s2 * period_s)),
            ("max_vel_x", params.max_vel_x_m_s),
            ("min_vel_x", min_x_m_s),
            ("max_vel_y", params.max_vel_y_m_s),
            ("min_vel_y", -params.max_vel_y_m_s),
            ("max_vel_theta", params.max_vel_theta_rad_s),
            ("min_vel_theta", MAX_MIN_TURN_RATE_RAD_S.min(params.acc_lim_theta_rad_s2 * period_s)),
            ("acc_lim_x", params.acc_lim_x_m_s2),
            ("acc_lim_y", params.acc_lim_y_m_s2),
            ("acc_lim_theta", params.acc_lim_theta_rad_s2),
            ("xy_goal_tolerance", params.xy_goal_tolerance_m),
            ("yaw_goal_tolerance", params.yaw_goal_tolerance_rad),
            ("trans_stopped_vel", params.trans_stopped_vel_m_s),
            ("theta_stopped_vel", params.theta_stopped_vel_rad_s),
        ],
    );
    values.set("latch_xy_goal_tolerance", ParamValue::Bool(true));
    values
}

fn pure_pursuit_values(params: &TebPlannerParams) -> ParamValues {
    let mut values = ParamValues::defaults(&REGULATED_PURE_PURSUIT);
    let [min_m, max_m] = LOOKAHEAD_RANGE_M;
    let lookahead_m = (1.5 * params.min_turning_radius_m).max(min_m).min(max_m);
    set_all(
        &mut values,
        &[
            ("desired_linear_vel", max_speed_m_s(params)),
            ("lookahead_dist", lookahead_m),
            ("max_angular_accel", params.acc_lim_theta_rad_s2),
            ("regulated_linear_scaling_min_radius", 2.0 * params.min_turning_radius_m),
            ("regulated_linear_scaling_min_speed", max_speed_m_s(params) / 4.0),
        ],
    );
    // The robot cannot rotate in place.
    values.set("use_rotate_to_heading", ParamValue::Bool(false));
    values.set("allow_reversing", ParamValue::Bool(params.max_vel_x_backwards_m_s > 0.0));
    values
}
