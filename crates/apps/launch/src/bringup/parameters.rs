//! Parameters of a node in a plan.

use std::collections::BTreeMap;
use std::path::Path;

use crate::PlanParameters;
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_graph::{Arguments, ParameterFileError};
use periplus_msgs::rcl_interfaces::{ParameterType as Type, ParameterValue};
use periplus_os::Machine;
use periplus_resources::{FileReadError, Host as _};
use serde_json::Value;

/// Parameters by name.
pub(crate) type NamedParameters = BTreeMap<String, ParameterValue>;

/// Parameters of a node: values and files in their order, then `--ros-args`. Errors are added to
/// `notes`.
pub(crate) fn of_node(
    full_name: &str,
    given: &[PlanParameters],
    ros: &[String],
    notes: &mut Vec<String>,
) -> NamedParameters {
    let mut all = NamedParameters::new();
    for parameters in given {
        match parameters {
            PlanParameters::Values(values) => {
                for (name, value) in values {
                    collect(name, value, &mut all, notes);
                }
            }
            PlanParameters::File(file) if file.starts_with("package://") => notes.push(format!(
                "{file} is in a package that is not on this machine; using defaults"
            )),
            PlanParameters::File(file) => {
                let words = ["--params-file".to_owned(), file.clone()];
                all.extend(arguments(&words, notes).parameters_of(full_name));
            }
        }
    }
    all.extend(arguments(ros, notes).parameters_of(full_name));
    all
}

/// Parses `--ros-args`.
pub(crate) fn arguments(words: &[String], notes: &mut Vec<String>) -> Arguments {
    let (mut sources, mut found) = (SourceMap::new(), Diagnostics::new());
    let arguments = Arguments::read(words, &mut sources, &mut found, &mut text);
    let told =
        found.iter().map(|one| render(one, &sources, RenderStyle::Plain).trim_end().to_owned());
    notes.extend(told);
    arguments
}

fn text(path: &Path) -> Result<String, ParameterFileError> {
    let unreadable = |error: FileReadError| ParameterFileError::Unreadable(error.to_string());
    let bytes = Machine.read(path).map_err(unreadable)?;
    String::from_utf8(bytes).map_err(|_| ParameterFileError::NotText)
}

/// Adds a value, or its members with dotted names.
fn collect(name: &str, value: &Value, all: &mut NamedParameters, notes: &mut Vec<String>) {
    if let Value::Object(inner) = value {
        for (inner_name, value) in inner {
            collect(&format!("{name}.{inner_name}"), value, all, notes);
        }
        return;
    }
    match parameter(value) {
        Some(value) => {
            all.insert(name.to_owned(), value);
        }
        None => notes.push(format!("`{name}` is ignored: {value} is not a parameter value")),
    }
}

/// JSON value as a parameter; `None` if ROS has no such type.
pub(crate) fn parameter(value: &Value) -> Option<ParameterValue> {
    let of = |r#type: u8| ParameterValue { r#type, ..ParameterValue::default() };
    Some(match value {
        Value::Bool(bool_value) => {
            ParameterValue { bool_value: *bool_value, ..of(Type::PARAMETER_BOOL) }
        }
        Value::Number(number) => match number.as_i64() {
            Some(integer_value) => ParameterValue { integer_value, ..of(Type::PARAMETER_INTEGER) },
            None => ParameterValue { double_value: number.as_f64()?, ..of(Type::PARAMETER_DOUBLE) },
        },
        Value::String(text) => text_parameter(text),
        Value::Array(items) => list(items)?,
        Value::Null | Value::Object(_) => return None,
    })
}

/// Text as a parameter.
pub(crate) fn text_parameter(text: &str) -> ParameterValue {
    ParameterValue {
        r#type: Type::PARAMETER_STRING,
        string_value: text.to_owned(),
        ..ParameterValue::default()
    }
}

fn list(items: &[Value]) -> Option<ParameterValue> {
    let of = |r#type: u8| ParameterValue { r#type, ..ParameterValue::default() };
    if items.iter().all(Value::is_i64) && !items.is_empty() {
        let integer_array_value = items.iter().filter_map(Value::as_i64).collect();
        return Some(ParameterValue { integer_array_value, ..of(Type::PARAMETER_INTEGER_ARRAY) });
    }
    if items.iter().all(Value::is_number) && !items.is_empty() {
        let double_array_value = items.iter().filter_map(Value::as_f64).collect();
        return Some(ParameterValue { double_array_value, ..of(Type::PARAMETER_DOUBLE_ARRAY) });
    }
    if items.iter().all(Value::is_boolean) && !items.is_empty() {
        let bool_array_value = items.iter().filter_map(Value::as_bool).collect();
        return Some(ParameterValue { bool_array_value, ..of(Type::PARAMETER_BOOL_ARRAY) });
    }
    let texts: Option<Vec<String>> =
        items.iter().map(|item| item.as_str().map(str::to_owned)).collect();
    Some(ParameterValue { string_array_value: texts?, ..of(Type::PARAMETER_STRING_ARRAY) })
}

/// Text value of a parameter.
pub(crate) fn text_of(all: &NamedParameters, name: &str) -> Option<String> {
    let value = all.get(name)?;
    (value.r#type == Type::PARAMETER_STRING).then(|| value.string_value.clone())
}

/// Numeric value of a parameter.
pub(crate) fn number_of(all: &NamedParameters, name: &str) -> Option<f64> {
    let value = all.get(name)?;
    match value.r#type {
        Type::PARAMETER_DOUBLE => Some(value.double_value),
        #[expect(clippy::cast_precision_loss, reason = "poses and rates are small")]
        Type::PARAMETER_INTEGER => Some(value.integer_value as f64),
        Type::PARAMETER_STRING => value.string_value.trim().parse().ok(),
        _ => None,
    }
}

/// Boolean value of a parameter.
pub(crate) fn truth_of(all: &NamedParameters, name: &str) -> Option<bool> {
    let value = all.get(name)?;
    match value.r#type {
        Type::PARAMETER_BOOL => Some(value.bool_value),
        Type::PARAMETER_STRING => match value.string_value.trim().to_lowercase().as_str() {
            "true" | "1" => Some(true),
            "false" | "0" => Some(false),
            _ => None,
        },
        _ => None,
    }
}

/// Texts of a parameter.
pub(crate) fn texts_of(all: &NamedParameters, name: &str) -> Vec<String> {
    all.get(name).map(|value| value.string_array_value.clone()).unwrap_or_default()
}

/// Value as words, lists joined.
pub(crate) fn words(value: &ParameterValue) -> String {
    fn join<T: ToString>(items: &[T]) -> String {
        items.iter().map(T::to_string).collect::<Vec<_>>().join(" ")
    }
    match value.r#type {
        Type::PARAMETER_BOOL => value.bool_value.to_string(),
        Type::PARAMETER_INTEGER => value.integer_value.to_string(),
        Type::PARAMETER_DOUBLE => value.double_value.to_string(),
        Type::PARAMETER_BOOL_ARRAY => join(&value.bool_array_value),
        Type::PARAMETER_INTEGER_ARRAY => join(&value.integer_array_value),
        Type::PARAMETER_DOUBLE_ARRAY => join(&value.double_array_value),
        Type::PARAMETER_STRING_ARRAY => join(&value.string_array_value),
        _ => value.string_value.clone(),
    }
}
