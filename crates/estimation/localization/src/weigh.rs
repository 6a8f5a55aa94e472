//! How likely a scan is at every particle, fast.

use crate::known_map::KnownMap;
use crate::models::{BeamSkip, Mixture, Model, expected_range_m, weight_of_cubes};
use crate::particles::Particles;
use crate::ranges::Ranges;
use crate::scan::Beams;
use crate::settings::Compat;

/// So many beams are placed at once.
const LANES: usize = 8;

/// What depends on the map, the mixture and the longest range, computed once.
#[derive(Clone, Debug)]
pub(crate) struct Terms {
    key: (Model, Mixture, f64, Compat),
    field: Field,
    /// What stops beams; only where beams are followed.
    ranges: Option<Ranges>,
}

/// What every particle gets from a scan.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Said {
    /// Likelihoods, all divided by the same.
    pub(crate) factors: Vec<f64>,
    /// Natural logarithm of that by which they were divided.
    pub(crate) scale: f64,
}

impl Terms {
    pub(crate) fn new(
        map: &KnownMap,
        model: Model,
        mixture: &Mixture,
        range_max_m: f64,
        compat: Compat,
    ) -> Self {
        let term = |distance_m: f64| {
            let p = mixture.field(distance_m, range_max_m);
            if model == Model::LikelihoodFieldProb {
                libm::log(p) as f32
            } else {
                (p * p * p) as f32
            }
        };
        let follows_beams = model == Model::Beam && compat == Compat::None;
        Self {
            key: (model, *mixture, range_max_m, compat),
            field: Field::new(map, term),
            ranges: follows_beams.then(|| Ranges::new(map)),
        }
    }

    pub(crate) fn is_for(
        &self,
        model: Model,
        mixture: &Mixture,
        range_max_m: f64,
        compat: Compat,
    ) -> bool {
        self.key == (model, *mixture, range_max_m, compat)
    }

    /// What every particle gets from a scan.
    pub(crate) fn weigh(
        &self,
        map: &KnownMap,
        skip: Option<BeamSkip>,
        beams: &Beams,
        particles: &Particles,
    ) -> Said {
        let plain = |factors: Vec<f64>| Said { factors, scale: 0.0 };
        match self.key.0 {
            Model::Beam => plain(self.weigh_beams(map, beams, particles)),
            Model::LikelihoodField => {
                let sums = self.field.sums(map, &Ends::new(&beams.ends()), particles);
                plain(sums.into_iter().map(|sum| 1.0 + f64::from(sum)).collect())
            }
            Model::LikelihoodFieldProb => {
                let mut ends = beams.ends();
                if let Some(skip) = skip {
                    let agreeing = self.agreeing(map, skip.distance_m, &ends, particles);
                    let mut used = skip.used(&agreeing, particles.len()).into_iter();
                    ends.retain(|_| used.next() == Some(true));
                }
                exponentials(&self.field.sums(map, &Ends::new(&ends), particles))
            }
        }
    }

    /// With how many particles each end agrees.
    fn agreeing(
        &self,
        map: &KnownMap,
        distance_m: f64,
        ends: &[[f32; 2]],
        particles: &Particles,
    ) -> Vec<usize> {
        let near = Field::new(map, |distance| f32::from(u8::from(distance < distance_m)));
        let count = |end: &[f32; 2]| {
            let sums = near.sums(map, &Ends::new(std::slice::from_ref(end)), particles);
            sums.iter().filter(|sum| **sum > 0.5).count()
        };
        ends.iter().map(count).collect()
    }

    fn weigh_beams(&self, map: &KnownMap, beams: &Beams, particles: &Particles) -> Vec<f64> {
        let (_, mixture, range_max_m, _) = &self.key;
        let weight = |index: usize| {
            let map_from_base = particles.pose(index);
            let map_from_laser = map_from_base * beams.base_from_laser;
            let start = (map_from_laser.x_m, map_from_laser.y_m);
            let likelihoods = beams.beams.iter().map(|beam| {
                let bearing = map_from_base.yaw_rad + beam.bearing_rad;
                let expected_m = match &self.ranges {
                    Some(ranges) => ranges.range_m(start, bearing, *range_max_m),
                    None => expected_range_m(map, start, bearing, *range_max_m),
                };
                mixture.beam(beam.range_m, expected_m, *range_max_m)
            });
            weight_of_cubes(likelihoods)
        };
        (0..particles.len()).map(weight).collect()
    }
}

/// Exponentials of logarithms, the largest of them one.
fn exponentials(logs: &[f32]) -> Said {
    let most = logs.iter().copied().filter(|log| !log.is_nan()).fold(f32::NEG_INFINITY, f32::max);
    if most == f32::NEG_INFINITY {
        return Said { factors: vec![0.0; logs.len()], scale: 0.0 };
    }
    let factor = |log: &f32| {
        let log = f64::from(log - most);
        if log.is_nan() { 0.0 } else { libm::exp(log) }
    };
    Said { factors: logs.iter().map(factor).collect(), scale: most.into() }
}

/// Where beams end, in the frame of the base \[m\].
struct Ends {
    x: Vec<f32>,
    y: Vec<f32>,
}

impl Ends {
    fn new(ends: &[[f32; 2]]) -> Self {
        Self {
            x: ends.iter().map(|end| end[0]).collect(),
            y: ends.iter().map(|end| end[1]).collect(),
        }
    }
}

/// A number for every cell, with a rim for all that is outside, in rows of a power of two, so that
/// nothing has to be asked on the way to a cell.
#[derive(Clone, Debug)]
struct Field {
    cells: Vec<f32>,
    shift: u32,
    /// The last column and row, of the rim.
    last: [f32; 2],
}

impl Field {
    /// Of distances to walls \[m\].
    fn new(map: &KnownMap, of: impl Fn(f64) -> f32) -> Self {
        let (width, height) = (map.lattice().width, map.lattice().height);
        let shift = (width + 2).next_power_of_two().trailing_zeros();
        let outside = of(map.most_m());
        let most = map.most_m() as f32;
        let mut cells = vec![outside; (height + 2) << shift];
        for (row, distances) in map.distances_m().chunks_exact(width).enumerate() {
            let begin = ((row + 1) << shift) + 1;
            for (cell, &distance) in cells[begin..begin + width].iter_mut().zip(distances) {
                // Most cells are far from walls.
                *cell = if distance == most { outside } else { of(distance.into()) };
            }
        }
        Self { cells, shift, last: [(width + 1) as f32, (height + 1) as f32] }
    }

    /// For every particle the sum over beams.
    fn sums(&self, map: &KnownMap, ends: &Ends, particles: &Particles) -> Vec<f32> {
        let finder = map.finder();
        let sum = |index: usize| {
            let (u, v) = finder.cells_to(particles.x_m[index], particles.y_m[index]);
            let (c, s) = finder.heading_f32(particles.yaw_rad[index]);
            self.sum(ends, [u as f32 + 1.0, v as f32 + 1.0], [c, s])
        };
        (0..particles.len()).map(sum).collect()
    }

    /// Always in the same order: each lane on its own, and then the lanes.
    fn sum(&self, ends: &Ends, [u, v]: [f32; 2], [c, s]: [f32; 2]) -> f32 {
        let mut sums = [0.0_f32; LANES];
        let (xs, ys) = (ends.x.chunks_exact(LANES), ends.y.chunks_exact(LANES));
        let rest = xs.remainder().iter().zip(ys.remainder());
        for (x, y) in xs.zip(ys) {
            let mut places = [0_u32; LANES];
            for lane in 0..LANES {
                places[lane] =
                    self.place(u + c * x[lane] - s * y[lane], v + s * x[lane] + c * y[lane]);
            }
            for lane in 0..LANES {
                sums[lane] += self.cells[places[lane] as usize];
            }
        }
        for (sum, (x, y)) in sums.iter_mut().zip(rest) {
            let place = self.place(u + c * x - s * y, v + s * x + c * y);
            *sum += self.cells[place as usize];
        }
        let [a, b, c, d, e, f, g, h] = sums;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }

    /// The place of a cell, given with parts of cells; on the rim for all that is outside or no
    /// number.
    #[inline]
    fn place(&self, column: f32, row: f32) -> u32 {
        let clamped = |value: f32, last: f32| {
            let value = if value > 0.0 { value } else { 0.0 };
            if value < last { value } else { last }
        };
        let column = clamped(column, self.last[0]) as i32;
        let row = clamped(row, self.last[1]) as i32;
        ((row << self.shift) + column) as u32
    }
}
