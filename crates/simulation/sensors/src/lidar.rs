//! Lidars: distances along a fan or a grid of rays.

mod beams;
mod blend;

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose, Stream};
use periplus_raycast::{Filter, Hit, Ray};

pub use beams::Beams;

use self::blend::Blend;
use crate::{NoiseModel, Streams, Sweep, View};

/// The most rays, and the most ranges, of one lidar: sixteen times 128 rows of 2048. More is taken
/// for a slip of the pen.
pub const MOST_BEAMS: usize = 1 << 22;

/// What a lidar measures, row after row from the lowest, each from the first angle to the last.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scan {
    /// Distances [m]; `-inf` too near, `inf` nothing there (REP 117).
    pub ranges_m: Vec<f32>,
    /// Brightness of what was met: its `laser_retro`.
    pub intensities: Vec<f32>,
}

/// A lidar of any spelling: `ray`, `gpu_ray`, `lidar`, `gpu_lidar`.
///
/// Rays look from the least range on, so that the housing around a lidar, which is nearer, is not
/// seen; parts of its own model that are farther are. Something of another model nearer than that is
/// told as too near. `<range><resolution>` is not applied, as in Gazebo.
#[derive(Clone, Debug)]
pub struct Lidar {
    beams: Beams,
    range_min_m: f64,
    range_max_m: f64,
    noise: NoiseModel,
    /// How ranges come from rays, where there are not as many.
    blend: Option<Blend>,
    /// Directions of the rays in the sensor's frame.
    directions: Vec<DVec3>,
    rays: Vec<Ray>,
    distances_m: Vec<f32>,
    hits: Vec<Option<Hit>>,
    near_m: Vec<f32>,
    brightness: Vec<f32>,
    scan: Scan,
}

impl Lidar {
    /// A lidar as a file describes it.
    ///
    /// # Errors
    /// When it cannot measure anything: no beams or too many, angles or ranges that are no numbers,
    /// no room between the least and the greatest range.
    pub fn new(spec: &periplus_scene::Lidar, streams: &Streams) -> Result<Self, Box<Diagnostic>> {
        let beams = Beams::new(spec)?;
        let (min_m, max_m) = (spec.range_min_m, spec.range_max_m);
        if !(min_m >= 0.0 && min_m.is_finite() && max_m > min_m) {
            return Err(Diagnostic::error(
                "out-of-range",
                format!("a lidar with ranges from {min_m} m to {max_m} m sees nothing"),
            )
            .help("write `<range><min>` at 0 or above, and `<max>` above it")
            .into());
        }
        let directions = beams.directions();
        Ok(Self {
            blend: Blend::new(&beams),
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
            scan: Scan::default(),
        })
    }

    /// Angles and counts.
    #[must_use]
    pub fn beams(&self) -> &Beams {
        &self.beams
    }

    /// Nearest and farthest [m].
    #[must_use]
    pub fn range_m(&self) -> [f64; 2] {
        [self.range_min_m, self.range_max_m]
    }

    /// Measures.
    pub fn scan(&mut self, view: &View<'_>, sweep: Sweep<'_>, stream: &mut Stream) -> &Scan {
        self.aim(sweep);
        self.look(view);
        self.drop_too_near(view, sweep);
        self.blend();
        let (min_m, max_m) = (self.range_min_m, self.range_max_m);
        let silent = self.noise.is_silent();
        for range_m in &mut self.scan.ranges_m {
            let seen_m = f64::from(*range_m);
            *range_m = if seen_m >= max_m {
                f32::INFINITY
            } else if seen_m <= min_m {
                f32::NEG_INFINITY
            } else if silent {
                *range_m
            } else {
                single(self.noise.spoil(seen_m, stream).clamp(min_m, max_m))
            };
        }
        &self.scan
    }

    /// The last scan.
    #[must_use]
    pub fn last(&self) -> &Scan {
        &self.scan
    }

    /// Points of the last scan in the sensor's frame [m], in the order of the ranges; infinite and
    /// unlike any point where nothing was met.
    pub fn points(&self) -> impl Iterator<Item = [f32; 3]> {
        let ranges = &self.scan.ranges_m;
        self.beams.range_directions().zip(ranges).map(|(direction, &range_m)| {
            let range_m = f64::from(range_m);
            direction.to_array().map(|axis| single(axis * range_m))
        })
    }

    /// Back to the start.
    pub fn reset(&mut self) {
        self.noise.reset();
        self.scan = Scan::default();
    }

    fn aim(&mut self, sweep: Sweep<'_>) {
        let columns = self.beams.rays[0];
        let ray = |pose: &Pose, direction: DVec3| Ray {
            origin_m: pose.translation,
            direction: pose.rotation * direction,
            min_m: self.range_min_m,
            max_m: self.range_max_m,
        };
        self.rays.clear();
        match sweep {
            Sweep::Still(pose) => {
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

    fn look(&mut self, view: &View<'_>) {
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

    /// Marks rays on which something of another model is nearer than the least range.
    fn drop_too_near(&mut self, view: &View<'_>, sweep: Sweep<'_>) {
        let others: Filter = view.others();
        let near = |pose: Pose| view.rays.may_be_near(pose.translation, self.range_min_m, others);
        let any = match sweep {
            Sweep::Still(pose) => near(pose),
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
        view.rays.cast_grid(&self.rays, columns, others, view.threads, &mut self.near_m);
        for (distance_m, near_m) in self.distances_m.iter_mut().zip(&self.near_m) {
            if near_m.is_finite() {
                *distance_m = f32::NEG_INFINITY;
            }
        }
    }

    /// From rays to ranges.
    fn blend(&mut self) {
        let Scan { ranges_m, intensities } = &mut self.scan;
        ranges_m.clear();
        intensities.clear();
        match &self.blend {
            None => {
                ranges_m.extend_from_slice(&self.distances_m);
                intensities.extend_from_slice(&self.brightness);
            }
            Some(blend) => {
                let (min_m, max_m) = (single(self.range_min_m), single(self.range_max_m));
                let within = |distance_m: f32| f64::from(distance_m.clamp(min_m, max_m));
                ranges_m.extend(blend.linear(|ray| within(self.distances_m[ray])));
                intensities.extend(blend.mean(|ray| f64::from(self.brightness[ray])));
                // Rounding must not make a range of what saw nothing.
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
