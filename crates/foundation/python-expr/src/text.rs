//! `str()` and `repr()`.

use super::budget::Budget;
use super::error::Outcome;
use super::format_float;
use super::value::{Value, ViewKind};

impl Value {
    /// `str(value)`; an error if the text would exceed the budget.
    pub fn to_text(&self, budget: &mut Budget) -> Outcome<String> {
        let mut text = String::new();
        match self {
            Self::Str(own) => {
                budget.allocate(own.len() as u128)?;
                text.push_str(own);
            }
            _ => write_repr(self, &mut text, budget)?,
        }
        Ok(text)
    }

    /// `repr(value)`; an error if the text would exceed the budget.
    pub fn to_repr(&self, budget: &mut Budget) -> Outcome<String> {
        let mut text = String::new();
        write_repr(self, &mut text, budget)?;
        Ok(text)
    }
}

fn write_repr(value: &Value, out: &mut String, budget: &mut Budget) -> Outcome<()> {
    budget.step()?;
    budget.allocate(32)?;
    match value {
        Value::None => out.push_str("None"),
        Value::Bool(true) => out.push_str("True"),
        Value::Bool(false) => out.push_str("False"),
        Value::Int(int) => out.push_str(&int.to_string()),
        Value::Float(float) => out.push_str(&format_float::repr(*float)),
        Value::Str(text) => {
            // An escape has at most ten characters for one.
            budget.allocate(text.len() as u128 * 2)?;
            write_quoted(text, out);
        }
        Value::List(list) => write_all(list, "[", "]", out, budget)?,
        Value::Tuple(items) if items.items().len() == 1 => {
            write_all(items.items(), "(", ",)", out, budget)?;
        }
        Value::Tuple(items) => write_all(items.items(), "(", ")", out, budget)?,
        Value::Dict(dict) => {
            out.push('{');
            for (index, (key, value)) in dict.entries().iter().enumerate() {
                if index > 0 {
                    out.push_str(", ");
                }
                write_repr(key, out, budget)?;
                out.push_str(": ");
                write_repr(value, out, budget)?;
            }
            out.push('}');
        }
        Value::Set(set) if set.entries().is_empty() => out.push_str("set()"),
        Value::Set(set) => {
            write_joined(set.entries().iter().map(|(key, _)| key), "{", "}", out, budget)?;
        }
        Value::Range(range) if range.step == 1 => {
            out.push_str(&format!("range({}, {})", range.start, range.stop));
        }
        Value::Range(range) => {
            out.push_str(&format!("range({}, {}, {})", range.start, range.stop, range.step));
        }
        Value::View(view) => match view.kind {
            ViewKind::Keys => write_joined(
                view.dict.entries().iter().map(|(key, _)| key),
                "dict_keys([",
                "])",
                out,
                budget,
            )?,
            ViewKind::Values => write_joined(
                view.dict.entries().iter().map(|(_, value)| value),
                "dict_values([",
                "])",
                out,
                budget,
            )?,
            ViewKind::Items => {
                out.push_str("dict_items([");
                for (index, (key, value)) in view.dict.entries().iter().enumerate() {
                    out.push_str(if index > 0 { ", (" } else { "(" });
                    write_repr(key, out, budget)?;
                    out.push_str(", ");
                    write_repr(value, out, budget)?;
                    out.push(')');
                }
                out.push_str("])");
            }
        },
        // Python adds an address, which is not reproducible.
        Value::Iterator(_) => out.push_str("<generator object>"),
        Value::Function(function) => out.push_str(&function.describe()),
        Value::Module(module) => out.push_str(&format!("<namespace '{}'>", module.name())),
        Value::Namespace(name) => out.push_str(&format!("<namespace '{name}'>")),
    }
    Ok(())
}

fn write_all(
    items: &[Value],
    open: &str,
    close: &str,
    out: &mut String,
    budget: &mut Budget,
) -> Outcome<()> {
    write_joined(items.iter(), open, close, out, budget)
}

fn write_joined<'a>(
    items: impl Iterator<Item = &'a Value>,
    open: &str,
    close: &str,
    out: &mut String,
    budget: &mut Budget,
) -> Outcome<()> {
    out.push_str(open);
    for (index, item) in items.enumerate() {
        if index > 0 {
            out.push_str(", ");
        }
        write_repr(item, out, budget)?;
    }
    out.push_str(close);
    Ok(())
}

/// Single quotes, unless the text has single quotes and no double ones.
fn write_quoted(text: &str, out: &mut String) {
    let quote = if text.contains('\'') && !text.contains('"') { '"' } else { '\'' };
    out.push(quote);
    for letter in text.chars() {
        match letter {
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            '\\' => out.push_str("\\\\"),
            _ if letter == quote => {
                out.push('\\');
                out.push(letter);
            }
            _ if is_printable(letter) => out.push(letter),
            _ => out.push_str(&escape(letter)),
        }
    }
    out.push(quote);
}

/// Shortest of `\xNN`, `\uNNNN` and `\UNNNNNNNN`.
fn escape(letter: char) -> String {
    match u32::from(letter) {
        code @ ..=0xff => format!("\\x{code:02x}"),
        code @ ..=0xffff => format!("\\u{code:04x}"),
        code => format!("\\U{code:08x}"),
    }
}

/// `ascii()` of a text that is already in `repr` form.
pub(super) fn to_ascii(repr: &str) -> String {
    repr.chars()
        .map(|letter| if letter.is_ascii() { letter.to_string() } else { escape(letter) })
        .collect()
}

fn is_printable(letter: char) -> bool {
    if letter.is_ascii() {
        return !letter.is_ascii_control();
    }
    // Rust escapes unprintable characters by the same Unicode categories as Python; after a letter, so that
    // combining marks count as printable, as in Python.
    let mut buffer = String::from("a");
    buffer.push(letter);
    buffer.escape_debug().eq(buffer.chars())
}
