//! KLD-sampling and clustering of particles, on bins of x, y and yaw.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use periplus_geometry::Pose2;

use crate::particles::{Covariance2, Moments, Particles};

/// Size of a bin along x and y \[m\], as in Nav2.
pub const BIN_M: f64 = 0.5;
/// Number of yaw bins: one per 10 degrees, as in Nav2.
pub const YAW_BIN_COUNT: i64 = 36;
/// Size of a yaw bin \[rad\].
pub const BIN_RAD: f64 = 2.0 * PI / YAW_BIN_COUNT as f64;

/// KLD-sampling: the number of particles for a given error bound (Fox 2003, "Adapting the sample
/// size in particle filters through KLD-sampling"; *Probabilistic Robotics*, table 8.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KldSampling {
    /// Bound on the Kullback-Leibler distance to the true distribution: `pf_err`.
    pub max_error: f64,
    /// Quantile of the standard normal distribution: `pf_z`. Nav2 uses the value as is: 0.99 corresponds
    /// to a probability of 84 %.
    pub quantile: f64,
    /// Minimum number of particles: `min_particles`.
    pub min_particles: usize,
    /// Maximum number of particles: `max_particles`.
    pub max_particles: usize,
}

impl KldSampling {
    /// Number of particles for a number of occupied bins (*Probabilistic Robotics*, table 8.4, line
    /// 16).
    #[must_use]
    pub fn particle_count(&self, bin_count: usize) -> usize {
        if bin_count <= 1 {
            return self.max_particles;
        }
        let k = (bin_count - 1) as f64;
        let b = 2.0 / (9.0 * k);
        let x = 1.0 - b + libm::sqrt(b) * self.quantile;
        let count = libm::ceil(k / (2.0 * self.max_error) * x * x * x);
        // Casts saturate, and NaN becomes 0.
        (count as usize).max(self.min_particles).min(self.max_particles)
    }
}

type Bin = (i64, i64, i64);

fn bin_of(pose: Pose2) -> Bin {
    let bin = |value: f64, size: f64| libm::floor(value / size) as i64;
    let yaw_bin = bin(pose.yaw_rad, BIN_RAD).rem_euclid(YAW_BIN_COUNT);
    (bin(pose.x_m, BIN_M), bin(pose.y_m, BIN_M), yaw_bin)
}

/// Set of occupied bins.
#[derive(Debug, Default)]
pub(crate) struct OccupiedBins(BTreeSet<Bin>);

impl OccupiedBins {
    /// Inserts the bin of a pose and returns the number of occupied bins.
    pub(crate) fn insert(&mut self, pose: Pose2) -> usize {
        self.0.insert(bin_of(pose));
        self.0.len()
    }
}

/// Particles in adjacent bins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cluster {
    /// Total weight, 0 to 1.
    pub weight: f64,
    /// Number of particles.
    pub count: usize,
    /// Mean of `map_from_base`.
    pub mean: Pose2,
    /// Covariance of the particles yaw_bin the mean.
    pub covariance: Covariance2,
}

/// Clusters in order of decreasing weight. Bins are adjacent across faces, edges and corners, and
/// across ±180 degrees.
pub(crate) fn clusters(particles: &Particles) -> Vec<Cluster> {
    let bins: Vec<Bin> = (0..particles.len()).map(|index| bin_of(particles.pose(index))).collect();
    let mut labels: BTreeMap<Bin, usize> = bins.iter().map(|&bin| (bin, usize::MAX)).collect();
    let mut count = 0;
    let mut open = Vec::new();
    for &bin in &bins {
        if labels.get(&bin) != Some(&usize::MAX) {
            continue;
        }
        open.push(bin);
        while let Some((x, y, yaw_bin)) = open.pop() {
            for step in 0..27 {
                let (dx, dy, turn) = (step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1);
                let other = (x + dx, y + dy, (yaw_bin + turn).rem_euclid(YAW_BIN_COUNT));
                if let Some(label) = labels.get_mut(&other).filter(|label| **label == usize::MAX) {
                    *label = count;
                    open.push(other);
                }
            }
        }
        count += 1;
    }
    let mut sums: Vec<Option<(Moments, usize)>> = vec![None; count];
    for (index, bin) in bins.iter().enumerate() {
        let pose = particles.pose(index);
        let sum = &mut sums[labels[bin]];
        let (moments, count) = sum.get_or_insert_with(|| (Moments::around(pose), 0));
        moments.add(pose, particles.weight[index]);
        *count += 1;
    }
    let mut clusters: Vec<Cluster> = sums
        .iter()
        .flatten()
        .map(|(moments, count)| Cluster {
            weight: moments.weight,
            count: *count,
            mean: moments.mean(),
            covariance: moments.covariance(),
        })
        .collect();
    clusters.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    clusters
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_bins_need_more_particles() {
        let sampling = KldSampling {
            max_error: 0.05,
            quantile: 0.99,
            min_particles: 500,
            max_particles: 2000,
        };
        assert_eq!(
            [0, 1, 2, 50, 100, 1000].map(|k| sampling.particle_count(k)),
            [2000, 2000, 500, 588, 1129, 2000]
        );
    }

    #[test]
    fn adjacent_particles_form_a_cluster_also_across_180_degrees() {
        let mut particles = Particles::default();
        for pose in [(0.1, 0.1, 3.1), (0.6, 0.1, -3.1), (5.0, 0.0, 0.0)] {
            particles.push(Pose2::new(pose.0, pose.1, pose.2));
        }
        particles.set_uniform_weights();
        let clusters = clusters(&particles);
        assert_eq!(clusters.iter().map(|it| it.count).collect::<Vec<_>>(), [2, 1]);
        assert!((clusters[0].mean.x_m - 0.35).abs() < 1e-12, "{clusters:?}");
        assert!((clusters[0].weight - 2.0 / 3.0).abs() < 1e-12);
    }
}
