//! Parameter changes at runtime.

use periplus_graph::ParameterRejection;
use periplus_params::{ParamValue, ParamValues};

use super::SlamNode;
use crate::slam_toolbox::parameters::NodeParams;

/// Parameter for the length of the transform buffer \[s\].
const BUFFER: &str = "tf_buffer_duration";

impl SlamNode {
    /// Applies parameter changes at runtime.
    pub(super) fn change(&mut self, values: &ParamValues) -> Result<(), ParameterRejection> {
        const STATES: [&str; 2] = ["interactive_mode", "paused_processing"];
        const AT_ANY_TIME: [&str; 11] = [
            "paused_new_measurements",
            "map_update_interval",
            "minimum_time_interval",
            "throttle_scans",
            "transform_timeout",
            "restamp_tf",
            "tf_delay",
            "position_covariance_scale",
            "yaw_covariance_scale",
            "use_sim_time",
            "debug_logging",
        ];
        if values.table().find(BUFFER).is_some() && values.get(BUFFER) != self.values.get(BUFFER) {
            return Err(ParameterRejection::new(format_args!(
                "`{BUFFER}` is read when the node is made; set it in its file"
            )));
        }
        let is_changed = |name: &&str| {
            values.table().find(name).is_some() && values.get(name) != self.values.get(name)
        };
        if let Some(name) = STATES.iter().find(|name| is_changed(name)) {
            return Err(ParameterRejection::new(format_args!(
                "`{name}` shows a state; the service `slam_toolbox/toggle_interactive_mode` changes \
                 it"
            )));
        }
        let changed =
            values.table().parameters.iter().map(|parameter| parameter.name).find(|name| {
                !AT_ANY_TIME.contains(name) && values.get(name) != self.values.get(name)
            });
        if let Some(name) = changed.filter(|_| self.scans.is_some()) {
            return Err(ParameterRejection::new(format_args!(
                "`{name}` is read when the node is configured; set it before, or clean the node up \
                 and configure it again"
            )));
        }
        let is_paused = self.params.is_paused;
        self.set_values(values.clone());
        if self.params.is_paused != is_paused {
            self.is_paused = self.params.is_paused;
        }
        Ok(())
    }

    pub(super) fn set_values(&mut self, values: ParamValues) {
        self.params = NodeParams::new(self.program, &values);
        self.values = values;
    }

    /// Publishes a state as a parameter.
    pub(crate) fn show_state(&mut self, name: &'static str, is_so: bool) {
        if let Some(parameters) = self.parameters.as_ref().filter(|_| self.program.is_toolbox())
            && parameters.set(name, ParamValue::Bool(is_so)).is_ok()
        {
            self.set_values(parameters.values());
        }
    }
}
