//! Parameters of `slam_toolbox` and `slam_gmapping` by their own names, and their mapping to the settings
//! here.
//!
//! Parameters of theirs without effect here are in the tables too, so that parameter files work unchanged.
//! Setting one of these to something other than its default gives a warning with the reason ([`idle`]).

mod gmapping;
mod toolbox;

use periplus_diagnostics::Diagnostic;
use periplus_params::{Default, Given, ParamValue, ParamValues, params};

use crate::settings::Settings;

pub use gmapping::{GMAPPING, GmappingParams};
pub use toolbox::{SLAM_TOOLBOX, SlamToolboxParams, ToolboxMode};

use crate::method::Method;

params! {
    /// Correction of the mounting, which neither program of ROS has.
    pub struct MountingParams {
        /// If true, an error of the scanner's mounting or of the odometry axes is corrected once it is
        /// certain, and the map is restarted (offline: the log is mapped again).
        #[param("correct_mounting")]
        correct_mounting: bool = true,
    }
}

/// Parameters that change nothing here.
struct Idle {
    names: &'static [&'static str],
    /// Reason: a sentence without its full stop.
    because: &'static str,
}

impl Method {
    /// The parameters by which a method is set up: of `slam_toolbox` for the graph, of
    /// `slam_gmapping` for particles.
    #[must_use]
    pub fn table(self) -> &'static periplus_params::Table {
        match self {
            Self::Graph => &SLAM_TOOLBOX,
            Self::Gmapping => &GMAPPING,
        }
    }
}

/// Parameters of a method that change nothing here, and why: for each reason the names.
pub fn reasons(method: Method) -> impl Iterator<Item = (&'static [&'static str], &'static str)> {
    lists(method).iter().map(|list| (list.names, list.because))
}

fn lists(method: Method) -> &'static [Idle] {
    match method {
        Method::Graph => toolbox::IDLE,
        Method::Gmapping => gmapping::IDLE,
    }
}

/// A warning for each parameter that was set to something else than its default and changes nothing.
#[must_use]
pub fn idle(values: &ParamValues) -> Vec<Diagnostic> {
    let of_table = Method::ALL.into_iter().find(|it| it.table().name == values.table().name);
    let lists = of_table.map(lists).unwrap_or_default();
    let mut findings = Vec::new();
    for list in lists {
        for name in list.names {
            if !is_changed(values, name) {
                continue;
            }
            let Some(value) = values.get(name) else { continue };
            findings.push(
                Diagnostic::warning("idle-parameter", format!("`{name}: {value}` changes nothing"))
                    .at(values.origin(name))
                    .note(list.because),
            );
        }
    }
    findings
}

/// Returns contradictions between values.
#[must_use]
pub fn conflicts(values: &ParamValues) -> Vec<Diagnostic> {
    let table = values.table();
    if table.name == GMAPPING.name { gmapping::conflicts(values) } else { Vec::new() }
}

/// True if a parameter differs from its default.
fn is_changed(values: &ParamValues, name: &str) -> bool {
    let default = values.table().find(name).and_then(|parameter| match parameter.default {
        Default::Value(default) => ParamValue::read(parameter, default).ok(),
        Default::Required | Default::None => None,
    });
    values.is_given(name) && values.get(name) != default
}

impl Settings {
    /// Converts values of [`SLAM_TOOLBOX`].
    #[must_use]
    pub fn of(values: &ParamValues) -> Self {
        Self::from(&SlamToolboxParams::from_values(values))
    }
}

/// Returns the method whose parameter names a file contains.
///
/// `None` if it contains names of both or of none.
#[must_use]
pub fn method_of<'a>(given: impl IntoIterator<Item = &'a Given<'a>>) -> Option<Method> {
    let (mut graph, mut gmapping) = (false, false);
    for one in given {
        let known = Method::ALL.map(|method| method.table().find(one.name).is_some());
        match known {
            [true, false] => graph = true,
            [false, true] => gmapping = true,
            _ => {}
        }
    }
    match (graph, gmapping) {
        (true, false) => Some(Method::Graph),
        (false, true) => Some(Method::Gmapping),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Diagnostics;

    use super::*;

    fn values(method: Method, given: &[(&'static str, &'static str)]) -> ParamValues {
        let mut diagnostics = Diagnostics::new();
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let values = method.table().check(given, None, &mut diagnostics);
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        values
    }

    #[test]
    fn the_tables_have_no_slips() {
        for method in Method::ALL {
            assert_eq!(method.table().faults(), [""; 0]);
        }
    }

    #[test]
    fn what_changes_nothing_is_a_parameter_and_is_named_once() {
        for method in Method::ALL {
            let mut seen = Vec::new();
            for name in lists(method).iter().flat_map(|list| list.names) {
                assert!(method.table().find(name).is_some(), "{name}");
                assert!(!seen.contains(name), "{name}");
                seen.push(name);
            }
        }
    }

    #[test]
    fn a_parameter_that_changes_nothing_says_why() {
        let given = [
            ("ceres_loss_function", "HuberLoss"),
            ("ceres_linear_solver", "SPARSE_NORMAL_CHOLESKY"),
            ("minimum_travel_distance", "0.2"),
        ];
        let values = values(Method::Graph, &given);
        let told: Vec<String> = idle(&values).into_iter().map(|it| it.message).collect();
        assert_eq!(told, ["`ceres_loss_function: HuberLoss` changes nothing"]);
        assert_eq!(Settings::of(&values).keyframe_distance_m, 0.2);
        assert_eq!(
            Settings::of(&values).keyframe_rotation_rad,
            Settings::default().keyframe_rotation_rad
        );
    }

    #[test]
    fn a_file_tells_its_method_by_the_names_in_it() {
        let of = |names: &[&'static str]| {
            let given: Vec<Given<'_>> = names.iter().map(|name| Given::new(name, "1")).collect();
            method_of(&given)
        };
        assert_eq!(of(&["map_frame", "resolution"]), Some(Method::Graph));
        assert_eq!(of(&["map_frame", "maxUrange"]), Some(Method::Gmapping));
        assert_eq!(of(&["map_frame", "odom_frame"]), None);
        assert_eq!(of(&["resolution", "delta"]), None);
    }

    #[test]
    fn default_settings_are_those_of_the_table() {
        let of_table = Settings::of(&ParamValues::defaults(&SLAM_TOOLBOX));
        assert_eq!(format!("{:?}", Settings::default()), format!("{of_table:?}"));
    }
}
