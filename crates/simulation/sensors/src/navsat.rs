//! Satellite navigation.

use periplus_geometry::{DVec3, Stream};
use periplus_scene::NoiseSpec;

use crate::geodesy::{GeodeticPosition, LocalTangentFrame};
use crate::{Motion, NoiseModel, Streams};

/// Reading of a satellite receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavSatReading {
    /// Position.
    pub position: GeodeticPosition,
    /// Velocity east, north and up [m/s].
    pub velocity_m_s: DVec3,
}

/// Noise specification of a receiver.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NavSatNoise {
    /// Horizontal position [m].
    pub position_horizontal: NoiseSpec,
    /// Vertical position [m].
    pub position_vertical: NoiseSpec,
    /// Horizontal velocity [m/s].
    pub velocity_horizontal: NoiseSpec,
    /// Vertical velocity [m/s].
    pub velocity_vertical: NoiseSpec,
}

/// A satellite receiver. Noise of the position is in metres east, north and up, as SDF defines and
/// Classic does (gz-sensors adds it to angles).
#[derive(Clone, Debug)]
pub struct NavSat {
    frame: LocalTangentFrame,
    position: [NoiseModel; 3],
    velocity: [NoiseModel; 3],
}

impl NavSat {
    /// Creates a receiver in a georeferenced world.
    #[must_use]
    pub fn new(frame: LocalTangentFrame, noise: &NavSatNoise, streams: &Streams) -> Self {
        let three = |horizontal: &NoiseSpec, vertical: &NoiseSpec, group: &str| {
            [(horizontal, "east"), (horizontal, "north"), (vertical, "up")]
                .map(|(noise, axis)| NoiseModel::new(noise, streams, &format!("{group}/{axis}")))
        };
        Self {
            frame,
            position: three(&noise.position_horizontal, &noise.position_vertical, "position"),
            velocity: three(&noise.velocity_horizontal, &noise.velocity_vertical, "velocity"),
        }
    }

    /// Returns the current reading, `dt_s` after the last.
    pub fn measure(&mut self, motion: &Motion, dt_s: f64, stream: &mut Stream) -> NavSatReading {
        let mut position = self.frame.position(motion.world_from_sensor.translation);
        let mut velocity_m_s = self.frame.velocity(position, motion.linear_m_s);
        let off_m = apply_bias_and_noise(&mut self.position, DVec3::ZERO, dt_s, stream);
        if off_m != DVec3::ZERO {
            position = self.frame.offset_by(position, off_m);
        }
        velocity_m_s = apply_bias_and_noise(&mut self.velocity, velocity_m_s, dt_s, stream);
        NavSatReading { position, velocity_m_s }
    }

    /// Returns the variances of the position east, north and up \[m²\].
    #[must_use]
    pub fn position_variances_m2(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.position[axis].spec().stddev * self.position[axis].spec().stddev)
    }

    /// Resets to the initial state.
    pub fn reset(&mut self) {
        self.position.iter_mut().chain(&mut self.velocity).for_each(NoiseModel::reset);
    }
}

/// Adds noise to every axis of a vector.
pub(crate) fn apply_bias_and_noise(
    noises: &mut [NoiseModel; 3],
    vector: DVec3,
    dt_s: f64,
    stream: &mut Stream,
) -> DVec3 {
    let values = vector.to_array();
    DVec3::from_array([0, 1, 2].map(|axis| noises[axis].apply(values[axis], dt_s, stream)))
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose;
    use periplus_scene::{NoiseKind, SphericalCoordinates};

    use super::*;

    fn frame() -> LocalTangentFrame {
        LocalTangentFrame::new(&SphericalCoordinates {
            surface_model: "EARTH_WGS84".into(),
            frame_orientation: "ENU".into(),
            latitude_rad: 0.8,
            longitude_rad: 0.2,
            elevation_m: 0.0,
            heading_rad: 0.0,
            extra: Vec::new(),
        })
        .unwrap()
    }

    #[test]
    fn a_kilometre_north_is_a_kilometre_by_the_meridian() {
        let mut sensor = NavSat::new(frame(), &NavSatNoise::default(), &Streams::new(0, "gps"));
        let motion = Motion {
            linear_m_s: DVec3::new(1.0, 2.0, 3.0),
            ..Motion::at_rest(Pose::from_xyz(0.0, 1000.0, 5.0))
        };
        let reading = sensor.measure(&motion, 0.0, &mut Stream::keyed(0, "", 0));
        // Radius of the meridian at this latitude: a (1 - e²) / (1 - e² sin²)^(3/2).
        let (e2, sine) = (0.006_694_379_990_14, libm::sin(0.8));
        let radius_m = 6_378_137.0 * (1.0 - e2) / libm::pow(1.0 - e2 * sine * sine, 1.5);
        let north_m = (reading.position.latitude_rad - 0.8) * radius_m;
        assert!((north_m - 1000.0).abs() < 0.01, "{north_m}");
        // The tangent plane leaves the Earth by s²/2R.
        let rise_m = 1000.0 * 1000.0 / (2.0 * radius_m);
        assert!((reading.position.altitude_m - 5.0 - rise_m).abs() < 1e-3);
        assert!(reading.velocity_m_s.distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-3);
    }

    #[test]
    fn noise_is_in_metres() {
        let metre = NoiseSpec { kind: NoiseKind::Gaussian, stddev: 2.0, ..NoiseSpec::default() };
        let noise = NavSatNoise { position_horizontal: metre, ..NavSatNoise::default() };
        let streams = Streams::new(0, "gps");
        let mut sensor = NavSat::new(frame(), &noise, &streams);
        assert_eq!(sensor.position_variances_m2(), [4.0, 4.0, 0.0]);
        let here = frame().to_ecef(DVec3::ZERO);
        let mut squares = 0.0;
        for tick in 0..2000 {
            let motion = Motion::at_rest(Pose::IDENTITY);
            let position = sensor.measure(&motion, 0.1, &mut streams.tick(tick)).position;
            squares += crate::geodesy::Ellipsoid::EARTH.to_ecef(position).distance_squared(here);
        }
        assert!((squares / 2000.0 - 8.0).abs() < 0.6, "{squares}");
    }
}
