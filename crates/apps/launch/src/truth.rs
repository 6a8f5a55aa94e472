//! Booleans and types of values that are written as text.

use periplus_diagnostics::SourceMap;
use periplus_yaml::YamlNode;
use serde_json::{Map, Value};

/// Boolean value of a condition; `None` if it is not one of the words of `launch`.
pub(crate) fn truth(text: &str) -> Option<bool> {
    match text.trim().to_lowercase().as_str() {
        "true" | "1" => Some(true),
        "false" | "0" => Some(false),
        _ => None,
    }
}

/// Value of a text in YAML: `1` is an integer, `[1, 2]` a list. Invalid YAML and mappings remain
/// texts.
pub(crate) fn typed(text: &str) -> Value {
    let plain = || Value::String(text.to_owned());
    // A robot description is neither a number nor a list, and long.
    if text.trim_start().starts_with('<') {
        return plain();
    }
    let mut sources = SourceMap::new();
    let file = sources.add("value", text);
    match periplus_yaml::parse(file, &sources) {
        Ok(Some(node)) if node.entries().is_none() => value_of(&node),
        _ => plain(),
    }
}

/// Converts a YAML tree to plain values.
pub(crate) fn value_of(node: &YamlNode) -> Value {
    if let Some(list) = node.list() {
        return Value::Array(list.iter().map(value_of).collect());
    }
    if let Some(entries) = node.entries() {
        let entry =
            |(key, value): &(YamlNode, YamlNode)| Some((key.text()?.to_owned(), value_of(value)));
        return Value::Object(entries.iter().filter_map(entry).collect::<Map<_, _>>());
    }
    if node.is_null() {
        return Value::Null;
    }
    if let Some(truth) = node.truth() {
        return Value::Bool(truth);
    }
    if let Some(integer) = node.integer() {
        return integer.into();
    }
    if let Some(number) = node.number() {
        return number.into();
    }
    Value::String(node.text().unwrap_or_default().to_owned())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{truth, typed};

    #[test]
    fn texts_have_the_types_that_yaml_gives_them() {
        assert_eq!(typed("true"), json!(true));
        assert_eq!(typed("7"), json!(7));
        assert_eq!(typed("-0.5"), json!(-0.5));
        assert_eq!(typed("'7'"), json!("7"));
        assert_eq!(typed("[1, 2]"), json!([1, 2]));
        assert_eq!(typed("map: to"), json!("map: to"));
        assert_eq!(typed("<robot name='x: [y'/>"), json!("<robot name='x: [y'/>"));
    }

    #[test]
    fn conditions_know_four_words() {
        assert_eq!(truth(" TRUE\n"), Some(true));
        assert_eq!(truth("0"), Some(false));
        assert_eq!(truth("yes"), None);
    }
}
