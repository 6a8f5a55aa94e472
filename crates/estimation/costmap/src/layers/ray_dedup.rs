//! Detection of rays with the same end cell.

/// Size of the hash table of ray ends. A power of two.
const RAY_END_SLOTS: usize = 1 << 13;

/// Detector of rays from the same sensor that end in the same cell, as most rays of a dense cloud
/// do: they cross the same cells. Some repetitions are missed, none is false.
#[derive(Clone, Debug)]
pub(crate) struct RayDeduplicator {
    ends: Vec<u64>,
    turn: u64,
}

impl Default for RayDeduplicator {
    fn default() -> Self {
        Self { ends: vec![u64::MAX; RAY_END_SLOTS], turn: 0 }
    }
}

impl RayDeduplicator {
    /// Clears the table for another sensor or cloud.
    pub(crate) fn forget(&mut self) {
        self.turn += 1;
        if self.turn == 1 << 24 {
            self.turn = 0;
            self.ends.fill(u64::MAX);
        }
    }

    /// Returns true if a ray with this end, an integer below 2^40, was seen before; marks it as
    /// seen.
    #[inline]
    pub(crate) fn has(&mut self, end: u64) -> bool {
        let key = self.turn << 40 | end;
        // Neighbouring cells get different slots.
        let place = (end ^ end >> 13) as usize & (RAY_END_SLOTS - 1);
        std::mem::replace(&mut self.ends[place], key) == key
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeats_are_found_until_forgotten() {
        let mut ray_dedup = RayDeduplicator::default();
        assert!(!ray_dedup.has(7));
        assert!(ray_dedup.has(7));
        assert!(!ray_dedup.has(8));
        ray_dedup.forget();
        assert!(!ray_dedup.has(7));
    }
}
