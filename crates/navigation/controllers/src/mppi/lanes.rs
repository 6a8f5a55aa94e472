//! Rows of samples: the unit of all vectorised loops.
//!
//! A row holds one quantity at one time step for [`LANES`] samples. Loops over a row have a constant length
//! and no branches, so that the compiler uses vector instructions. The order of all sums is that of the code:
//! results are equal on every platform.

/// Number of samples that are processed together.
pub(crate) const LANES: usize = 32;

/// One quantity of [`LANES`] samples.
pub(crate) type Row = [f32; LANES];

/// Row of zeros.
pub(crate) const ZEROS: Row = [0.0; LANES];

/// Larger number; one instruction, unlike `f32::max`, which treats NaN.
#[inline(always)]
pub(crate) fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Smaller number.
#[inline(always)]
pub(crate) fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Number limited to a range; the upper end wins where the range is empty, as in Nav2.
#[inline(always)]
pub(crate) fn clamp(value: f32, lower: f32, upper: f32) -> f32 {
    min(max(value, lower), upper)
}

/// Number of rows for a number of samples.
pub(crate) fn rows_for(samples: usize) -> usize {
    samples.div_ceil(LANES)
}

/// Sum of a row, by halves.
pub(crate) fn sum(row: &Row) -> f32 {
    let mut part = *row;
    let mut width = LANES / 2;
    while width > 0 {
        for lane in 0..width {
            part[lane] += part[lane + width];
        }
        width /= 2;
    }
    part[0]
}

/// Non-negative integer power by repeated multiplication; exponents 0 and 1 return the base, as in Nav2.
#[inline(always)]
pub(crate) fn power(base: f32, exponent: u32) -> f32 {
    let mut result = base;
    for _ in 1..exponent.max(1) {
        result *= base;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_summed_completely() {
        let row: Row = std::array::from_fn(|lane| lane as f32);
        assert_eq!(sum(&row), (LANES * (LANES - 1) / 2) as f32);
    }

    #[test]
    fn limits_and_powers() {
        assert_eq!(
            [clamp(2.0, -1.0, 1.0), clamp(-2.0, -1.0, 1.0), clamp(0.5, -1.0, 1.0)],
            [1.0, -1.0, 0.5]
        );
        assert_eq!(clamp(0.0, 2.0, 1.0), 1.0);
        assert_eq!([power(3.0, 0), power(3.0, 1), power(3.0, 3)], [3.0, 3.0, 27.0]);
        assert_eq!([rows_for(0), rows_for(1), rows_for(LANES), rows_for(LANES + 1)], [0, 1, 1, 2]);
    }
}
