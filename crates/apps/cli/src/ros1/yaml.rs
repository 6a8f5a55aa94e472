//! Parameters as YAML.

use std::fmt::Write as _;

use periplus_diagnostics::SourceMap;
use periplus_ros1::XmlRpcValue;
use periplus_yaml::{YamlNode, YamlValue};

use crate::error::CliError;

/// XmlRpcValue of a YAML text; `name` is its file.
pub(super) fn read(name: &str, text: &str) -> Result<XmlRpcValue, CliError> {
    let mut sources = SourceMap::new();
    let file = sources.add(name, text);
    match periplus_yaml::parse(file, &sources) {
        Ok(Some(node)) => value_of(&node),
        Ok(None) => Ok(XmlRpcValue::Text(String::new())),
        Err(finding) => Err(CliError::failed(format!("{name} is not YAML: {}", finding.message))),
    }
}

fn value_of(node: &YamlNode) -> Result<XmlRpcValue, CliError> {
    if let Some(number) = node.integer() {
        let wide = || XmlRpcValue::Double(number as f64);
        return Ok(i32::try_from(number).map_or_else(|_| wide(), XmlRpcValue::Int));
    }
    if let Some(number) = node.number() {
        return Ok(XmlRpcValue::Double(number));
    }
    if let Some(truth) = node.truth() {
        return Ok(XmlRpcValue::Bool(truth));
    }
    match &node.value {
        YamlValue::Scalar { text, .. } => Ok(XmlRpcValue::Text(text.clone())),
        YamlValue::List(list) => {
            Ok(XmlRpcValue::List(list.iter().map(value_of).collect::<Result<_, _>>()?))
        }
        YamlValue::Map(entries) => {
            let pairs = entries.iter().map(|(name, value)| {
                let name = name.text().ok_or_else(|| {
                    CliError::failed("names of parameters are texts, not lists or dictionaries")
                })?;
                Ok((name.to_owned(), value_of(value)?))
            });
            Ok(XmlRpcValue::Struct(pairs.collect::<Result<_, CliError>>()?))
        }
    }
}

/// YAML of a value, with a line break at its end.
pub(super) fn write(value: &XmlRpcValue) -> String {
    let mut out = String::new();
    match value {
        // As `rosparam get` prints a text: without quotes.
        XmlRpcValue::Text(text) => out.push_str(text),
        XmlRpcValue::Struct(members) if !members.is_empty() => block(&mut out, value, 0),
        other => flow(&mut out, other),
    }
    if !out.ends_with('\n') {
        out.push('\n');
    }
    out
}

/// Lines of a dictionary.
fn block(out: &mut String, value: &XmlRpcValue, indent: usize) {
    let XmlRpcValue::Struct(members) = value else { return };
    for (name, value) in members {
        let _ = write!(out, "{:indent$}{}:", "", scalar(name));
        match value {
            XmlRpcValue::Struct(inner) if !inner.is_empty() => {
                out.push('\n');
                block(out, value, indent + 2);
            }
            XmlRpcValue::Text(text) if text.contains('\n') && !text.starts_with([' ', '\n']) => {
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
fn flow(out: &mut String, value: &XmlRpcValue) {
    match value {
        XmlRpcValue::Int(number) => _ = write!(out, "{number}"),
        XmlRpcValue::Bool(is_true) => _ = write!(out, "{is_true}"),
        XmlRpcValue::Double(number) => _ = write!(out, "{number:?}"),
        XmlRpcValue::Text(text) | XmlRpcValue::Time(text) => out.push_str(&scalar(text)),
        XmlRpcValue::Binary(bytes) => {
            let _ =
                write!(out, "[{}]", bytes.iter().map(u8::to_string).collect::<Vec<_>>().join(", "));
        }
        XmlRpcValue::List(list) => {
            out.push('[');
            for (at, one) in list.iter().enumerate() {
                if at > 0 {
                    out.push_str(", ");
                }
                flow(out, one);
            }
            out.push(']');
        }
        XmlRpcValue::Struct(members) => {
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
        && matches!(read("text", text), Ok(XmlRpcValue::Text(_)))
        && !matches!(text, "null" | "Null" | "NULL" | "yes" | "no" | "on" | "off");
    if is_plain { text.to_owned() } else { serde_json::Value::from(text).to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: XmlRpcValue) {
        assert_eq!(read("text", text).expect("YAML"), expected);
    }

    #[test]
    fn values_have_their_types() {
        check("7", XmlRpcValue::Int(7));
        check("5000000000", XmlRpcValue::Double(5e9));
        check("0.5", XmlRpcValue::Double(0.5));
        check("true", XmlRpcValue::Bool(true));
        check("'7'", XmlRpcValue::Text("7".into()));
        check("base_link", XmlRpcValue::Text("base_link".into()));
        check(
            "[1, a]",
            XmlRpcValue::List(vec![XmlRpcValue::Int(1), XmlRpcValue::Text("a".into())]),
        );
        check("{a: 1}", XmlRpcValue::Struct([("a".to_owned(), XmlRpcValue::Int(1))].into()));
    }

    #[test]
    fn what_is_written_is_read_again() {
        let inner = [
            ("text".to_owned(), XmlRpcValue::Text("7".into())),
            ("lines".to_owned(), XmlRpcValue::Text("a: 1\nb\n".into())),
            ("open".to_owned(), XmlRpcValue::Text("a\nb".into())),
            (
                "list".to_owned(),
                XmlRpcValue::List(vec![XmlRpcValue::Double(1.0), XmlRpcValue::Text("x y".into())]),
            ),
            ("empty".to_owned(), XmlRpcValue::Struct(Default::default())),
        ];
        let all =
            XmlRpcValue::Struct([("slam".to_owned(), XmlRpcValue::Struct(inner.into()))].into());
        let text = write(&all);
        assert_eq!(read("text", &text).expect("YAML"), all, "{text}");
    }
}
