//! Findings about parameters that cannot work together, with each other or with the local costmap.

mod checkers;
mod graceful;
mod move_base;
mod pure_pursuit;
mod trajectories;

use periplus_costmap::{CostmapView, InflationLaw, Nav2Release};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_params::ParamValues;

pub use checkers::{check_goal_checker, check_progress_checker};

use crate::dwb::DWB;
use crate::graceful::GRACEFUL;
use crate::ros1::{DWA_PLANNER, TRAJECTORY_PLANNER};
use crate::rpp::REGULATED_PURE_PURSUIT;
use crate::{Controller, ROTATION_SHIM};

/// Facts about the local costmap, the robot and the server on which parameters depend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostmapFacts {
    /// Side length of a cell \[m\].
    pub resolution_m: f64,
    /// Half of the shorter side of the costmap, which is the distance that the robot sees ahead \[m\].
    pub extent_m: f64,
    /// Inscribed radius of the footprint \[m\].
    pub inscribed_radius_m: f64,
    /// Circumscribed radius of the footprint \[m\].
    pub circumscribed_radius_m: f64,
    /// True if the robot is given by a radius.
    pub is_circular: bool,
    /// Inflation; none without an inflation layer.
    pub inflation: Option<InflationLaw>,
    /// Period of the control loop \[s\].
    pub control_period_s: f64,
}

impl CostmapFacts {
    /// Returns the facts of a costmap, for a period of the control loop \[s\].
    #[must_use]
    pub fn new(view: &CostmapView<'_>, control_period_s: f64) -> Self {
        let (width_m, height_m) = view.costs.info().size_m();
        Self {
            resolution_m: view.costs.resolution_m(),
            extent_m: width_m.min(height_m) / 2.0,
            inscribed_radius_m: view.footprint.inscribed_radius_m,
            circumscribed_radius_m: view.footprint.circumscribed_radius_m,
            is_circular: view.is_circular,
            inflation: view.inflation,
            control_period_s,
        }
    }
}

/// Subject of findings: parameters of a plugin with its name.
struct Subject<'a> {
    /// Name of the plugin, which is the group of its parameters.
    name: &'a str,
    values: &'a ParamValues,
    release: Nav2Release,
    facts: &'a CostmapFacts,
}

impl Subject<'_> {
    /// Full name of a parameter.
    fn full(&self, parameter: &str) -> String {
        format!("`{}.{parameter}`", self.name)
    }

    /// Finding at the location of a parameter.
    fn warning(&self, code: &'static str, parameter: &str, text: String) -> Diagnostic {
        Diagnostic::warning(code, text).at(self.values.origin(parameter))
    }

    /// Error at the location of a parameter.
    fn error(&self, code: &'static str, parameter: &str, text: String) -> Diagnostic {
        Diagnostic::error(code, text).at(self.values.origin(parameter))
    }

    /// Hint at the location of a parameter.
    fn hint(&self, code: &'static str, parameter: &str, text: String) -> Diagnostic {
        Diagnostic::hint(code, text).at(self.values.origin(parameter))
    }
}

/// Reports parameters of a controller that contradict each other or the local costmap.
pub fn check_controller(
    name: &str,
    controller: &dyn Controller,
    release: Nav2Release,
    facts: &CostmapFacts,
    diagnostics: &mut Diagnostics,
) {
    for group in controller.parameters() {
        let name = match group.group.as_str() {
            "" => name.to_owned(),
            inner => format!("{name}.{inner}"),
        };
        let subject = Subject { name: &name, values: group.values, release, facts };
        let table = group.values.table();
        if *table == REGULATED_PURE_PURSUIT {
            pure_pursuit::check(&subject, diagnostics);
        } else if *table == GRACEFUL {
            graceful::check(&subject, diagnostics);
        } else if *table == ROTATION_SHIM {
            graceful::check_shim(&subject, diagnostics);
        } else if *table == DWB {
            trajectories::check(&subject, diagnostics);
        } else if *table == DWA_PLANNER {
            move_base::check_dwa(&subject, diagnostics);
        } else if *table == TRAJECTORY_PLANNER {
            move_base::check_rollout(&subject, diagnostics);
        }
    }
}
