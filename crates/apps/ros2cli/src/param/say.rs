//! Text and JSON of parameters.

use std::fmt::Write as _;

use periplus_msgs::rcl_interfaces::{ParameterDescriptor, ParameterType as Type, ParameterValue};
use serde_json::json;

use crate::show::{python_float, python_text};

/// Type name as in `ros2 param`.
pub(super) fn type_name(number: u8) -> &'static str {
    match number {
        Type::PARAMETER_NOT_SET => "not set",
        Type::PARAMETER_BOOL => "boolean",
        Type::PARAMETER_INTEGER => "integer",
        Type::PARAMETER_DOUBLE => "double",
        Type::PARAMETER_STRING => "string",
        Type::PARAMETER_BYTE_ARRAY => "byte array",
        Type::PARAMETER_BOOL_ARRAY => "boolean array",
        Type::PARAMETER_INTEGER_ARRAY => "integer array",
        Type::PARAMETER_DOUBLE_ARRAY => "double array",
        Type::PARAMETER_STRING_ARRAY => "string array",
        _ => "unknown",
    }
}

/// Label before a value.
pub(super) fn label(number: u8) -> &'static str {
    match number {
        Type::PARAMETER_BOOL => "Boolean value is:",
        Type::PARAMETER_INTEGER => "Integer value is:",
        Type::PARAMETER_DOUBLE => "Double value is:",
        Type::PARAMETER_STRING => "String value is:",
        Type::PARAMETER_BYTE_ARRAY => "Byte values are:",
        Type::PARAMETER_BOOL_ARRAY => "Boolean values are:",
        Type::PARAMETER_INTEGER_ARRAY => "Integer values are:",
        Type::PARAMETER_DOUBLE_ARRAY => "Double values are:",
        Type::PARAMETER_STRING_ARRAY => "String values are:",
        _ => "Unknown value is:",
    }
}

fn truth(value: bool) -> String {
    if value { "True".into() } else { "False".into() }
}

fn list<T>(values: &[T], one: impl Fn(&T) -> String) -> String {
    format!("[{}]", values.iter().map(one).collect::<Vec<_>>().join(", "))
}

/// Value in Python syntax.
pub(super) fn python(value: &ParameterValue) -> String {
    match value.r#type {
        Type::PARAMETER_BOOL => truth(value.bool_value),
        Type::PARAMETER_INTEGER => value.integer_value.to_string(),
        Type::PARAMETER_DOUBLE => python_float(value.double_value),
        Type::PARAMETER_STRING => value.string_value.clone(),
        Type::PARAMETER_BYTE_ARRAY => {
            list(&value.byte_array_value, |byte| format!("b'\\x{byte:02x}'"))
        }
        Type::PARAMETER_BOOL_ARRAY => list(&value.bool_array_value, |one| truth(*one)),
        Type::PARAMETER_INTEGER_ARRAY => list(&value.integer_array_value, i64::to_string),
        Type::PARAMETER_DOUBLE_ARRAY => list(&value.double_array_value, |one| python_float(*one)),
        Type::PARAMETER_STRING_ARRAY => list(&value.string_array_value, |one| python_text(one)),
        _ => "None".into(),
    }
}

pub(super) fn to_json(value: &ParameterValue) -> serde_json::Value {
    let whole = periplus_msgs::to_json(value);
    let field = match value.r#type {
        Type::PARAMETER_BOOL => "bool_value",
        Type::PARAMETER_INTEGER => "integer_value",
        Type::PARAMETER_DOUBLE => "double_value",
        Type::PARAMETER_STRING => "string_value",
        Type::PARAMETER_BYTE_ARRAY => "byte_array_value",
        Type::PARAMETER_BOOL_ARRAY => "bool_array_value",
        Type::PARAMETER_INTEGER_ARRAY => "integer_array_value",
        Type::PARAMETER_DOUBLE_ARRAY => "double_array_value",
        Type::PARAMETER_STRING_ARRAY => "string_array_value",
        _ => return json!(null),
    };
    whole[field].clone()
}

/// Description of a parameter, in lines.
pub(super) fn description(one: &ParameterDescriptor) -> String {
    let mut text = format!("Parameter name: {}\n  Type: {}\n", one.name, type_name(one.r#type));
    if !one.description.is_empty() {
        let _ = writeln!(text, "  Description: {}", one.description);
    }
    let mut limits = String::new();
    if one.read_only {
        limits.push_str("    Read only: true\n");
    }
    for range in &one.integer_range {
        let _ = writeln!(
            limits,
            "    Min value: {}\n    Max value: {}",
            range.from_value, range.to_value
        );
        if range.step != 0 {
            let _ = writeln!(limits, "    Step: {}", range.step);
        }
    }
    for range in &one.floating_point_range {
        let [from, to] = [range.from_value, range.to_value].map(python_float);
        let _ = writeln!(limits, "    Min value: {from}\n    Max value: {to}");
        if range.step != 0.0 {
            let _ = writeln!(limits, "    Step: {}", python_float(range.step));
        }
    }
    if !one.additional_constraints.is_empty() {
        let _ = writeln!(limits, "    Additional constraints: {}", one.additional_constraints);
    }
    // Always printed, even if empty, as `ros2 param describe` does.
    text.push_str("  Constraints:\n");
    text.push_str(&limits);
    text
}
