//! Inertial measurement units.

use periplus_xml::Element;
use serde::Serialize;

use crate::NoiseSpec;

/// Inertial measurement unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ImuSpec {
    /// Noise about x, y, z [rad/s].
    pub angular_velocity: [NoiseSpec; 3],
    /// Noise along x, y, z [m/s²].
    pub linear_acceleration: [NoiseSpec; 3],
    /// True if it reports an orientation.
    pub enable_orientation: bool,
    /// Reference of the orientation: `CUSTOM`, `ENU`, `NED`, `NWU`, `GRAV_UP`, `GRAV_DOWN`; `None` for the
    /// initial orientation.
    pub localization: Option<String>,
    /// Custom reference frames.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}
