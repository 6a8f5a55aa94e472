//! Built-in functions on collections, and those of the `xacro` namespace.

use std::cmp::Ordering;
use std::rc::Rc;

use super::ast::Binary;
use super::callable::{Arguments, Builtin};
use super::compare;
use super::conversion::sequence_of;
use super::error::{ExpressionError, Outcome, fail};
use super::interpreter::Interpreter;
use super::iterator::{IteratorHandle, State};
use super::operators::binary;
use super::subscript::length;
use super::value::{PythonRange, Value};

/// Python functions with collections as arguments or results.
pub(super) static COLLECTIONS: &[Builtin] = &[
    Builtin { name: "len", is_type: false, call: len },
    Builtin { name: "map", is_type: true, call: map },
    Builtin { name: "filter", is_type: true, call: filter },
    Builtin { name: "zip", is_type: true, call: zip },
    Builtin { name: "enumerate", is_type: true, call: enumerate },
    Builtin { name: "range", is_type: true, call: range },
    Builtin { name: "reversed", is_type: true, call: reversed },
    Builtin { name: "sorted", is_type: false, call: sorted },
    Builtin {
        name: "min",
        is_type: false,
        call: |interpreter, arguments| extreme(interpreter, "min", Ordering::Less, arguments),
    },
    Builtin {
        name: "max",
        is_type: false,
        call: |interpreter, arguments| extreme(interpreter, "max", Ordering::Greater, arguments),
    },
    Builtin { name: "sum", is_type: false, call: sum },
    Builtin {
        name: "all",
        is_type: false,
        call: |interpreter, arguments| Ok(Value::Bool(!has(interpreter, "all", false, arguments)?)),
    },
    Builtin {
        name: "any",
        is_type: false,
        call: |interpreter, arguments| Ok(Value::Bool(has(interpreter, "any", true, arguments)?)),
    },
];

/// Functions of `xacro` that do not need the caller.
pub(super) static XACRO: &[Builtin] = &[
    Builtin { name: "dotify", is_type: false, call: dotify },
    Builtin { name: "tokenize", is_type: false, call: tokenize },
    Builtin { name: "fatal", is_type: false, call: fatal },
];

fn len(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("len")?;
    let count = match &value {
        Value::Str(text) => length(text),
        Value::List(list) => list.len(),
        Value::Tuple(items) => items.items().len(),
        Value::Dict(dict) => dict.entries().len(),
        Value::Set(set) => set.entries().len(),
        Value::View(view) => view.dict.entries().len(),
        Value::Range(range) => return Ok(Value::Int(range.length)),
        other => return fail(format!("a `{}` has no length", other.type_name())),
    };
    Ok(Value::Int(count as i128))
}

fn sources(interpreter: &mut Interpreter<'_>, values: &[Value]) -> Outcome<Vec<IteratorHandle>> {
    values.iter().map(|value| interpreter.iterate(value)).collect()
}

fn map(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let mut values = arguments.all("map")?;
    if values.len() < 2 {
        return fail("`map` takes a function and at least one list");
    }
    let function = values.remove(0);
    let sources = sources(interpreter, &values)?;
    IteratorHandle::new(State::Map { function, sources }).map(Value::Iterator)
}

fn filter(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [function, values] = arguments.exactly("filter")?;
    let function = if matches!(function, Value::None) { None } else { Some(function) };
    let source = interpreter.iterate(&values)?;
    IteratorHandle::new(State::Filter { function, source }).map(Value::Iterator)
}

fn zip(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let values = arguments.all("zip")?;
    IteratorHandle::new(State::Zip(sources(interpreter, &values)?)).map(Value::Iterator)
}

fn enumerate(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [values, start] = arguments.bind("enumerate", ["iterable", "start"], 1)?;
    let source = interpreter.iterate(&values.unwrap_or(Value::None))?;
    let next = start.map_or(Ok(0), |start| start.integer())?;
    IteratorHandle::new(State::Enumerate { source, next }).map(Value::Iterator)
}

fn range(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let bounds: Outcome<Vec<i128>> = arguments.all("range")?.iter().map(Value::integer).collect();
    match bounds?.as_slice() {
        [stop] => PythonRange::new(0, *stop, 1),
        [start, stop] => PythonRange::new(*start, *stop, 1),
        [start, stop, step] => PythonRange::new(*start, *stop, *step),
        other => fail(format!("`range` takes 1 to 3 arguments, not {}", other.len())),
    }
    .map(Value::Range)
}

fn reversed(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [values] = arguments.exactly("reversed")?;
    let state = match &values {
        Value::Range(range) if range.length > 0 => {
            let last = range.nth(range.length - 1);
            let range = PythonRange {
                start: last,
                stop: range.start,
                step: range.step.checked_neg().ok_or_else(super::number::too_large)?,
                length: range.length,
            };
            State::Range { range, next: 0 }
        }
        Value::Set(_) | Value::Iterator(_) => {
            return fail(format!("a `{}` cannot be reversed", values.type_name()));
        }
        _ => {
            let mut items = interpreter.collect(&values)?;
            items.reverse();
            State::Values(items.into_iter())
        }
    };
    IteratorHandle::new(state).map(Value::Iterator)
}

/// Sort keys of `sorted`, `min` and `max`.
fn with_keys(
    interpreter: &mut Interpreter<'_>,
    values: Vec<Value>,
    key: &Option<Value>,
) -> Outcome<Vec<(Value, Value)>> {
    interpreter.budget.allocate_values(2 * values.len())?;
    let mut keyed = Vec::with_capacity(values.len());
    for value in values {
        let key = match key {
            None | Some(Value::None) => value.clone(),
            Some(function) => interpreter.apply(function, vec![value.clone()])?,
        };
        keyed.push((key, value));
    }
    Ok(keyed)
}

fn sorted(interpreter: &mut Interpreter<'_>, mut arguments: Arguments) -> Outcome<Value> {
    let key = arguments.keyword("key");
    let is_reversed = arguments.keyword("reverse").is_some_and(|reverse| reverse.is_true());
    let [values] = arguments.exactly("sorted")?;
    let values = interpreter.collect(&values)?;
    let mut keyed = with_keys(interpreter, values, &key)?;
    // Keeps the order of equal elements in a reverse sort: reverse, sort, reverse.
    if is_reversed {
        keyed.reverse();
    }
    let mut sorted = merge_sort(interpreter, keyed)?;
    if is_reversed {
        sorted.reverse();
    }
    Value::list(sorted.into_iter().map(|(_, value)| value).collect())
}

/// Stable merge sort that, unlike Rust's sort, allows comparisons that fail or are inconsistent (NaN).
fn merge_sort(
    interpreter: &mut Interpreter<'_>,
    values: Vec<(Value, Value)>,
) -> Outcome<Vec<(Value, Value)>> {
    if values.len() < 2 {
        return Ok(values);
    }
    let mut left = values;
    let right = left.split_off(left.len() / 2);
    let mut left = merge_sort(interpreter, left)?.into_iter().peekable();
    let mut right = merge_sort(interpreter, right)?.into_iter().peekable();
    let mut merged = Vec::with_capacity(left.len() + right.len());
    while let (Some((a, _)), Some((b, _))) = (left.peek(), right.peek()) {
        let right_first = compare::order(b, a, "<", interpreter.budget)? == Some(Ordering::Less);
        merged.extend(if right_first { right.next() } else { left.next() });
    }
    merged.extend(left);
    merged.extend(right);
    Ok(merged)
}

fn extreme(
    interpreter: &mut Interpreter<'_>,
    name: &'static str,
    wanted: Ordering,
    mut arguments: Arguments,
) -> Outcome<Value> {
    let key = arguments.keyword("key");
    let default = arguments.keyword("default");
    let mut values = arguments.all(name)?;
    let several = values.len() > 1;
    if values.is_empty() {
        return fail(format!("`{name}` needs at least one argument"));
    }
    if several && default.is_some() {
        return fail(format!("`{name}` takes a default only together with a list"));
    }
    if !several {
        values = interpreter.collect(&values[0])?;
    }
    let mut best: Option<(Value, Value)> = None;
    let sign = if wanted == Ordering::Less { "<" } else { ">" };
    for (key, value) in with_keys(interpreter, values, &key)? {
        let is_better = match &best {
            None => true,
            Some((best, _)) => {
                compare::order(&key, best, sign, interpreter.budget)? == Some(wanted)
            }
        };
        if is_better {
            best = Some((key, value));
        }
    }
    match best.map(|(_, value)| value).or(default) {
        Some(value) => Ok(value),
        None => Err(ExpressionError::new(format!("`{name}` of nothing"))
            .with_help("give a default: default=...")),
    }
}

fn sum(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [values, start] = arguments.bind("sum", ["iterable", "start"], 1)?;
    let mut total = start.unwrap_or(Value::Int(0));
    if matches!(total, Value::Str(_)) {
        return Err(ExpressionError::new("`sum` does not join text").with_help("use ''.join(...)"));
    }
    let iterator = interpreter.iterate(&values.unwrap_or(Value::None))?;
    while let Some(value) = interpreter.next(&iterator)? {
        total = binary(Binary::Add, &total, &value, interpreter.budget)?;
    }
    Ok(total)
}

/// Returns true if the truth value of any element is `wanted`.
fn has(
    interpreter: &mut Interpreter<'_>,
    name: &str,
    wanted: bool,
    arguments: Arguments,
) -> Outcome<bool> {
    let [values] = arguments.exactly(name)?;
    let iterator = interpreter.iterate(&values)?;
    while let Some(value) = interpreter.next(&iterator)? {
        if value.is_true() == wanted {
            return Ok(true);
        }
    }
    Ok(false)
}

fn dotify(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    super::conversion::dict(interpreter, arguments).map(Value::dotted)
}

/// Splits at any of the characters of `sep`, which xacro uses as a regular expression's character set.
fn tokenize(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [text, separators, skip_empty] =
        arguments.bind("xacro.tokenize", ["s", "sep", "skip_empty"], 1)?;
    let Some(Value::Str(text)) = text else { return fail("`xacro.tokenize` needs text to split") };
    let separators = match separators {
        None => ",; ".into(),
        Some(Value::Str(separators)) if !separators.is_empty() => separators,
        Some(_) => return fail("the separators of `xacro.tokenize` are letters in a text"),
    };
    if separators.contains(['\\', '^', ']', '[', '-']) {
        return fail(
            "the separators of `xacro.tokenize` must be plain letters, none of \\ ^ [ ] -",
        );
    }
    let keeps_empty = skip_empty.is_some_and(|skip| !skip.is_true());
    let separators: Rc<str> = separators;
    let parts = text
        .split(|letter| separators.contains(letter))
        .filter(|part| keeps_empty || !part.is_empty());
    sequence_of(interpreter, parts.map(str::to_owned))
}

fn fatal(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let words: Outcome<Vec<String>> =
        arguments.all("xacro.fatal")?.iter().map(|word| word.to_text(interpreter.budget)).collect();
    fail(words?.join(" "))
}
