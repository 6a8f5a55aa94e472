//! Radars.

use periplus_xml::Element;
use serde::Serialize;

/// Radar that measures range, angles and radial velocity in resolution cells.
///
/// SDF has no radar. Gazebo's convention for its custom sensors is `<sensor type="custom" gz:type="radar">` with the
/// settings in `<gz:radar>`; `<sensor type="radar">` with `<radar>` is read too.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RadarSpec {
    /// Horizontal field of view, symmetrical about x [rad].
    pub horizontal_fov_rad: f64,
    /// Vertical field of view, symmetrical about x [rad].
    pub vertical_fov_rad: f64,
    /// Minimum range [m].
    pub range_min_m: f64,
    /// Maximum range [m].
    pub range_max_m: f64,
    /// Width of a range cell [m].
    pub range_resolution_m: f64,
    /// Maximum width of an azimuth cell [rad].
    pub azimuth_resolution_rad: f64,
    /// Maximum height of an elevation cell [rad]; the vertical field of view is one cell if it is not above this.
    pub elevation_resolution_rad: f64,
    /// Width of a cell of radial velocity [m/s].
    pub doppler_resolution_m_per_s: f64,
    /// Maximum unambiguous radial velocity [m/s]; velocities beyond it wrap around.
    pub doppler_max_m_per_s: f64,
    /// Smallest radar cross-section that is detected at the maximum range \[m²\].
    pub min_cross_section_m2: f64,
    /// Standard deviations of a return.
    pub noise: RadarNoise,
    /// Uninterpreted elements, kept verbatim.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// Standard deviations of the values of a radar return, before they are rounded to cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RadarNoise {
    /// Range [m].
    pub range_stddev_m: f64,
    /// Azimuth [rad].
    pub azimuth_stddev_rad: f64,
    /// Elevation [rad].
    pub elevation_stddev_rad: f64,
    /// Radial velocity \[m/s\].
    pub doppler_stddev_m_per_s: f64,
    /// Amplitude \[dB\].
    pub amplitude_stddev_db: f64,
}

impl Default for RadarSpec {
    /// Typical values of a 77 GHz radar for medium range.
    fn default() -> Self {
        Self {
            horizontal_fov_rad: 1.57,
            vertical_fov_rad: 0.2,
            range_min_m: 0.2,
            range_max_m: 50.0,
            range_resolution_m: 0.2,
            azimuth_resolution_rad: 0.035,
            elevation_resolution_rad: 0.2,
            doppler_resolution_m_per_s: 0.1,
            doppler_max_m_per_s: 30.0,
            min_cross_section_m2: 0.1,
            noise: RadarNoise::default(),
            extra: Vec::new(),
        }
    }
}
