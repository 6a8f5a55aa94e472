//! `values[index]` and `values[start:stop:step]`.

use super::budget::Budget;
use super::error::{ExpressionError, Outcome, fail};
use super::suggest::closest;
use super::value::{DictHandle, PythonList, PythonRange, Sequence, Value};

/// `object[index]`.
pub(super) fn item(object: &Value, index: &Value, budget: &mut Budget) -> Outcome<Value> {
    match object {
        Value::Dict(dict) => match dict.get(index)? {
            Some(value) => Ok(value.clone().dotted_if(dict.is_dotted)),
            None => Err(match index {
                Value::Str(key) => missing_key(dict, key),
                _ => {
                    ExpressionError::new(format!("the dict has no key {}", index.to_repr(budget)?))
                }
            }),
        },
        Value::List(list) => {
            let place = place(index, list.len() as i128, "list")?;
            Ok(list[place as usize].clone().dotted_if(list.is_dotted))
        }
        Value::Tuple(items) => {
            Ok(items.items()[place(index, items.items().len() as i128, "tuple")? as usize].clone())
        }
        Value::Range(range) => Ok(Value::Int(range.nth(place(index, range.length, "range")?))),
        Value::Str(text) => {
            budget.scan(text.len())?;
            budget.allocate(24)?;
            let place = place(index, length(text) as i128, "string")? as usize;
            Ok(Value::text(text.chars().skip(place).take(1).collect::<String>()))
        }
        other => Err(not_indexable(other)),
    }
}

fn not_indexable(value: &Value) -> ExpressionError {
    let error = ExpressionError::new(format!(
        "a `{}` has no elements to take by `[...]`",
        value.type_name()
    ));
    match value {
        Value::Iterator(_) | Value::View(_) | Value::Set(_) => {
            error.with_help("make a list of it first: list(...)")
        }
        Value::Function(_) => error.with_help("call it with `(...)`"),
        _ => error,
    }
}

pub(super) fn missing_key(dict: &DictHandle, key: &str) -> ExpressionError {
    let texts = || {
        dict.entries()
            .iter()
            .filter_map(|(key, _)| if let Value::Str(key) = key { Some(&**key) } else { None })
    };
    let error = ExpressionError::new(format!("the dict has no key '{}'", key.escape_debug()));
    match closest(key, texts()) {
        Some(found) => error.with_help(format!("did you mean '{found}'?")),
        None => {
            let known: Vec<&str> = texts().take(8).collect();
            if known.is_empty() {
                error
            } else {
                error.with_help(format!("it has {}", known.join(", ")))
            }
        }
    }
}

/// Number of characters.
pub(super) fn length(text: &str) -> usize {
    if text.is_ascii() { text.len() } else { text.chars().count() }
}

fn place(index: &Value, length: i128, what: &str) -> Outcome<i128> {
    let Ok(index) = index.integer() else {
        let error = ExpressionError::new(format!(
            "a {what} is indexed by integers, not by `{}`",
            index.type_name()
        ));
        return Err(match index {
            Value::Float(_) => error.with_help("`/` gives a float; use `//` or int(...)"),
            _ => error,
        });
    };
    let place = if index < 0 { index.saturating_add(length) } else { index };
    if (0..length).contains(&place) {
        Ok(place)
    } else {
        Err(ExpressionError::new(format!("the index {index} is outside the {what}")).with_help(
            match length {
                0 => format!("the {what} is empty"),
                _ => format!("it has {length} elements, the last one at {}", length - 1),
            },
        ))
    }
}

/// `object[start:stop:step]`.
pub(super) fn slice(
    object: &Value,
    bounds: &[Option<Value>; 3],
    budget: &mut Budget,
) -> Outcome<Value> {
    match object {
        Value::List(list) => {
            let items = pick(list, bounds, budget)?;
            Ok(Value::List(PythonList { items: Sequence::new(items)?, is_dotted: list.is_dotted }))
        }
        Value::Tuple(items) => Value::tuple(pick(items.items(), bounds, budget)?),
        Value::Str(text) => {
            budget.scan(text.len())?;
            budget.allocate(text.len() as u128 * 5)?;
            let letters: Vec<char> = text.chars().collect();
            let places = indices(bounds, letters.len() as i128)?;
            Ok(Value::text(
                (0..places.length).map(|nth| letters[places.nth(nth) as usize]).collect::<String>(),
            ))
        }
        Value::Range(range) => {
            let places = indices(bounds, range.length)?;
            let step = range.step.checked_mul(places.step).ok_or_else(super::number::too_large)?;
            // Bounds as in Python: the values at the bounding indices.
            let at = |index: i128| {
                index
                    .checked_mul(range.step)
                    .and_then(|offset| offset.checked_add(range.start))
                    .ok_or_else(super::number::too_large)
            };
            PythonRange::new(at(places.start)?, at(places.stop)?, step).map(Value::Range)
        }
        Value::Dict(_) => fail("a dict has no slices"),
        other => Err(not_indexable(other)),
    }
}

fn pick(items: &[Value], bounds: &[Option<Value>; 3], budget: &mut Budget) -> Outcome<Vec<Value>> {
    let places = indices(bounds, items.len() as i128)?;
    budget.allocate_values(places.length as usize)?;
    budget.steps(places.length as u64 / 16)?;
    Ok((0..places.length).map(|nth| items[places.nth(nth) as usize].clone()).collect())
}

/// Indices of a slice in a sequence of this length.
fn indices(bounds: &[Option<Value>; 3], length: i128) -> Outcome<PythonRange> {
    let bound = |value: &Option<Value>| -> Outcome<Option<i128>> {
        match value {
            None | Some(Value::None) => Ok(None),
            Some(value) => match value.integer() {
                Ok(int) => Ok(Some(int)),
                Err(_) => Err(ExpressionError::new(format!(
                    "the bounds of a slice are integers, not `{}`",
                    value.type_name()
                ))),
            },
        }
    };
    // Steps beyond the length all select one element; limiting them avoids overflow.
    let step = match bound(&bounds[2])?.unwrap_or(1) {
        0 => return fail("the step of a slice must not be zero"),
        step => step.clamp(-(1 << 62), 1 << 62),
    };
    let (lowest, highest) = if step > 0 { (0, length) } else { (-1, length - 1) };
    let clamped = |value: Option<i128>, default: i128| match value {
        None => default,
        Some(index) => {
            (if index < 0 { index.saturating_add(length) } else { index }).clamp(lowest, highest)
        }
    };
    let (first, last) = if step > 0 { (lowest, highest) } else { (highest, lowest) };
    PythonRange::new(clamped(bound(&bounds[0])?, first), clamped(bound(&bounds[1])?, last), step)
}

/// Part of a text between two optional character indices, as `text[start:stop]`, and its start.
pub(super) fn window<'a>(
    text: &'a str,
    start: &Option<Value>,
    stop: &Option<Value>,
) -> Outcome<Option<(usize, &'a str)>> {
    let count = length(text) as i128;
    let raw = |bound: &Option<Value>, default: i128| -> Outcome<i128> {
        match bound {
            None | Some(Value::None) => Ok(default),
            Some(value) => value.integer(),
        }
    };
    let place = |index: i128| if index < 0 { index.saturating_add(count).max(0) } else { index };
    let (start, stop) = (place(raw(start, 0)?), place(raw(stop, count)?).min(count));
    if start > stop {
        return Ok(None);
    }
    let byte =
        |place: i128| text.char_indices().nth(place as usize).map_or(text.len(), |(byte, _)| byte);
    let (from, to) =
        if text.is_ascii() { (start as usize, stop as usize) } else { (byte(start), byte(stop)) };
    Ok(Some((start as usize, &text[from..to])))
}
