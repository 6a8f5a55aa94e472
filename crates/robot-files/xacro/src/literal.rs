//! Values of texts without expressions, and truth values.

use periplus_python_expr::Value;

/// Value of a text: a number, a truth value, or the text itself. Single quotes mark a string and are
/// removed. A text with an underscore is a string too, although Python would accept it in a number.
pub(crate) fn literal(text: &str) -> Value {
    if text.len() >= 2 && text.starts_with('\'') && text.ends_with('\'') {
        return Value::text(&text[1..text.len() - 1]);
    }
    if text.contains('_') {
        return Value::text(text);
    }
    let trimmed = text.trim();
    if let Ok(int) = trimmed.parse::<i128>() {
        return Value::Int(int);
    }
    // Rust's parser accepts the same texts as Python's `float`.
    if let Ok(float) = trimmed.parse::<f64>() {
        return Value::Float(float);
    }
    match text {
        "true" | "True" => Value::Bool(true),
        "false" | "False" => Value::Bool(false),
        _ => Value::text(text),
    }
}

/// Converts a string that is a number or a truth value; returns other values unchanged.
pub(crate) fn typed(value: Value) -> Value {
    match value {
        Value::Str(text) => literal(&text),
        other => other,
    }
}

/// Value of an argument in `$(eval ...)`, which has its own rules: a number with a point is a float, one
/// without is an integer or (`1e3`) a string.
pub(crate) fn automatic(text: &str) -> Value {
    let trimmed = text.trim();
    let number = if text.contains('.') {
        trimmed.parse().ok().map(Value::Float)
    } else {
        trimmed.parse().ok().map(Value::Int)
    };
    number.unwrap_or_else(|| {
        if text.eq_ignore_ascii_case("true") {
            Value::Bool(true)
        } else if text.eq_ignore_ascii_case("false") {
            Value::Bool(false)
        } else {
            Value::text(text)
        }
    })
}

/// Truth of a condition: `true`, `True`, `false`, `False`, an integer, or for values other than strings
/// Python's truth value. `None` for anything else.
pub(crate) fn condition(value: &Value) -> Option<bool> {
    match value {
        Value::Str(text) => match &**text {
            "true" | "True" => Some(true),
            "false" | "False" => Some(false),
            other => other.trim().parse::<i128>().ok().map(|int| int != 0),
        },
        other => Some(other.is_true()),
    }
}

/// Returns true if a property may have this name: a Python identifier that is not a keyword.
pub(crate) fn is_name(name: &str) -> bool {
    const KEYWORDS: &[&str] = &[
        "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class",
        "continue", "def", "del", "elif", "else", "except", "finally", "for", "from", "global",
        "if", "import", "in", "is", "lambda", "nonlocal", "not", "or", "pass", "raise", "return",
        "try", "while", "with", "yield",
    ];
    let mut characters = name.chars();
    characters.next().is_some_and(|first| first.is_alphabetic() || first == '_')
        && characters.all(|other| other.is_alphanumeric() || other == '_')
        && !KEYWORDS.contains(&name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_become_numbers_and_truths() {
        assert!(matches!(literal("12"), Value::Int(12)));
        assert!(matches!(literal(" 0.5 "), Value::Float(value) if value == 0.5));
        assert!(matches!(literal("True"), Value::Bool(true)));
        assert!(matches!(literal("'12'"), Value::Str(text) if &*text == "12"));
        assert!(matches!(literal("1_000"), Value::Str(_)));
        assert!(matches!(literal(""), Value::Str(_)));
    }

    #[test]
    fn conditions() {
        let text = |text: &str| condition(&Value::text(text));
        assert_eq!(text("true"), Some(true));
        assert_eq!(text("0"), Some(false));
        assert_eq!(text("yes"), None);
        assert_eq!(condition(&Value::Float(0.0)), Some(false));
    }

    #[test]
    fn names() {
        assert!(is_name("wheel_radius2") && is_name("größe"));
        assert!(!is_name("2x") && !is_name("lambda") && !is_name("a.b") && !is_name(""));
    }
}
