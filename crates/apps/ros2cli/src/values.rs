//! Messages as YAML, as for `ros2 topic pub`.

use std::sync::Arc;

use periplus_diagnostics::SourceMap;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::{DynamicMessage, Layout, Problem};
use periplus_yaml::{YamlNode, YamlValue};
use serde_json::{Map, json};

use crate::{Failure, Outcome};

/// Values of a message.
pub struct Values {
    tree: Option<YamlNode>,
}

impl Values {
    /// Parses values.
    ///
    /// # Errors
    /// When the text is not YAML, or not a mapping.
    pub fn read(text: &str) -> Outcome<Self> {
        let mut sources = SourceMap::new();
        let file = sources.add("values", text);
        let tree = periplus_yaml::parse(file, &sources).map_err(|wrong| {
            Failure::Usage(format!("the values are not valid YAML: {}", wrong.message))
        })?;
        let tree = tree.filter(|tree| !tree.is_null());
        match &tree {
            Some(tree) if tree.entries().is_none() => Err(Failure::Usage(format!(
                "the values are {}; expected names and values, such as `{{linear: {{x: 0.5}}}}`; \
                 a colon needs a space after it",
                tree.kind()
            ))),
            _ => Ok(Self { tree }),
        }
    }

    /// Builds the message; `auto` as a header and `now` as a stamp become this time \[ns\].
    ///
    /// # Errors
    /// When the type has no such fields.
    pub fn message(&self, layout: &Arc<Layout>, now_ns: i64) -> Outcome<DynamicMessage> {
        let json = match &self.tree {
            None => json!({}),
            Some(tree) => to_json(tree, Some(layout), now_ns),
        };
        DynamicMessage::from_json(layout, &json).map_err(|error| {
            let quotes = match error.problem {
                Problem::NotAString { .. } => {
                    "; a string that looks like another type needs quotes"
                }
                _ => "",
            };
            Failure::failed(format!(
                "the values do not match {}: {error}{quotes}",
                layout.type_name()
            ))
        })
    }
}

/// Conversion by the rules of YAML 1.1.
fn to_json(node: &YamlNode, layout: Option<&Arc<Layout>>, now_ns: i64) -> serde_json::Value {
    match &node.value {
        YamlValue::Scalar { text, is_plain: true } => match (stamped(text, layout), node) {
            (Some(path), _) => {
                let stamp = Time::of_ns(now_ns);
                let stamp = json!({ "sec": stamp.sec, "nanosec": stamp.nanosec });
                if path.is_empty() { stamp } else { json!({ path: stamp }) }
            }
            (None, node) => scalar(node, text),
        },
        YamlValue::Scalar { text, is_plain: false } => text.as_str().into(),
        YamlValue::List(items) => {
            items.iter().map(|item| to_json(item, layout, now_ns)).collect::<Vec<_>>().into()
        }
        YamlValue::Map(entries) => {
            let entries = entries.iter().map(|(name, value)| {
                let name = name.text().unwrap_or_default();
                let nested = layout.and_then(|layout| layout.nested(name));
                (name.to_owned(), to_json(value, nested, now_ns))
            });
            entries.collect::<Map<_, _>>().into()
        }
    }
}

/// Field that takes the time, if a word requests it.
fn stamped(word: &str, layout: Option<&Arc<Layout>>) -> Option<&'static str> {
    match (word, layout?.type_name()) {
        ("auto", "std_msgs/msg/Header") => Some("stamp"),
        ("now", "builtin_interfaces/msg/Time") => Some(""),
        _ => None,
    }
}

fn scalar(node: &YamlNode, text: &str) -> serde_json::Value {
    if node.is_null() {
        return serde_json::Value::Null;
    }
    if let Some(truth) = node.truth() {
        return truth.into();
    }
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    match unsigned.to_ascii_lowercase().as_str() {
        ".nan" => return "NaN".into(),
        ".inf" if text.starts_with('-') => return "-Infinity".into(),
        ".inf" => return "Infinity".into(),
        _ => {}
    }
    let digits = unsigned.replace('_', "");
    let whole = match digits.strip_prefix("0x") {
        Some(hex) => u64::from_str_radix(hex, 16).ok(),
        None if digits.bytes().all(|b| b.is_ascii_digit()) => digits.parse().ok(),
        None => None,
    };
    match (whole, text.starts_with('-')) {
        (Some(number), false) => return number.into(),
        (Some(number), true) => {
            if let Some(number) = 0_i64.checked_sub_unsigned(number) {
                return number.into();
            }
        }
        (None, _) => {}
    }
    match node.number() {
        Some(number) => number.into(),
        None => text.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};
    use periplus_msgs::{TypeRegistry, YamlStyle};

    fn check(type_name: &str, text: &str, expected: Expect) {
        let layout = TypeRegistry::builtin().layout(type_name).unwrap();
        let message = Values::read(text).and_then(|values| values.message(layout, 1_500_000_000));
        let style = YamlStyle { flow: true, ..YamlStyle::default() };
        expected.assert_eq(&match message {
            Ok(message) => message.to_yaml(&style),
            Err(failure) => failure.to_string(),
        });
    }

    #[test]
    fn values_fill_a_message() {
        check("std_msgs/msg/String", "data: hello", expect!["{data: hello}\n"]);
        check("std_msgs/msg/String", "{data: '12'}", expect!["{data: '12'}\n"]);
        check("std_msgs/msg/UInt8", "data: 0xff", expect!["{data: 255}\n"]);
        check("std_msgs/msg/Float32", "data: -.inf", expect!["{data: -.inf}\n"]);
        check(
            "std_msgs/msg/Int64",
            "data: -9223372036854775808",
            expect!["{data: -9223372036854775808}\n"],
        );
        check("std_msgs/msg/Bool", "data: yes", expect!["{data: true}\n"]);
        check("std_msgs/msg/Empty", "", expect!["{}\n"]);
        check(
            "geometry_msgs/msg/Vector3",
            "{x: 1, z: 1e-1}",
            expect!["{x: 1.0, y: 0.0, z: 0.1}\n"],
        );
    }

    #[test]
    fn times_are_filled_in() {
        check(
            "geometry_msgs/msg/PointStamped",
            "{header: auto, point: {x: 1.0}}",
            expect![
                "{header: {stamp: {sec: 1, nanosec: 500000000}, frame_id: ''}, point: {x: 1.0, y: 0.0, z: 0.0}}\n"
            ],
        );
        check(
            "tf2_msgs/msg/TFMessage",
            "transforms: [{header: {stamp: now, frame_id: odom}}]",
            expect![
                "{transforms: [{header: {stamp: {sec: 1, nanosec: 500000000}, frame_id: odom}, child_frame_id: '', transform: {translation: {x: 0.0, y: 0.0, z: 0.0}, rotation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}}}]}\n"
            ],
        );
        // In other fields they are ordinary strings.
        check("std_msgs/msg/String", "data: auto", expect!["{data: auto}\n"]);
    }

    #[test]
    fn what_does_not_fit_is_told() {
        check(
            "std_msgs/msg/String",
            "data: 12",
            expect![
                "the values do not match std_msgs/msg/String: expected a string, found 12 (at `data`); a string that looks like another type needs quotes"
            ],
        );
        check(
            "std_msgs/msg/String",
            "date: a",
            expect![
                "the values do not match std_msgs/msg/String: there is no field `date`, did you mean `data`?"
            ],
        );
        check(
            "std_msgs/msg/UInt8",
            "data: -1",
            expect![
                "the values do not match std_msgs/msg/UInt8: expected a value of type uint8, found -1 (at `data`)"
            ],
        );
        check(
            "std_msgs/msg/String",
            "data:hello",
            expect![
                "the values are a text; expected names and values, such as `{linear: {x: 0.5}}`; a colon needs a space after it"
            ],
        );
        check(
            "std_msgs/msg/String",
            "{data: [",
            expect![
                "the values are not valid YAML: this is not YAML: while parsing a node, did not find expected node content"
            ],
        );
    }
}
