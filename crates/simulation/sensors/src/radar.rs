//! Radars: returns with range, angles, radial velocity and amplitude.

mod cells;

use std::collections::BTreeMap;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose, Stream};
use periplus_raycast::{Hit, Ray};
use periplus_scene::{RadarNoise, RadarSpec};

use self::cells::{RadarRays, fold, nearest_cell};
use crate::{Motion, RayView};

/// Return of a radar: the reflection of one resolution cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadarDetection {
    /// Distance [m].
    pub range_m: f64,
    /// Angle to the left of x in the plane of x and y [rad].
    pub azimuth_rad: f64,
    /// Angle above the plane of x and y [rad].
    pub elevation_rad: f64,
    /// Radial velocity, positive away from the sensor [m/s].
    pub doppler_m_per_s: f64,
    /// Received power, `10 log10(σ / R⁴)` for the cross-section σ \[m²\] at the range R \[m\]: 0 dB is a reflector of 1 m²
    /// at 1 m \[dB\].
    pub amplitude_db: f64,
}

/// Surface that a radar ray has hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadarEcho {
    /// The hit.
    pub hit: Hit,
    /// Point of the surface in the world [m].
    pub point_m: DVec3,
}

/// Radar with resolution cells of range, azimuth, elevation and radial velocity.
///
/// Rays sample the surfaces in the field of view, three across each azimuth cell. A ray with the solid angle Ω that
/// hits at the range R, θ off the normal of the surface, contributes the cross-section `σ = R² Ω cos θ`: that of a
/// diffuse reflector whose cross-section is its area when it faces the radar (Lambert's law for backscatter, σ = 4 ρ A
/// cos²θ, with the reflectivity ρ = 1/4). The radar equation has the received power in proportion to σ / R⁴ (Skolnik,
/// *Introduction to Radar Systems*, chapter 1); powers within a cell add up. A cell is reported if its power reaches that
/// of the smallest detectable cross-section at the maximum range.
#[derive(Clone, Debug)]
pub struct RadarSensor {
    spec: RadarSpec,
    cells: RadarRays,
    /// Minimum of σ / R⁴ that is detected [1/m²].
    min_power_per_m2: f64,
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
    detections: Vec<RadarDetection>,
}

impl RadarSensor {
    /// Creates a radar from its specification.
    ///
    /// # Errors
    /// When it cannot measure: empty ranges or fields of view, resolutions that are not above 0, or too many cells.
    pub fn new(spec: &RadarSpec) -> Result<Self, Box<Diagnostic>> {
        check(spec)?;
        let max_m = spec.range_max_m;
        Ok(Self {
            cells: RadarRays::new(spec)?,
            min_power_per_m2: spec.min_cross_section_m2 / (max_m * max_m * max_m * max_m),
            spec: spec.clone(),
            rays: Vec::new(),
            hits: Vec::new(),
            detections: Vec::new(),
        })
    }

    /// Returns the specification.
    #[must_use]
    pub fn spec(&self) -> &RadarSpec {
        &self.spec
    }

    /// Returns the width of an azimuth cell and the height of an elevation cell [rad]: at most the resolutions of the
    /// specification, so that cells cover the field of view exactly.
    #[must_use]
    pub fn angle_cells_rad(&self) -> [f64; 2] {
        [self.cells.azimuth.width_rad, self.cells.elevation.width_rad]
    }

    /// Measures a scan: one detection per cell with enough power, by elevation, azimuth, range and radial velocity.
    /// `velocity_m_per_s` returns the velocity of a point of a surface in the world. The sensor's own model is not
    /// seen.
    pub fn scan(
        &mut self,
        view: &RayView<'_>,
        motion: &Motion,
        velocity_m_per_s: &mut dyn FnMut(&RadarEcho) -> DVec3,
        stream: &mut Stream,
    ) -> &[RadarDetection] {
        self.cast(view, motion.world_from_sensor);
        let mut power_per_m2: BTreeMap<[i32; 4], f64> = BTreeMap::new();
        for ((ray, hit), aim) in self.rays.iter().zip(&self.hits).zip(&self.cells.rays) {
            let Some(hit) = *hit else { continue };
            let echo = RadarEcho { hit, point_m: ray.at(hit.distance_m) };
            let relative_m_per_s = velocity_m_per_s(&echo) - motion.linear_m_s;
            let doppler_m_per_s =
                fold(relative_m_per_s.dot(ray.direction), self.spec.doppler_max_m_per_s);
            let cell = [
                aim.elevation_cell,
                aim.azimuth_cell,
                nearest_cell(hit.distance_m, self.spec.range_resolution_m),
                nearest_cell(doppler_m_per_s, self.spec.doppler_resolution_m_per_s),
            ];
            let facing = hit.normal.dot(ray.direction).abs();
            let range2_m2 = hit.distance_m * hit.distance_m;
            *power_per_m2.entry(cell).or_default() += aim.solid_angle_sr * facing / range2_m2;
        }
        self.detections.clear();
        for (cell, power) in power_per_m2 {
            // Noise is drawn for every cell, so that the others do not change with the power of one.
            let noise = Noise::draw(&self.spec.noise, stream);
            if power >= self.min_power_per_m2 && power > 0.0 {
                self.detections.push(self.detection(cell, power, &noise));
            }
        }
        &self.detections
    }

    fn cast(&mut self, view: &RayView<'_>, world_from_sensor: Pose) {
        let Pose { translation: origin_m, rotation } = world_from_sensor;
        let (min_m, max_m) = (self.spec.range_min_m, self.spec.range_max_m);
        let aim =
            |direction: DVec3| Ray { origin_m, direction: rotation * direction, min_m, max_m };
        self.rays.clear();
        self.rays.extend(self.cells.rays.iter().map(|ray| aim(ray.direction)));
        self.hits.clear();
        self.hits.resize(self.rays.len(), None);
        let filter = view.without_own_model();
        view.rays.hits_grid(&self.rays, self.cells.columns, filter, view.threads, &mut self.hits);
    }

    fn detection(&self, cell: [i32; 4], power_per_m2: f64, noise: &Noise) -> RadarDetection {
        let [elevation, azimuth, range, doppler] = cell;
        let (range_width_m, doppler_width_m_per_s) =
            (self.spec.range_resolution_m, self.spec.doppler_resolution_m_per_s);
        let on_cells = |cell: i32, error: f64, width: f64| {
            f64::from(nearest_cell(f64::from(cell) * width + error, width)) * width
        };
        let turned = |cells: &cells::AngleCells, cell: i32, error_rad: f64| {
            cells.centre_rad(cells.index(cells.centre_rad(cell) + error_rad))
        };
        RadarDetection {
            range_m: on_cells(range, noise.range_m, range_width_m),
            azimuth_rad: turned(&self.cells.azimuth, azimuth, noise.azimuth_rad),
            elevation_rad: turned(&self.cells.elevation, elevation, noise.elevation_rad),
            doppler_m_per_s: on_cells(doppler, noise.doppler_m_per_s, doppler_width_m_per_s),
            amplitude_db: 10.0 * libm::log10(power_per_m2) + noise.amplitude_db,
        }
    }
}

/// Errors of one return.
struct Noise {
    range_m: f64,
    azimuth_rad: f64,
    elevation_rad: f64,
    doppler_m_per_s: f64,
    amplitude_db: f64,
}

impl Noise {
    fn draw(spec: &RadarNoise, stream: &mut Stream) -> Self {
        let mut draw = |stddev: f64| if stddev == 0.0 { 0.0 } else { stddev * stream.normal() };
        Self {
            range_m: draw(spec.range_stddev_m),
            azimuth_rad: draw(spec.azimuth_stddev_rad),
            elevation_rad: draw(spec.elevation_stddev_rad),
            doppler_m_per_s: draw(spec.doppler_stddev_m_per_s),
            amplitude_db: draw(spec.amplitude_stddev_db),
        }
    }
}

/// Checks that a radar can measure.
fn check(spec: &RadarSpec) -> Result<(), Box<Diagnostic>> {
    let wrong = |message: String, help: &str| {
        Err(Diagnostic::error("out-of-range", message).help(help.to_owned()).into())
    };
    let (min_m, max_m) = (spec.range_min_m, spec.range_max_m);
    if !(min_m >= 0.0 && max_m > min_m && max_m.is_finite()) {
        return wrong(
            format!("a radar with ranges from {min_m} m to {max_m} m cannot measure anything"),
            "set `<range><min>` to 0 or above, and `<max>` above it",
        );
    }
    let fields_of_view = [
        ("horizontal_fov", spec.horizontal_fov_rad, std::f64::consts::TAU),
        ("vertical_fov", spec.vertical_fov_rad, std::f64::consts::PI),
    ];
    for (name, fov_rad, max_rad) in fields_of_view {
        if !(fov_rad > 0.0 && fov_rad <= max_rad) {
            return wrong(
                format!("`<{name}>` of {fov_rad} rad is not possible for a radar"),
                "use a value in radians above 0: up to 6.2831 across and 3.1415 up",
            );
        }
    }
    let widths = [
        ("range><resolution", spec.range_resolution_m),
        ("azimuth_resolution", spec.azimuth_resolution_rad),
        ("elevation_resolution", spec.elevation_resolution_rad),
        ("velocity><resolution", spec.doppler_resolution_m_per_s),
        ("velocity><max", spec.doppler_max_m_per_s),
    ];
    for (name, width) in widths {
        if !(width > 0.0 && width.is_finite()) {
            return wrong(
                format!("`<{name}>` of {width} is not possible for a radar"),
                "resolutions and the maximum velocity must be above 0",
            );
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
