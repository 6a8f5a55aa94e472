//! Dicts and sets: entries in insertion order, indexed by key.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::super::error::{ExpressionError, Outcome, fail};
use super::super::number::truncate;
use super::{Value, depth_around};

/// Key in a form that Rust can order: equal exactly if Python's `==` and `hash` agree, so 1, 1.0 and True
/// are one key.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    None,
    Int(i128),
    /// Bits of the float; integral floats are `Int`.
    Float(u64),
    Str(Rc<str>),
    Tuple(Vec<Key>),
    Function(Rc<str>),
}

/// Maximum number of elements of a tuple used as a key: tuples with shared elements could otherwise grow
/// without bound.
const MAX_PARTS: usize = 1000;

/// Key of a value.
fn key_of(value: &Value) -> Outcome<Key> {
    key_within(value, &mut MAX_PARTS.clone())
}

fn key_within(value: &Value, parts_left: &mut usize) -> Outcome<Key> {
    *parts_left = match parts_left.checked_sub(1) {
        Some(left) => left,
        None => return fail(format!("a key of a dict has more than {MAX_PARTS} parts")),
    };
    Ok(match value {
        Value::None => Key::None,
        Value::Bool(value) => Key::Int(i128::from(*value)),
        Value::Int(value) => Key::Int(*value),
        Value::Float(value) => match truncate(*value) {
            Ok(whole) if value.fract() == 0.0 => Key::Int(whole),
            _ => Key::Float(value.to_bits()),
        },
        Value::Str(text) => Key::Str(text.clone()),
        Value::Tuple(items) => Key::Tuple(
            items
                .items()
                .iter()
                .map(|item| key_within(item, parts_left))
                .collect::<Outcome<_>>()?,
        ),
        Value::Function(function) => match function.name() {
            Some(name) => Key::Function(name),
            None => return fail("a lambda cannot be a key"),
        },
        _ => {
            return Err(ExpressionError::new(format!(
                "a `{}` cannot be a key of a dict or an element of a set",
                value.type_name()
            ))
            .with_help("use a string, a number or a tuple of them"));
        }
    })
}

/// Entries of a dict, or of a set (with `None` as values), in insertion order.
#[derive(Debug, Clone, Default)]
pub struct Dict {
    entries: Vec<(Value, Value)>,
    places: BTreeMap<Key, usize>,
    depth: u32,
}

impl Dict {
    /// Keys and values in insertion order.
    pub fn entries(&self) -> &[(Value, Value)] {
        &self.entries
    }

    /// Value of a key; an error if it is not hashable.
    pub fn get(&self, key: &Value) -> Outcome<Option<&Value>> {
        Ok(self.get_key(&key_of(key)?))
    }

    /// Value of a text key.
    pub fn get_text(&self, key: &str) -> Option<&Value> {
        self.get_key(&Key::Str(key.into()))
    }

    fn get_key(&self, key: &Key) -> Option<&Value> {
        self.places.get(key).map(|&place| &self.entries[place].1)
    }

    /// Sets a value; an existing key keeps its position, as in Python.
    pub(in super::super) fn insert(&mut self, key: Value, value: Value) -> Outcome<()> {
        let place = key_of(&key)?;
        self.depth = self.depth.max(depth_around([&key, &value].into_iter())?);
        match self.places.get(&place) {
            Some(&index) => self.entries[index].1 = value,
            None => {
                self.places.insert(place, self.entries.len());
                self.entries.push((key, value));
            }
        }
        Ok(())
    }

    pub(super) fn depth(&self) -> u32 {
        self.depth
    }
}
