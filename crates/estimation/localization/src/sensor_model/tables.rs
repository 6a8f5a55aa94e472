//! Vectorized evaluation of the sensor models at all particles.

use crate::likelihood_map::LikelihoodMap;
use crate::parameters::AmclCompat;
use crate::particles::Particles;
use crate::scan::Beams;
use crate::sensor_model::ray_casting::RayCaster;
use crate::sensor_model::{
    BeamMixture, BeamSkip, SensorModel, expected_range_m, sum_of_cubes_weight,
};

/// Number of beams per SIMD batch.
const LANES: usize = 8;

/// Tables of a sensor model for one map, mixture and maximum range.
#[derive(Clone, Debug)]
pub(crate) struct SensorTables {
    key: (SensorModel, BeamMixture, f64, AmclCompat),
    table: LookupTable,
    /// Ray casting; only for the beam model.
    ray_caster: Option<RayCaster>,
}

/// Likelihoods of a scan at all particles.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ScanLikelihoods {
    /// Likelihoods up to a common factor.
    pub(crate) likelihoods: Vec<f64>,
    /// Natural logarithm of the common factor.
    pub(crate) log_factor: f64,
}

impl SensorTables {
    pub(crate) fn new(
        map: &LikelihoodMap,
        model: SensorModel,
        mixture: &BeamMixture,
        range_max_m: f64,
        compat: AmclCompat,
    ) -> Self {
        let term = |distance_m: f64| {
            let p = mixture.likelihood_field(distance_m, range_max_m);
            if model == SensorModel::LikelihoodFieldProb {
                libm::log(p) as f32
            } else {
                (p * p * p) as f32
            }
        };
        let casts_rays = model == SensorModel::Beam && compat == AmclCompat::None;
        Self {
            key: (model, *mixture, range_max_m, compat),
            table: LookupTable::new(map, term),
            ray_caster: casts_rays.then(|| RayCaster::new(map)),
        }
    }

    pub(crate) fn is_for(
        &self,
        model: SensorModel,
        mixture: &BeamMixture,
        range_max_m: f64,
        compat: AmclCompat,
    ) -> bool {
        self.key == (model, *mixture, range_max_m, compat)
    }

    /// Evaluates the sensor model at all particles.
    pub(crate) fn evaluate(
        &self,
        map: &LikelihoodMap,
        beam_skip: Option<BeamSkip>,
        beams: &Beams,
        particles: &Particles,
    ) -> ScanLikelihoods {
        let unscaled = |likelihoods: Vec<f64>| ScanLikelihoods { likelihoods, log_factor: 0.0 };
        match self.key.0 {
            SensorModel::Beam => unscaled(self.beam_likelihoods(map, beams, particles)),
            SensorModel::LikelihoodField => {
                let sums = self.table.sums(map, &BeamEnds::new(&beams.ends()), particles);
                unscaled(sums.into_iter().map(|sum| 1.0 + f64::from(sum)).collect())
            }
            SensorModel::LikelihoodFieldProb => {
                let mut ends = beams.ends();
                if let Some(skip) = beam_skip {
                    let agreement_counts =
                        self.agreement_counts(map, skip.distance_m, &ends, particles);
                    let mut used = skip.used(&agreement_counts, particles.len()).into_iter();
                    ends.retain(|_| used.next() == Some(true));
                }
                exponentials(&self.table.sums(map, &BeamEnds::new(&ends), particles))
            }
        }
    }

    /// Number of particles that agree with each beam end.
    fn agreement_counts(
        &self,
        map: &LikelihoodMap,
        distance_m: f64,
        ends: &[[f32; 2]],
        particles: &Particles,
    ) -> Vec<usize> {
        let agreement =
            LookupTable::new(map, |distance| f32::from(u8::from(distance < distance_m)));
        let count = |end: &[f32; 2]| {
            let sums = agreement.sums(map, &BeamEnds::new(std::slice::from_ref(end)), particles);
            sums.iter().filter(|sum| **sum > 0.5).count()
        };
        ends.iter().map(count).collect()
    }

    fn beam_likelihoods(
        &self,
        map: &LikelihoodMap,
        beams: &Beams,
        particles: &Particles,
    ) -> Vec<f64> {
        let (_, mixture, range_max_m, _) = &self.key;
        let weight = |index: usize| {
            let map_from_base = particles.pose(index);
            let map_from_laser = map_from_base * beams.base_from_scanner;
            let start = (map_from_laser.x_m, map_from_laser.y_m);
            let beam_likelihoods = beams.beams.iter().map(|beam| {
                let bearing = map_from_base.yaw_rad + beam.bearing_rad;
                let expected_m = match &self.ray_caster {
                    Some(caster) => caster.cast_m(start, bearing, *range_max_m),
                    None => expected_range_m(map, start, bearing, *range_max_m),
                };
                mixture.beam_range(beam.range_m, expected_m, *range_max_m)
            });
            sum_of_cubes_weight(beam_likelihoods)
        };
        (0..particles.len()).map(weight).collect()
    }
}

/// Exponentials of log-likelihoods, scaled to a maximum of one.
fn exponentials(logs: &[f32]) -> ScanLikelihoods {
    let max = logs.iter().copied().filter(|log| !log.is_nan()).fold(f32::NEG_INFINITY, f32::max);
    if max == f32::NEG_INFINITY {
        return ScanLikelihoods { likelihoods: vec![0.0; logs.len()], log_factor: 0.0 };
    }
    let factor = |log: &f32| {
        let log = f64::from(log - max);
        if log.is_nan() { 0.0 } else { libm::exp(log) }
    };
    ScanLikelihoods { likelihoods: logs.iter().map(factor).collect(), log_factor: max.into() }
}

/// Beam end points in the base frame \[m\].
struct BeamEnds {
    x: Vec<f32>,
    y: Vec<f32>,
}

impl BeamEnds {
    fn new(ends: &[[f32; 2]]) -> Self {
        Self {
            x: ends.iter().map(|end| end[0]).collect(),
            y: ends.iter().map(|end| end[1]).collect(),
        }
    }
}

/// Lookup table with a border for all points outside of the map, in rows of a power of two, so that
/// a lookup needs no branch.
#[derive(Clone, Debug)]
struct LookupTable {
    cells: Vec<f32>,
    shift: u32,
    /// Last column and row, on the border.
    last: [f32; 2],
}

impl LookupTable {
    /// Maps the distances of a likelihood map \[m\] through a function.
    fn new(map: &LikelihoodMap, value: impl Fn(f64) -> f32) -> Self {
        let (width, height) = (map.info().width, map.info().height);
        let shift = (width + 2).next_power_of_two().trailing_zeros();
        let outside = value(map.distance_max_m());
        let max = map.distance_max_m() as f32;
        let mut cells = vec![outside; (height + 2) << shift];
        for (row, distances) in map.distances_m().chunks_exact(width).enumerate() {
            let begin = ((row + 1) << shift) + 1;
            for (cell, &distance) in cells[begin..begin + width].iter_mut().zip(distances) {
                // Most cells are far from walls.
                *cell = if distance == max { outside } else { value(distance.into()) };
            }
        }
        Self { cells, shift, last: [(width + 1) as f32, (height + 1) as f32] }
    }

    /// Sum over beam ends for every particle.
    fn sums(&self, map: &LikelihoodMap, ends: &BeamEnds, particles: &Particles) -> Vec<f32> {
        let cell_transform = map.cell_transform();
        let sum = |index: usize| {
            let (u, v) = cell_transform.map_to_cells(particles.x_m[index], particles.y_m[index]);
            let (c, s) = cell_transform.direction_f32(particles.yaw_rad[index]);
            self.sum(ends, [u as f32 + 1.0, v as f32 + 1.0], [c, s])
        };
        (0..particles.len()).map(sum).collect()
    }

    /// Sums in a fixed order: each lane first, then the lanes.
    fn sum(&self, ends: &BeamEnds, [u, v]: [f32; 2], [c, s]: [f32; 2]) -> f32 {
        let mut sums = [0.0_f32; LANES];
        let (xs, ys) = (ends.x.chunks_exact(LANES), ends.y.chunks_exact(LANES));
        let rest = xs.remainder().iter().zip(ys.remainder());
        for (x, y) in xs.zip(ys) {
            let mut indices = [0_u32; LANES];
            for lane in 0..LANES {
                indices[lane] =
                    self.index(u + c * x[lane] - s * y[lane], v + s * x[lane] + c * y[lane]);
            }
            for lane in 0..LANES {
                sums[lane] += self.cells[indices[lane] as usize];
            }
        }
        for (sum, (x, y)) in sums.iter_mut().zip(rest) {
            let index = self.index(u + c * x - s * y, v + s * x + c * y);
            *sum += self.cells[index as usize];
        }
        let [a, b, c, d, e, f, g, h] = sums;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }

    /// Index of the cell at fractional coordinates; on the border for points outside and NaN.
    #[inline]
    fn index(&self, column: f32, row: f32) -> u32 {
        let clamped = |value: f32, last: f32| {
            let value = if value > 0.0 { value } else { 0.0 };
            if value < last { value } else { last }
        };
        let column = clamped(column, self.last[0]) as i32;
        let row = clamped(row, self.last[1]) as i32;
        ((row << self.shift) + column) as u32
    }
}
