//! `<gz:radar>` of a custom sensor, or `<radar>`.

use periplus_scene::{RadarNoise, RadarSpec};

use crate::fields::Fields;

/// Attributes of a custom sensor that name its type, the newest first.
pub(crate) const CUSTOM_TYPE_ATTRIBUTES: [&str; 2] = ["gz:type", "ignition:type"];

/// Elements that hold the settings of a radar.
pub(crate) const RADAR_ELEMENTS: [&str; 3] = ["gz:radar", "ignition:radar", "radar"];

pub(crate) fn read_radar(mut fields: Fields<'_, '_>) -> RadarSpec {
    let default = RadarSpec::default();
    let vertical_fov_rad = fields.magnitude("vertical_fov", default.vertical_fov_rad);
    let mut radar = RadarSpec {
        horizontal_fov_rad: fields.magnitude("horizontal_fov", default.horizontal_fov_rad),
        vertical_fov_rad,
        azimuth_resolution_rad: fields
            .magnitude("azimuth_resolution", default.azimuth_resolution_rad),
        elevation_resolution_rad: fields.magnitude("elevation_resolution", vertical_fov_rad),
        min_cross_section_m2: fields.magnitude("min_cross_section", default.min_cross_section_m2),
        ..default
    };
    if let Some(mut range) = fields.open("range") {
        radar.range_min_m = range.magnitude("min", radar.range_min_m);
        radar.range_max_m = range.magnitude("max", radar.range_max_m);
        radar.range_resolution_m = range.magnitude("resolution", radar.range_resolution_m);
        let rest = range.finish();
        fields.close("range", rest);
    }
    if let Some(mut velocity) = fields.open("velocity") {
        radar.doppler_max_m_per_s = velocity.magnitude("max", radar.doppler_max_m_per_s);
        radar.doppler_resolution_m_per_s =
            velocity.magnitude("resolution", radar.doppler_resolution_m_per_s);
        let rest = velocity.finish();
        fields.close("velocity", rest);
    }
    if let Some(mut noise) = fields.open("noise") {
        radar.noise = RadarNoise {
            range_stddev_m: noise.magnitude("range_stddev", 0.0),
            azimuth_stddev_rad: noise.magnitude("azimuth_stddev", 0.0),
            elevation_stddev_rad: noise.magnitude("elevation_stddev", 0.0),
            doppler_stddev_m_per_s: noise.magnitude("velocity_stddev", 0.0),
            amplitude_stddev_db: noise.magnitude("amplitude_stddev", 0.0),
        };
        let rest = noise.finish();
        fields.close("noise", rest);
    }
    radar.extra = fields.finish();
    radar
}
