//! Normal distribution by the ziggurat method, which needs no logarithm for 98 of 100 numbers.
//!
//! Marsaglia & Tsang 2000, "The ziggurat method for generating random variables"; with the correction of
//! reused bits by Doornik 2005, "An improved ziggurat method to generate normal random samples".

use std::sync::LazyLock;

use super::Stream;

const LAYERS: usize = 128;
/// Start of the tail.
const TAIL: f64 = 3.442_619_855_899;
/// Area of a layer under `exp(-x²/2)`.
const AREA: f64 = 9.912_563_035_262_17e-3;

/// Right ends of the layers, from the lowest (with the tail) up to the tip at 0.
static ENDS: LazyLock<[f64; LAYERS + 1]> = LazyLock::new(|| {
    let mut ends = [0.0; LAYERS + 1];
    let mut height = density(TAIL);
    ends[0] = AREA / height;
    ends[1] = TAIL;
    for layer in 2..LAYERS {
        ends[layer] = libm::sqrt(-2.0 * libm::log(AREA / ends[layer - 1] + height));
        height = density(ends[layer]);
    }
    ends
});

fn density(x: f64) -> f64 {
    libm::exp(-0.5 * x * x)
}

pub(super) fn draw(stream: &mut Stream) -> f64 {
    let ends = &*ENDS;
    loop {
        let bits = stream.bits();
        // The layer uses the lowest seven bits, the position in it the upper 53.
        let layer = (bits & 127) as usize;
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
        let place = (bits >> 11) as f64 * (2.0 / 9_007_199_254_740_992.0) - 1.0;
        let x = place * ends[layer];
        if x.abs() < ends[layer + 1] {
            return x;
        }
        if layer == 0 {
            return tail(stream, place < 0.0);
        }
        let (low, high) = (density(ends[layer]), density(ends[layer + 1]));
        if low + stream.unit() * (high - low) < density(x) {
            return x;
        }
    }
}

/// Marsaglia 1964, "Generating a variable from the tail of the normal distribution".
fn tail(stream: &mut Stream, negative: bool) -> f64 {
    loop {
        // `1 - unit` is never 0.
        let x = -libm::log(1.0 - stream.unit()) / TAIL;
        let y = -libm::log(1.0 - stream.unit());
        if 2.0 * y > x * x {
            return if negative { -TAIL - x } else { TAIL + x };
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::Stream;

    /// Fractions of a million numbers below some bounds, compared with the distribution function.
    #[test]
    fn normal_numbers_are_spread_as_they_should() {
        let mut stream = Stream::keyed(1, "normal", 0);
        let numbers: Vec<f64> = (0..1_000_000).map(|_| stream.normal()).collect();
        let mean = numbers.iter().sum::<f64>() / 1e6;
        let moment =
            |power: i32| numbers.iter().map(|x| libm::pow(*x, f64::from(power))).sum::<f64>() / 1e6;
        assert!(mean.abs() < 0.004, "{mean}");
        assert!((moment(2) - 1.0).abs() < 0.006, "{}", moment(2));
        assert!(moment(3).abs() < 0.016, "{}", moment(3));
        assert!((moment(4) - 3.0).abs() < 0.04, "{}", moment(4));
        for bound in [-4.0, -3.5, -3.0, -2.0, -1.0, -0.3, 0.0, 0.1, 0.7, 1.5, 2.5, 3.4, 3.5, 4.0] {
            let below = numbers.iter().filter(|x| **x < bound).count() as f64 / 1e6;
            let share = 0.5 * libm::erfc(-bound / std::f64::consts::SQRT_2);
            let sigma = (share * (1.0 - share) / 1e6).sqrt();
            assert!((below - share).abs() < 5.0 * sigma, "{bound}: {below} {share}");
        }
    }

    #[test]
    fn the_same_key_gives_the_same_normal_numbers() {
        let draw = || {
            let mut stream = Stream::keyed(3, "imu", 9);
            [0; 1000].map(|_| stream.normal().to_bits())
        };
        assert_eq!(draw(), draw());
    }
}
