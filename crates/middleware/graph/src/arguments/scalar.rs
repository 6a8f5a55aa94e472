//! Parameter values as YAML, and back.
//!
//! Source of the type of a scalar: `get_value` in `rcl_yaml_param_parser/parse.c`.

use std::fmt::{self, Write as _};

use periplus_diagnostics::{Diagnostic, SourceMap};
use periplus_geometry::{decode_base64, encode_base64};
use periplus_msgs::rcl_interfaces::{ParameterType as Type, ParameterValue};
use periplus_yaml::{YamlNode, YamlValue};

/// Text that is not the value of a parameter. Its text completes the sentence "the value ...".
#[derive(Clone, Debug, PartialEq)]
pub enum InvalidParameter {
    /// The text is not YAML.
    Syntax(Box<Diagnostic>),
    /// The YAML is not a value of a parameter.
    Value(Box<Diagnostic>),
}

impl fmt::Display for InvalidParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Syntax(finding) => write!(f, "cannot be read: {}", finding.message),
            Self::Value(finding) => f.write_str(&finding.message),
        }
    }
}

impl std::error::Error for InvalidParameter {}

/// Parses a parameter value as written after `-p name:=` or for `ros2 param set`.
///
/// # Errors
/// When the text is not a value.
pub fn parameter_from_yaml(text: &str) -> Result<ParameterValue, InvalidParameter> {
    let mut sources = SourceMap::new();
    let file = sources.add("value", text);
    match periplus_yaml::parse(file, &sources) {
        Ok(Some(node)) => value(&node).map_err(InvalidParameter::Value),
        // An empty text, quoted or not, is an empty string.
        Ok(None) => Ok(of_text(String::new())),
        Err(wrong) => Err(InvalidParameter::Syntax(wrong)),
    }
}

/// Converts the value of a YAML node. The message of the finding is the rest of the sentence "the
/// value ...".
pub(super) fn value(node: &YamlNode) -> Result<ParameterValue, Box<Diagnostic>> {
    let fail = |message: &str| Box::new(Diagnostic::error("bad-parameter", message).at(node.span));
    match &node.value {
        YamlValue::Scalar { .. } if node.is_null() => {
            Err(fail("is null; write `\"\"` for an empty string"))
        }
        YamlValue::Scalar { .. } if node.is_binary => {
            bytes(node).map(of_bytes).ok_or_else(|| fail(NO_BASE64))
        }
        YamlValue::Scalar { text, is_plain } => Ok(scalar(text, *is_plain)),
        YamlValue::List(items) => list(items).map_err(|(at, wrong)| {
            Box::new(Diagnostic::error("bad-parameter", wrong).at(at.map_or(node.span, |n| n.span)))
        }),
        YamlValue::Map(_) => Err(fail("is a mapping; a parameter is one value or a list")),
    }
}

fn scalar(text: &str, is_plain: bool) -> ParameterValue {
    if !is_plain {
        return of_text(text.to_owned());
    }
    if let Some(bool_value) = truth(text) {
        return ParameterValue { r#type: Type::PARAMETER_BOOL, bool_value, ..Default::default() };
    }
    if let Some(integer_value) = integer(text) {
        let r#type = Type::PARAMETER_INTEGER;
        return ParameterValue { r#type, integer_value, ..Default::default() };
    }
    if let Some(double_value) = number(text) {
        let r#type = Type::PARAMETER_DOUBLE;
        return ParameterValue { r#type, double_value, ..Default::default() };
    }
    of_text(text.to_owned())
}

/// Decodes a scalar with the tag `!!binary`, which may span several lines.
fn bytes(node: &YamlNode) -> Option<Vec<u8>> {
    let letters: String = node.text()?.split_ascii_whitespace().collect();
    decode_base64(&letters)
}

/// Message for invalid base64, the rest of the sentence "the value ...".
const NO_BASE64: &str =
    "has the tag `!!binary` and is not base64; write `!!binary AQ==` for the byte 1";

fn of_bytes(byte_array_value: Vec<u8>) -> ParameterValue {
    ParameterValue { r#type: Type::PARAMETER_BYTE_ARRAY, byte_array_value, ..Default::default() }
}

fn of_text(string_value: String) -> ParameterValue {
    ParameterValue { r#type: Type::PARAMETER_STRING, string_value, ..Default::default() }
}

fn truth(text: &str) -> Option<bool> {
    match text {
        "y" | "Y" | "yes" | "Yes" | "YES" | "true" | "True" | "TRUE" | "on" | "On" | "ON" => {
            Some(true)
        }
        "n" | "N" | "no" | "No" | "NO" | "false" | "False" | "FALSE" | "off" | "Off" | "OFF" => {
            Some(false)
        }
        _ => None,
    }
}

/// Parses decimal, `0x` hexadecimal, or octal after a zero, as `strtol` does.
fn integer(text: &str) -> Option<i64> {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    if !digits.starts_with(|first: char| first.is_ascii_digit()) {
        return None;
    }
    let hex = digits.strip_prefix("0x").or(digits.strip_prefix("0X"));
    let (digits, radix) = match hex {
        Some(hex) => (hex, 16),
        None if digits.len() > 1 && digits.starts_with('0') => (&digits[1..], 8),
        None => (digits, 10),
    };
    let size = i128::from_str_radix(digits, radix).ok()?;
    i64::try_from(sign * size).ok()
}

fn number(text: &str) -> Option<f64> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    match unsigned {
        ".inf" | ".Inf" | ".INF" if text.starts_with('-') => return Some(f64::NEG_INFINITY),
        ".inf" | ".Inf" | ".INF" => return Some(f64::INFINITY),
        ".nan" | ".NaN" | ".NAN" => return Some(f64::NAN),
        _ => {}
    }
    // Rust also parses "inf" and "nan", which are strings here.
    let is_number = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    text.parse().ok().filter(|_| is_number)
}

fn list(items: &[YamlNode]) -> Result<ParameterValue, (Option<&YamlNode>, String)> {
    if !items.is_empty() && items.iter().all(|item| item.is_binary) {
        let mut all = Vec::new();
        for item in items {
            all.extend(bytes(item).ok_or_else(|| (Some(item), NO_BASE64.to_owned()))?);
        }
        return Ok(of_bytes(all));
    }
    let mut all = ParameterValue::default();
    for (index, item) in items.iter().enumerate() {
        let YamlValue::Scalar { text, is_plain } = &item.value else {
            return Err((
                Some(item),
                "is a list of lists or mappings; the items must be values".into(),
            ));
        };
        if item.is_binary {
            let wrong = "is a list in which some items are `!!binary` and others are not";
            return Err((Some(item), wrong.into()));
        }
        let one = scalar(text, *is_plain);
        if index > 0 && all.r#type != list_type(one.r#type) {
            let wrong = format!(
                "is a list of {} with {} in it; all must be of one type{}",
                kind(all.r#type - list_type(0)),
                article(one.r#type),
                if one.r#type == Type::PARAMETER_INTEGER
                    && all.r#type == Type::PARAMETER_DOUBLE_ARRAY
                {
                    format!(": write `{text}.0`")
                } else {
                    String::new()
                }
            );
            return Err((Some(item), wrong));
        }
        all.r#type = list_type(one.r#type);
        match one.r#type {
            Type::PARAMETER_BOOL => all.bool_array_value.push(one.bool_value),
            Type::PARAMETER_INTEGER => all.integer_array_value.push(one.integer_value),
            Type::PARAMETER_DOUBLE => all.double_array_value.push(one.double_value),
            _ => all.string_array_value.push(one.string_value),
        }
    }
    if items.is_empty() {
        return Err((None, "is an empty list, whose item type is unknown".into()));
    }
    Ok(all)
}

/// Type of a list of values of a type: 6 for bool (1), and so on.
fn list_type(one: u8) -> u8 {
    one + (Type::PARAMETER_BOOL_ARRAY - Type::PARAMETER_BOOL)
}

fn kind(one: u8) -> &'static str {
    match one {
        Type::PARAMETER_BOOL => "booleans",
        Type::PARAMETER_INTEGER => "integers",
        Type::PARAMETER_DOUBLE => "numbers",
        _ => "texts",
    }
}

fn article(one: u8) -> &'static str {
    match one {
        Type::PARAMETER_BOOL => "a boolean",
        Type::PARAMETER_INTEGER => "an integer",
        Type::PARAMETER_DOUBLE => "a number",
        _ => "a string",
    }
}

/// Formats a value as YAML that [`parameter_from_yaml`] parses to the same value; a value that is
/// not set is `null`.
#[must_use]
pub fn parameter_to_yaml(value: &ParameterValue) -> String {
    fn list<T>(items: &[T], one: impl Fn(&T) -> String) -> String {
        let items: Vec<String> = items.iter().map(one).collect();
        format!("[{}]", items.join(", "))
    }
    match value.r#type {
        Type::PARAMETER_BOOL => value.bool_value.to_string(),
        Type::PARAMETER_INTEGER => value.integer_value.to_string(),
        Type::PARAMETER_DOUBLE => of_number(value.double_value),
        Type::PARAMETER_STRING => quoted(&value.string_value),
        // A list of single bytes, as `ros2 param dump` writes them; an empty one has no type.
        Type::PARAMETER_BYTE_ARRAY if value.byte_array_value.is_empty() => "!!binary \"\"".into(),
        Type::PARAMETER_BYTE_ARRAY => list(&value.byte_array_value, |byte| {
            format!("!!binary \"{}\"", encode_base64(&[*byte]))
        }),
        Type::PARAMETER_BOOL_ARRAY => list(&value.bool_array_value, bool::to_string),
        Type::PARAMETER_INTEGER_ARRAY => list(&value.integer_array_value, i64::to_string),
        Type::PARAMETER_DOUBLE_ARRAY => list(&value.double_array_value, |one| of_number(*one)),
        Type::PARAMETER_STRING_ARRAY => list(&value.string_array_value, |one| quoted(one)),
        _ => "null".into(),
    }
}

fn of_number(number: f64) -> String {
    if number.is_nan() {
        ".nan".into()
    } else if number.is_infinite() {
        if number > 0.0 { ".inf" } else { "-.inf" }.into()
    } else {
        // YAML 1.1 accepts an exponent only with a decimal point and a sign.
        let text = format!("{number:?}");
        let Some((digits, exponent)) = text.split_once('e') else { return text };
        let point = if digits.contains('.') { "" } else { ".0" };
        let (sign, size) = exponent.strip_prefix('-').map_or(('+', exponent), |size| ('-', size));
        format!("{digits}{point}e{sign}{size:0>2}")
    }
}

/// Plain where that is unambiguous; otherwise quoted.
fn quoted(text: &str) -> String {
    let is_word = |c: char| c.is_alphanumeric() || "_-/.".contains(c);
    let is_plain = text.starts_with(|c: char| c.is_alphabetic() || "_/".contains(c))
        && text.chars().all(is_word)
        && scalar(text, true).r#type == Type::PARAMETER_STRING
        && !matches!(text, "null" | "Null" | "NULL");
    if is_plain {
        return text.to_owned();
    }
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => {
                out.push('\\');
                out.push(letter);
            }
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            letter if letter.is_control() || "\u{85}\u{2028}\u{2029}\u{feff}".contains(letter) => {
                let _ = write!(out, "\\U{:08X}", u32::from(letter));
            }
            letter => out.push(letter),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn words_mean_what_rcl_takes_them_for() {
        let check = |text: &str, expected: &str| {
            let read = parameter_from_yaml(text);
            let shown = read.map(|value| format!("{} {}", value.r#type, parameter_to_yaml(&value)));
            assert_eq!(shown.unwrap_or_else(|wrong| wrong.to_string()), expected, "{text}");
        };
        check("5", "2 5");
        check("-0x10", "2 -16");
        check("010", "2 8");
        check("5.", "3 5.0");
        check("1e3", "3 1000.0");
        check("-.inf", "3 -.inf");
        check("99999999999999999999", "3 1.0e+20");
        check("1e-9", "3 1.0e-09");
        check("-2.5e-7", "3 -2.5e-07");
        check("1.5e300", "3 1.5e+300");
        check("inf", "4 inf");
        check("yes", "1 true");
        check("Off", "1 false");
        check("'5'", "4 \"5\"");
        check("base link", "4 \"base link\"");
        check("", "4 \"\"");
        check("[1, 2]", "7 [1, 2]");
        check("[1.0, .nan]", "8 [1.0, .nan]");
        check("[a, 'b c']", "9 [a, \"b c\"]");
        check("[true, no]", "6 [true, false]");
        check(
            "[1.5, 2]",
            "is a list of numbers with an integer in it; all must be of one type: write `2.0`",
        );
        check("[!!binary AQ==, !!binary /w==]", "5 [!!binary \"AQ==\", !!binary \"/w==\"]");
        check("!!binary |\n  Af8=\n", "5 [!!binary \"AQ==\", !!binary \"/w==\"]");
        check("!!binary ''", "5 !!binary \"\"");
        check("!!binary '*'", NO_BASE64);
        check(
            "[!!binary AQ==, 2]",
            "is a list in which some items are `!!binary` and others are not",
        );
        check("[]", "is an empty list, whose item type is unknown");
        check("{a: 1}", "is a mapping; a parameter is one value or a list");
        check("~", "is null; write `\"\"` for an empty string");
    }

    proptest! {
        #[test]
        fn texts_come_back(text in "\\PC{0,12}|[a-z0-9 :#'\"\\\\\n\t,\\[\\]{}&*!|>%@-]{0,12}") {
            let value = of_text(text);
            let yaml = parameter_to_yaml(&value);
            prop_assert_eq!(parameter_from_yaml(&yaml), Ok(value), "{}", yaml);
        }

        #[test]
        fn bytes_come_back(bytes in any::<Vec<u8>>()) {
            let value = of_bytes(bytes);
            let yaml = parameter_to_yaml(&value);
            prop_assert_eq!(parameter_from_yaml(&yaml), Ok(value), "{}", yaml);
        }

        #[test]
        fn numbers_come_back(bits in any::<u64>()) {
            let double_value = f64::from_bits(bits);
            let value = ParameterValue { r#type: 3, double_value, ..Default::default() };
            let back = parameter_from_yaml(&parameter_to_yaml(&value)).unwrap();
            prop_assert_eq!(back.r#type, 3);
            let same = back.double_value.to_bits() == bits
                || double_value.is_nan() && back.double_value.is_nan();
            prop_assert!(same, "{} {}", double_value, back.double_value);
        }
    }
}
