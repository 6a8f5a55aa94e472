//! YAML loader with the rules of the reference: PyYAML's safe loader (YAML 1.1) and xacro's unit tags.
//!
//! The rules by which a plain scalar is a number or a truth value differ between YAML versions (`yes`,
//! `010`, `1e5`); this module implements those of PyYAML's resolver.

use std::borrow::Cow;
use std::collections::BTreeMap;

use saphyr_parser::{Event, Parser, ScalarStyle, Tag};

use periplus_python_expr::Value;

/// Maximum nesting depth of lists and mappings.
const MAX_DEPTH: usize = 60;

/// Maximum number of values in a file; each use of an alias counts.
const MAX_VALUES: usize = 1_000_000;

/// Reason that a YAML text has no value.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct YamlError {
    /// Description of the fault.
    pub(crate) message: String,
    /// Line, from 1.
    pub(crate) line: usize,
    /// Column, from 1.
    pub(crate) column: usize,
}

/// Loads the first document of a text. `evaluate` computes the expression behind a unit tag: `!degrees
/// 90/2`.
pub(crate) fn load(
    text: &str,
    evaluate: &mut dyn FnMut(&str) -> Result<f64, String>,
) -> Result<Value, YamlError> {
    let mut loader = Loader {
        parser: Parser::new_from_str(text),
        anchors: BTreeMap::new(),
        values: 0,
        evaluate,
    };
    loop {
        match loader.next()?.0 {
            Event::DocumentStart(_) => {
                let (event, line, column) = loader.next()?;
                return loader.value(event, (line, column), 0);
            }
            Event::StreamEnd => return Ok(Value::None),
            _ => {}
        }
    }
}

struct Loader<'t, 'e> {
    parser: Parser<'t, saphyr_parser::StrInput<'t>>,
    anchors: BTreeMap<usize, (Value, usize)>,
    values: usize,
    evaluate: &'e mut dyn FnMut(&str) -> Result<f64, String>,
}

type Place = (usize, usize);

impl<'t> Loader<'t, '_> {
    fn next(&mut self) -> Result<(Event<'t>, usize, usize), YamlError> {
        match self.parser.next_event() {
            Some(Ok((event, span))) => Ok((event, span.start.line(), span.start.col() + 1)),
            Some(Err(error)) => Err(YamlError {
                message: format!("this is not YAML: {}", error.info()),
                line: error.marker().line(),
                column: error.marker().col() + 1,
            }),
            None => Ok((Event::StreamEnd, 1, 1)),
        }
    }

    fn value(&mut self, event: Event<'t>, place: Place, depth: usize) -> Result<Value, YamlError> {
        let fail = |message: String| YamlError { message, line: place.0, column: place.1 };
        self.values += 1;
        if depth > MAX_DEPTH || self.values > MAX_VALUES {
            return Err(fail("the file is nested too deeply or too large".into()));
        }
        let before = self.values;
        let (value, anchor) = match event {
            Event::Scalar(text, style, anchor, tag) => {
                (self.scalar(&text, style, tag.as_deref()).map_err(fail)?, anchor)
            }
            Event::SequenceStart(anchor, _) => {
                let mut items = Vec::new();
                loop {
                    match self.next()? {
                        (Event::SequenceEnd, ..) => break,
                        (event, line, column) => {
                            items.push(self.value(event, (line, column), depth + 1)?);
                        }
                    }
                }
                (Value::list(items).map_err(|error| fail(error.message))?, anchor)
            }
            Event::MappingStart(anchor, _) => {
                let entries = self.mapping(depth)?;
                (Value::dict(entries).map_err(|error| fail(error.message))?, anchor)
            }
            Event::Alias(anchor) => {
                let (value, size) =
                    self.anchors.get(&anchor).cloned().ok_or_else(|| {
                        fail("an alias names an anchor that is still open".into())
                    })?;
                self.values += size;
                (value, 0)
            }
            _ => return Err(fail("a value is missing here".into())),
        };
        if anchor != 0 {
            self.anchors.insert(anchor, (value.clone(), 1 + self.values - before));
        }
        Ok(value)
    }

    fn mapping(&mut self, depth: usize) -> Result<Vec<(Value, Value)>, YamlError> {
        let mut entries = Vec::new();
        let mut merged = Vec::new();
        loop {
            let (event, line, column) = self.next()?;
            if matches!(event, Event::MappingEnd) {
                break;
            }
            let is_merge =
                matches!(&event, Event::Scalar(text, ScalarStyle::Plain, _, None) if text == "<<");
            let key = self.value(event, (line, column), depth + 1)?;
            let (event, line, column) = self.next()?;
            let value = self.value(event, (line, column), depth + 1)?;
            if is_merge {
                merge(&value, &mut merged);
            } else {
                entries.push((key, value));
            }
        }
        // Merged entries come first, so that the mapping's own win.
        merged.extend(entries);
        Ok(merged)
    }

    fn scalar(
        &mut self,
        text: &str,
        style: ScalarStyle,
        tag: Option<&Tag>,
    ) -> Result<Value, String> {
        let Some(tag) = tag else {
            return Ok(if style == ScalarStyle::Plain { plain(text) } else { Value::text(text) });
        };
        let name = format!("{}{}", tag.handle, tag.suffix);
        let factor = match name.as_str() {
            "!radians" | "!meters" => 1.0,
            "!degrees" => std::f64::consts::PI / 180.0,
            "!millimeters" => 0.001,
            "!foot" => 0.3048,
            "!inches" => 0.0254,
            _ if tag.is_yaml_core_schema() => {
                return Ok(match tag.suffix.as_str() {
                    "str" => Value::text(text),
                    "float" => match plain(text) {
                        #[expect(clippy::cast_precision_loss, reason = "as Python's float() does")]
                        Value::Int(int) => Value::Float(int as f64),
                        other => other,
                    },
                    _ => plain(text),
                });
            }
            _ => {
                return Err(format!(
                    "`{name}` is not a tag; units are !radians, !degrees, !meters, !millimeters, !foot and !inches"
                ));
            }
        };
        Ok(Value::Float((self.evaluate)(text)? * factor))
    }
}

/// Merges `<<: *base` or `<<: [*a, *b]`; the first of several entries wins.
fn merge(value: &Value, into: &mut Vec<(Value, Value)>) {
    match value {
        Value::Dict(dict) => {
            into.extend(dict.entries().iter().cloned());
        }
        Value::List(list) => list.iter().rev().for_each(|item| merge(item, into)),
        _ => {}
    }
}

/// Value of a plain scalar by the rules of PyYAML's resolver.
fn plain(text: &str) -> Value {
    match text {
        "" | "~" | "null" | "Null" | "NULL" => return Value::None,
        "yes" | "Yes" | "YES" | "true" | "True" | "TRUE" | "on" | "On" | "ON" => {
            return Value::Bool(true);
        }
        "no" | "No" | "NO" | "false" | "False" | "FALSE" | "off" | "Off" | "OFF" => {
            return Value::Bool(false);
        }
        _ => {}
    }
    if let Some(int) = integer(text) {
        return Value::Int(int);
    }
    float(text).map_or_else(|| Value::text(text), Value::Float)
}

fn signed(text: &str) -> (i128, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    }
}

fn digits(text: &str, radix: u32) -> Option<i128> {
    let text: Cow<'_, str> =
        if text.contains('_') { text.replace('_', "").into() } else { text.into() };
    // `from_str_radix` would accept a second sign.
    if !text.chars().all(|digit| digit.is_digit(radix)) {
        return None;
    }
    i128::from_str_radix(&text, radix).ok()
}

fn integer(text: &str) -> Option<i128> {
    let (sign, rest) = signed(text);
    let value = if let Some(binary) = rest.strip_prefix("0b") {
        digits(binary, 2)
    } else if let Some(hex) = rest.strip_prefix("0x") {
        digits(hex, 16)
    } else if rest.len() > 1 && rest.starts_with('0') {
        digits(&rest[1..], 8)
    } else if !rest.starts_with(|first: char| first.is_ascii_digit()) {
        None
    } else if rest.contains(':') {
        rest.split(':').try_fold(0_i128, |sum, part| {
            sum.checked_mul(60)?.checked_add(digits(part, 10).filter(|_| !part.is_empty())?)
        })
    } else {
        digits(rest, 10)
    };
    value.map(|value| sign * value)
}

/// Parses a float. PyYAML needs a point, and a sign in the exponent: `1e5` is text.
fn float(text: &str) -> Option<f64> {
    let (sign, rest) = signed(text);
    #[expect(clippy::cast_precision_loss, reason = "the sign is 1 or -1")]
    let sign = sign as f64;
    match rest {
        ".inf" | ".Inf" | ".INF" => return Some(sign * f64::INFINITY),
        ".nan" | ".NaN" | ".NAN" => return Some(f64::NAN),
        _ => {}
    }
    let rest = rest.replace('_', "");
    let (mantissa, exponent) = match rest.find(['e', 'E']) {
        Some(at) => (&rest[..at], Some(&rest[at + 1..])),
        None => (rest.as_str(), None),
    };
    let (whole, fraction) = mantissa.split_once('.')?;
    let all_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let exponent_ok = exponent.is_none_or(|exponent| {
        exponent.strip_prefix(['+', '-']).is_some_and(|rest| !rest.is_empty() && all_digits(rest))
    });
    let well_formed = all_digits(whole)
        && all_digits(fraction)
        && (!whole.is_empty() || !fraction.is_empty())
        && exponent_ok;
    if !well_formed {
        return None;
    }
    rest.parse::<f64>().ok().map(|value| sign * value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &str) {
        let mut evaluate = |text: &str| text.parse::<f64>().map_err(|error| error.to_string());
        let shown = match load(text, &mut evaluate) {
            Ok(value) => value.to_repr(&mut periplus_python_expr::Budget::default()).unwrap(),
            Err(error) => format!("{}:{}: {}", error.line, error.column, error.message),
        };
        assert_eq!(shown, expected, "{text}");
    }

    // Expected values: PyYAML 6's `yaml.safe_load`.
    #[test]
    fn scalars_follow_yaml_1_1() {
        check("[yes, No, on, true, ~, ]", "[True, False, True, True, None]");
        check("[10, 010, 0x1F, 0b11, 1_000, 1:30]", "[10, 8, 31, 3, 1000, 90]");
        check("[1.5, 1e5, 1.0e+5, .5, -.inf, 1.]", "[1.5, '1e5', 100000.0, 0.5, -inf, 1.0]");
        check("['1', \"x\", a b, 1.2.3]", "['1', 'x', 'a b', '1.2.3']");
        check("", "None");
    }

    #[test]
    fn mappings_keep_their_order_and_merge() {
        check("b: 1\na: {c: [2]}", "{'b': 1, 'a': {'c': [2]}}");
        check(
            "x: &x {a: 1, b: 2}\ny:\n  <<: *x\n  b: 3",
            "{'x': {'a': 1, 'b': 2}, 'y': {'a': 1, 'b': 3}}",
        );
    }

    #[test]
    fn units_are_converted() {
        check("a: !degrees 180\nb: !millimeters 250", "{'a': 3.141592653589793, 'b': 0.25}");
        check(
            "!parsecs 3",
            "1:1: `!parsecs` is not a tag; units are !radians, !degrees, !meters, !millimeters, !foot and !inches",
        );
    }

    #[test]
    fn an_alias_bomb_is_refused() {
        let mut text = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
        for level in 1..12 {
            let before = level - 1;
            text += &format!("a{level}: &a{level} [{}]\n", format!("*a{before}, ").repeat(10));
        }
        let error = load(&text, &mut |_| Ok(0.0)).unwrap_err();
        assert!(error.message.contains("too large"), "{error:?}");
    }
}
