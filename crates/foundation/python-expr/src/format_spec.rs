//! Format specifications, `'{:+08.3f}'`: Python's "format specification mini-language".

use super::budget::Budget;
use super::error::{ExpressionError, Outcome, fail};
use super::format_float;
use super::number::Number;
use super::value::Value;

#[derive(Debug, Clone, Default)]
pub(super) struct Spec {
    pub(super) fill: Option<char>,
    pub(super) align: Option<char>,
    pub(super) sign: Option<char>,
    pub(super) no_negative_zero: bool,
    pub(super) alternate: bool,
    pub(super) width: usize,
    pub(super) grouping: Option<char>,
    pub(super) precision: Option<usize>,
    pub(super) kind: Option<char>,
}

/// `format(value, spec)`.
pub(super) fn format_value(value: &Value, spec: &str, budget: &mut Budget) -> Outcome<String> {
    if spec.is_empty() {
        return value.to_text(budget);
    }
    match value {
        Value::Str(text) => format_text(text, &parse(spec)?, budget),
        Value::Float(float) => format_float_value(*float, &parse(spec)?, budget),
        Value::Bool(_) | Value::Int(_) => {
            format_int(value.integer()?, &parse(spec)?, value, budget)
        }
        _ => Err(ExpressionError::new(format!(
            "a `{}` takes no format such as `{spec}`",
            value.type_name()
        ))
        .with_help("turn it into text first: str(...)")),
    }
}

fn parse(text: &str) -> Outcome<Spec> {
    let invalid = || {
        ExpressionError::new(format!("`{text}` is not a format"))
            .with_help("formats look like `08.3f`, `>10` or `,d`")
    };
    let is_align = |letter: char| matches!(letter, '<' | '>' | '=' | '^');
    let mut letters = text.chars().peekable();
    let mut spec = Spec::default();
    let mut ahead = text.chars();
    match (ahead.next(), ahead.next()) {
        (Some(fill), Some(align)) if is_align(align) => {
            spec.fill = Some(fill);
            spec.align = Some(align);
            letters.nth(1);
        }
        (Some(align), _) if is_align(align) => {
            spec.align = Some(align);
            letters.next();
        }
        _ => {}
    }
    spec.sign = letters.next_if(|letter| matches!(letter, '+' | '-' | ' '));
    spec.no_negative_zero = letters.next_if_eq(&'z').is_some();
    spec.alternate = letters.next_if_eq(&'#').is_some();
    if spec.fill.is_none() && letters.next_if_eq(&'0').is_some() {
        spec.fill = Some('0');
        if spec.align.is_none() {
            // Marks the default alignment of numbers; strings reset it, see `format_text`.
            spec.align = Some('0');
        }
    }
    let count = |letters: &mut std::iter::Peekable<std::str::Chars<'_>>| -> Outcome<Option<usize>> {
        let mut digits = String::new();
        while let Some(digit) = letters.next_if(char::is_ascii_digit) {
            digits.push(digit);
        }
        if digits.is_empty() {
            Ok(None)
        } else {
            digits
                .parse()
                .map(Some)
                .map_err(|_| ExpressionError::new("too many digits in a format"))
        }
    };
    spec.width = count(&mut letters)?.unwrap_or(0);
    spec.grouping = letters.next_if(|letter| matches!(letter, ',' | '_'));
    if letters.next_if_eq(&'.').is_some() {
        spec.precision = Some(count(&mut letters)?.ok_or_else(invalid)?);
    }
    spec.kind = letters.next();
    if letters.next().is_some() { Err(invalid()) } else { Ok(spec) }
}

fn unknown(kind: char, value: &str) -> ExpressionError {
    ExpressionError::new(format!("the format `{kind}` does not work on `{value}`"))
}

fn format_text(text: &str, spec: &Spec, budget: &mut Budget) -> Outcome<String> {
    if let Some(kind) = spec.kind.filter(|kind| *kind != 's') {
        return Err(unknown(kind, "str")
            .with_help("turn the text into a number first: float(...) or int(...)"));
    }
    if spec.sign.is_some()
        || spec.alternate
        || spec.grouping.is_some()
        || spec.no_negative_zero
        || spec.align == Some('=')
    {
        return fail("signs, `#`, `z`, `=` and thousands separators do not work on `str`");
    }
    budget.allocate(text.len() as u128)?;
    let shown: String = text.chars().take(spec.precision.unwrap_or(usize::MAX)).collect();
    let spec = Spec { align: spec.align.filter(|align| *align != '0'), ..spec.clone() };
    pad(&shown, &spec, '<', budget)
}

/// Pads to the width.
pub(super) fn pad(
    text: &str,
    spec: &Spec,
    default_align: char,
    budget: &mut Budget,
) -> Outcome<String> {
    let length = text.chars().count();
    let missing = spec.width.saturating_sub(length);
    let fill = spec.fill.unwrap_or(' ');
    budget.allocate(text.len() as u128 + missing as u128 * fill.len_utf8() as u128)?;
    let left = match spec.align.unwrap_or(default_align) {
        '<' => 0,
        '^' => missing / 2,
        _ => missing,
    };
    let mut padded = String::with_capacity(text.len() + missing);
    padded.extend(std::iter::repeat_n(fill, left));
    padded.push_str(text);
    padded.extend(std::iter::repeat_n(fill, missing - left));
    Ok(padded)
}

fn format_int(int: i128, spec: &Spec, value: &Value, budget: &mut Budget) -> Outcome<String> {
    let magnitude = int.unsigned_abs();
    let (prefix, digits) = match spec.kind.unwrap_or('d') {
        'd' | 'n' => ("", magnitude.to_string()),
        'b' => ("0b", format!("{magnitude:b}")),
        'o' => ("0o", format!("{magnitude:o}")),
        'x' => ("0x", format!("{magnitude:x}")),
        'X' => ("0X", format!("{magnitude:X}")),
        'c' => {
            let Some(letter) = u32::try_from(int).ok().and_then(char::from_u32) else {
                return fail(format!("{int} is not the code of a character"));
            };
            if spec.sign.is_some() || spec.precision.is_some() || spec.grouping.is_some() {
                return fail(
                    "signs, precisions and thousands separators do not work with the format `c`",
                );
            }
            return pad(&letter.to_string(), spec, '<', budget);
        }
        'e' | 'E' | 'f' | 'F' | 'g' | 'G' | '%' => {
            return format_float_value(int as f64, spec, budget);
        }
        kind => return Err(unknown(kind, value.type_name())),
    };
    if spec.precision.is_some() {
        return Err(
            ExpressionError::new("an integer takes no precision").with_help("add `f`, as in `.3f`")
        );
    }
    if spec.no_negative_zero {
        return fail("`z` does not work on integers");
    }
    let group = match (spec.grouping, spec.kind) {
        (Some(','), Some('b' | 'o' | 'x' | 'X' | 'n')) | (Some('_'), Some('n')) => {
            return fail("this format takes no such thousands separator");
        }
        (Some('_'), Some('b' | 'o' | 'x' | 'X')) => 4,
        _ => 3,
    };
    let prefix = if spec.alternate { prefix } else { "" };
    number_text(int < 0, prefix, &digits, "", group, spec, budget)
}

fn format_float_value(float: f64, spec: &Spec, budget: &mut Budget) -> Outcome<String> {
    budget.allocate(spec.precision.unwrap_or(0) as u128 * 3 + 400)?;
    let magnitude = float.abs();
    let text = match (spec.kind, spec.precision) {
        (None, None) => format_float::repr(magnitude),
        (None, Some(precision)) => {
            format_float::general_like_repr(magnitude, precision, spec.alternate)
        }
        (Some('%'), _) => {
            let percent = magnitude * 100.0;
            format_float::fixed(percent, spec.precision.unwrap_or(6), spec.alternate) + "%"
        }
        (Some(kind @ ('e' | 'E' | 'f' | 'F' | 'g' | 'G' | 'n')), precision) => {
            float_text(magnitude, kind, precision.unwrap_or(6), spec.alternate)
        }
        (Some(kind), _) => return Err(unknown(kind, "float")),
    };
    let is_zero = !text
        .bytes()
        .take_while(|byte| !matches!(byte, b'e' | b'E'))
        .any(|byte| matches!(byte, b'1'..=b'9'))
        && magnitude.is_finite();
    let is_negative =
        float.is_sign_negative() && !float.is_nan() && !(spec.no_negative_zero && is_zero);
    let whole = text.bytes().take_while(u8::is_ascii_digit).count();
    if whole == 0 {
        // inf and nan have no digits to group.
        return number_text(
            is_negative,
            "",
            "",
            &text,
            3,
            &Spec { grouping: None, ..spec.clone() },
            budget,
        );
    }
    number_text(is_negative, "", &text[..whole], &text[whole..], 3, spec, budget)
}

/// `%e`, `%f` or `%g` of a float; an upper case letter gives an upper case exponent.
pub(super) fn float_text(float: f64, kind: char, precision: usize, alternate: bool) -> String {
    let text = match kind.to_ascii_lowercase() {
        'e' => format_float::scientific(float, precision, alternate),
        'f' => format_float::fixed(float, precision, alternate),
        _ => format_float::general(float, precision, alternate),
    };
    if kind.is_ascii_uppercase() { text.to_ascii_uppercase() } else { text }
}

/// Sign, prefix, grouped digits and suffix, padded to the width.
fn number_text(
    is_negative: bool,
    prefix: &str,
    digits: &str,
    rest: &str,
    group: usize,
    spec: &Spec,
    budget: &mut Budget,
) -> Outcome<String> {
    let sign = match (is_negative, spec.sign) {
        (true, _) => "-",
        (false, Some('+')) => "+",
        (false, Some(' ')) => " ",
        _ => "",
    };
    let fills_inside = matches!(spec.align, Some('=' | '0'));
    let mut body = digits.to_owned();
    if let Some(separator) = spec.grouping {
        let others = sign.len() + prefix.len() + rest.len();
        if fills_inside && spec.fill == Some('0') {
            // Zeros are grouped like other digits. The text may exceed the width by one, so that it never
            // starts with a separator.
            budget.allocate(spec.width as u128 * 2)?;
            let wanted = spec.width.saturating_sub(others);
            let fewest = wanted - wanted / (group + 1);
            let separators = fewest.saturating_sub(1) / group;
            let needed = if fewest + separators < wanted { fewest + 1 } else { fewest };
            if body.len() < needed {
                body.insert_str(0, &"0".repeat(needed - body.len()));
            }
        }
        body = grouped(&body, separator, group);
    }
    let head = format!("{sign}{prefix}");
    let tail = format!("{body}{rest}");
    if !fills_inside {
        return pad(&(head + &tail), spec, '>', budget);
    }
    let missing = spec.width.saturating_sub(head.len() + tail.len());
    let fill = spec.fill.unwrap_or(' ');
    budget.allocate(missing as u128 * fill.len_utf8() as u128 + tail.len() as u128)?;
    Ok(head + &std::iter::repeat_n(fill, missing).collect::<String>() + &tail)
}

fn grouped(digits: &str, separator: char, group: usize) -> String {
    let mut result = String::with_capacity(digits.len() * 2);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(group) {
            result.push(separator);
        }
        result.push(digit);
    }
    result
}

/// Number formatted by `%d`.
pub(super) fn whole(value: &Value) -> Outcome<i128> {
    match value.number() {
        Some(Number::Int(int)) => Ok(int),
        Some(Number::Float(float)) => super::number::truncate(float),
        None => {
            Err(ExpressionError::new(format!("`%d` needs a number, not `{}`", value.type_name()))
                .with_help("use `%s` for text"))
        }
    }
}
