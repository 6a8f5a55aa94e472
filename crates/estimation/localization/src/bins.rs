//! Particles by the bins in which they are: how many are needed, and which belong together.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use periplus_geometry::Pose2;

use crate::particles::{Covariance2, Moments, Particles};

/// Length of a bin along x and y \[m\].
pub const BIN_M: f64 = 0.5;
/// Bins around the circle: one for every 10 degrees.
pub const BINS_AROUND: i64 = 36;
/// Width of a bin of directions \[rad\].
pub const BIN_RAD: f64 = 2.0 * PI / BINS_AROUND as f64;

/// How many particles there should be (Fox 2003, "Adapting the sample size in particle filters through
/// KLD-sampling").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleSize {
    /// By how much the particles may be wrong about the true distribution: `pf_err`.
    pub error: f64,
    /// A quantile of the normal distribution: `pf_z`. Nav2 takes the number as it is, so 0.99 stands
    /// for a probability of 84 %.
    pub quantile: f64,
    /// Never fewer.
    pub least: usize,
    /// Never more.
    pub most: usize,
}

impl SampleSize {
    /// How many are needed when they fill so many bins.
    #[must_use]
    pub fn needed(&self, bins: usize) -> usize {
        if bins <= 1 {
            return self.most;
        }
        let free = (bins - 1) as f64;
        let b = 2.0 / (9.0 * free);
        let x = 1.0 - b + libm::sqrt(b) * self.quantile;
        let needed = libm::ceil(free / (2.0 * self.error) * x * x * x);
        // Casts keep to the range of the type, and what is no number becomes 0.
        (needed as usize).max(self.least).min(self.most)
    }
}

type Bin = (i64, i64, i64);

fn bin_of(pose: Pose2) -> Bin {
    let bin = |value: f64, size: f64| libm::floor(value / size) as i64;
    let around = bin(pose.yaw_rad, BIN_RAD).rem_euclid(BINS_AROUND);
    (bin(pose.x_m, BIN_M), bin(pose.y_m, BIN_M), around)
}

/// Bins that are taken.
#[derive(Debug, Default)]
pub(crate) struct Taken(BTreeSet<Bin>);

impl Taken {
    /// Takes the bin of a pose, and tells how many are taken now.
    pub(crate) fn take(&mut self, pose: Pose2) -> usize {
        self.0.insert(bin_of(pose));
        self.0.len()
    }
}

/// Particles in bins that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cluster {
    /// How much they count together, 0 to 1.
    pub weight: f64,
    /// How many they are.
    pub count: usize,
    /// `map_from_base` on average.
    pub mean: Pose2,
    /// How far they are spread.
    pub covariance: Covariance2,
}

/// Clusters, the heaviest first. Bins touch also across corners, and across half a turn.
pub(crate) fn clusters(particles: &Particles) -> Vec<Cluster> {
    let bins: Vec<Bin> = (0..particles.len()).map(|index| bin_of(particles.pose(index))).collect();
    let mut names: BTreeMap<Bin, usize> = bins.iter().map(|&bin| (bin, usize::MAX)).collect();
    let mut count = 0;
    let mut open = Vec::new();
    for &bin in &bins {
        if names.get(&bin) != Some(&usize::MAX) {
            continue;
        }
        open.push(bin);
        while let Some((x, y, around)) = open.pop() {
            for step in 0..27 {
                let (dx, dy, turn) = (step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1);
                let other = (x + dx, y + dy, (around + turn).rem_euclid(BINS_AROUND));
                if let Some(name) = names.get_mut(&other).filter(|name| **name == usize::MAX) {
                    *name = count;
                    open.push(other);
                }
            }
        }
        count += 1;
    }
    let mut sums: Vec<Option<(Moments, usize)>> = vec![None; count];
    for (index, bin) in bins.iter().enumerate() {
        let pose = particles.pose(index);
        let sum = &mut sums[names[bin]];
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
        let size = SampleSize { error: 0.05, quantile: 0.99, least: 500, most: 2000 };
        assert_eq!(
            [0, 1, 2, 50, 100, 1000].map(|k| size.needed(k)),
            [2000, 2000, 500, 588, 1129, 2000]
        );
    }

    #[test]
    fn particles_that_touch_belong_together_also_across_half_a_turn() {
        let mut particles = Particles::default();
        for pose in [(0.1, 0.1, 3.1), (0.6, 0.1, -3.1), (5.0, 0.0, 0.0)] {
            particles.push(Pose2::new(pose.0, pose.1, pose.2));
        }
        particles.level();
        let clusters = clusters(&particles);
        assert_eq!(clusters.iter().map(|it| it.count).collect::<Vec<_>>(), [2, 1]);
        assert!((clusters[0].mean.x_m - 0.35).abs() < 1e-12, "{clusters:?}");
        assert!((clusters[0].weight - 2.0 / 3.0).abs() < 1e-12);
    }
}
