//! Binary and unary operators.

use std::rc::Rc;

use super::ast::{Binary, Unary};
use super::budget::Budget;
use super::error::{ExpressionError, Outcome, fail};
use super::number::{self, Number, too_large};
use super::percent;
use super::value::{Dict, DictHandle, Sequence, Value};

/// `a OP b`.
pub(super) fn binary(
    operator: Binary,
    a: &Value,
    b: &Value,
    budget: &mut Budget,
) -> Outcome<Value> {
    if let (Value::Bool(a), Value::Bool(b)) = (a, b) {
        match operator {
            Binary::And => return Ok(Value::Bool(a & b)),
            Binary::Or => return Ok(Value::Bool(a | b)),
            Binary::Xor => return Ok(Value::Bool(a ^ b)),
            _ => {}
        }
    }
    if let (Some(left), Some(right)) = (a.number(), b.number()) {
        return arithmetic(operator, left, right)?
            .map(Value::from)
            .ok_or_else(|| mismatch(operator, a, b));
    }
    match (operator, a, b) {
        (Binary::Add, Value::Str(left), Value::Str(right)) => {
            budget.allocate(left.len() as u128 + right.len() as u128)?;
            Ok(Value::text([&**left, right].concat()))
        }
        (Binary::Add, Value::List(left), Value::List(right)) => {
            Value::list(joined(left, right, budget)?)
        }
        (Binary::Add, Value::Tuple(left), Value::Tuple(right)) => {
            Value::tuple(joined(left.items(), right.items(), budget)?)
        }
        (Binary::Multiply, Value::Str(_) | Value::List(_) | Value::Tuple(_), count)
            if is_int(count) =>
        {
            repeat(a, count.integer()?, budget)
        }
        (Binary::Multiply, count, Value::Str(_) | Value::List(_) | Value::Tuple(_))
            if is_int(count) =>
        {
            repeat(b, count.integer()?, budget)
        }
        (Binary::Modulo, Value::Str(template), _) => {
            percent::format(template, b, budget).map(Value::text)
        }
        (Binary::Or, Value::Dict(left), Value::Dict(right)) => {
            budget.allocate_values(2 * (left.entries().len() + right.entries().len()))?;
            let mut dict = (*left.dict).clone();
            for (key, value) in right.entries() {
                dict.insert(key.clone(), value.clone())?;
            }
            Ok(Value::Dict(DictHandle { dict: Rc::new(dict), is_dotted: false }))
        }
        (
            Binary::And | Binary::Or | Binary::Xor | Binary::Subtract,
            Value::Set(left),
            Value::Set(right),
        ) => set_operation(operator, left, right, budget),
        _ => Err(mismatch(operator, a, b)),
    }
}

fn is_int(value: &Value) -> bool {
    matches!(value, Value::Int(_) | Value::Bool(_))
}

fn arithmetic(operator: Binary, a: Number, b: Number) -> Outcome<Option<Number>> {
    Ok(Some(match (operator, a, b) {
        (Binary::Divide, ..) => Number::Float(number::divide(a, b)?),
        (Binary::Power, ..) => number::power(a, b)?,
        (_, Number::Int(a), Number::Int(b)) => Number::Int(match operator {
            Binary::Add => a.checked_add(b).ok_or_else(too_large)?,
            Binary::Subtract => a.checked_sub(b).ok_or_else(too_large)?,
            Binary::Multiply => a.checked_mul(b).ok_or_else(too_large)?,
            Binary::FloorDivide => number::floor_divide_ints(a, b)?,
            Binary::Modulo => number::modulo_ints(a, b)?,
            Binary::And => a & b,
            Binary::Or => a | b,
            Binary::Xor => a ^ b,
            Binary::ShiftLeft => number::shift_left(a, b)?,
            Binary::ShiftRight => number::shift_right(a, b)?,
            Binary::Divide | Binary::Power => return Ok(None),
        }),
        _ => {
            let (a, b) = (a.to_float(), b.to_float());
            Number::Float(match operator {
                Binary::Add => a + b,
                Binary::Subtract => a - b,
                Binary::Multiply => a * b,
                Binary::FloorDivide => number::divmod_floats(a, b)?.0,
                Binary::Modulo => number::divmod_floats(a, b)?.1,
                _ => return Ok(None),
            })
        }
    }))
}

fn joined(a: &[Value], b: &[Value], budget: &mut Budget) -> Outcome<Vec<Value>> {
    budget.allocate_values(a.len() + b.len())?;
    budget.steps((a.len() + b.len()) as u64 / 16)?;
    Ok([a, b].concat())
}

fn repeat(sequence: &Value, count: i128, budget: &mut Budget) -> Outcome<Value> {
    let count = usize::try_from(count.max(0)).unwrap_or(usize::MAX);
    let repeat_items = |items: &[Value], budget: &mut Budget| -> Outcome<Vec<Value>> {
        budget.allocate(items.len() as u128 * count as u128 * size_of::<Value>() as u128)?;
        Ok(if items.is_empty() {
            Vec::new()
        } else {
            std::iter::repeat_n(items, count).flatten().cloned().collect()
        })
    };
    match sequence {
        Value::Str(text) => {
            budget.allocate(text.len() as u128 * count as u128)?;
            Ok(Value::text(if text.is_empty() { String::new() } else { text.repeat(count) }))
        }
        Value::List(list) => Value::list(repeat_items(list, budget)?),
        Value::Tuple(items) => {
            Ok(Value::Tuple(Sequence::new(repeat_items(items.items(), budget)?)?))
        }
        _ => fail(format!("cannot repeat `{}`", sequence.type_name())),
    }
}

/// `&`, `|`, `^` and `-` of sets.
pub(super) fn set_operation(
    operator: Binary,
    a: &Dict,
    b: &Dict,
    budget: &mut Budget,
) -> Outcome<Value> {
    let mut result = Dict::default();
    let mut take = |from: &Dict, wanted: &dyn Fn(&Value) -> Outcome<bool>| -> Outcome<()> {
        for (key, _) in from.entries() {
            budget.step()?;
            budget.allocate_values(4)?;
            if wanted(key)? {
                result.insert(key.clone(), Value::None)?;
            }
        }
        Ok(())
    };
    let in_a = |key: &Value| Ok(a.get(key)?.is_some());
    let in_b = |key: &Value| Ok(b.get(key)?.is_some());
    match operator {
        Binary::And => take(a, &in_b)?,
        Binary::Subtract => take(a, &|key| Ok(!in_b(key)?))?,
        Binary::Xor => {
            take(a, &|key| Ok(!in_b(key)?))?;
            take(b, &|key| Ok(!in_a(key)?))?;
        }
        _ => {
            take(a, &|_| Ok(true))?;
            take(b, &|_| Ok(true))?;
        }
    }
    Ok(Value::Set(Rc::new(result)))
}

/// `-a`, `+a`, `~a`.
pub(super) fn unary(operator: Unary, operand: &Value) -> Outcome<Value> {
    match (operator, operand.number()) {
        (Unary::Minus, Some(Number::Int(int))) => {
            int.checked_neg().map(Value::Int).ok_or_else(too_large)
        }
        (Unary::Minus, Some(Number::Float(float))) => Ok(Value::Float(-float)),
        (Unary::Plus, Some(number)) => Ok(number.into()),
        (Unary::Invert, Some(Number::Int(int))) => Ok(Value::Int(!int)),
        _ => {
            let sign = match operator {
                Unary::Minus => "-",
                Unary::Plus => "+",
                Unary::Invert => "~",
            };
            let error = ExpressionError::new(format!(
                "`{sign}` does not work on `{}`",
                operand.type_name()
            ));
            Err(match operand {
                Value::Str(_) => error.with_help("turn the text into a number first: float(...)"),
                _ => error,
            })
        }
    }
}

fn mismatch(operator: Binary, a: &Value, b: &Value) -> ExpressionError {
    let error = ExpressionError::new(format!(
        "`{}` does not work between `{}` and `{}`",
        operator.sign(),
        a.type_name(),
        b.type_name()
    ));
    match (operator, a, b) {
        (Binary::Add, Value::Str(_), _) | (Binary::Add, _, Value::Str(_)) => {
            error.with_help("to join text, turn the other side into text: str(...); to add, turn the text into a number: float(...)")
        }
        (_, Value::Str(_), other) | (_, other, Value::Str(_)) if other.number().is_some() => {
            error.with_help("turn the text into a number first: float(...)")
        }
        (Binary::Xor, Value::Float(_), _) | (Binary::Xor, _, Value::Float(_)) => error.with_help("a power is written `**`"),
        (_, Value::Function(_), _) | (_, _, Value::Function(_)) => error.with_help("call the function: name(...)"),
        _ => error,
    }
}
