//! Deterministic random numbers that depend on a key only.

mod normal;

/// Stream of random numbers for a seed, a name and a number (a tick, an index). The same key gives the same
/// numbers on every machine and in every order of work. SplitMix64 (Steele, Lea, Flood 2014, "Fast
/// splittable pseudorandom number generators"), seeded by an FNV-1a hash of the key.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream {
    state: u64,
}

impl Stream {
    /// Stream of a key.
    #[must_use]
    pub fn keyed(seed: u64, name: &str, number: u64) -> Self {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        let numbers = [seed.to_le_bytes(), number.to_le_bytes()];
        for byte in numbers.iter().flatten().chain(name.as_bytes()) {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
        }
        Self { state: hash }
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniformly distributed number in `0..1`.
    pub fn unit(&mut self) -> f64 {
        // The upper 53 bits fill a double exactly.
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
        let value = (self.bits() >> 11) as f64;
        value * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Number of the normal distribution with mean 0 and standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        normal::draw(self)
    }
}

#[cfg(test)]
mod tests {
    use super::Stream;

    #[test]
    fn the_same_key_gives_the_same_numbers() {
        let first = Stream::keyed(1, "lidar", 7).bits();
        assert_eq!(first, Stream::keyed(1, "lidar", 7).bits());
        for other in [(2, "lidar", 7), (1, "lidas", 7), (1, "lidar", 8)] {
            assert_ne!(first, Stream::keyed(other.0, other.1, other.2).bits());
        }
    }

    #[test]
    fn unit_numbers_are_even() {
        let mut stream = Stream::keyed(0, "", 0);
        let numbers: Vec<f64> = (0..10_000).map(|_| stream.unit()).collect();
        assert!(numbers.iter().all(|number| (0.0..1.0).contains(number)));
        let mean = numbers.iter().sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 0.01, "{mean}");
        let low = numbers.iter().filter(|number| **number < 0.1).count();
        assert!((900..1100).contains(&low), "{low}");
    }
}
