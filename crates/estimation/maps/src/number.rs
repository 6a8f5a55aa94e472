//! Number formatting of the map savers.

/// Formats like C++ streams with a precision, and like `printf` with `%.<digits>g`: significant
/// digits, no trailing zeros, an exponent where that is shorter.
pub(crate) fn general(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return match value {
            f64::INFINITY => ".inf".into(),
            f64::NEG_INFINITY => "-.inf".into(),
            _ => ".nan".into(),
        };
    }
    let digits = digits.max(1);
    let scientific = format!("{value:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let power: i32 = exponent.parse().unwrap_or(0);
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    if power < -4 || power >= digits as i32 {
        let sign = if power < 0 { '-' } else { '+' };
        return format!("{}e{sign}{:02}", trimmed(mantissa), power.abs());
    }
    let decimals = usize::try_from(digits as i32 - 1 - power).unwrap_or(0);
    trimmed(&format!("{value:.decimals$}"))
}

/// Formats with a fixed number of decimals.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_printf_does() {
        let cases = [
            (0.05_f32.into(), 3, "0.05"),
            (-12.345, 3, "-12.3"),
            (-10.0, 3, "-10"),
            (1234.5, 3, "1.23e+03"),
            (0.00001234, 3, "1.23e-05"),
            (std::f64::consts::FRAC_PI_2, 7, "1.570796"),
            (0.0, 7, "0"),
            (-0.0, 7, "-0"),
            (999.9, 3, "1e+03"),
        ];
        for (value, digits, text) in cases {
            assert_eq!(general(value, digits), text);
        }
        assert_eq!(fixed(-10.0, 3), "-10.000");
        assert_eq!(fixed(-0.0001, 3), "-0.000");
    }
}
