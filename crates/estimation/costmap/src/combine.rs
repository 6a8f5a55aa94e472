//! Combination of the grid of a layer with the master grid.
//!
//! Source: `nav2_costmap_2d/src/costmap_layer.cpp`.

use crate::cost::{INSCRIBED, UNKNOWN};
use crate::{CellWindow, Costmap};

/// Rule that combines an old cost with the cost of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    /// Known costs of the layer overwrite.
    Overwrite,
    /// The maximum; unknown cells of either grid are ignored.
    Max,
    /// The maximum; unknown cells of the master grid stay unknown.
    MaxOfKnown,
    /// Copies the layer, unknown cells included.
    Copy,
    /// The sum, limited to below inscribed.
    Sum,
}

impl Combination {
    /// Converts the value of `combination_method`; unknown values become 1.
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
            // Unknown is the highest number but the lowest knowledge.
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
    pub fn apply(self, master: &mut Costmap, layer: &Costmap, window: &CellWindow) {
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

/// Inlined for each combination, which removes the branches from the loop.
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
