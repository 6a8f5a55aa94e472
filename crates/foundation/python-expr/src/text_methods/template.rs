//! `'{side}_wheel_{0:02d}'.format(1, side='left')`.

use std::rc::Rc;

use super::super::callable::Arguments;
use super::super::error::{ExpressionError, Outcome, fail};
use super::super::format_spec::format_value;
use super::super::interpreter::Interpreter;
use super::super::subscript::item;
use super::super::value::Value;

/// Numbering of fields without a name.
#[derive(Clone, Copy, PartialEq)]
enum Numbering {
    Unknown,
    Automatic(usize),
    Manual,
}

pub(super) fn format(
    interpreter: &mut Interpreter<'_>,
    template: &str,
    arguments: &Arguments,
) -> Outcome<String> {
    let mut numbering = Numbering::Unknown;
    fill(interpreter, template, arguments, &mut numbering, 2)
}

fn fill(
    interpreter: &mut Interpreter<'_>,
    template: &str,
    arguments: &Arguments,
    numbering: &mut Numbering,
    levels: u32,
) -> Outcome<String> {
    if levels == 0 {
        return fail("the fields of the format nest too deeply");
    }
    let mut result = String::new();
    let mut rest = template;
    while let Some(place) = rest.find(['{', '}']) {
        result.push_str(&rest[..place]);
        let brace = &rest[place..place + 1];
        rest = &rest[place + 1..];
        if let Some(after) = rest.strip_prefix(brace) {
            result.push_str(brace);
            rest = after;
        } else if brace == "}" {
            return Err(
                ExpressionError::new("a single `}` in the format").with_help("double it: `}}`")
            );
        } else {
            let end = field_end(rest).ok_or_else(|| {
                ExpressionError::new("a `{` in the format is not closed")
                    .with_help("close it with `}`, or double it: `{{`")
            })?;
            result.push_str(&field(interpreter, &rest[..end], arguments, numbering, levels)?);
            rest = &rest[end + 1..];
        }
    }
    result.push_str(rest);
    Ok(result)
}

/// Position of the `}` of a field, after the fields in its specification.
fn field_end(text: &str) -> Option<usize> {
    let mut open = 0_usize;
    for (place, letter) in text.char_indices() {
        match letter {
            '{' => open += 1,
            '}' if open == 0 => return Some(place),
            '}' => open -= 1,
            _ => {}
        }
    }
    None
}

fn field(
    interpreter: &mut Interpreter<'_>,
    field: &str,
    arguments: &Arguments,
    numbering: &mut Numbering,
    levels: u32,
) -> Outcome<String> {
    interpreter.budget.scan(field.len())?;
    // `!` and `:` inside an index belong to the key.
    let mut in_index = false;
    let name_end = field.find(|letter| {
        in_index = (in_index || letter == '[') && letter != ']';
        !in_index && matches!(letter, '!' | ':')
    });
    let (name, mut rest) = field.split_at(name_end.unwrap_or(field.len()));
    let mut conversion = None;
    if let Some(behind) = rest.strip_prefix('!') {
        conversion = behind.chars().next();
        let Some(letter) = conversion else {
            return fail("behind `!` one of `r`, `s` and `a` is needed");
        };
        rest = &behind[letter.len_utf8()..];
        if !rest.is_empty() && !rest.starts_with(':') {
            return fail("behind the conversion `:` or `}` is needed");
        }
    }
    let value = named(interpreter, name, arguments, numbering)?;
    let value = interpreter.convert(value, conversion)?;
    let specification = match rest.strip_prefix(':') {
        Some(specification) if specification.contains(['{', '}']) => {
            fill(interpreter, specification, arguments, numbering, levels - 1)?
        }
        Some(specification) => specification.to_owned(),
        None => String::new(),
    };
    format_value(&value, &specification, interpreter.budget)
}

/// `0`, `name`, `name.attribute` or `name[key]`.
fn named(
    interpreter: &mut Interpreter<'_>,
    name: &str,
    arguments: &Arguments,
    numbering: &mut Numbering,
) -> Outcome<Value> {
    let (first, mut rest) = name.split_at(name.find(['.', '[']).unwrap_or(name.len()));
    let is_number = !first.is_empty() && first.bytes().all(|byte| byte.is_ascii_digit());
    let mut value = if first.is_empty() || is_number {
        let index = match (*numbering, first.is_empty()) {
            (Numbering::Unknown, true) => {
                *numbering = Numbering::Automatic(1);
                0
            }
            (Numbering::Automatic(next), true) => {
                *numbering = Numbering::Automatic(next + 1);
                next
            }
            (Numbering::Unknown | Numbering::Manual, false) => {
                *numbering = Numbering::Manual;
                first.parse().unwrap_or(usize::MAX)
            }
            _ => return fail("the format mixes `{}` with `{0}`"),
        };
        let given = arguments.positional.len();
        arguments.positional.get(index).cloned().ok_or_else(|| {
            ExpressionError::new(format!("the format uses argument {index}, but there are {given}"))
        })?
    } else {
        let found = arguments.keywords.iter().find(|(keyword, _)| &**keyword == first);
        found.map(|(_, value)| value.clone()).ok_or_else(|| {
            ExpressionError::new(format!("the format uses `{first}`, which is not given"))
        })?
    };
    while !rest.is_empty() {
        interpreter.budget.step()?;
        if let Some(behind) = rest.strip_prefix('.') {
            let end = behind.find(['.', '[']).unwrap_or(behind.len());
            let attribute: Rc<str> = behind[..end].into();
            value = interpreter.attribute(value, &attribute)?;
            rest = &behind[end..];
        } else if let Some((key, behind)) =
            rest.strip_prefix('[').and_then(|rest| rest.split_once(']'))
        {
            let is_index = !key.is_empty() && key.bytes().all(|byte| byte.is_ascii_digit());
            let key = if is_index {
                Value::Int(key.parse().unwrap_or(i128::MAX))
            } else {
                Value::text(key)
            };
            value = item(&value, &key, interpreter.budget)?;
            rest = behind;
        } else {
            return fail("a `[` in the format is not closed");
        }
    }
    Ok(value)
}
