//! Elementary functions in single precision, without branches, for vectorised loops.
//!
//! They need additions, multiplications, one division and bit operations only, so that results are equal on
//! every platform. Maximum errors, checked by the tests against `libm` in double precision:
//!
//! | function | range | error |
//! |---|---|---|
//! | [`sin_cos`] | up to 1000 rad | 1.2e-7 absolute up to 100 rad, 1e-6 up to 1000 rad |
//! | [`exp`] | -87 to 88 | 2e-7 relative; 0 below |
//! | [`ln`] | normal numbers above 0 | 2e-7 relative, or 2e-7 absolute near 1 |
//! | [`atan2`] | all | 4e-7 absolute |
//! | [`normalize_angle`] | up to 1000 rad | 1e-6 up to 100 rad, 1e-4 up to 1000 rad |
//!
//! Sources: range reduction in parts by Cody and Waite, *Software Manual for the Elementary Functions*
//! (1980); coefficients are those of minimax polynomials in the Cephes library (Moshier 1989).

#![allow(clippy::excessive_precision, reason = "coefficients are written as published")]

use std::f32::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LN_2, LOG2_E, PI};

/// Number that rounds to an integer when it is added and subtracted: 1.5 times 2^23.
const ROUNDING_RATIO: f32 = 12_582_912.0;

/// Bits of [`ROUNDING_RATIO`].
const ROUNDING_MASK: u32 = 0x4b40_0000;

/// Nearest integer, for numbers below 2^22.
#[inline(always)]
pub(crate) fn round(x: f32) -> f32 {
    (x + ROUNDING_RATIO) - ROUNDING_RATIO
}

/// Greatest integer that is not above a number below 2^22.
#[inline(always)]
pub(crate) fn floor(x: f32) -> f32 {
    let nearest = round(x);
    nearest - if nearest > x { 1.0 } else { 0.0 }
}

/// Conversion of an integer below 2^22 in a float.
#[inline(always)]
pub(crate) fn to_integer(whole: f32) -> i32 {
    (whole + ROUNDING_RATIO).to_bits().wrapping_sub(ROUNDING_MASK).cast_signed()
}

/// Sine and cosine.
#[inline(always)]
pub(crate) fn sin_cos(angle_rad: f32) -> (f32, f32) {
    // Quarter turns, and the rest in parts of which the first two have few digits.
    let shifted = angle_rad * FRAC_2_PI + ROUNDING_RATIO;
    let quarters = shifted - ROUNDING_RATIO;
    let rest = ((angle_rad - quarters * 1.570_312_5) - quarters * 4.837_512_969_970_703e-4)
        - quarters * 7.549_789_954_891_88e-8;
    let square = rest * rest;
    let sine = rest
        + rest
            * square
            * (-1.666_665_461e-1 + square * (8.332_160_873_6e-3 + square * -1.951_529_589_1e-4));
    let cosine = 1.0 - 0.5 * square
        + square
            * square
            * (4.166_664_568_298_827e-2
                + square * (-1.388_731_625_493_765e-3 + square * 2.443_315_711_809_948e-5));
    let quadrant = shifted.to_bits();
    let is_odd = quadrant & 1 == 1;
    let (along_sine, along_cosine) = if is_odd { (cosine, sine) } else { (sine, cosine) };
    let sine_sign = (quadrant & 2) << 30;
    let cosine_sign = (quadrant.wrapping_add(1) & 2) << 30;
    (
        f32::from_bits(along_sine.to_bits() ^ sine_sign),
        f32::from_bits(along_cosine.to_bits() ^ cosine_sign),
    )
}

/// Exponential function; 0 below -87, and that of 88 above.
#[inline(always)]
pub(crate) fn exp(x: f32) -> f32 {
    const LOWEST_RATIO: f32 = -87.0;
    let limited = if x > 88.0 { 88.0 } else { x };
    let limited = if limited < LOWEST_RATIO { LOWEST_RATIO } else { limited };
    let shifted = limited * LOG2_E + ROUNDING_RATIO;
    let doublings = shifted - ROUNDING_RATIO;
    let rest = (limited - doublings * 0.693_359_375) - doublings * -2.121_944_4e-4;
    let polynomial = 5.000_000_120_1e-1
        + rest
            * (1.666_666_545_9e-1
                + rest
                    * (4.166_579_589_4e-2
                        + rest
                            * (8.333_451_907_3e-3
                                + rest * (1.398_199_950_7e-3 + rest * 1.987_569_150_0e-4))));
    let fraction = rest * rest * polynomial + rest + 1.0;
    let exponent = shifted.to_bits().wrapping_sub(ROUNDING_MASK).wrapping_add(127) << 23;
    let value = fraction * f32::from_bits(exponent);
    if x < LOWEST_RATIO { 0.0 } else { value }
}

/// Natural logarithm of a normal positive number.
#[inline(always)]
pub(crate) fn ln(x: f32) -> f32 {
    // Exponent so that the fraction is from sqrt(1/2) to sqrt(2).
    let offset = x.to_bits().wrapping_sub(0x3f35_04f3);
    let exponent = (offset.cast_signed() >> 23) as f32;
    let fraction = f32::from_bits((offset & 0x007f_ffff).wrapping_add(0x3f35_04f3)) - 1.0;
    let square = fraction * fraction;
    let polynomial = 3.333_331_174e-1
        + fraction
            * (-2.499_999_399_3e-1
                + fraction
                    * (2.000_071_476_5e-1
                        + fraction
                            * (-1.666_805_766_5e-1
                                + fraction
                                    * (1.424_932_278_7e-1
                                        + fraction
                                            * (-1.242_014_084_6e-1
                                                + fraction
                                                    * (1.167_699_874e-1
                                                        + fraction
                                                            * (-1.151_461_031e-1
                                                                + fraction
                                                                    * 7.037_683_629_2e-2)))))));
    let rest = fraction * square * polynomial - 0.5 * square;
    exponent * LN_2 + (fraction + rest)
}

/// Angle of a vector; 0 for no vector.
#[inline(always)]
pub(crate) fn atan2(y: f32, x: f32) -> f32 {
    const TAN_EIGHTH_RATIO: f32 = 0.414_213_56;
    let (along, across) = (x.abs(), y.abs());
    let is_steep = across > along;
    let (small, large) = if is_steep { (along, across) } else { (across, along) };
    let is_wide = small > large * TAN_EIGHTH_RATIO;
    let (top, bottom) = if is_wide { (small - large, small + large) } else { (small, large) };
    let ratio = top / if bottom == 0.0 { 1.0 } else { bottom };
    let square = ratio * ratio;
    let polynomial = -3.333_294_915_39e-1
        + square
            * (1.997_771_064_78e-1
                + square * (-1.387_768_560_32e-1 + square * 8.053_744_497_15e-2));
    let angle = ratio + ratio * square * polynomial + if is_wide { FRAC_PI_4 } else { 0.0 };
    let angle = if is_steep { FRAC_PI_2 - angle } else { angle };
    let angle = if x < 0.0 { PI - angle } else { angle };
    if y < 0.0 { -angle } else { angle }
}

/// Equivalent angle from -pi to pi.
#[inline(always)]
pub(crate) fn normalize_angle(angle_rad: f32) -> f32 {
    const TURN_RAD: f32 = 2.0 * PI;
    angle_rad - round(angle_rad * (1.0 / TURN_RAD)) * TURN_RAD
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest error over a range, checked at many points.
    fn check(low: f64, high: f64, max_error: f64, error: impl Fn(f32) -> f64) {
        let count = 200_000;
        let points =
            (0..=count).map(|i| (low + (high - low) * f64::from(i) / f64::from(count)) as f32);
        let worst =
            points.map(|x| (error(x), x)).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
        assert!(worst.0 <= max_error, "{low}..{high}: error {} at {}", worst.0, worst.1);
    }

    fn sine_error(x: f32) -> f64 {
        let (sine, cosine) = sin_cos(x);
        let (exact_sine, exact_cosine) = libm::sincos(f64::from(x));
        (f64::from(sine) - exact_sine).abs().max((f64::from(cosine) - exact_cosine).abs())
    }

    #[test]
    fn sine_and_cosine_are_accurate() {
        check(-7.0, 7.0, 1.2e-7, sine_error);
        check(-100.0, 100.0, 1.2e-7, sine_error);
        check(-1000.0, 1000.0, 1e-6, sine_error);
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
    }

    #[test]
    fn the_exponential_function_is_accurate() {
        check(-87.0, 88.0, 2e-7, |x| {
            let exact = libm::exp(f64::from(x));
            (f64::from(exp(x)) - exact).abs() / exact
        });
        assert_eq!([exp(0.0), exp(-88.0), exp(-1e30)], [1.0, 0.0, 0.0]);
        assert!(exp(1e30).is_finite());
    }

    #[test]
    fn the_logarithm_is_accurate() {
        let error = |x: f32| {
            let exact = libm::log(f64::from(x));
            (f64::from(ln(x)) - exact).abs() / exact.abs().max(1.0)
        };
        check(1e-7, 1e-3, 2e-7, error);
        check(1e-3, 4.0, 2e-7, error);
        check(4.0, 1e9, 2e-7, error);
        assert_eq!(ln(1.0), 0.0);
    }

    #[test]
    fn angles_of_vectors_are_accurate() {
        check(-3.1, 3.1, 4e-7, |angle| {
            let (sine, cosine) = libm::sincos(f64::from(angle));
            let (y, x) = ((3.0 * sine) as f32, (3.0 * cosine) as f32);
            (f64::from(atan2(y, x)) - libm::atan2(f64::from(y), f64::from(x))).abs()
        });
        let axes =
            [(0.0, 1.0, 0.0), (1.0, 0.0, FRAC_PI_2), (0.0, -1.0, PI), (-1.0, 0.0, -FRAC_PI_2)];
        for (y, x, angle) in axes {
            assert_eq!(atan2(y, x), angle, "{y} {x}");
        }
        assert_eq!(atan2(0.0, 0.0), 0.0);
    }

    #[test]
    fn integers_are_found() {
        for (x, below, nearest) in
            [(2.5, 2, 2), (-0.5, -1, 0), (3.0, 3, 3), (-1.0, -1, -1), (7.9, 7, 8)]
        {
            assert_eq!((to_integer(floor(x)), to_integer(round(x))), (below, nearest), "{x}");
        }
    }

    #[test]
    fn angles_are_normalized() {
        for (angle, expected) in
            [(0.5, 0.5), (PI + 0.5, 0.5 - PI), (-7.0, -7.0 + 2.0 * PI), (100.0, 100.0 - 32.0 * PI)]
        {
            assert!((normalize_angle(angle) - expected).abs() < 1e-5, "{angle}");
        }
    }
}
