//! Magnetometer, altimeter and barometer.

use periplus_geometry::{DVec3, Stream};
use periplus_scene::NoiseSpec;

use crate::navsat::apply_bias_and_noise;
use crate::{Motion, NoiseModel, Streams};

/// A magnetometer: the world's magnetic field in the sensor's frame.
#[derive(Clone, Debug)]
pub struct Magnetometer {
    noise: [NoiseModel; 3],
}

impl Magnetometer {
    /// Creates a magnetometer with noise along x, y, z [T].
    #[must_use]
    pub fn new(noise: &[NoiseSpec; 3], streams: &Streams) -> Self {
        let noise = [(0, "x"), (1, "y"), (2, "z")]
            .map(|(axis, name)| NoiseModel::new(&noise[axis], streams, name));
        Self { noise }
    }

    /// Returns the field [T] in the sensor's frame, `dt_s` after the last reading.
    pub fn measure(
        &mut self,
        motion: &Motion,
        world_field_t: DVec3,
        dt_s: f64,
        stream: &mut Stream,
    ) -> DVec3 {
        apply_bias_and_noise(&mut self.noise, motion.in_sensor(world_field_t), dt_s, stream)
    }

    /// Returns the variances along x, y, z \[T²\].
    #[must_use]
    pub fn variances_t2(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.noise[axis].spec().stddev * self.noise[axis].spec().stddev)
    }

    /// Resets to the initial state.
    pub fn reset(&mut self) {
        self.noise.iter_mut().for_each(NoiseModel::reset);
    }
}

/// Reading of an altimeter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AltimeterReading {
    /// Height above the reference [m].
    pub position_m: f64,
    /// Upward velocity [m/s].
    pub velocity_m_s: f64,
    /// Reference: height of the first reading in the world [m].
    pub reference_m: f64,
}

/// An altimeter: height above its first reading, and vertical velocity.
#[derive(Clone, Debug)]
pub struct Altimeter {
    position: NoiseModel,
    velocity: NoiseModel,
    reference_m: Option<f64>,
}

impl Altimeter {
    /// Creates an altimeter with noise of height [m] and velocity [m/s].
    #[must_use]
    pub fn new(position: &NoiseSpec, velocity: &NoiseSpec, streams: &Streams) -> Self {
        Self {
            position: NoiseModel::new(position, streams, "vertical_position"),
            velocity: NoiseModel::new(velocity, streams, "vertical_velocity"),
            reference_m: None,
        }
    }

    /// Returns the current reading, `dt_s` after the last.
    pub fn measure(&mut self, motion: &Motion, dt_s: f64, stream: &mut Stream) -> AltimeterReading {
        let height_m = motion.world_from_sensor.translation.z;
        let reference_m = *self.reference_m.get_or_insert(height_m);
        AltimeterReading {
            position_m: self.position.apply(height_m - reference_m, dt_s, stream),
            velocity_m_s: self.velocity.apply(motion.linear_m_s.z, dt_s, stream),
            reference_m,
        }
    }

    /// Resets to the initial state.
    pub fn reset(&mut self) {
        self.reference_m = None;
        self.position.reset();
        self.velocity.reset();
    }
}

/// A barometer in the standard atmosphere.
#[derive(Clone, Debug)]
pub struct Barometer {
    reference_altitude_m: f64,
    noise: NoiseModel,
}

impl Barometer {
    /// Creates a barometer for a world whose origin is at an altitude [m], with noise [Pa].
    #[must_use]
    pub fn new(reference_altitude_m: f64, noise: &NoiseSpec, streams: &Streams) -> Self {
        Self { reference_altitude_m, noise: NoiseModel::new(noise, streams, "pressure") }
    }

    /// Returns the air pressure [Pa], `dt_s` after the last reading.
    pub fn measure(&mut self, motion: &Motion, dt_s: f64, stream: &mut Stream) -> f64 {
        let altitude_m = self.reference_altitude_m + motion.world_from_sensor.translation.z;
        self.noise.apply(standard_pressure_pa(altitude_m), dt_s, stream)
    }

    /// Returns the variance \[Pa²\].
    #[must_use]
    pub fn variance_pa2(&self) -> f64 {
        self.noise.spec().stddev * self.noise.spec().stddev
    }

    /// Resets to the initial state.
    pub fn reset(&mut self) {
        self.noise.reset();
    }
}

/// A layer of the standard atmosphere.
struct AtmosphereLayer {
    /// Geopotential height of the base [m].
    base_m: f64,
    /// Lapse rate of the temperature [K/m].
    lapse_k_m: f64,
}

/// Layers of the standard atmosphere (U.S. Standard Atmosphere 1976, table 4).
const ATMOSPHERE_LAYERS: [AtmosphereLayer; 7] = [
    AtmosphereLayer { base_m: 0.0, lapse_k_m: -0.0065 },
    AtmosphereLayer { base_m: 11_000.0, lapse_k_m: 0.0 },
    AtmosphereLayer { base_m: 20_000.0, lapse_k_m: 0.001 },
    AtmosphereLayer { base_m: 32_000.0, lapse_k_m: 0.0028 },
    AtmosphereLayer { base_m: 47_000.0, lapse_k_m: 0.0 },
    AtmosphereLayer { base_m: 51_000.0, lapse_k_m: -0.0028 },
    AtmosphereLayer { base_m: 71_000.0, lapse_k_m: -0.002 },
];
/// Radius of the Earth for geopotential heights [m].
const EARTH_RADIUS_M: f64 = 6_356_766.0;
/// `g₀ M / R*`, the hydrostatic constant [K/m].
const HYDROSTATIC_K_M: f64 = 9.806_65 * 28.9644 / 8_314.32;

/// Returns the pressure [Pa] at a geometric altitude [m] by the U.S. Standard Atmosphere 1976
/// (NASA-TM-X-74335), equations 18, 33a and 33b, from -5 km to 86 km; the last layer is
/// extrapolated.
#[must_use]
pub fn standard_pressure_pa(altitude_m: f64) -> f64 {
    let height_m = EARTH_RADIUS_M * altitude_m / (EARTH_RADIUS_M + altitude_m);
    let (mut pressure_pa, mut temperature_k) = (101_325.0, 288.15);
    for (layer, &AtmosphereLayer { base_m, lapse_k_m }) in ATMOSPHERE_LAYERS.iter().enumerate() {
        let top_m = ATMOSPHERE_LAYERS.get(layer + 1).map_or(f64::INFINITY, |next| next.base_m);
        let rise_m = height_m.min(top_m) - base_m;
        if lapse_k_m == 0.0 {
            pressure_pa *= libm::exp(-HYDROSTATIC_K_M * rise_m / temperature_k);
        } else {
            let above_k = (temperature_k + lapse_k_m * rise_m).max(1.0);
            pressure_pa *= libm::pow(temperature_k / above_k, HYDROSTATIC_K_M / lapse_k_m);
            temperature_k = above_k;
        }
        if height_m <= top_m {
            break;
        }
    }
    pressure_pa
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{Pose, Rpy};

    use super::*;

    const NONE: NoiseSpec = NoiseSpec {
        kind: periplus_scene::NoiseKind::None,
        mean: 0.0,
        stddev: 0.0,
        bias_mean: 0.0,
        bias_stddev: 0.0,
        dynamic_bias_stddev: 0.0,
        dynamic_bias_correlation_time_s: 0.0,
        precision: 0.0,
    };

    fn streams() -> Streams {
        Streams::new(0, "s")
    }

    /// Values of the standard's tables I (geometric altitude).
    #[test]
    fn the_air_is_as_thin_as_in_the_tables() {
        for (altitude_m, pressure_pa) in [
            (0.0, 101_325.0),
            (1_000.0, 89_876.3),
            (5_000.0, 54_048.3),
            (11_000.0, 22_699.9),
            (15_000.0, 12_111.8),
            (30_000.0, 1_197.0),
            (50_000.0, 79.779),
        ] {
            let error = standard_pressure_pa(altitude_m) / pressure_pa - 1.0;
            assert!(error.abs() < 2e-4, "{altitude_m}: {error}");
        }
        assert!(standard_pressure_pa(-1000.0) > 113_900.0);
        assert!(standard_pressure_pa(1e9).is_finite());
    }

    #[test]
    fn a_barometer_adds_the_altitude_of_the_world() {
        let mut sensor = Barometer::new(990.0, &NONE, &streams());
        let motion = Motion::at_rest(Pose::from_xyz(3.0, 2.0, 10.0));
        let pressure = sensor.measure(&motion, 0.0, &mut streams().tick(0));
        assert_eq!(pressure, standard_pressure_pa(1000.0));
    }

    #[test]
    fn a_magnetometer_turned_left_finds_north_to_the_right() {
        let mut sensor = Magnetometer::new(&[NONE; 3], &streams());
        let left = Rpy { roll: 0.0, pitch: 0.0, yaw: std::f64::consts::FRAC_PI_2 };
        let motion = Motion::at_rest(Pose::from_xyz_rpy([0.0; 3], left));
        let field = DVec3::new(2e-5, 0.0, -4e-5);
        let read = sensor.measure(&motion, field, 0.0, &mut streams().tick(0));
        assert!(read.distance(DVec3::new(0.0, -2e-5, -4e-5)) < 1e-18, "{read}");
    }

    #[test]
    fn an_altimeter_counts_from_where_it_began() {
        let mut sensor = Altimeter::new(&NONE, &NONE, &streams());
        let at = |z: f64| Motion {
            linear_m_s: DVec3::new(5.0, 0.0, 0.5),
            ..Motion::at_rest(Pose::from_xyz(0.0, 0.0, z))
        };
        sensor.measure(&at(1.5), 0.0, &mut streams().tick(0));
        let reading = sensor.measure(&at(4.0), 0.1, &mut streams().tick(1));
        let expected = AltimeterReading { position_m: 2.5, velocity_m_s: 0.5, reference_m: 1.5 };
        assert_eq!(reading, expected);
    }
}
