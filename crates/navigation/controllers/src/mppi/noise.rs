//! Noise of the samples: numbers of the normal distribution, many at once.
//!
//! Each block of samples has a generator per lane (xoshiro128+, Blackman and Vigna 2021), keyed by seed,
//! number of the draw and block. Pairs of uniform numbers become pairs of normal ones (Box and Muller 1958).
//! The noise therefore depends on seed and number alone, not on the order of the computation.

use std::f32::consts::PI;

use periplus_geometry::Stream;

use super::lane_math::{ln, sin_cos};
use super::lanes::{LANES, Row, ZEROS};

/// Generators of one block of samples.
pub(crate) struct BlockNoise {
    state: [[u32; LANES]; 4],
}

impl BlockNoise {
    /// Creates the generators of a block for one draw.
    pub(crate) fn new(seed: u64, draw: u64, block: usize) -> Self {
        let key = draw.wrapping_shl(20).wrapping_add(block as u64);
        let mut stream = Stream::keyed(seed, "mppi", key);
        let mut state = [[0; LANES]; 4];
        for words in state.as_flattened_mut().as_chunks_mut::<2>().0 {
            let bits = stream.bits();
            *words = [bits as u32, (bits >> 32) as u32];
        }
        // A generator whose state is zero stays there.
        for word in &mut state[0] {
            *word |= 1;
        }
        Self { state }
    }

    /// Next 32 random bits of every lane.
    #[inline(always)]
    fn bits(&mut self) -> [u32; LANES] {
        let [s0, s1, s2, s3] = &mut self.state;
        let mut out = [0; LANES];
        for lane in 0..LANES {
            out[lane] = s0[lane].wrapping_add(s3[lane]);
            let shifted = s1[lane] << 9;
            s2[lane] ^= s0[lane];
            s3[lane] ^= s1[lane];
            s1[lane] ^= s2[lane];
            s0[lane] ^= s3[lane];
            s2[lane] ^= shifted;
            s3[lane] = s3[lane].rotate_left(11);
        }
        out
    }

    /// Two rows of the normal distribution with mean 0 and a standard deviation.
    #[inline(always)]
    fn pair(&mut self, std: f32) -> (Row, Row) {
        const STEP_RATIO: f32 = 1.0 / 16_777_216.0;
        const ANGLE_RAD: f32 = PI / 2_147_483_648.0;
        let (radii, angles) = (self.bits(), self.bits());
        let (mut first, mut second) = (ZEROS, ZEROS);
        for lane in 0..LANES {
            // From 2^-24 to 1, so that the logarithm is finite; at most 5.8 standard deviations.
            let unit = (((radii[lane] >> 8) + 1).cast_signed()) as f32 * STEP_RATIO;
            let radius = (-2.0 * ln(unit)).sqrt() * std;
            let (sine, cosine) = sin_cos(angles[lane].cast_signed() as f32 * ANGLE_RAD);
            first[lane] = radius * cosine;
            second[lane] = radius * sine;
        }
        (first, second)
    }

    /// Fills rows with noise of a standard deviation.
    pub(crate) fn fill(&mut self, rows: &mut [Row], std: f32) {
        if std <= 0.0 {
            return rows.fill(ZEROS);
        }
        let (pairs, last) = rows.as_chunks_mut::<2>();
        for pair in pairs {
            (pair[0], pair[1]) = self.pair(std);
        }
        for row in last {
            *row = self.pair(std).0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(seed: u64, draw: u64, block: usize, std: f32) -> Vec<f32> {
        let mut rows = vec![ZEROS; 4001];
        BlockNoise::new(seed, draw, block).fill(&mut rows, std);
        rows.as_flattened().to_vec()
    }

    #[test]
    fn noise_is_normally_distributed() {
        let numbers = numbers(1, 2, 3, 2.0);
        let count = numbers.len() as f64;
        let moment = |power: i32| {
            numbers.iter().map(|x| libm::pow(f64::from(*x / 2.0), f64::from(power))).sum::<f64>()
                / count
        };
        // Standard errors with 128000 numbers: 0.0028, 0.004, 0.011, 0.027.
        for (power, expected, tolerance) in
            [(1, 0.0, 0.012), (2, 1.0, 0.016), (3, 0.0, 0.05), (4, 3.0, 0.12)]
        {
            assert!((moment(power) - expected).abs() < tolerance, "{power}: {}", moment(power));
        }
        for (limit, expected) in [(1.0, 0.682_7), (2.0, 0.954_5), (3.0, 0.997_3)] {
            let share = numbers.iter().filter(|x| (**x / 2.0).abs() < limit).count() as f64 / count;
            assert!((share - expected).abs() < 0.005, "{limit}: {share}");
        }
    }

    #[test]
    fn neighbours_are_uncorrelated() {
        let rows = numbers(5, 0, 0, 1.0);
        let lag = |lag: usize| {
            rows.windows(lag + 1).map(|w| f64::from(w[0] * w[lag])).sum::<f64>() / rows.len() as f64
        };
        for distance in [1, 2, LANES, 2 * LANES, 3 * LANES] {
            assert!(lag(distance).abs() < 0.012, "{distance}: {}", lag(distance));
        }
    }

    #[test]
    fn noise_depends_on_its_key_alone() {
        let first = numbers(1, 2, 3, 1.0);
        assert_eq!(first, numbers(1, 2, 3, 1.0));
        for other in [(2, 2, 3), (1, 3, 3), (1, 2, 4)] {
            assert_ne!(first, numbers(other.0, other.1, other.2, 1.0));
        }
        assert!(numbers(1, 2, 3, 0.0).iter().all(|x| *x == 0.0));
    }
}
