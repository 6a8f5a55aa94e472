//! Physics settings.

use periplus_xml::Element;
use serde::Serialize;

/// One `<physics>` profile.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Physics {
    /// Its name.
    pub name: String,
    /// True if it is marked as the world's default.
    pub default: bool,
    /// Physics engine that the file asks for: `ode`, `bullet`, `simbody`, `dart`.
    pub engine: String,
    /// Step of the simulation [s].
    pub max_step_size_s: f64,
    /// Target ratio of simulated to wall time; 0 is as fast as possible.
    pub real_time_factor: f64,
    /// Target rate of steps in wall time in Gazebo Classic [Hz]; 0 is as fast as possible.
    pub real_time_update_rate_hz: f64,
    /// Maximum number of contact points between two bodies.
    pub max_contacts: u32,
    /// Engine settings.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

impl Default for Physics {
    fn default() -> Self {
        Self {
            name: "default_physics".into(),
            default: false,
            engine: "ode".into(),
            max_step_size_s: 0.001,
            real_time_factor: 1.0,
            real_time_update_rate_hz: 1000.0,
            max_contacts: 20,
            extra: Vec::new(),
        }
    }
}
