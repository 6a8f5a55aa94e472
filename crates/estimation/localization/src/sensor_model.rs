//! Sensor models: the likelihood of a scan at a particle.
//!
//! Source of the formulas: Thrun, Burgard, Fox, *Probabilistic Robotics*, chapter 6. Two models sum
//! cubed likelihoods in place of a product, as Nav2 does.

mod ray_casting;
pub(crate) mod tables;

use periplus_params::param_choice;

use crate::likelihood_map::{CellState, LikelihoodMap};
use crate::scan::BeamStep;

/// BeamMixture of the beam model (*Probabilistic Robotics*, section 6.3.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamMixture {
    /// Weight of measurements of mapped obstacles: `z_hit`.
    pub hit: f64,
    /// Weight of measurements of unmapped obstacles in front of mapped ones: `z_short`.
    pub short: f64,
    /// Weight of maximum range readings: `z_max`.
    pub max: f64,
    /// Weight of random measurements: `z_rand`.
    pub random: f64,
    /// Standard deviation of hits: `sigma_hit` \[m\].
    pub sigma_hit_m: f64,
    /// Decay rate of short readings: `lambda_short` \[1/m\].
    pub lambda_short_per_m: f64,
}

impl BeamMixture {
    /// Beam model: likelihood of a measured range given the expected range (*Probabilistic
    /// Robotics*, equation 6.12). The parts are not normalized.
    #[must_use]
    pub fn beam_range(&self, measured_m: f64, expected_m: f64, range_max_m: f64) -> f64 {
        let error_m = measured_m - expected_m;
        let mut p = self.hit * self.gaussian(error_m);
        if error_m < 0.0 {
            p += self.short
                * self.lambda_short_per_m
                * libm::exp(-self.lambda_short_per_m * measured_m);
        }
        if measured_m >= range_max_m {
            p += self.max;
        } else {
            p += self.random / range_max_m;
        }
        p
    }

    /// Likelihood field model: likelihood of a beam that ends at a distance from the nearest
    /// obstacle (*Probabilistic Robotics*, table 6.3).
    #[must_use]
    pub fn likelihood_field(&self, distance_m: f64, range_max_m: f64) -> f64 {
        self.hit * self.gaussian(distance_m) + self.random / range_max_m
    }

    fn gaussian(&self, distance_m: f64) -> f64 {
        libm::exp(-(distance_m * distance_m) / (2.0 * self.sigma_hit_m * self.sigma_hit_m))
    }
}

/// Particle weight from the likelihoods of beams that are not independent: one plus the sum of
/// cubes. Weights differ less than with a product.
#[must_use]
pub fn sum_of_cubes_weight(likelihoods: impl IntoIterator<Item = f64>) -> f64 {
    1.0 + likelihoods.into_iter().map(|p| p * p * p).sum::<f64>()
}

/// Particle weight from the likelihoods of independent beams: their product.
#[must_use]
pub fn product_weight(likelihoods: impl IntoIterator<Item = f64>) -> f64 {
    libm::exp(likelihoods.into_iter().map(libm::log).sum())
}

param_choice! {
    /// Sensor model: `laser_model_type`.
    pub enum SensorModel {
        /// Likelihood field with summed cubes (*Probabilistic Robotics*, table 6.3).
        #[default]
        LikelihoodField = "likelihood_field",
        /// Beam model: expected ranges by ray casting (*Probabilistic Robotics*, table 6.1).
        Beam = "beam",
        /// Likelihood field with a product of likelihoods and optional beam skipping.
        LikelihoodFieldProb = "likelihood_field_prob",
    }
}

impl SensorModel {
    /// Selection of beams, as in the Nav2 model.
    #[must_use]
    pub fn beam_step(self) -> BeamStep {
        if self == Self::LikelihoodFieldProb { BeamStep::RoundedUp } else { BeamStep::RoundedDown }
    }
}

/// Beam skipping of [`SensorModel::LikelihoodFieldProb`]: beams that disagree with most particles
/// are not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamSkip {
    /// Maximum distance between a beam end and a wall for inlier_ratios: `beam_skip_distance` \[m\].
    pub distance_m: f64,
    /// Minimum fraction of particles that agree with a used beam: `beam_skip_threshold`.
    pub threshold: f64,
    /// Fraction of skipped beams from which on all beams are used: `beam_skip_error_threshold`.
    pub error_threshold: f64,
}

impl BeamSkip {
    /// Selects the beams to use from the number of particles that agree with each.
    #[must_use]
    pub fn used(&self, agreement_counts: &[usize], particle_count: usize) -> Vec<bool> {
        let fraction = |count: usize| count as f64 / particle_count as f64;
        let used: Vec<bool> =
            agreement_counts.iter().map(|&it| fraction(it) > self.threshold).collect();
        let skipped = used.iter().filter(|used| !**used).count();
        if skipped as f64 >= self.error_threshold * agreement_counts.len() as f64 {
            return vec![true; agreement_counts.len()];
        }
        used
    }
}

/// Casts a ray as Nav2 does: along a Bresenham line to the first cell that is not free. Unknown
/// cells and the border of the map block the ray. Returns the range \[m\].
#[must_use]
pub fn expected_range_m(
    map: &LikelihoodMap,
    (x_m, y_m): (f64, f64),
    bearing_rad: f64,
    range_max_m: f64,
) -> f64 {
    let resolution_m = map.info().resolution_m;
    // No line within the map is longer.
    let cells = (map.info().width + map.info().height + 2) as f64;
    let line_max_m = range_max_m.min(cells * resolution_m);
    let start = map.cell_at(x_m, y_m);
    if map.state(start) != Some(CellState::Free) {
        return 0.0;
    }
    let (sine, cosine) = libm::sincos(bearing_rad);
    let end = map.cell_at(x_m + line_max_m * cosine, y_m + line_max_m * sine);
    let (dx, dy) = (end.0 - start.0, end.1 - start.1);
    let is_steep = dy.abs() > dx.abs();
    let (long, short) = if is_steep { (dy.abs(), dx.abs()) } else { (dx.abs(), dy.abs()) };
    let (mut x, mut y, mut error) = (start.0, start.1, 0);
    for _ in 0..=long {
        error += short;
        let is_minor_step = 2 * error >= long;
        if is_minor_step {
            error -= long;
        }
        if !is_steep || is_minor_step {
            x += dx.signum();
        }
        if is_steep || is_minor_step {
            y += dy.signum();
        }
        if map.state((x, y)) != Some(CellState::Free) {
            let (dx, dy) = ((x - start.0) as f64, (y - start.1) as f64);
            return resolution_m * libm::hypot(dx, dy);
        }
    }
    range_max_m
}
