//! Errors of parameter values.

use std::fmt;

use crate::{ParamRange, ParamType, ParamValue};

/// Error of a value that a parameter does not accept. Its text completes the sentence "the value ...".
#[derive(Debug, Clone, PartialEq)]
pub enum ParamError {
    /// No text where a value of this form is needed: "a number".
    Empty(&'static str),
    /// Neither true nor false.
    NotBool,
    /// Not an integer.
    NotInteger,
    /// Not a number; with the unit, if a unit was written after the number.
    NotNumber(Option<&'static str>),
    /// A list of numbers with a NaN.
    NanInList,
    /// None of these choices.
    NotAChoice(&'static [&'static str]),
    /// A typed value of another type than the parameter's.
    WrongType {
        /// The value.
        value: ParamValue,
        /// Type of the parameter.
        expected: ParamType,
    },
    /// Out of the valid range.
    OutOfRange {
        /// The number.
        number: f64,
        /// Unit of the parameter.
        unit: Option<&'static str>,
        /// Valid range.
        range: ParamRange,
    },
}

impl fmt::Display for ParamError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty(form) => write!(f, "is empty; write {form}"),
            Self::NotBool => write!(f, "is neither `true` nor `false`"),
            Self::NotInteger => write!(f, "is not a whole number"),
            Self::NotNumber(None) => write!(f, "is not a number"),
            Self::NotNumber(Some(unit)) => {
                write!(f, "is not a number; write it in {unit}, without the unit")
            }
            Self::NanInList => write!(f, "is not a list of numbers: one of them is none"),
            Self::NotAChoice(words) => write!(f, "is none of {}", crate::value::quoted_list(words)),
            Self::WrongType { value, expected } => {
                write!(f, "is of another kind: {value} where {expected} belongs")
            }
            Self::OutOfRange { number, unit, range } => {
                let unit = unit.map(|unit| format!(" {unit}")).unwrap_or_default();
                write!(f, "is out of range: {number}{unit} must be {range}")
            }
        }
    }
}

impl std::error::Error for ParamError {}
