//! Random samples, the same for the same seed.

/// Sequence of random numbers (SplitMix64).
pub(crate) struct Random {
    state: u64,
}

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.state;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// At most `count` of the elements, each at most once, in their order.
    pub(crate) fn pick<T>(&mut self, elements: Vec<T>, count: usize) -> Vec<T> {
        let mut keyed: Vec<_> = elements
            .into_iter()
            .enumerate()
            .map(|(at, element)| (self.next(), at, element))
            .collect();
        keyed.sort_by_key(|(key, at, _)| (*key, *at));
        keyed.truncate(count);
        keyed.sort_by_key(|(_, at, _)| *at);
        keyed.into_iter().map(|(_, _, element)| element).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_depend_on_the_seed_alone() {
        let pick = |seed, count| Random::new(seed).pick((0..100).collect(), count);
        assert_eq!(pick(1, 5), pick(1, 5));
        assert_ne!(pick(1, 5), pick(2, 5));
        assert_eq!(pick(1, 5).len(), 5);
        assert_eq!(pick(1, 200), (0..100).collect::<Vec<_>>());
    }
}
