//! Replacement of TebLocalPlannerROS.
//!
//! TEB optimizes poses and times as a graph; it is not part of Periplus. Its parameters are accepted, and a controller
//! that suits the robot drives with its limits: RegulatedPurePursuit for robots with a minimum turning radius, else DWB.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_params::{Given, ParamValue, ParamValues};

use super::{TEB_PLANNER, TebPlannerParams};
use crate::dwb::Dwb;
use crate::rpp::{REGULATED_PURE_PURSUIT, RegulatedPurePursuit};
use crate::{Controller, GivenParameters, PluginSetup};

/// Range of the lookahead distance of the replacement \[m\].
const LOOKAHEAD_RANGE_M: [f64; 2] = [0.3, 1.5];

/// Critics of the replacement, as in the stock files of Nav2, with the footprint.
const CRITICS: [(&str, &str); 13] = [
    (
        "critics",
        "[RotateToGoal, Oscillation, BaseObstacle, ObstacleFootprint, GoalAlign, PathAlign, PathDist, GoalDist]",
    ),
    ("RotateToGoal.scale", "32.0"),
    ("BaseObstacle.scale", "0.02"),
    ("ObstacleFootprint.scale", "0.01"),
    ("GoalAlign.scale", "24.0"),
    ("GoalAlign.forward_point_distance", "0.1"),
    ("PathAlign.scale", "32.0"),
    ("PathAlign.forward_point_distance", "0.1"),
    ("PathDist.scale", "32.0"),
    ("GoalDist.scale", "24.0"),
    ("linear_granularity", "0.05"),
    ("vtheta_samples", "20"),
    ("prune_distance", "1.0"),
];

/// Controller that drives in place of TEB.
#[derive(Clone, Debug, PartialEq)]
pub enum TebReplacement {
    /// DWB with these parameters, as texts.
    Dwb(Vec<(&'static str, String)>),
    /// RegulatedPurePursuit with these values of [`REGULATED_PURE_PURSUIT`].
    PurePursuit(ParamValues),
}

impl TebReplacement {
    /// Selects the controller for parameters of TEB.
    #[must_use]
    pub fn new(params: &TebPlannerParams) -> Self {
        if params.min_turning_radius_m > 0.0 || params.cmd_angle_instead_rotvel {
            Self::PurePursuit(pure_pursuit_values(params))
        } else {
            Self::Dwb(dwb_texts(params))
        }
    }

    /// Returns the name of the controller.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Dwb(_) => "DWBLocalPlanner",
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
        .note(
            "it uses the limits of velocity and acceleration and the tolerances of the goal; weights, homotopy classes \
             and dynamic obstacles have no effect",
        );
        match self {
            Self::Dwb(_) => warning.help(
                "to choose its other parameters, set `base_local_planner` to `dwb_core::DWBLocalPlanner` or \
                 `dwa_local_planner/DWAPlannerROS`",
            ),
            Self::PurePursuit(_) => warning
                .note("it stops for obstacles and does not drive around them")
                .help("use a global planner that knows the minimum turning radius, such as SmacPlannerHybrid"),
        }
    }

    /// Creates the controller for a period of the control loop \[s\].
    #[must_use]
    pub fn build(self, name: &str, period_s: f64) -> Option<Box<dyn Controller>> {
        let release = Nav2Release::Jazzy;
        match self {
            Self::Dwb(texts) => {
                let given = texts.iter().map(|(name, text)| Given::new(name, text.as_str()));
                let setup = PluginSetup {
                    release,
                    control_period_s: period_s,
                    given: GivenParameters::new(given),
                    ..PluginSetup::new(name)
                };
                let dwb = Dwb::read(&setup, &mut Diagnostics::new())?;
                Some(Box::new(dwb))
            }
            Self::PurePursuit(values) => {
                Some(Box::new(RegulatedPurePursuit::new(values, release, period_s)))
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
    let replacement = TebReplacement::new(&params);
    diagnostics.push(replacement.warning(setup));
    replacement.build(setup.name, setup.control_period_s)
}

/// Maximum speed of translation \[m/s\].
fn max_speed_m_s(params: &TebPlannerParams) -> f64 {
    if params.max_vel_trans_m_s > 0.0 { params.max_vel_trans_m_s } else { params.max_vel_x_m_s }
}

fn dwb_texts(params: &TebPlannerParams) -> Vec<(&'static str, String)> {
    let backwards_m_s = params.max_vel_x_backwards_m_s;
    let min_x_m_s = if params.allow_init_with_backwards_motion { -backwards_m_s } else { 0.0 };
    let numbers = [
        ("max_vel_x", params.max_vel_x_m_s),
        ("min_vel_x", min_x_m_s),
        ("max_vel_y", params.max_vel_y_m_s),
        ("min_vel_y", -params.max_vel_y_m_s),
        ("max_vel_theta", params.max_vel_theta_rad_s),
        ("max_speed_xy", max_speed_m_s(params)),
        ("acc_lim_x", params.acc_lim_x_m_s2),
        ("acc_lim_y", params.acc_lim_y_m_s2),
        ("acc_lim_theta", params.acc_lim_theta_rad_s2),
        ("decel_lim_x", -params.acc_lim_x_m_s2),
        ("decel_lim_y", -params.acc_lim_y_m_s2),
        ("decel_lim_theta", -params.acc_lim_theta_rad_s2),
        ("xy_goal_tolerance", params.xy_goal_tolerance_m),
        ("trans_stopped_velocity", params.trans_stopped_vel_m_s),
        ("forward_prune_distance", params.max_global_plan_lookahead_dist_m),
    ];
    let numbers = numbers.into_iter().map(|(name, number)| (name, format!("{number:?}")));
    numbers.chain(CRITICS.map(|(name, text)| (name, text.to_owned()))).collect()
}

fn pure_pursuit_values(params: &TebPlannerParams) -> ParamValues {
    let mut values = ParamValues::defaults(&REGULATED_PURE_PURSUIT);
    let [min_m, max_m] = LOOKAHEAD_RANGE_M;
    let lookahead_m = (1.5 * params.min_turning_radius_m).max(min_m).min(max_m);
    let max_m_s = max_speed_m_s(params);
    for (name, number) in [
        ("desired_linear_vel", max_m_s),
        ("lookahead_dist", lookahead_m),
        ("max_angular_accel", params.acc_lim_theta_rad_s2),
        ("regulated_linear_scaling_min_radius", 2.0 * params.min_turning_radius_m),
        ("regulated_linear_scaling_min_speed", max_m_s / 4.0),
    ] {
        values.set(name, ParamValue::Number(number));
    }
    // The robot cannot rotate in place.
    values.set("use_rotate_to_heading", ParamValue::Bool(false));
    values.set("allow_reversing", ParamValue::Bool(params.max_vel_x_backwards_m_s > 0.0));
    values
}
