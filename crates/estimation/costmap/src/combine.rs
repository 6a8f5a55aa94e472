//! How the cells of a layer get into those of the costmap.
//!
//! Source: `nav2_costmap_2d/src/costmap_layer.cpp`.

use crate::cost::{INSCRIBED, UNKNOWN};
use crate::{Costmap, Window};

/// What comes of an old cost and a layer's cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    /// What the layer knows, in the place of what was there.
    Overwrite,
    /// The higher one; what is unknown gives way.
    Max,
    /// The higher one, and unknown stays unknown.
    MaxOfKnown,
    /// The layer's cell whatever it is, unknown as well.
    Copy,
    /// The sum, below inscribed.
    Sum,
}

impl Combination {
    /// By the number that parameters have; others are taken as 1.
    #[must_use]
    pub fn from_number(number: i64) -> Self {
        match number {
            0 => Self::Overwrite,
            2 => Self::MaxOfKnown,
            _ => Self::Max,
        }
    }

    /// Combines one cell.
    #[must_use]
    #[inline]
    pub fn of(self, old: u8, new: u8) -> u8 {
        match self {
            Self::Copy => new,
            _ if new == UNKNOWN => old,
            Self::Overwrite => new,
            // Unknown is the highest number and the least that can be said.
            Self::Max => {
                if old == UNKNOWN {
                    new
                } else {
                    old.max(new)
                }
            }
            Self::MaxOfKnown => old.max(new),
            Self::Sum if old == UNKNOWN => new,
            Self::Sum => match old.checked_add(new) {
                Some(sum) if sum < INSCRIBED => sum,
                _ => INSCRIBED - 1,
            },
        }
    }

    /// Combines a window of two grids with the same cells.
    pub fn apply(self, master: &mut Costmap, layer: &Costmap, window: &Window) {
        debug_assert_eq!(master.info().width, layer.info().width);
        for span in window.spans(layer.info().width) {
            let olds = &mut master.costs_mut()[span.clone()];
            let news = &layer.costs()[span];
            match self {
                Self::Copy => olds.copy_from_slice(news),
                Self::Overwrite => merge(Self::Overwrite, olds, news),
                Self::Max => merge(Self::Max, olds, news),
                Self::MaxOfKnown => merge(Self::MaxOfKnown, olds, news),
                Self::Sum => merge(Self::Sum, olds, news),
            }
        }
    }
}

/// Inlined for each combination, so that the loop has no branches left.
#[inline(always)]
fn merge(combination: Combination, olds: &mut [u8], news: &[u8]) {
    for (old, new) in olds.iter_mut().zip(news) {
        *old = combination.of(*old, *new);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_combination_of_known_and_unknown() {
        let check = |combination: Combination, expected: [u8; 5]| {
            let pairs = [(10, 20), (20, 10), (255, 10), (10, 255), (250, 20)];
            assert_eq!(pairs.map(|(old, new)| combination.of(old, new)), expected);
        };
        check(Combination::Overwrite, [20, 10, 10, 10, 20]);
        check(Combination::Max, [20, 20, 10, 10, 250]);
        check(Combination::MaxOfKnown, [20, 20, 255, 10, 250]);
        check(Combination::Copy, [20, 10, 10, 255, 20]);
        check(Combination::Sum, [30, 30, 10, 10, 252]);
        assert_eq!(Combination::from_number(7), Combination::Max);
    }
}
