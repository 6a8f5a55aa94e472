//! Random numbers that are the same on every machine: SplitMix64.

/// A stream of random numbers.
pub(super) struct Random(u64);

impl Random {
    /// The stream of an input: the seed of the run, the kind's name and the number of the input.
    pub(super) fn of(seed: u64, kind: &str, number: usize) -> Self {
        let mut state = seed ^ (number as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        for byte in kind.bytes() {
            state = state.rotate_left(7).wrapping_mul(0x0100_0000_01B3) ^ u64::from(byte);
        }
        Self(state)
    }

    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// A number below a limit; 0 where the limit is 0.
    pub(super) fn below(&mut self, limit: usize) -> usize {
        if limit == 0 { 0 } else { (self.next() % limit as u64) as usize }
    }

    pub(super) fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.below(from.len())]
    }
}
