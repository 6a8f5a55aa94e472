//! `==`, `<` and `in`.

use std::cmp::Ordering;
use std::rc::Rc;

use super::budget::Budget;
use super::error::{ExpressionError, Outcome, fail};
use super::number;
use super::value::{Dict, Value, ViewKind};

/// `a == b`.
pub(super) fn equal(a: &Value, b: &Value, budget: &mut Budget) -> Outcome<bool> {
    budget.step()?;
    if let (Some(a), Some(b)) = (a.number(), b.number()) {
        return Ok(number::compare(a, b) == Some(Ordering::Equal));
    }
    Ok(match (a, b) {
        (Value::None, Value::None) => true,
        (Value::Str(a), Value::Str(b)) => {
            budget.scan(a.len().min(b.len()))?;
            a == b
        }
        (Value::List(a), Value::List(b)) => equal_items(a, b, budget)?,
        (Value::Tuple(a), Value::Tuple(b)) => equal_items(a.items(), b.items(), budget)?,
        (Value::Dict(a), Value::Dict(b)) => equal_dicts(a, b, budget)?,
        (Value::Set(a), Value::Set(b)) => {
            a.entries().len() == b.entries().len() && is_subset(a, b, budget)?
        }
        (Value::Range(a), Value::Range(b)) => {
            a.length == b.length
                && (a.length == 0 || a.start == b.start && (a.length == 1 || a.step == b.step))
        }
        (Value::Function(a), Value::Function(b)) => a.is_same(b),
        (Value::Module(a), Value::Module(b)) => a == b,
        (Value::Namespace(a), Value::Namespace(b)) => a == b,
        (Value::View(a), Value::View(b))
            if a.kind == ViewKind::Keys && b.kind == ViewKind::Keys =>
        {
            a.dict.entries().len() == b.dict.entries().len() && is_subset(&a.dict, &b.dict, budget)?
        }
        _ => is(a, b),
    })
}

/// Equal or identical: the comparison of elements in Python, so that `nan in [nan]` can be true.
fn same_or_equal(a: &Value, b: &Value, budget: &mut Budget) -> Outcome<bool> {
    equal(a, b, budget)
}

fn equal_items(a: &[Value], b: &[Value], budget: &mut Budget) -> Outcome<bool> {
    if a.len() != b.len() {
        return Ok(false);
    }
    for (a, b) in a.iter().zip(b) {
        if !same_or_equal(a, b, budget)? {
            return Ok(false);
        }
    }
    Ok(true)
}

fn equal_dicts(a: &Dict, b: &Dict, budget: &mut Budget) -> Outcome<bool> {
    if a.entries().len() != b.entries().len() {
        return Ok(false);
    }
    for (key, value) in a.entries() {
        match b.get(key)? {
            Some(other) if equal(value, other, budget)? => {}
            _ => return Ok(false),
        }
    }
    Ok(true)
}

/// Returns true if every key of `a` is in `b`.
pub(super) fn is_subset(a: &Dict, b: &Dict, budget: &mut Budget) -> Outcome<bool> {
    for (key, _) in a.entries() {
        budget.step()?;
        if b.get(key)?.is_none() {
            return Ok(false);
        }
    }
    Ok(true)
}

/// `a is b`. Values have no identity here except shared memory; equal scalars of one type are identical.
pub(super) fn is(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::None, Value::None) => true,
        (Value::Bool(a), Value::Bool(b)) => a == b,
        (Value::Int(a), Value::Int(b)) => a == b,
        (Value::Float(a), Value::Float(b)) => a.to_bits() == b.to_bits(),
        (Value::Str(a), Value::Str(b)) => a == b,
        (Value::List(a), Value::List(b)) => Rc::ptr_eq(&a.items, &b.items),
        (Value::Tuple(a), Value::Tuple(b)) => Rc::ptr_eq(a, b),
        (Value::Dict(a), Value::Dict(b)) => Rc::ptr_eq(&a.dict, &b.dict),
        (Value::Set(a), Value::Set(b)) => Rc::ptr_eq(a, b),
        (Value::Iterator(a), Value::Iterator(b)) => a.is_same(b),
        (Value::Function(a), Value::Function(b)) => a.is_same(b),
        (Value::Module(a), Value::Module(b)) => a == b,
        (Value::Namespace(a), Value::Namespace(b)) => a == b,
        _ => false,
    }
}

/// Order of two values; `None` if a NaN makes every comparison false. `sign` is for the error.
pub(super) fn order(
    a: &Value,
    b: &Value,
    sign: &str,
    budget: &mut Budget,
) -> Outcome<Option<Ordering>> {
    budget.step()?;
    if let (Some(a), Some(b)) = (a.number(), b.number()) {
        return Ok(number::compare(a, b));
    }
    match (a, b) {
        (Value::Str(a), Value::Str(b)) => {
            budget.scan(a.len().min(b.len()))?;
            // The byte order of UTF-8 is that of the code points.
            Ok(Some(a.cmp(b)))
        }
        (Value::List(a), Value::List(b)) => order_items(a, b, sign, budget),
        (Value::Tuple(a), Value::Tuple(b)) => order_items(a.items(), b.items(), sign, budget),
        (Value::Set(a), Value::Set(b)) => order_sets(a, b, budget),
        _ => {
            let error = ExpressionError::new(format!(
                "cannot compare `{}` {sign} `{}`",
                a.type_name(),
                b.type_name()
            ));
            Err(match (a, b) {
                (Value::Str(_), other) | (other, Value::Str(_)) if other.number().is_some() => {
                    error.with_help("turn the text into a number first: float(...)")
                }
                _ => error,
            })
        }
    }
}

fn order_items(
    a: &[Value],
    b: &[Value],
    sign: &str,
    budget: &mut Budget,
) -> Outcome<Option<Ordering>> {
    for (a, b) in a.iter().zip(b) {
        if !same_or_equal(a, b, budget)? {
            return order(a, b, sign, budget);
        }
    }
    Ok(Some(a.len().cmp(&b.len())))
}

fn order_sets(a: &Dict, b: &Dict, budget: &mut Budget) -> Outcome<Option<Ordering>> {
    Ok(match (is_subset(a, b, budget)?, is_subset(b, a, budget)?) {
        (true, true) => Some(Ordering::Equal),
        (true, false) => Some(Ordering::Less),
        (false, true) => Some(Ordering::Greater),
        (false, false) => None,
    })
}

/// `element in container`, for containers that need no iterator.
pub(super) fn contains(container: &Value, element: &Value, budget: &mut Budget) -> Outcome<bool> {
    let any_equal =
        |items: &mut dyn Iterator<Item = &Value>, budget: &mut Budget| -> Outcome<bool> {
            for item in items {
                if same_or_equal(item, element, budget)? {
                    return Ok(true);
                }
            }
            Ok(false)
        };
    match container {
        Value::Str(text) => match element {
            Value::Str(part) => {
                budget.scan(text.len())?;
                Ok(text.contains(&**part))
            }
            _ => Err(ExpressionError::new(format!(
                "`in` a `str` needs a `str` on the left, not `{}`",
                element.type_name()
            ))
            .with_help("turn the left side into text: str(...)")),
        },
        Value::List(list) => any_equal(&mut list.iter(), budget),
        Value::Tuple(items) => any_equal(&mut items.items().iter(), budget),
        Value::Dict(dict) => Ok(dict.get(element)?.is_some()),
        Value::Set(set) => Ok(set.get(element)?.is_some()),
        Value::Range(range) => match element.number() {
            Some(number) => {
                let whole = match number {
                    number::Number::Int(int) => int,
                    number::Number::Float(float) if float.fract() == 0.0 => {
                        match number::truncate(float) {
                            Ok(whole) => whole,
                            Err(_) => return Ok(false),
                        }
                    }
                    number::Number::Float(_) => return Ok(false),
                };
                let in_bounds = if range.step > 0 {
                    (range.start..range.stop).contains(&whole)
                } else {
                    range.stop < whole && whole <= range.start
                };
                Ok(in_bounds
                    && whole
                        .checked_sub(range.start)
                        .is_some_and(|distance| distance % range.step == 0))
            }
            None => Ok(false),
        },
        Value::View(view) => match view.kind {
            ViewKind::Keys => Ok(view.dict.get(element)?.is_some()),
            ViewKind::Values => {
                any_equal(&mut view.dict.entries().iter().map(|(_, value)| value), budget)
            }
            ViewKind::Items => match element {
                Value::Tuple(pair) if pair.items().len() == 2 => {
                    match view.dict.get(&pair.items()[0])? {
                        Some(value) => equal(value, &pair.items()[1], budget),
                        None => Ok(false),
                    }
                }
                _ => Ok(false),
            },
        },
        _ => fail(format!(
            "`in` needs a list, string or dict on the right, not `{}`",
            container.type_name()
        )),
    }
}
