//! `<gz:radar>`.

use periplus_scene::{RadarNoise, RadarSpec};
use periplus_xml::Element;

use super::out::Out;

pub(super) fn write_radar(radar: &RadarSpec, name: &str) -> Element {
    let mut out = Out::new(name);
    out.always("horizontal_fov", radar.horizontal_fov_rad);
    out.always("vertical_fov", radar.vertical_fov_rad);
    let mut range = Out::new("range");
    range.always("min", radar.range_min_m);
    range.always("max", radar.range_max_m);
    range.always("resolution", radar.range_resolution_m);
    out.push(range.finish(&[]));
    out.always("azimuth_resolution", radar.azimuth_resolution_rad);
    out.always("elevation_resolution", radar.elevation_resolution_rad);
    let mut velocity = Out::new("velocity");
    velocity.always("max", radar.doppler_max_m_per_s);
    velocity.always("resolution", radar.doppler_resolution_m_per_s);
    out.push(velocity.finish(&[]));
    out.always("min_cross_section", radar.min_cross_section_m2);
    if radar.noise != RadarNoise::default() {
        let mut noise = Out::new("noise");
        noise.number("range_stddev", radar.noise.range_stddev_m, 0.0);
        noise.number("azimuth_stddev", radar.noise.azimuth_stddev_rad, 0.0);
        noise.number("elevation_stddev", radar.noise.elevation_stddev_rad, 0.0);
        noise.number("velocity_stddev", radar.noise.doppler_stddev_m_per_s, 0.0);
        noise.number("amplitude_stddev", radar.noise.amplitude_stddev_db, 0.0);
        out.push(noise.finish(&[]));
    }
    out.finish(&radar.extra)
}
