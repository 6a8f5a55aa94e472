//! Methods of values. Only listed methods exist; none changes its object.

use std::rc::Rc;

use super::ast::Binary;
use super::callable::Arguments;
use super::compare;
use super::error::{ExpressionError, Outcome, fail};
use super::interpreter::Interpreter;
use super::number::truncate;
use super::operators::set_operation;
use super::suggest::closest;
use super::text_methods;
use super::value::{Dict, DictHandle, DictView, Value, ViewKind};

const SEQUENCE: &[&str] = &["index", "count"];
const LIST: &[&str] = &["index", "count", "copy"];
const DICT: &[&str] = &["keys", "values", "items", "get", "copy"];
const SET: &[&str] = &[
    "union",
    "intersection",
    "difference",
    "symmetric_difference",
    "issubset",
    "issuperset",
    "isdisjoint",
    "copy",
];
/// Methods that change their object in Python.
const CHANGING: &[&str] = &[
    "append",
    "extend",
    "insert",
    "remove",
    "pop",
    "clear",
    "sort",
    "reverse",
    "update",
    "setdefault",
    "popitem",
    "add",
    "discard",
];

/// Methods of a value.
pub(super) fn names(value: &Value) -> &'static [&'static str] {
    match value {
        Value::Str(_) => text_methods::NAMES,
        Value::List(_) => LIST,
        Value::Tuple(_) | Value::Range(_) => SEQUENCE,
        Value::Dict(_) => DICT,
        Value::Set(_) => SET,
        Value::Float(_) => &["is_integer"],
        Value::Int(_) | Value::Bool(_) => &["bit_length"],
        _ => &[],
    }
}

/// Error of an unknown attribute.
pub(super) fn unknown(value: &Value, name: &str) -> ExpressionError {
    let kind = value.type_name();
    if CHANGING.contains(&name) && matches!(value, Value::List(_) | Value::Dict(_) | Value::Set(_))
    {
        return ExpressionError::new(format!(
            "`{name}` would change the {kind}, and values in expressions never change"
        ))
        .with_help(match value {
            Value::List(_) if name == "sort" => "use python.sorted(...)",
            Value::List(_) if name == "reverse" => "use values[::-1]",
            Value::List(_) => "make a new list: values + [value]",
            _ => "make a new one: python.dict(values, key=value)",
        });
    }
    let error = ExpressionError::new(format!("a `{kind}` has no attribute `{name}`"));
    if let Value::Dict(dict) = value
        && dict.get_text(name).is_some()
    {
        return error.with_help(format!(
            "write ['{name}'], or make the keys attributes: xacro.dotify(...)"
        ));
    }
    match closest(name, names(value).iter().copied()) {
        Some(found) => error.with_help(format!("did you mean `{found}`?")),
        None => error,
    }
}

/// `object.name(arguments)`, for a name of [`names`].
pub(super) fn call(
    interpreter: &mut Interpreter<'_>,
    object: &Value,
    name: &str,
    arguments: Arguments,
) -> Outcome<Value> {
    match object {
        Value::Str(text) => text_methods::call(interpreter, text, name, arguments),
        Value::Dict(dict) => dict_method(dict, name, arguments),
        Value::Set(set) => set_method(interpreter, set, name, arguments),
        Value::Float(float) => {
            let [] = arguments.exactly(name)?;
            Ok(Value::Bool(float.is_finite() && float.fract() == 0.0))
        }
        Value::Int(_) | Value::Bool(_) => {
            let [] = arguments.exactly(name)?;
            Ok(Value::Int(i128::from(128 - object.integer()?.unsigned_abs().leading_zeros())))
        }
        _ => sequence_method(interpreter, object, name, arguments),
    }
}

fn sequence_method(
    interpreter: &mut Interpreter<'_>,
    object: &Value,
    name: &str,
    arguments: Arguments,
) -> Outcome<Value> {
    if name == "copy" {
        let [] = arguments.exactly(name)?;
        return Ok(object.clone());
    }
    let [element] = arguments.exactly(name)?;
    if let Value::Range(range) = object {
        // By arithmetic, as a range may be very long.
        let found = compare::contains(object, &element, interpreter.budget)?;
        return match (name, found) {
            ("count", found) => Ok(Value::Int(i128::from(found))),
            (_, true) => {
                let value = match element {
                    Value::Float(float) => truncate(float)?,
                    other => other.integer()?,
                };
                Ok(Value::Int((value - range.start) / range.step))
            }
            _ => fail("the range does not contain the value"),
        };
    }
    let items = interpreter.collect(object)?;
    let mut count = 0;
    for (index, item) in items.iter().enumerate() {
        if compare::equal(item, &element, interpreter.budget)? {
            if name == "index" {
                return Ok(Value::Int(index as i128));
            }
            count += 1;
        }
    }
    if name == "index" {
        fail(format!(
            "{} is not in the {}",
            element.to_repr(interpreter.budget)?,
            object.type_name()
        ))
    } else {
        Ok(Value::Int(count))
    }
}

fn dict_method(dict: &DictHandle, name: &str, arguments: Arguments) -> Outcome<Value> {
    let view = |kind| Ok(Value::View(DictView { kind, dict: dict.dict.clone() }));
    if name == "get" {
        let [key, default] = arguments.bind("get", ["key", "default"], 1)?;
        let value = dict.get(&key.unwrap_or(Value::None))?.cloned();
        return Ok(value.or(default).unwrap_or(Value::None));
    }
    let [] = arguments.exactly(name)?;
    match name {
        "keys" => view(ViewKind::Keys),
        "values" => view(ViewKind::Values),
        "items" => view(ViewKind::Items),
        _ => Ok(Value::Dict(DictHandle { dict: dict.dict.clone(), is_dotted: false })),
    }
}

fn set_method(
    interpreter: &mut Interpreter<'_>,
    set: &Rc<Dict>,
    name: &str,
    arguments: Arguments,
) -> Outcome<Value> {
    if name == "copy" {
        let [] = arguments.exactly(name)?;
        return Ok(Value::Set(set.clone()));
    }
    let [other] = arguments.exactly(name)?;
    let items = interpreter.collect(&other)?;
    let Value::Set(other) = interpreter.set_of(items)? else { return fail("no set") };
    let budget = &mut *interpreter.budget;
    match name {
        "union" => set_operation(Binary::Or, set, &other, budget),
        "intersection" => set_operation(Binary::And, set, &other, budget),
        "difference" => set_operation(Binary::Subtract, set, &other, budget),
        "symmetric_difference" => set_operation(Binary::Xor, set, &other, budget),
        "issubset" => compare::is_subset(set, &other, budget).map(Value::Bool),
        "issuperset" => compare::is_subset(&other, set, budget).map(Value::Bool),
        _ => {
            let shared = set_operation(Binary::And, set, &other, budget)?;
            Ok(Value::Bool(!shared.is_true()))
        }
    }
}
