//! Resampling of particles.

use periplus_geometry::Stream;

/// Weights that add up to 1, from logarithms; the largest is never lost to rounding.
pub(super) fn weights(logarithms: &[f64], gain: f64) -> Vec<f64> {
    let most = logarithms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut weights: Vec<f64> = logarithms.iter().map(|it| libm::exp((it - most) / gain)).collect();
    let sum: f64 = weights.iter().sum();
    for weight in &mut weights {
        *weight /= sum;
    }
    weights
}

/// Effective sample size: all if the weights are equal, one if one particle has all the weight.
///
/// Grisetti, Stachniss, Burgard 2007, equation (18), after Liu 1996 and Doucet.
pub(super) fn effective(weights: &[f64]) -> f64 {
    1.0 / weights.iter().map(|it| it * it).sum::<f64>()
}

/// Returns the ancestor of each new particle, in order (low variance sampler; Thrun, Burgard, Fox 2005,
/// "Probabilistic Robotics", table 4.4).
pub(super) fn resample(weights: &[f64], stream: &mut Stream) -> Vec<usize> {
    let count = weights.len();
    let step = 1.0 / count as f64;
    let mut target = stream.unit() * step;
    let mut chosen = Vec::with_capacity(count);
    let mut sum = 0.0;
    for (index, weight) in weights.iter().enumerate() {
        sum += weight;
        while target < sum && chosen.len() < count {
            chosen.push(index);
            target += step;
        }
    }
    // Rounding may leave the last one out.
    chosen.resize(count, count - 1);
    chosen
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn equal_weights_keep_everyone() {
        let weights = weights(&[-7.0; 5], 1.0);
        assert!((effective(&weights) - 5.0).abs() < 1e-12);
        assert_eq!(resample(&weights, &mut Stream::keyed(0, "", 0)), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn one_that_explains_all_is_all_that_is_left() {
        let weights = weights(&[-1000.0, 0.0, -2000.0], 1.0);
        assert_eq!(weights, [0.0, 1.0, 0.0]);
        assert_eq!(effective(&weights), 1.0);
        assert_eq!(resample(&weights, &mut Stream::keyed(0, "", 0)), [1, 1, 1]);
    }

    #[test]
    fn the_gain_flattens() {
        let weights = weights(&[0.0, -90.0 * std::f64::consts::LN_2], 90.0);
        assert!((weights[0] - 2.0 / 3.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn shares_are_kept_to_one_particle(logs in prop::collection::vec(-5.0..0.0_f64, 1..60), seed: u64) {
            let weights = weights(&logs, 1.0);
            let chosen = resample(&weights, &mut Stream::keyed(seed, "", 0));
            prop_assert_eq!(chosen.len(), logs.len());
            for (index, weight) in weights.iter().enumerate() {
                let times = chosen.iter().filter(|it| **it == index).count() as f64;
                prop_assert!((times - weight * logs.len() as f64).abs() < 1.0 + 1e-9);
            }
        }
    }
}
