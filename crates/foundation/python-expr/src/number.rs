//! Python's arithmetic of integers and floats.
//!
//! Integers have 128 bits here; Python's are unbounded. A result that does not fit is an error, never a
//! wrong number.

use std::cmp::Ordering;

use super::error::{ExpressionError, Outcome, fail};

/// Operand of arithmetic; booleans are 0 and 1.
#[derive(Debug, Clone, Copy)]
pub(super) enum Number {
    Int(i128),
    Float(f64),
}

impl Number {
    pub(super) fn to_float(self) -> f64 {
        match self {
            Self::Int(int) => int as f64,
            Self::Float(float) => float,
        }
    }
}

pub(super) fn too_large() -> ExpressionError {
    ExpressionError::new("the integer gets too large")
        .with_help("integers are kept between -2**127 and 2**127 - 1; use a float such as 1e40")
}

fn by_zero() -> ExpressionError {
    ExpressionError::new("division by zero")
}

/// `//` of integers: rounds towards minus infinity.
pub(super) fn floor_divide_ints(a: i128, b: i128) -> Outcome<i128> {
    if b == 0 {
        return Err(by_zero());
    }
    let quotient = a.checked_div(b).ok_or_else(too_large)?;
    let inexact = a.wrapping_rem(b) != 0;
    Ok(if inexact && (a < 0) != (b < 0) { quotient - 1 } else { quotient })
}

/// `%` of integers: the sign is that of the divisor.
pub(super) fn modulo_ints(a: i128, b: i128) -> Outcome<i128> {
    if b == 0 {
        return Err(by_zero());
    }
    let remainder = a.wrapping_rem(b);
    Ok(if remainder != 0 && (remainder < 0) != (b < 0) { remainder + b } else { remainder })
}

/// `(a // b, a % b)` of floats, with CPython's rounding and signed zeros.
pub(super) fn divmod_floats(a: f64, b: f64) -> Outcome<(f64, f64)> {
    if b == 0.0 {
        return Err(by_zero());
    }
    let mut remainder = a % b;
    let mut quotient = (a - remainder) / b;
    if remainder == 0.0 {
        remainder = 0.0_f64.copysign(b);
    } else if (remainder < 0.0) != (b < 0.0) {
        remainder += b;
        quotient -= 1.0;
    }
    let floored = if quotient == 0.0 {
        0.0_f64.copysign(a / b)
    } else {
        // (a - remainder) / b is an integer except for rounding, so the nearest one is correct.
        let floor = quotient.floor();
        if quotient - floor > 0.5 { floor + 1.0 } else { floor }
    };
    Ok((floored, remainder))
}

/// `/` of any two numbers.
pub(super) fn divide(a: Number, b: Number) -> Outcome<f64> {
    match (a, b) {
        (Number::Int(a), Number::Int(b)) => divide_ints(a, b),
        _ if b.to_float() == 0.0 => Err(by_zero()),
        _ => Ok(a.to_float() / b.to_float()),
    }
}

/// `/` of integers, correctly rounded even if they do not fit a float.
fn divide_ints(a: i128, b: i128) -> Outcome<f64> {
    const EXACT: u128 = 1 << 53;
    if b == 0 {
        return Err(by_zero());
    }
    let (numerator, denominator) = (a.unsigned_abs(), b.unsigned_abs());
    if numerator <= EXACT && denominator <= EXACT {
        return Ok(a as f64 / b as f64);
    }
    // Binary long division until the quotient has more bits than a float; the last bit records whether
    // there is a remainder, so that the conversion rounds as the exact quotient would.
    let mut quotient = numerator / denominator;
    let mut remainder = numerator % denominator;
    let mut scale = 0;
    while remainder != 0 && quotient < 1 << 60 {
        remainder *= 2;
        quotient *= 2;
        scale += 1;
        if remainder >= denominator {
            remainder -= denominator;
            quotient += 1;
        }
    }
    if remainder != 0 {
        quotient |= 1;
    }
    let magnitude = quotient as f64 * libm::pow(2.0_f64, f64::from(-scale));
    Ok(if (a < 0) == (b < 0) { magnitude } else { -magnitude })
}

/// `**` of any two numbers.
pub(super) fn power(a: Number, b: Number) -> Outcome<Number> {
    if let (Number::Int(base), Number::Int(exponent)) = (a, b)
        && exponent >= 0
    {
        return power_ints(base, exponent).map(Number::Int);
    }
    let (base, exponent) = (a.to_float(), b.to_float());
    if base == 0.0 && exponent < 0.0 {
        return fail("0 cannot be raised to a negative power");
    }
    if base < 0.0 && base.is_finite() && exponent.is_finite() && exponent.fract() != 0.0 {
        return fail(
            "a negative number to a broken power is complex, and complex numbers are not supported",
        );
    }
    let result = crate::maths::powf(base, exponent);
    if result.is_infinite() && base.is_finite() && exponent.is_finite() {
        return fail("the result is too large for a float");
    }
    Ok(Number::Float(result))
}

fn power_ints(base: i128, exponent: i128) -> Outcome<i128> {
    match base {
        0 | 1 => Ok(if exponent == 0 { 1 } else { base }),
        -1 => Ok(if exponent % 2 == 0 { 1 } else { -1 }),
        _ => u32::try_from(exponent)
            .ok()
            .and_then(|exponent| base.checked_pow(exponent))
            .ok_or_else(too_large),
    }
}

/// `<<`.
pub(super) fn shift_left(a: i128, by: i128) -> Outcome<i128> {
    match by {
        _ if by < 0 => fail("cannot shift by a negative count"),
        _ if a == 0 => Ok(0),
        0..127 if (a << by) >> by == a => Ok(a << by),
        _ => Err(too_large()),
    }
}

/// `>>`.
pub(super) fn shift_right(a: i128, by: i128) -> Outcome<i128> {
    match by {
        _ if by < 0 => fail("cannot shift by a negative count"),
        _ => Ok(a >> by.min(127)),
    }
}

/// Integral part of a float, for `int()` and `math.trunc`.
pub(super) fn truncate(float: f64) -> Outcome<i128> {
    const LIMIT: f64 = 170141183460469231731687303715884105728.0;
    if float.is_nan() {
        fail("NaN has no integer value")
    } else if float.is_infinite() {
        fail("infinity has no integer value")
    } else if !(-LIMIT..LIMIT).contains(&float) {
        Err(too_large())
    } else {
        Ok(float as i128)
    }
}

/// Exact order, without rounding an integer to a float; `None` for a NaN.
pub(super) fn compare(a: Number, b: Number) -> Option<Ordering> {
    match (a, b) {
        (Number::Int(a), Number::Int(b)) => Some(a.cmp(&b)),
        (Number::Float(a), Number::Float(b)) => a.partial_cmp(&b),
        (Number::Int(a), Number::Float(b)) => compare_int_float(a, b),
        (Number::Float(a), Number::Int(b)) => compare_int_float(b, a).map(Ordering::reverse),
    }
}

fn compare_int_float(int: i128, float: f64) -> Option<Ordering> {
    if float.is_nan() {
        return None;
    }
    Some(match truncate(float) {
        Ok(whole) => int.cmp(&whole).then_with(|| 0.0_f64.total_cmp(&(float.fract() + 0.0))),
        Err(_) if float > 0.0 => Ordering::Less,
        Err(_) => Ordering::Greater,
    })
}

/// `round(int, digits)` for negative digits: to the nearest multiple of a power of ten, ties to even.
pub(super) fn round_int(int: i128, digits: i128) -> Outcome<i128> {
    if digits >= 0 {
        return Ok(int);
    }
    let Some(unit) =
        u32::try_from(digits.unsigned_abs()).ok().and_then(|places| 10_i128.checked_pow(places))
    else {
        // The unit exceeds 10^38 and is more than twice any value but the largest: half of 10^39 is 5 *
        // 10^38.
        return Ok(0);
    };
    let low = modulo_ints(int, unit)?;
    let quotient = floor_divide_ints(int, unit)?;
    let up = match low.cmp(&(unit - low)) {
        Ordering::Less => false,
        Ordering::Greater => true,
        Ordering::Equal => quotient % 2 != 0,
    };
    let rounded = if up { quotient + 1 } else { quotient };
    rounded.checked_mul(unit).ok_or_else(too_large)
}

/// `round(float, digits)`: the decimal nearest to the float's exact value, ties to even.
pub(super) fn round_float(float: f64, digits: i128) -> f64 {
    if !float.is_finite() || float == 0.0 || digits > 1100 {
        return float;
    }
    if digits >= 0 {
        let digits = usize::try_from(digits).unwrap_or(1100);
        return format!("{float:.digits$}").parse().unwrap_or(float);
    }
    let zero = 0.0_f64.copysign(float);
    if digits < -310 {
        return zero;
    }
    let exponent: i128 = format!("{float:e}")
        .split_once('e')
        .and_then(|(_, exponent)| exponent.parse().ok())
        .unwrap_or(0);
    match exponent + digits {
        ..=-2 => zero,
        // Rounding to a unit of the next higher power of ten: only more than half of it rounds up.
        -1 => {
            let half: f64 = format!("5e{exponent}").parse().unwrap_or(f64::INFINITY);
            let unit: f64 = format!("1e{}", exponent + 1).parse().unwrap_or(f64::INFINITY);
            if float.abs() > half { unit.copysign(float) } else { zero }
        }
        places => {
            let places = usize::try_from(places).unwrap_or(0);
            format!("{float:.places$e}").parse().unwrap_or(float)
        }
    }
}
