//! Ray tracing of cells along a line.

use crate::info::Cell;

/// Cells between two cells, both included, one for each step along the longer side. Bresenham's
/// algorithm in integers. Ties are resolved as in `costmap_2d`: the error starts at half the longer
/// side, rounded down, and a side step is taken when the error reaches the longer side.
///
/// Source: `nav2_util/raytrace_line_2d.hpp`.
#[derive(Clone, Debug)]
pub struct Line {
    next: Cell,
    /// Number of remaining cells.
    left: usize,
    /// Longer and shorter side \[cells\].
    long: usize,
    short: usize,
    error: usize,
    /// True if the longer side is along x.
    is_flat: bool,
    grows: (bool, bool),
}

impl Line {
    /// Creates the line from one cell to another.
    #[must_use]
    pub fn between(start: Cell, end: Cell) -> Self {
        let (width, height) = (start.0.abs_diff(end.0), start.1.abs_diff(end.1));
        let is_flat = width >= height;
        let (long, short) = if is_flat { (width, height) } else { (height, width) };
        Self {
            next: start,
            left: long + 1,
            long,
            short,
            error: long / 2,
            is_flat,
            grows: (start.0 < end.0, start.1 < end.1),
        }
    }

    /// Creates the part of a line whose straight distance from the start is at least `min_length`
    /// and at most `max_length` cells. It is empty when the end is nearer than `min_length`. The
    /// last cell is the one at which the length along the longer side, scaled in proportion and
    /// rounded down, ends.
    /// With a `min_length` above 0 the line begins at the cell at that distance, rounded down, and
    /// runs from there to the end.
    #[must_use]
    pub fn within(start: Cell, end: Cell, min_length: u32, max_length: u32) -> Self {
        let (dx, dy) = (end.0 as f64 - start.0 as f64, end.1 as f64 - start.1 as f64);
        let length = libm::hypot(dx, dy);
        if length < f64::from(min_length) {
            return Self { left: 0, ..Self::between(start, end) };
        }
        if length == 0.0 {
            return Self::between(start, end);
        }
        let min_length = f64::from(min_length);
        let begin = (
            (start.0 as f64 + dx / length * min_length) as usize,
            (start.1 as f64 + dy / length * min_length) as usize,
        );
        let line = Self::between(begin, end);
        let part = (f64::from(max_length) / length).min(1.0);
        Self { left: ((part * line.long as f64) as usize).min(line.long) + 1, ..line }
    }
}

impl Iterator for Line {
    type Item = Cell;

    #[inline]
    fn next(&mut self) -> Option<Cell> {
        self.left = self.left.checked_sub(1)?;
        let cell = self.next;
        if self.left > 0 {
            self.error += self.short;
            let steps_aside = self.error >= self.long;
            if steps_aside {
                self.error -= self.long;
            }
            if self.is_flat || steps_aside {
                step(&mut self.next.0, self.grows.0);
            }
            if !self.is_flat || steps_aside {
                step(&mut self.next.1, self.grows.1);
            }
        }
        Some(cell)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.left, Some(self.left))
    }
}

impl ExactSizeIterator for Line {}

#[inline]
fn step(place: &mut usize, grows: bool) {
    // Never below zero: a line stays between its ends.
    *place = if grows { *place + 1 } else { place.wrapping_sub(1) };
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn from_the_first_cell_to_the_last() {
        let cells: Vec<_> = Line::between((0, 0), (3, 1)).collect();
        assert_eq!(cells, [(0, 0), (1, 0), (2, 1), (3, 1)]);
        assert_eq!(Line::between((5, 5), (5, 5)).collect::<Vec<_>>(), [(5, 5)]);
        let cells: Vec<_> = Line::between((1, 2), (0, 0)).collect();
        assert_eq!(cells, [(1, 2), (0, 1), (0, 0)]);
    }

    #[test]
    fn lengths_are_limited() {
        let cells = |end, min_length, max_length| Line::within((0, 0), end, min_length, max_length);
        // Five cells along a diagonal are 3.5 along each side.
        assert_eq!(cells((9, 9), 0, 5).last(), Some((3, 3)));
        assert_eq!(cells((9, 0), 2, 4).next(), Some((2, 0)));
        assert_eq!(cells((3, 0), 5, 9).count(), 0);
        assert_eq!(cells((3, 0), 0, u32::MAX).count(), 4);
        assert_eq!(cells((0, 0), 0, 3).count(), 1);
    }

    proptest! {
        #[test]
        fn steps_are_to_neighbours_and_near_the_line(
            start in (0..40_usize, 0..40_usize), end in (0..40_usize, 0..40_usize),
        ) {
            let cells: Vec<_> = Line::between(start, end).collect();
            prop_assert_eq!((cells[0], cells[cells.len() - 1]), (start, end));
            for pair in cells.windows(2) {
                let (dx, dy) = (pair[0].0.abs_diff(pair[1].0), pair[0].1.abs_diff(pair[1].1));
                prop_assert_eq!(dx.max(dy), 1);
            }
            let (dx, dy) = (end.0 as f64 - start.0 as f64, end.1 as f64 - start.1 as f64);
            for (x, y) in cells {
                let aside = dx * (y as f64 - start.1 as f64) - dy * (x as f64 - start.0 as f64);
                // At most one cell off the line, since ties start from the line.
                prop_assert!(aside.abs() <= dx.abs().max(dy.abs()));
            }
        }
    }
}
