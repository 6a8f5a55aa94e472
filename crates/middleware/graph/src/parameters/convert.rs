//! Conversion of parameter values and descriptors to messages.

use periplus_msgs::rcl_interfaces::{
    FloatingPointRange, IntegerRange, ParameterDescriptor, ParameterType, ParameterValue,
};
use periplus_params::{ParamType, ParamValue, Parameter};

pub(super) fn to_message(value: ParamValue) -> ParameterValue {
    let r#type = kind(&value);
    let blank = ParameterValue { r#type, ..Default::default() };
    match value {
        ParamValue::Bool(bool_value) => ParameterValue { bool_value, ..blank },
        ParamValue::Integer(integer_value) => ParameterValue { integer_value, ..blank },
        ParamValue::Number(double_value) => ParameterValue { double_value, ..blank },
        ParamValue::Text(string_value) => ParameterValue { string_value, ..blank },
        ParamValue::Numbers(double_array_value) => ParameterValue { double_array_value, ..blank },
        ParamValue::Texts(string_array_value) => ParameterValue { string_array_value, ..blank },
    }
}

fn kind(value: &ParamValue) -> u8 {
    match value {
        ParamValue::Bool(_) => ParameterType::PARAMETER_BOOL,
        ParamValue::Integer(_) => ParameterType::PARAMETER_INTEGER,
        ParamValue::Number(_) => ParameterType::PARAMETER_DOUBLE,
        ParamValue::Text(_) => ParameterType::PARAMETER_STRING,
        ParamValue::Numbers(_) => ParameterType::PARAMETER_DOUBLE_ARRAY,
        ParamValue::Texts(_) => ParameterType::PARAMETER_STRING_ARRAY,
    }
}

/// Highest parameter type number of ROS.
const MAX_TYPE: u8 = ParameterType::PARAMETER_STRING_ARRAY;

/// Converts a message to a value. The error is the rest of the sentence "the value ...".
pub(super) fn from_message(value: &ParameterValue) -> Result<ParamValue, String> {
    Ok(match value.r#type {
        ParameterType::PARAMETER_BOOL => ParamValue::Bool(value.bool_value),
        ParameterType::PARAMETER_INTEGER => ParamValue::Integer(value.integer_value),
        ParameterType::PARAMETER_DOUBLE => ParamValue::Number(value.double_value),
        ParameterType::PARAMETER_STRING => ParamValue::Text(value.string_value.clone()),
        ParameterType::PARAMETER_INTEGER_ARRAY => {
            ParamValue::Numbers(value.integer_array_value.iter().map(|one| *one as f64).collect())
        }
        ParameterType::PARAMETER_DOUBLE_ARRAY => {
            ParamValue::Numbers(value.double_array_value.clone())
        }
        ParameterType::PARAMETER_STRING_ARRAY => {
            ParamValue::Texts(value.string_array_value.clone())
        }
        ParameterType::PARAMETER_NOT_SET => {
            return Err("is not set; declared parameters cannot be deleted".into());
        }
        // Lists of booleans map to the tables' lists of words: `odom0_config` of a filter.
        ParameterType::PARAMETER_BOOL_ARRAY => {
            ParamValue::Texts(value.bool_array_value.iter().map(bool::to_string).collect())
        }
        ParameterType::PARAMETER_BYTE_ARRAY => {
            ParamValue::Numbers(value.byte_array_value.iter().map(|one| f64::from(*one)).collect())
        }
        other => {
            return Err(format!("has the unknown type {other}; ROS has the types 0 to {MAX_TYPE}"));
        }
    })
}

/// Descriptor of a parameter of this name.
pub(super) fn describe(name: &str, parameter: &Parameter) -> ParameterDescriptor {
    let unit = parameter.unit.map(|unit| format!(" [{unit}]")).unwrap_or_default();
    let mut descriptor = ParameterDescriptor {
        name: name.to_owned(),
        r#type: type_of(parameter.kind),
        description: format!("{}{unit}", parameter.doc),
        ..Default::default()
    };
    if let ParamType::Choice(words) = parameter.kind {
        descriptor.additional_constraints = format!("one of {}", words.join(", "));
    }
    let Some(range) = parameter.range else { return descriptor };
    // The message has neither open ranges nor ranges of lists, so the text states the range as
    // well.
    descriptor.additional_constraints = range.to_string();
    match parameter.kind {
        ParamType::Integer => descriptor.integer_range.push(IntegerRange {
            // Conversions saturate: an open end becomes the largest integer.
            #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
            from_value: range.min as i64 + i64::from(range.above),
            #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
            to_value: range.max as i64,
            step: 0,
        }),
        ParamType::Number => descriptor.floating_point_range.push(FloatingPointRange {
            from_value: range.min.max(f64::MIN),
            to_value: range.max.min(f64::MAX),
            step: 0.0,
        }),
        _ => {}
    }
    descriptor
}

pub(super) fn type_of(kind: ParamType) -> u8 {
    match kind {
        ParamType::Bool => ParameterType::PARAMETER_BOOL,
        ParamType::Integer => ParameterType::PARAMETER_INTEGER,
        ParamType::Number => ParameterType::PARAMETER_DOUBLE,
        ParamType::Text | ParamType::Choice(_) => ParameterType::PARAMETER_STRING,
        ParamType::NumberList => ParameterType::PARAMETER_DOUBLE_ARRAY,
        ParamType::TextList => ParameterType::PARAMETER_STRING_ARRAY,
        ParamType::Group => ParameterType::PARAMETER_NOT_SET,
    }
}
