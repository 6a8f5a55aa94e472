//! Python's formats of floats.

/// `repr(float)`: the shortest digits that read back as the same float, with an exponent if the point would
/// be more than 16 digits to the right or 4 zeros to the left.
pub(super) fn repr(float: f64) -> String {
    if let Some(special) = special(float) {
        return special.to_owned();
    }
    let scientific = format!("{float:e}");
    let (mantissa, exponent) = split(&scientific);
    if (-4..16).contains(&exponent) {
        let plain = format!("{float}");
        if plain.contains('.') { plain } else { plain + ".0" }
    } else {
        format!("{mantissa}{}", exponent_text(exponent))
    }
}

fn special(float: f64) -> Option<&'static str> {
    if float.is_nan() {
        Some("nan")
    } else if float == f64::INFINITY {
        Some("inf")
    } else if float == f64::NEG_INFINITY {
        Some("-inf")
    } else {
        None
    }
}

fn split(scientific: &str) -> (&str, i32) {
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    (mantissa, exponent.parse().unwrap_or(0))
}

/// Exponent as in C: signed, at least two digits.
fn exponent_text(exponent: i32) -> String {
    format!("e{}{:02}", if exponent < 0 { '-' } else { '+' }, exponent.abs())
}

/// Maximum number of digits after the point that a float has; further zeros are appended, since Rust's
/// formatting refuses very large precisions.
const ALL_DIGITS: usize = 1100;

/// `%.{precision}f`; `alternate` keeps the point of an integral value.
pub(super) fn fixed(float: f64, precision: usize, alternate: bool) -> String {
    if let Some(special) = special(float) {
        return special.to_owned();
    }
    let shown = precision.min(ALL_DIGITS);
    let mut text = format!("{float:.shown$}");
    text.extend(std::iter::repeat_n('0', precision - shown));
    if alternate && precision == 0 {
        text.push('.');
    }
    text
}

/// `%.{precision}e`.
pub(super) fn scientific(float: f64, precision: usize, alternate: bool) -> String {
    if let Some(special) = special(float) {
        return special.to_owned();
    }
    let shown = precision.min(ALL_DIGITS);
    let text = format!("{float:.shown$e}");
    let (mantissa, exponent) = split(&text);
    let zeros = "0".repeat(precision - shown);
    let point = if alternate && precision == 0 { "." } else { "" };
    format!("{mantissa}{zeros}{point}{}", exponent_text(exponent))
}

/// `%.{precision}g`: significant digits, trailing zeros dropped unless `alternate`.
pub(super) fn general(float: f64, precision: usize, alternate: bool) -> String {
    general_between(float, precision, alternate, false)
}

/// As [`general`], but for `format(float, '.3')`, which keeps one digit after the point and uses an
/// exponent one digit earlier.
pub(super) fn general_like_repr(float: f64, precision: usize, alternate: bool) -> String {
    general_between(float, precision, alternate, true)
}

fn general_between(float: f64, precision: usize, alternate: bool, like_repr: bool) -> String {
    if let Some(special) = special(float) {
        return special.to_owned();
    }
    let precision = precision.max(1);
    let shown = (precision - 1).min(ALL_DIGITS);
    let rounded = format!("{float:.shown$e}");
    let exponent = split(&rounded).1;
    let limit = i32::try_from(precision).unwrap_or(i32::MAX) - i32::from(like_repr);
    if (-4..limit.max(if like_repr { i32::MIN } else { 1 })).contains(&exponent) {
        // Digits after the point, for `precision` digits in total.
        let behind = (precision as i64 - 1 - i64::from(exponent)).max(0) as usize;
        let text = fixed(float, behind, alternate);
        let text = if alternate { text } else { without_trailing_zeros(&text).to_owned() };
        if like_repr && !text.contains('.') { text + ".0" } else { text }
    } else {
        let text = scientific(float, precision - 1, alternate);
        let Some((mantissa, exponent)) = text.split_once('e') else { return text };
        let mantissa = if alternate { mantissa } else { without_trailing_zeros(mantissa) };
        format!("{mantissa}e{exponent}")
    }
}

fn without_trailing_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}
