//! Parameters of `controller_manager`.

use periplus_params::params;

params! {
    /// Controller manager.
    #[table(CONTROLLER_MANAGER, "controller_manager")]
    pub struct ManagerParams {
        /// Rate of the updates in simulated time (default 100).
        #[param("update_rate", unit("Hz"), within(1.0, 100000.0))]
        update_rate_hz: f64 = 100,
        /// Components that start inactive (default none).
        #[param("hardware_components_initial_state.inactive")]
        inactive_components: Vec<String>,
        /// Components that start unconfigured (default none).
        #[param("hardware_components_initial_state.unconfigured")]
        unconfigured_components: Vec<String>,
        /// Limits commands to the limits of the joints (default true after Jazzy, else false).
        #[param("enforce_command_limits")]
        enforce_command_limits: Option<bool>,
    }
}
