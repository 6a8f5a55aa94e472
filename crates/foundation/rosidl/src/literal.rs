//! Values of constants and defaults.

use crate::{ArrayShape, ElementType, Scalar, Type};

/// Value as written, already in the range of its type.
#[derive(Clone, Debug, PartialEq)]
pub enum Literal {
    /// `true` or `false`.
    Bool(bool),
    /// An integer.
    Int(i128),
    /// Floating-point number; NaN is never equal to itself.
    Float(f64),
    /// Text.
    Text(String),
    /// The elements of an array.
    List(Vec<Self>),
}

impl Eq for Literal {}

/// Parses a value of a type.
///
/// # Errors
/// Expected input, to be placed after "expected".
pub(crate) fn read(text: &str, r#type: &Type) -> Result<Literal, String> {
    if r#type.shape == ArrayShape::One {
        return read_one(text, &r#type.element);
    }
    let inner = text.strip_prefix('[').and_then(|text| text.strip_suffix(']'));
    let inner = inner.ok_or("values in square brackets, such as `[1, 2, 3]`")?;
    let items = split(inner)?;
    let list: Result<Vec<_>, _> =
        items.iter().map(|item| read_one(item, &r#type.element)).collect();
    let list = list?;
    let count = list.len() as u64;
    match r#type.shape {
        ArrayShape::Fixed(size) if count != size => Err(format!("{size} values, not {count}")),
        ArrayShape::Bounded(bound) if count > bound => {
            Err(format!("at most {bound} values, not {count}"))
        }
        _ => Ok(Literal::List(list)),
    }
}

pub(crate) fn read_one(text: &str, element: &ElementType) -> Result<Literal, String> {
    match element {
        ElementType::Scalar(Scalar::Bool) => match text.to_ascii_lowercase().as_str() {
            "true" | "1" => Ok(Literal::Bool(true)),
            "false" | "0" => Ok(Literal::Bool(false)),
            _ => Err("`true` or `false`".into()),
        },
        ElementType::Scalar(scalar @ (Scalar::F32 | Scalar::F64)) => {
            let value = text.parse::<f64>().map_err(|_| "a number, such as `0.5`".to_owned())?;
            // A value beyond the range of a float32 would become infinite.
            #[allow(clippy::cast_possible_truncation, reason = "that is the question")]
            let lost = *scalar == Scalar::F32 && value.is_finite() && !(value as f32).is_finite();
            if lost {
                Err("a number that a float32 can hold".into())
            } else {
                Ok(Literal::Float(value))
            }
        }
        ElementType::Scalar(scalar) => {
            let (least, most) = scalar.range().unwrap_or((0, 0));
            let expected = || format!("a whole number from {least} to {most}");
            let value = whole_number(text).ok_or_else(expected)?;
            if value < least || value > most { Err(expected()) } else { Ok(Literal::Int(value)) }
        }
        ElementType::String(bound) | ElementType::WString(bound) => {
            let value = unquote(text)?;
            let length = value.len() as u64;
            match bound {
                Some(bound) if length > *bound => {
                    Err(format!("at most {bound} characters, not {length}"))
                }
                _ => Ok(Literal::Text(value)),
            }
        }
        ElementType::Nested(_) => Err("no value: only simple types have defaults".into()),
    }
}

/// Parses like Python's `int(text, base=0)`.
fn whole_number(text: &str) -> Option<i128> {
    let (negative, digits) = match text.as_bytes().first()? {
        b'-' => (true, &text[1..]),
        b'+' => (false, &text[1..]),
        _ => (false, text),
    };
    if digits.starts_with(['-', '+']) {
        return None;
    }
    let lower = digits.to_ascii_lowercase();
    let (base, digits) = match lower.get(..2) {
        Some("0x") => (16, &lower[2..]),
        Some("0o") => (8, &lower[2..]),
        Some("0b") => (2, &lower[2..]),
        _ => (10, lower.as_str()),
    };
    let value =
        i128::from_str_radix(digits, base).ok().filter(|_| !digits.starts_with(['-', '+']))?;
    Some(if negative { -value } else { value })
}

/// Text with or without quotes around it.
fn unquote(text: &str) -> Result<String, String> {
    let Some(quote) = text.chars().next().filter(|c| ['"', '\''].contains(c)) else {
        return Ok(text.into());
    };
    let inner = text[1..].strip_suffix(quote).ok_or("a closing quote")?;
    let mut value = String::new();
    let mut characters = inner.chars();
    while let Some(character) = characters.next() {
        match character {
            '\\' => match characters.next() {
                Some('n') => value.push('\n'),
                Some('t') => value.push('\t'),
                Some('r') => value.push('\r'),
                Some(same @ ('\\' | '"' | '\'')) => value.push(same),
                Some(other) => value.extend(['\\', other]),
                None => return Err("something after the last `\\`".into()),
            },
            character if character == quote => {
                return Err(format!("`\\{quote}` for a quote inside of quotes"));
            }
            character => value.push(character),
        }
    }
    Ok(value)
}

/// Splits at commas outside of quotes.
fn split(text: &str) -> Result<Vec<&str>, String> {
    let mut items = Vec::new();
    let mut start = 0;
    let mut quote = None;
    let mut escaped = false;
    for (at, character) in text.char_indices() {
        match quote {
            Some(_) if escaped => escaped = false,
            Some(_) if character == '\\' => escaped = true,
            Some(open) if character == open => quote = None,
            None if ['"', '\''].contains(&character) => quote = Some(character),
            None if character == ',' => {
                items.push(text[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    if quote.is_some() {
        return Err("a closing quote".into());
    }
    let last = text[start..].trim();
    if !last.is_empty() {
        items.push(last);
    } else if !items.is_empty() {
        return Err("a value after the last comma".into());
    }
    Ok(items)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, element: ElementType, shape: ArrayShape, expected: Result<Literal, &str>) {
        let read = read(text, &Type { element, shape });
        assert_eq!(read, expected.map_err(String::from), "{text}");
    }

    #[test]
    fn numbers_keep_to_their_range() {
        let u8 = || ElementType::Scalar(Scalar::U8);
        check("255", u8(), ArrayShape::One, Ok(Literal::Int(255)));
        check("0x1F", u8(), ArrayShape::One, Ok(Literal::Int(31)));
        check("256", u8(), ArrayShape::One, Err("a whole number from 0 to 255"));
        check("-1", u8(), ArrayShape::One, Err("a whole number from 0 to 255"));
        check(
            "--1",
            ElementType::Scalar(Scalar::I8),
            ArrayShape::One,
            Err("a whole number from -128 to 127"),
        );
        check("-2", ElementType::Scalar(Scalar::I8), ArrayShape::One, Ok(Literal::Int(-2)));
        check(
            "1e39",
            ElementType::Scalar(Scalar::F32),
            ArrayShape::One,
            Err("a number that a float32 can hold"),
        );
        check("1e39", ElementType::Scalar(Scalar::F64), ArrayShape::One, Ok(Literal::Float(1e39)));
        check("True", ElementType::Scalar(Scalar::Bool), ArrayShape::One, Ok(Literal::Bool(true)));
    }

    #[test]
    fn lists_and_quotes() {
        let text = |text: &str| Literal::Text(text.into());
        let strings = ElementType::String(None);
        let both = vec![text("a,b"), text("it's")];
        check(
            r#"["a,b", "it's"]"#,
            strings.clone(),
            ArrayShape::Unbounded,
            Ok(Literal::List(both)),
        );
        check("[]", strings.clone(), ArrayShape::Unbounded, Ok(Literal::List(Vec::new())));
        check(
            "[1, 2]",
            ElementType::Scalar(Scalar::U8),
            ArrayShape::Fixed(3),
            Err("3 values, not 2"),
        );
        check(
            "[1, ]",
            ElementType::Scalar(Scalar::U8),
            ArrayShape::Unbounded,
            Err("a value after the last comma"),
        );
        check("'a", strings.clone(), ArrayShape::One, Err("a closing quote"));
        check(r#""say \"é\"""#, strings, ArrayShape::One, Ok(text("say \"é\"")));
        check(
            "abcd",
            ElementType::String(Some(3)),
            ArrayShape::One,
            Err("at most 3 characters, not 4"),
        );
    }
}
