//! Types, and conversions between values and text.

use std::rc::Rc;

use super::callable::{Arguments, Builtin, Callable};
use super::error::{ExpressionError, Outcome, fail};
use super::globals::python_builtin;
use super::interpreter::Interpreter;
use super::literal;
use super::number::{Number, truncate};
use super::text::to_ascii;
use super::value::{Dict, DictHandle, Value};

pub(super) static CONVERSIONS: &[Builtin] = &[
    Builtin { name: "str", is_type: true, call: str },
    Builtin { name: "int", is_type: true, call: int },
    Builtin { name: "float", is_type: true, call: float },
    Builtin { name: "bool", is_type: true, call: bool },
    Builtin {
        name: "list",
        is_type: true,
        call: |interpreter, arguments| {
            elements(interpreter, "list", arguments).and_then(Value::list)
        },
    },
    Builtin {
        name: "tuple",
        is_type: true,
        call: |interpreter, arguments| {
            elements(interpreter, "tuple", arguments).and_then(Value::tuple)
        },
    },
    Builtin {
        name: "set",
        is_type: true,
        call: |interpreter, arguments| set(interpreter, "set", arguments),
    },
    Builtin {
        name: "frozenset",
        is_type: true,
        call: |interpreter, arguments| set(interpreter, "frozenset", arguments),
    },
    Builtin { name: "dict", is_type: true, call: dict },
    Builtin { name: "repr", is_type: false, call: repr },
    Builtin { name: "ascii", is_type: false, call: ascii },
    Builtin { name: "ord", is_type: false, call: ord },
    Builtin { name: "chr", is_type: false, call: chr },
    Builtin {
        name: "bin",
        is_type: false,
        call: |_, arguments| in_base("bin", arguments, |int| format!("0b{int:b}")),
    },
    Builtin {
        name: "oct",
        is_type: false,
        call: |_, arguments| in_base("oct", arguments, |int| format!("0o{int:o}")),
    },
    Builtin {
        name: "hex",
        is_type: false,
        call: |_, arguments| in_base("hex", arguments, |int| format!("0x{int:x}")),
    },
    Builtin { name: "type", is_type: true, call: type_of },
    Builtin { name: "isinstance", is_type: false, call: isinstance },
];

fn str(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.bind("str", ["object"], 0)?;
    value.map_or(Ok(String::new()), |value| value.to_text(interpreter.budget)).map(Value::text)
}

fn repr(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("repr")?;
    value.to_repr(interpreter.budget).map(Value::text)
}

fn ascii(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("ascii")?;
    Ok(Value::text(to_ascii(&value.to_repr(interpreter.budget)?)))
}

fn int(interpreter: &mut Interpreter<'_>, mut arguments: Arguments) -> Outcome<Value> {
    let base = arguments.keyword("base");
    let mut values = arguments.all("int")?.into_iter();
    let (value, place_base) = (values.next(), values.next());
    if values.next().is_some() || (base.is_some() && place_base.is_some()) {
        return fail("`int` takes a value and a base, no more");
    }
    let Some(value) = value else { return Ok(Value::Int(0)) };
    let base = match base.or(place_base) {
        None => None,
        Some(base) => match base.integer()? {
            base @ (0 | 2..=36) => Some(base as u32),
            other => return fail(format!("the base of `int` is 0 or 2 to 36, not {other}")),
        },
    };
    match (&value, base) {
        (Value::Str(text), base) => {
            interpreter.budget.scan(text.len())?;
            interpreter.budget.allocate(text.len() as u128 * 2)?;
            literal::integer(text, base.unwrap_or(10)).map(Value::Int).map_err(|error| {
                match literal::float(text) {
                    Ok(_) if error.help.is_none() && base.is_none() => {
                        error.with_help("convert in two steps: int(float(...))")
                    }
                    _ => error,
                }
            })
        }
        (_, Some(_)) => fail("`int` takes a base only together with text"),
        (other, None) => match other.number() {
            Some(Number::Int(int)) => Ok(Value::Int(int)),
            Some(Number::Float(float)) => truncate(float).map(Value::Int),
            None => fail(format!("a `{}` cannot become an integer", other.type_name())),
        },
    }
}

fn float(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let values = arguments.all("float")?;
    match values.as_slice() {
        [] => Ok(Value::Float(0.0)),
        [Value::Str(text)] => {
            interpreter.budget.scan(text.len())?;
            interpreter.budget.allocate(text.len() as u128 * 2)?;
            literal::float(text).map(Value::Float)
        }
        [value] if value.number().is_some() => value.real().map(Value::Float),
        [other] => fail(format!("a `{}` cannot become a number", other.type_name())),
        _ => fail("`float` takes one argument"),
    }
}

fn bool(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let values = arguments.all("bool")?;
    match values.as_slice() {
        [] => Ok(Value::Bool(false)),
        [value] => Ok(Value::Bool(value.is_true())),
        _ => fail("`bool` takes one argument"),
    }
}

fn elements(
    interpreter: &mut Interpreter<'_>,
    name: &str,
    arguments: Arguments,
) -> Outcome<Vec<Value>> {
    let values = arguments.all(name)?;
    match values.as_slice() {
        [] => Ok(Vec::new()),
        [value] => interpreter.collect(value),
        _ => Err(ExpressionError::new(format!("`{name}` takes one argument"))
            .with_help("put the elements in brackets")),
    }
}

fn set(interpreter: &mut Interpreter<'_>, name: &str, arguments: Arguments) -> Outcome<Value> {
    let items = elements(interpreter, name, arguments)?;
    interpreter.set_of(items)
}

pub(super) fn dict(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let mut dict = Dict::default();
    match arguments.positional.as_slice() {
        [] => {}
        [Value::Dict(other)] => {
            for (key, value) in other.entries() {
                interpreter.insert(&mut dict, key.clone(), value.clone())?;
            }
        }
        [pairs] => {
            let iterator = interpreter.iterate(pairs)?;
            while let Some(pair) = interpreter.next(&iterator)? {
                let pair: Result<[Value; 2], _> = interpreter.collect(&pair)?.try_into();
                let Ok([key, value]) = pair else {
                    return fail("`dict` needs pairs of a key and a value");
                };
                interpreter.insert(&mut dict, key, value)?;
            }
        }
        _ => return fail("`dict` takes one argument besides those by name"),
    }
    for (name, value) in arguments.keywords {
        interpreter.insert(&mut dict, Value::Str(name), value)?;
    }
    Ok(Value::Dict(DictHandle { dict: Rc::new(dict), is_dotted: false }))
}

fn ord(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("ord")?;
    if let Value::Str(text) = &value {
        let mut letters = text.chars();
        if let (Some(letter), None) = (letters.next(), letters.next()) {
            return Ok(Value::Int(i128::from(u32::from(letter))));
        }
    }
    fail("`ord` needs a text of one character")
}

fn chr(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("chr")?;
    match u32::try_from(value.integer()?).ok().and_then(char::from_u32) {
        Some(letter) => Ok(Value::text(letter.to_string())),
        None => fail("`chr` needs the code of a character"),
    }
}

fn in_base(name: &str, arguments: Arguments, write: fn(u128) -> String) -> Outcome<Value> {
    let [value] = arguments.exactly(name)?;
    let int = value.integer()?;
    let text = write(int.unsigned_abs());
    Ok(Value::text(if int < 0 { format!("-{text}") } else { text }))
}

fn type_of(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("type")?;
    match python_builtin(value.type_name()) {
        Some(builtin) if builtin.is_type => Ok(Value::Function(Callable::Builtin(builtin))),
        _ => fail(format!("`type` of a `{}` is not supported", value.type_name())),
    }
}

fn isinstance(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value, types] = arguments.exactly("isinstance")?;
    is_one_of(&value, &types).map(Value::Bool)
}

fn is_one_of(value: &Value, types: &Value) -> Outcome<bool> {
    match types {
        Value::Function(Callable::Builtin(builtin)) if builtin.is_type => {
            let own = value.type_name();
            Ok(own == builtin.name || (own == "bool" && builtin.name == "int"))
        }
        Value::Tuple(all) => {
            for one in all.items() {
                if is_one_of(value, one)? {
                    return Ok(true);
                }
            }
            Ok(false)
        }
        other => fail(format!(
            "`isinstance` needs a type such as `str` or a tuple of types, not `{}`",
            other.type_name()
        )),
    }
}

/// List of texts.
pub(super) fn sequence_of(
    interpreter: &mut Interpreter<'_>,
    texts: impl Iterator<Item = String>,
) -> Outcome<Value> {
    let mut values = Vec::new();
    for text in texts {
        interpreter.budget.step()?;
        interpreter.budget.allocate(2 * size_of::<Value>() as u128 + text.len() as u128)?;
        values.push(Value::text(text));
    }
    Value::list(values)
}
