//! How likely a scan is where a particle is.
//!
//! Source of the formulas: Thrun, Burgard, Fox, "Probabilistic Robotics", chapter 6. That the sum of
//! cubes takes the place of a product in two of the models is as Nav2 and its ancestors have it.

use crate::known_map::{CellState, KnownMap};
use crate::scan::Thinning;

/// What a beam is made of: `z_hit` and so on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixture {
    /// Share of beams that hit what the map has.
    pub hit: f64,
    /// Share that ends early.
    pub short: f64,
    /// Share that sees nothing.
    pub max: f64,
    /// Share that measures anything.
    pub random: f64,
    /// Standard deviation of hits: `sigma_hit` \[m\].
    pub sigma_m: f64,
    /// How quickly early ends become rare: `lambda_short` \[1/m\].
    pub lambda: f64,
}

impl Mixture {
    /// How likely a beam is to measure what it did where the map says something else. The parts are
    /// not scaled to an area of one.
    #[must_use]
    pub fn beam(&self, measured_m: f64, expected_m: f64, range_max_m: f64) -> f64 {
        let beyond_m = measured_m - expected_m;
        let mut p = self.hit * self.bell(beyond_m);
        if beyond_m < 0.0 {
            p += self.short * self.lambda * libm::exp(-self.lambda * measured_m);
        }
        if measured_m >= range_max_m {
            p += self.max;
        } else {
            p += self.random / range_max_m;
        }
        p
    }

    /// How likely a beam is to end so far from what the map has.
    #[must_use]
    pub fn field(&self, distance_m: f64, range_max_m: f64) -> f64 {
        self.hit * self.bell(distance_m) + self.random / range_max_m
    }

    fn bell(&self, distance_m: f64) -> f64 {
        libm::exp(-(distance_m * distance_m) / (2.0 * self.sigma_m * self.sigma_m))
    }
}

/// A particle's weight from how likely each beam is, when beams are not independent: one plus the
/// cubes. It tells good from bad less sharply than a product does.
#[must_use]
pub fn weight_of_cubes(likelihoods: impl IntoIterator<Item = f64>) -> f64 {
    1.0 + likelihoods.into_iter().map(|p| p * p * p).sum::<f64>()
}

/// A particle's weight from how likely each beam is, when beams are independent: their product.
#[must_use]
pub fn weight_of_product(likelihoods: impl IntoIterator<Item = f64>) -> f64 {
    libm::exp(likelihoods.into_iter().map(libm::log).sum())
}

/// Which model tells how likely scans are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// What beams should measure, by lines through the map.
    Beam,
    /// How far from the map's walls beams end, joined by cubes.
    #[default]
    LikelihoodField,
    /// The same, joined as a product; beams that contradict most particles may be skipped.
    LikelihoodFieldProb,
}

impl Model {
    /// How it takes beams from a scan.
    #[must_use]
    pub fn thinning(self) -> Thinning {
        if self == Self::LikelihoodFieldProb { Thinning::Within } else { Thinning::Between }
    }
}

/// When beams are skipped, in [`Model::LikelihoodFieldProb`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamSkip {
    /// A beam agrees with a particle when it ends nearer to a wall \[m\].
    pub distance_m: f64,
    /// A beam is used when it agrees with a larger share of particles.
    pub threshold: f64,
    /// When so large a share would be skipped, all are used.
    pub error_threshold: f64,
}

impl BeamSkip {
    /// Which beams are used, by how many of `particles` each agrees with.
    #[must_use]
    pub fn used(&self, agreeing: &[usize], particles: usize) -> Vec<bool> {
        let share = |count: usize| count as f64 / particles as f64;
        let used: Vec<bool> = agreeing.iter().map(|&it| share(it) > self.threshold).collect();
        let skipped = used.iter().filter(|used| !**used).count();
        if skipped as f64 >= self.error_threshold * agreeing.len() as f64 {
            return vec![true; agreeing.len()];
        }
        used
    }
}

/// What a beam should measure \[m\], as Nav2 reckons it: from cell to cell along a line up to the first that is not free;
/// what is unknown or outside of the map stops it as well.
#[must_use]
pub fn expected_range_m(
    map: &KnownMap,
    (x_m, y_m): (f64, f64),
    bearing_rad: f64,
    range_max_m: f64,
) -> f64 {
    let resolution_m = map.lattice().resolution_m;
    // No line is longer within the map, and outside of it ends.
    let cells = (map.lattice().width + map.lattice().height + 2) as f64;
    let reach_m = range_max_m.min(cells * resolution_m);
    let start = map.cell_at(x_m, y_m);
    if map.state(start) != Some(CellState::Free) {
        return 0.0;
    }
    let (sine, cosine) = libm::sincos(bearing_rad);
    let end = map.cell_at(x_m + reach_m * cosine, y_m + reach_m * sine);
    let (dx, dy) = (end.0 - start.0, end.1 - start.1);
    let is_steep = dy.abs() > dx.abs();
    let (long, short) = if is_steep { (dy.abs(), dx.abs()) } else { (dx.abs(), dy.abs()) };
    let (mut x, mut y, mut error) = (start.0, start.1, 0);
    for _ in 0..=long {
        error += short;
        let steps_aside = 2 * error >= long;
        if steps_aside {
            error -= long;
        }
        if !is_steep || steps_aside {
            x += dx.signum();
        }
        if is_steep || steps_aside {
            y += dy.signum();
        }
        if map.state((x, y)) != Some(CellState::Free) {
            let (dx, dy) = ((x - start.0) as f64, (y - start.1) as f64);
            return resolution_m * libm::hypot(dx, dy);
        }
    }
    range_max_m
}
