//! Rays that end where another has ended already.

/// How many ends are remembered. A power of two.
const ENDS: usize = 1 << 13;

/// Recognises rays from the same sensor that end in the same cell, as most rays of a dense cloud do:
/// they go through the same cells. Some repeats are missed, none is made up.
#[derive(Clone, Debug)]
pub(crate) struct Repeats {
    ends: Vec<u64>,
    turn: u64,
}

impl Default for Repeats {
    fn default() -> Self {
        Self { ends: vec![u64::MAX; ENDS], turn: 0 }
    }
}

impl Repeats {
    /// Another sensor, or another cloud: nothing has been seen yet.
    pub(crate) fn forget(&mut self) {
        self.turn += 1;
        if self.turn == 1 << 24 {
            self.turn = 0;
            self.ends.fill(u64::MAX);
        }
    }

    /// Whether a ray with this end, a number below 2^40, has been here; from now on it has.
    #[inline]
    pub(crate) fn has(&mut self, end: u64) -> bool {
        let key = self.turn << 40 | end;
        // Neighbouring cells go to places of their own.
        let place = (end ^ end >> 13) as usize & (ENDS - 1);
        std::mem::replace(&mut self.ends[place], key) == key
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeats_are_found_until_forgotten() {
        let mut repeats = Repeats::default();
        assert!(!repeats.has(7));
        assert!(repeats.has(7));
        assert!(!repeats.has(8));
        repeats.forget();
        assert!(!repeats.has(7));
    }
}
