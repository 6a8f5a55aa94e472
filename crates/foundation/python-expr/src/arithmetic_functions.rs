//! Built-in functions on numbers.

use super::callable::{Arguments, Builtin};
use super::error::{Outcome, fail};
use super::interpreter::Interpreter;
use super::number::{self, Number, too_large};
use super::value::Value;

pub(super) static ARITHMETIC: &[Builtin] = &[
    Builtin { name: "abs", is_type: false, call: abs },
    Builtin { name: "round", is_type: false, call: round },
    Builtin { name: "divmod", is_type: false, call: divmod },
];

fn abs(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("abs")?;
    match value.number() {
        Some(Number::Int(int)) => int.checked_abs().map(Value::Int).ok_or_else(too_large),
        Some(Number::Float(float)) => Ok(Value::Float(float.abs())),
        None => fail(format!("`abs` needs a number, not `{}`", value.type_name())),
    }
}

fn round(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value, digits] = arguments.bind("round", ["number", "ndigits"], 1)?;
    let value = value.unwrap_or(Value::None);
    let digits = match digits {
        None | Some(Value::None) => None,
        Some(digits) => Some(digits.integer()?),
    };
    match (value.number(), digits) {
        (Some(Number::Int(int)), digits) => {
            number::round_int(int, digits.unwrap_or(0)).map(Value::Int)
        }
        (Some(Number::Float(float)), None) => {
            number::truncate(float.round_ties_even()).map(Value::Int)
        }
        (Some(Number::Float(float)), Some(digits)) => {
            let rounded = number::round_float(float, digits);
            if rounded.is_infinite() && float.is_finite() {
                fail("the rounded value is too large for a float")
            } else {
                Ok(Value::Float(rounded))
            }
        }
        (None, _) => fail(format!("`round` needs a number, not `{}`", value.type_name())),
    }
}

fn divmod(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [a, b] = arguments.exactly("divmod")?;
    match (a.number(), b.number()) {
        (Some(Number::Int(a)), Some(Number::Int(b))) => Value::tuple(vec![
            Value::Int(number::floor_divide_ints(a, b)?),
            Value::Int(number::modulo_ints(a, b)?),
        ]),
        (Some(a), Some(b)) => {
            let (quotient, remainder) = number::divmod_floats(a.to_float(), b.to_float())?;
            Value::tuple(vec![Value::Float(quotient), Value::Float(remainder)])
        }
        _ => {
            fail(format!("`divmod` needs numbers, not `{}` and `{}`", a.type_name(), b.type_name()))
        }
    }
}
