//! Inputs from which plugins are created.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostics, Origin};
use periplus_params::{ParamValues, Table};

use crate::GivenParameters;

/// Period of the control loop of Nav2's controller server by default \[s\].
const DEFAULT_CONTROL_PERIOD_S: f64 = 0.05;

/// Inputs from which a controller or a checker is created.
#[derive(Clone, Debug)]
pub struct PluginSetup<'a> {
    /// Name of the plugin, which is the group of its parameters, such as `FollowPath`.
    pub name: &'a str,
    /// Release of Nav2 whose behaviour is used.
    pub release: Nav2Release,
    /// Period of the control loop \[s\].
    pub control_period_s: f64,
    /// Parameters of the group.
    pub given: GivenParameters<'a>,
    /// Tables of other plugins with parameters in the same group.
    pub neighbours: Vec<&'static Table>,
    /// Source location of the name of the class.
    pub class_origin: Origin,
}

impl<'a> PluginSetup<'a> {
    /// Returns a setup for Nav2 main at 20 Hz without parameters.
    #[must_use]
    pub fn new(name: &'a str) -> Self {
        Self {
            name,
            release: Nav2Release::Main,
            control_period_s: DEFAULT_CONTROL_PERIOD_S,
            given: GivenParameters::default(),
            neighbours: Vec::new(),
            class_origin: Origin::default(),
        }
    }

    /// Returns the setup with the source location of the class, for errors.
    #[must_use]
    pub fn at(mut self, class_origin: impl Into<Origin>) -> Self {
        self.class_origin = class_origin.into();
        self
    }

    /// Reads the parameters by a table.
    pub(crate) fn read(&self, table: &'static Table, diagnostics: &mut Diagnostics) -> ParamValues {
        self.given.read(table, &self.neighbours, diagnostics)
    }
}
