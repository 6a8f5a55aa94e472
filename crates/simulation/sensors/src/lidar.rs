//! Lidars: ranges along a fan or a grid of rays.

mod beams;
mod interpolation;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose, Stream};
use periplus_raycast::{Filter, Hit, Ray};

pub use beams::LidarBeams;

use self::interpolation::RangeInterpolation;
use crate::{NoiseModel, RayView, Streams, Sweep};

/// Maximum number of rays, and of ranges, of a lidar: sixteen times 128 rows of 2048. More is
/// assumed to be a mistake.
pub const MAX_BEAMS: usize = 1 << 22;

/// Ranges of a lidar, row by row from the lowest, each from the first angle to the last.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LidarScan {
    /// Distances [m]; `-inf` too near, `inf` no hit (REP 117).
    pub ranges_m: Vec<f32>,
    /// Laser intensity (`laser_retro`) of the hits.
    pub intensities: Vec<f32>,
}

/// A lidar of any sensor type: `ray`, `gpu_ray`, `lidar`, `gpu_lidar`.
///
/// Rays start at the minimum range, so that the housing of the lidar is not seen; farther parts of
/// the same model are. Another model within the minimum range is reported as too near.
/// `<range><resolution>` is not applied, as in Gazebo.
#[derive(Clone, Debug)]
pub struct LidarSensor {
    beams: LidarBeams,
    range_min_m: f64,
    range_max_m: f64,
    noise: NoiseModel,
    /// Interpolation from rays to ranges, when their numbers differ.
    interpolate: Option<RangeInterpolation>,
    /// Directions of the rays in the sensor's frame.
    directions: Vec<DVec3>,
    rays: Vec<Ray>,
    distances_m: Vec<f32>,
    hits: Vec<Option<Hit>>,
    near_m: Vec<f32>,
    brightness: Vec<f32>,
    scan: LidarScan,
}

impl LidarSensor {
    /// Creates a lidar from its specification.
    ///
    /// # Errors
    /// When it cannot measure: no beams or too many, angles or ranges that are not finite, or an
    /// empty range interval.
    pub fn new(
        spec: &periplus_scene::LidarSpec,
        streams: &Streams,
    ) -> Result<Self, Box<Diagnostic>> {
        let beams = LidarBeams::new(spec)?;
        let (min_m, max_m) = (spec.range_min_m, spec.range_max_m);
        if !(min_m >= 0.0 && min_m.is_finite() && max_m > min_m) {
            return Err(Diagnostic::error(
                "out-of-range",
                format!("a lidar with ranges from {min_m} m to {max_m} m cannot measure anything"),
            )
            .help("set `<range><min>` to 0 or above, and `<max>` above it")
            .into());
        }
        let directions = beams.directions();
        Ok(Self {
            interpolate: RangeInterpolation::new(&beams),
            beams,
            range_min_m: min_m,
            range_max_m: max_m,
            noise: NoiseModel::new(&spec.noise, streams, "range"),
            directions,
            rays: Vec::new(),
            distances_m: Vec::new(),
            hits: Vec::new(),
            near_m: Vec::new(),
            brightness: Vec::new(),
            scan: LidarScan::default(),
        })
    }

    /// Returns angles and counts.
    #[must_use]
    pub fn beams(&self) -> &LidarBeams {
        &self.beams
    }

    /// Returns the minimum and maximum range [m].
    #[must_use]
    pub fn range_m(&self) -> [f64; 2] {
        [self.range_min_m, self.range_max_m]
    }

    /// Measures a scan.
    pub fn scan(
        &mut self,
        view: &RayView<'_>,
        sweep: Sweep<'_>,
        stream: &mut Stream,
    ) -> &LidarScan {
        self.aim_rays(sweep);
        self.cast_rays(view);
        self.mark_too_near(view, sweep);
        self.interpolate();
        let (min_m, max_m) = (self.range_min_m, self.range_max_m);
        let silent = self.noise.is_none();
        for range_m in &mut self.scan.ranges_m {
            let seen_m = f64::from(*range_m);
            *range_m = if seen_m >= max_m {
                f32::INFINITY
            } else if seen_m <= min_m {
                f32::NEG_INFINITY
            } else if silent {
                *range_m
            } else {
                single(self.noise.apply_bias_and_noise(seen_m, stream).clamp(min_m, max_m))
            };
        }
        &self.scan
    }

    /// Returns the last scan.
    #[must_use]
    pub fn last(&self) -> &LidarScan {
        &self.scan
    }

    /// Returns the points of the last scan in the sensor's frame [m], in the order of the ranges;
    /// infinite without a hit.
    pub fn points(&self) -> impl Iterator<Item = [f32; 3]> {
        let ranges = &self.scan.ranges_m;
        self.beams.range_directions().zip(ranges).map(|(direction, &range_m)| {
            let range_m = f64::from(range_m);
            direction.to_array().map(|axis| single(axis * range_m))
        })
    }

    /// Resets to the initial state.
    pub fn reset(&mut self) {
        self.noise.reset();
        self.scan = LidarScan::default();
    }

    fn aim_rays(&mut self, sweep: Sweep<'_>) {
        let columns = self.beams.rays[0];
        let ray = |pose: &Pose, direction: DVec3| Ray {
            origin_m: pose.translation,
            direction: pose.rotation * direction,
            min_m: self.range_min_m,
            max_m: self.range_max_m,
        };
        self.rays.clear();
        match sweep {
            Sweep::AtOnce(pose) => {
                self.rays.extend(self.directions.iter().map(|&direction| ray(&pose, direction)));
            }
            Sweep::Moving(_) => {
                #[expect(clippy::cast_precision_loss, reason = "fewer than 2^22")]
                let part = |column: usize| column as f64 / (columns.max(2) - 1) as f64;
                let poses: Vec<Pose> = (0..columns).map(|column| sweep.at(part(column))).collect();
                let aimed = self.directions.iter().enumerate();
                self.rays.extend(
                    aimed.map(|(index, &direction)| ray(&poses[index % columns], direction)),
                );
            }
        }
    }

    fn cast_rays(&mut self, view: &RayView<'_>) {
        let (count, columns) = (self.rays.len(), self.beams.rays[0]);
        self.distances_m.resize(count, f32::INFINITY);
        self.brightness.clear();
        let Some(retro) = view.retro else {
            let out = &mut self.distances_m;
            view.rays.cast_grid(&self.rays, columns, view.filter, view.threads, out);
            self.brightness.resize(count, 0.0);
            return;
        };
        self.hits.resize(count, None);
        view.rays.hits_grid(&self.rays, columns, view.filter, view.threads, &mut self.hits);
        for (distance_m, hit) in self.distances_m.iter_mut().zip(&self.hits) {
            *distance_m = hit.map_or(f32::INFINITY, |hit| single(hit.distance_m));
            self.brightness.push(hit.map_or(0.0, |hit| single(retro(hit.instance))));
        }
    }

    /// Marks rays with another model within the minimum range.
    fn mark_too_near(&mut self, view: &RayView<'_>, sweep: Sweep<'_>) {
        let without_own_model: Filter = view.without_own_model();
        let near = |pose: Pose| {
            view.rays.may_be_near(pose.translation, self.range_min_m, without_own_model)
        };
        let any = match sweep {
            Sweep::AtOnce(pose) => near(pose),
            Sweep::Moving(_) => true,
        };
        if self.range_min_m == 0.0 || !any {
            return;
        }
        for ray in &mut self.rays {
            (ray.min_m, ray.max_m) = (0.0, self.range_min_m);
        }
        self.near_m.resize(self.rays.len(), f32::INFINITY);
        let columns = self.beams.rays[0];
        view.rays.cast_grid(&self.rays, columns, without_own_model, view.threads, &mut self.near_m);
        for (distance_m, near_m) in self.distances_m.iter_mut().zip(&self.near_m) {
            if near_m.is_finite() {
                *distance_m = f32::NEG_INFINITY;
            }
        }
    }

    /// Interpolates ranges from rays.
    fn interpolate(&mut self) {
        let LidarScan { ranges_m, intensities } = &mut self.scan;
        ranges_m.clear();
        intensities.clear();
        match &self.interpolate {
            None => {
                ranges_m.extend_from_slice(&self.distances_m);
                intensities.extend_from_slice(&self.brightness);
            }
            Some(interpolate) => {
                let (min_m, max_m) = (single(self.range_min_m), single(self.range_max_m));
                let within = |distance_m: f32| f64::from(distance_m.clamp(min_m, max_m));
                ranges_m.extend(interpolate.linear(|ray| within(self.distances_m[ray])));
                intensities.extend(interpolate.mean(|ray| f64::from(self.brightness[ray])));
                // Rounding must not produce a finite range without a hit.
                for range_m in ranges_m {
                    if *range_m >= max_m {
                        *range_m = f32::INFINITY;
                    } else if *range_m <= min_m {
                        *range_m = f32::NEG_INFINITY;
                    }
                }
            }
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "messages have single precision")]
fn single(value: f64) -> f32 {
    value as f32
}
