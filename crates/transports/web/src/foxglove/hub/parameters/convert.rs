//! Conversion of parameter values between ROS and Foxglove.

use periplus_msgs::rcl_interfaces::{ParameterType, ParameterValue};
use serde_json::{Value, json};

/// A parameter: name, value, and the type where JSON is ambiguous.
pub(super) type Named = (String, Value, Option<&'static str>);

/// Converts a value to JSON; none if it is not set.
pub(super) fn to_json(value: &ParameterValue) -> Option<(Value, Option<&'static str>)> {
    Some(match value.r#type {
        ParameterType::PARAMETER_BOOL => (json!(value.bool_value), None),
        ParameterType::PARAMETER_INTEGER => (json!(value.integer_value), None),
        ParameterType::PARAMETER_DOUBLE => (number(value.double_value), Some("float64")),
        ParameterType::PARAMETER_STRING => (json!(value.string_value), None),
        ParameterType::PARAMETER_BYTE_ARRAY => {
            (json!(periplus_geometry::encode_base64(&value.byte_array_value)), Some("byte_array"))
        }
        ParameterType::PARAMETER_BOOL_ARRAY => (json!(value.bool_array_value), None),
        ParameterType::PARAMETER_INTEGER_ARRAY => (json!(value.integer_array_value), None),
        ParameterType::PARAMETER_DOUBLE_ARRAY => {
            let numbers = value.double_array_value.iter().map(|one| number(*one));
            (Value::Array(numbers.collect()), Some("float64_array"))
        }
        ParameterType::PARAMETER_STRING_ARRAY => (json!(value.string_array_value), None),
        _ => return None,
    })
}

/// JSON has no NaN and no infinities; Foxglove accepts these texts.
fn number(value: f64) -> Value {
    match value {
        _ if value.is_nan() => json!("NaN"),
        f64::INFINITY => json!("Infinity"),
        f64::NEG_INFINITY => json!("-Infinity"),
        _ => json!(value),
    }
}

/// Converts a value from JSON. `declared` is the type that the node declares, or 0. None if the
/// value cannot be converted to that type.
pub(super) fn from_json(
    value: Option<&Value>,
    kind: Option<&str>,
    declared: u8,
) -> Option<ParameterValue> {
    let Some(value) = value.filter(|value| !value.is_null()) else {
        return Some(ParameterValue::default());
    };
    let r#type =
        if declared == ParameterType::PARAMETER_NOT_SET { guess(value, kind)? } else { declared };
    let blank = ParameterValue { r#type, ..ParameterValue::default() };
    let list = || value.as_array();
    Some(match r#type {
        ParameterType::PARAMETER_BOOL => ParameterValue { bool_value: value.as_bool()?, ..blank },
        ParameterType::PARAMETER_INTEGER => {
            ParameterValue { integer_value: integer(value)?, ..blank }
        }
        ParameterType::PARAMETER_DOUBLE => ParameterValue { double_value: double(value)?, ..blank },
        ParameterType::PARAMETER_STRING => {
            ParameterValue { string_value: value.as_str()?.to_owned(), ..blank }
        }
        ParameterType::PARAMETER_BOOL_ARRAY => {
            let bool_array_value = list()?.iter().map(Value::as_bool).collect::<Option<_>>()?;
            ParameterValue { bool_array_value, ..blank }
        }
        ParameterType::PARAMETER_INTEGER_ARRAY => {
            let integer_array_value = list()?.iter().map(integer).collect::<Option<_>>()?;
            ParameterValue { integer_array_value, ..blank }
        }
        ParameterType::PARAMETER_DOUBLE_ARRAY => {
            let double_array_value = list()?.iter().map(double).collect::<Option<_>>()?;
            ParameterValue { double_array_value, ..blank }
        }
        ParameterType::PARAMETER_STRING_ARRAY => {
            let words = list()?.iter().map(|one| one.as_str().map(str::to_owned));
            ParameterValue { string_array_value: words.collect::<Option<_>>()?, ..blank }
        }
        _ => return None,
    })
}

fn guess(value: &Value, kind: Option<&str>) -> Option<u8> {
    Some(match (kind, value) {
        (Some("float64"), _) => ParameterType::PARAMETER_DOUBLE,
        (Some("float64_array"), _) => ParameterType::PARAMETER_DOUBLE_ARRAY,
        (_, Value::Bool(_)) => ParameterType::PARAMETER_BOOL,
        (_, Value::Number(number)) if number.is_i64() => ParameterType::PARAMETER_INTEGER,
        (_, Value::Number(_)) => ParameterType::PARAMETER_DOUBLE,
        (_, Value::String(_)) => ParameterType::PARAMETER_STRING,
        (_, Value::Array(list)) => match list.first()? {
            Value::Bool(_) => ParameterType::PARAMETER_BOOL_ARRAY,
            Value::Number(_) if list.iter().all(Value::is_i64) => {
                ParameterType::PARAMETER_INTEGER_ARRAY
            }
            Value::Number(_) => ParameterType::PARAMETER_DOUBLE_ARRAY,
            Value::String(_) => ParameterType::PARAMETER_STRING_ARRAY,
            _ => return None,
        },
        _ => return None,
    })
}

/// An integer, also in the form `3.0`.
fn integer(value: &Value) -> Option<i64> {
    let whole = |number: &f64| number.fract() == 0.0 && number.abs() < 9e15;
    #[expect(clippy::cast_possible_truncation, reason = "it is an integer below 2^53")]
    value.as_i64().or_else(|| value.as_f64().filter(whole).map(|number| number as i64))
}

fn double(value: &Value) -> Option<f64> {
    match value.as_str() {
        Some("NaN") => Some(f64::NAN),
        Some("Infinity") => Some(f64::INFINITY),
        Some("-Infinity") => Some(f64::NEG_INFINITY),
        Some(_) => None,
        None => value.as_f64(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_becomes_what_the_node_declared() {
        let make = |value: Value, declared| from_json(Some(&value), None, declared);
        let double = make(json!(3), ParameterType::PARAMETER_DOUBLE).expect("a value");
        assert_eq!(double.double_value, 3.0);
        let integer = make(json!(3.0), ParameterType::PARAMETER_INTEGER).expect("a value");
        assert_eq!(integer.integer_value, 3);
        assert_eq!(make(json!(3.5), ParameterType::PARAMETER_INTEGER), None);
        assert_eq!(make(json!("3"), ParameterType::PARAMETER_DOUBLE), None);
        assert_eq!(make(json!([1, 2.5]), 0).expect("a value").double_array_value, [1.0, 2.5]);
        let gone = from_json(None, None, ParameterType::PARAMETER_BOOL).expect("a value");
        assert_eq!(gone.r#type, ParameterType::PARAMETER_NOT_SET);
    }

    #[test]
    fn what_goes_out_comes_back() {
        for value in
            [json!(true), json!(-4), json!("a"), json!([1, 2]), json!(["a"]), json!([true])]
        {
            let node = from_json(Some(&value), None, 0).expect("a value");
            assert_eq!(to_json(&node).expect("a value").0, value);
        }
        let node = from_json(Some(&json!("-Infinity")), Some("float64"), 0).expect("a value");
        assert_eq!(node.double_value, f64::NEG_INFINITY);
        assert_eq!(to_json(&node), Some((json!("-Infinity"), Some("float64"))));
    }
}
