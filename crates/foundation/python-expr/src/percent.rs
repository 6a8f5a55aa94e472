//! `'%s_wheel %.3f' % (side, radius)`.

use super::budget::Budget;
use super::error::{ExpressionError, Outcome, fail};
use super::format_spec::{Spec, float_text, pad, whole};
use super::text::to_ascii;
use super::value::Value;

struct Values<'a> {
    all: &'a [Value],
    used: usize,
}

impl<'a> Values<'a> {
    fn next(&mut self) -> Outcome<&'a Value> {
        let value = self.all.get(self.used).ok_or_else(|| {
            ExpressionError::new("the text has more `%` fields than there are values")
        })?;
        self.used += 1;
        Ok(value)
    }

    fn next_count(&mut self) -> Outcome<i128> {
        self.next()?.integer()
    }
}

pub(super) fn format(template: &str, values: &Value, budget: &mut Budget) -> Outcome<String> {
    let single = std::slice::from_ref(values);
    let mut given = Values {
        all: if let Value::Tuple(items) = values { items.items() } else { single },
        used: 0,
    };
    let mut result = String::new();
    let mut letters = template.chars().peekable();
    budget.allocate(template.len() as u128)?;
    budget.scan(template.len())?;
    while let Some(letter) = letters.next() {
        if letter != '%' {
            result.push(letter);
            continue;
        }
        let mut keyed = None;
        if letters.next_if_eq(&'(').is_some() {
            let mut open = 1;
            let mut key = String::new();
            for letter in letters.by_ref() {
                match letter {
                    '(' => open += 1,
                    ')' => open -= 1,
                    _ => {}
                }
                if open == 0 {
                    break;
                }
                key.push(letter);
            }
            let Value::Dict(dict) = values else {
                return fail("`%(name)` needs a dict on the right");
            };
            let value = dict.get_text(&key).ok_or_else(|| {
                ExpressionError::new(format!("the dict has no key '{}'", key.escape_debug()))
            })?;
            keyed = Some(value);
        }
        let mut spec = Spec::default();
        let mut zeros = false;
        let mut left = false;
        while let Some(flag) =
            letters.next_if(|letter| matches!(letter, '-' | '+' | ' ' | '#' | '0'))
        {
            match flag {
                '-' => left = true,
                '+' => spec.sign = Some('+'),
                ' ' => spec.sign = spec.sign.or(Some(' ')),
                '#' => spec.alternate = true,
                _ => zeros = true,
            }
        }
        let mut width = count(&mut letters, &mut given)?.unwrap_or(0);
        if width < 0 {
            left = true;
            width = width.saturating_neg();
        }
        spec.width = usize::try_from(width).unwrap_or(usize::MAX);
        let mut precision = None;
        if letters.next_if_eq(&'.').is_some() {
            let count = count(&mut letters, &mut given)?.unwrap_or(0).max(0);
            precision = Some(usize::try_from(count).unwrap_or(usize::MAX));
        }
        letters.next_if(|letter| matches!(letter, 'h' | 'l' | 'L'));
        let Some(kind) = letters.next() else {
            return Err(ExpressionError::new("the text ends inside a `%` field")
                .with_help("write a percent sign as `%%`"));
        };
        if kind == '%' {
            result.push('%');
            continue;
        }
        let value = match keyed {
            Some(value) => value,
            None => given.next()?,
        };
        spec.align = left.then_some('<');
        let field = field(kind, value, precision, zeros && !left, &spec, budget)?;
        result.push_str(&field);
    }
    if given.used < given.all.len()
        && !matches!(values, Value::Dict(_) | Value::List(_) | Value::Range(_))
    {
        return fail("there are more values than `%` fields in the text");
    }
    Ok(result)
}

/// Digits, or `*` for the next value.
fn count(
    letters: &mut std::iter::Peekable<std::str::Chars<'_>>,
    given: &mut Values<'_>,
) -> Outcome<Option<i128>> {
    if letters.next_if_eq(&'*').is_some() {
        return given.next_count().map(Some);
    }
    let mut digits = String::new();
    while let Some(digit) = letters.next_if(char::is_ascii_digit) {
        digits.push(digit);
    }
    if digits.is_empty() {
        Ok(None)
    } else {
        digits.parse().map(Some).map_err(|_| ExpressionError::new("too many digits in a `%` field"))
    }
}

fn field(
    kind: char,
    value: &Value,
    precision: Option<usize>,
    zeros: bool,
    spec: &Spec,
    budget: &mut Budget,
) -> Outcome<String> {
    let (is_negative, prefix, digits) = match kind {
        's' | 'r' | 'a' => {
            let text = match kind {
                's' => value.to_text(budget)?,
                'r' => value.to_repr(budget)?,
                _ => to_ascii(&value.to_repr(budget)?),
            };
            let shown: String = text.chars().take(precision.unwrap_or(usize::MAX)).collect();
            return pad(&shown, spec, '>', budget);
        }
        'c' => {
            let letter = match value {
                Value::Str(text) if text.chars().count() == 1 => text.to_string(),
                Value::Int(int) => match u32::try_from(*int).ok().and_then(char::from_u32) {
                    Some(letter) => letter.to_string(),
                    None => return fail(format!("{int} is not the code of a character")),
                },
                _ => return fail(format!("`%c` needs a character, not `{}`", value.type_name())),
            };
            return pad(&letter, spec, '>', budget);
        }
        'd' | 'i' | 'u' => {
            let int = whole(value)?;
            (int < 0, "", int.unsigned_abs().to_string())
        }
        'o' | 'x' | 'X' => {
            let Ok(int) = value.integer() else {
                return fail(format!("`%{kind}` needs an integer, not `{}`", value.type_name()));
            };
            let magnitude = int.unsigned_abs();
            match kind {
                'o' => (int < 0, "0o", format!("{magnitude:o}")),
                'x' => (int < 0, "0x", format!("{magnitude:x}")),
                _ => (int < 0, "0X", format!("{magnitude:X}")),
            }
        }
        'e' | 'E' | 'f' | 'F' | 'g' | 'G' => {
            let Ok(float) = value.real() else {
                return Err(ExpressionError::new(format!(
                    "`%{kind}` needs a number, not `{}`",
                    value.type_name()
                ))
                .with_help("use `%s` for text, or float(...)"));
            };
            let precision = precision.unwrap_or(6);
            budget.allocate(precision as u128 * 3 + 400)?;
            (
                float.is_sign_negative() && !float.is_nan(),
                "",
                float_text(float.abs(), kind, precision, spec.alternate),
            )
        }
        _ => {
            return Err(ExpressionError::new(format!("`%{kind}` is not a format"))
                .with_help("write a percent sign as `%%`"));
        }
    };
    let is_int = !matches!(kind, 'e' | 'E' | 'f' | 'F' | 'g' | 'G');
    // For an integer the precision is the minimum number of digits.
    let missing_digits =
        if is_int { precision.unwrap_or(0).saturating_sub(digits.len()) } else { 0 };
    budget.allocate(missing_digits as u128)?;
    let digits = "0".repeat(missing_digits) + &digits;
    let sign = match (is_negative, spec.sign) {
        (true, _) => "-",
        (false, Some('+')) => "+",
        (false, Some(_)) => " ",
        _ => "",
    };
    let head = format!("{sign}{}", if spec.alternate { prefix } else { "" });
    if zeros {
        let missing = spec.width.saturating_sub(head.len() + digits.len());
        budget.allocate(missing as u128)?;
        return Ok(head + &"0".repeat(missing) + &digits);
    }
    pad(&(head + &digits), spec, '>', budget)
}
