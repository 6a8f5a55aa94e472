//! Parameters as YAML.

use std::fmt::Write as _;

use periplus_diagnostics::SourceMap;
use periplus_ros1::Value;
use periplus_yaml::{YamlNode, YamlValue};

use crate::error::CliError;

/// Value of a YAML text; `name` is its file.
pub(super) fn read(name: &str, text: &str) -> Result<Value, CliError> {
    let mut sources = SourceMap::new();
    let file = sources.add(name, text);
    match periplus_yaml::parse(file, &sources) {
        Ok(Some(node)) => value_of(&node),
        Ok(None) => Ok(Value::Text(String::new())),
        Err(finding) => Err(CliError::failed(format!("{name} is not YAML: {}", finding.message))),
    }
}

fn value_of(node: &YamlNode) -> Result<Value, CliError> {
    if let Some(number) = node.integer() {
        let wide = || Value::Double(number as f64);
        return Ok(i32::try_from(number).map_or_else(|_| wide(), Value::Int));
    }
    if let Some(number) = node.number() {
        return Ok(Value::Double(number));
    }
    if let Some(truth) = node.truth() {
        return Ok(Value::Bool(truth));
    }
    match &node.value {
        YamlValue::Scalar { text, .. } => Ok(Value::Text(text.clone())),
        YamlValue::List(list) => {
            Ok(Value::List(list.iter().map(value_of).collect::<Result<_, _>>()?))
        }
        YamlValue::Map(entries) => {
            let pairs = entries.iter().map(|(name, value)| {
                let name = name.text().ok_or_else(|| {
                    CliError::failed("names of parameters are texts, not lists or dictionaries")
                })?;
                Ok((name.to_owned(), value_of(value)?))
            });
            Ok(Value::Struct(pairs.collect::<Result<_, CliError>>()?))
        }
    }
}

/// YAML of a value, with a line break at its end.
pub(super) fn write(value: &Value) -> String {
    let mut out = String::new();
    match value {
        // As `rosparam get` prints a text: without quotes.
        Value::Text(text) => out.push_str(text),
        Value::Struct(members) if !members.is_empty() => block(&mut out, value, 0),
        other => flow(&mut out, other),
    }
    if !out.ends_with('\n') {
        out.push('\n');
    }
    out
}

/// Lines of a dictionary.
fn block(out: &mut String, value: &Value, indent: usize) {
    let Value::Struct(members) = value else { return };
    for (name, value) in members {
        let _ = write!(out, "{:indent$}{}:", "", scalar(name));
        match value {
            Value::Struct(inner) if !inner.is_empty() => {
                out.push('\n');
                block(out, value, indent + 2);
            }
            Value::Text(text) if text.contains('\n') && !text.starts_with([' ', '\n']) => {
                let keep = if text.ends_with("\n\n") {
                    "+"
                } else if text.ends_with('\n') {
                    ""
                } else {
                    "-"
                };
                let _ = writeln!(out, " |{keep}");
                for line in text.lines() {
                    let indent = if line.is_empty() { 0 } else { indent + 2 };
                    let _ = writeln!(out, "{:indent$}{line}", "");
                }
            }
            value => {
                out.push(' ');
                flow(out, value);
                out.push('\n');
            }
        }
    }
}

/// A value in one line.
fn flow(out: &mut String, value: &Value) {
    match value {
        Value::Int(number) => _ = write!(out, "{number}"),
        Value::Bool(is_true) => _ = write!(out, "{is_true}"),
        Value::Double(number) => _ = write!(out, "{number:?}"),
        Value::Text(text) | Value::Time(text) => out.push_str(&scalar(text)),
        Value::Binary(bytes) => {
            let _ =
                write!(out, "[{}]", bytes.iter().map(u8::to_string).collect::<Vec<_>>().join(", "));
        }
        Value::List(list) => {
            out.push('[');
            for (at, one) in list.iter().enumerate() {
                if at > 0 {
                    out.push_str(", ");
                }
                flow(out, one);
            }
            out.push(']');
        }
        Value::Struct(members) => {
            out.push('{');
            for (at, (name, one)) in members.iter().enumerate() {
                if at > 0 {
                    out.push_str(", ");
                }
                let _ = write!(out, "{}: ", scalar(name));
                flow(out, one);
            }
            out.push('}');
        }
    }
}

/// A text, in quotes if it would be read as something else.
fn scalar(text: &str) -> String {
    let is_plain = !text.is_empty()
        && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_/.-".contains(&byte))
        && !text.starts_with(['-', '.'])
        && matches!(read("text", text), Ok(Value::Text(_)))
        && !matches!(text, "null" | "Null" | "NULL" | "yes" | "no" | "on" | "off");
    if is_plain { text.to_owned() } else { serde_json::Value::from(text).to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: Value) {
        assert_eq!(read("text", text).expect("YAML"), expected);
    }

    #[test]
    fn values_have_their_types() {
        check("7", Value::Int(7));
        check("5000000000", Value::Double(5e9));
        check("0.5", Value::Double(0.5));
        check("true", Value::Bool(true));
        check("'7'", Value::Text("7".into()));
        check("base_link", Value::Text("base_link".into()));
        check("[1, a]", Value::List(vec![Value::Int(1), Value::Text("a".into())]));
        check("{a: 1}", Value::Struct([("a".to_owned(), Value::Int(1))].into()));
    }

    #[test]
    fn what_is_written_is_read_again() {
        let inner = [
            ("text".to_owned(), Value::Text("7".into())),
            ("lines".to_owned(), Value::Text("a: 1\nb\n".into())),
            ("open".to_owned(), Value::Text("a\nb".into())),
            ("list".to_owned(), Value::List(vec![Value::Double(1.0), Value::Text("x y".into())])),
            ("empty".to_owned(), Value::Struct(Default::default())),
        ];
        let all = Value::Struct([("slam".to_owned(), Value::Struct(inner.into()))].into());
        let text = write(&all);
        assert_eq!(read("text", &text).expect("YAML"), all, "{text}");
    }
}
