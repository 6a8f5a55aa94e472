//! Part of a message: a field, or an element of a list.

use std::borrow::Cow;
use std::sync::Arc;

use super::layout::{Element, Layout, Shape};
use super::value::{list, write_one, write_struct};
use super::{DynamicMessage, Value};
use crate::{Count, DecodeError, NumberKind, Problem, Sink, YamlStyle, yaml};

/// Part of a message.
#[derive(Clone, Debug)]
pub struct Part<'a> {
    element: &'a Element,
    shape: Shape,
    value: Cow<'a, Value>,
}

impl<'a> Part<'a> {
    /// Value.
    #[must_use]
    pub fn value(&self) -> Value {
        self.value.clone().into_owned()
    }

    /// Reference to the value.
    #[must_use]
    pub fn peek(&self) -> &Value {
        &self.value
    }

    /// Type, if it is a message or a list of messages.
    #[must_use]
    pub fn layout(&self) -> Option<&'a Arc<Layout>> {
        match self.element {
            Element::Struct(layout) => Some(layout),
            _ => None,
        }
    }

    /// Returns true for a list without a fixed length.
    #[must_use]
    pub fn is_sequence(&self) -> bool {
        matches!(self.shape, Shape::List(Count::Any | Count::AtMost(_)))
    }

    /// Type of its number or numbers; `None` for `byte`, texts and messages.
    #[must_use]
    pub fn number_kind(&self) -> Option<NumberKind> {
        match self.element {
            Element::Number { kind, is_byte: false } => Some(*kind),
            _ => None,
        }
    }

    /// Value as a message, if it is one.
    #[must_use]
    pub fn message(&self) -> Option<DynamicMessage> {
        match (self.element, &*self.value) {
            (Element::Struct(layout), Value::Struct(fields)) => {
                Some(DynamicMessage::of_fields(layout, fields.clone()))
            }
            _ => None,
        }
    }

    /// YAML in the format of `ros2 topic echo`.
    #[must_use]
    pub fn to_yaml(&self, style: &YamlStyle) -> String {
        yaml::print_part(self.element, self.shape, &self.value, style)
    }

    /// Writes its value to `sink`.
    pub fn write(&self, sink: &mut dyn Sink) {
        match (self.element, &*self.value, self.shape) {
            (_, Value::Numbers(numbers), Shape::List(count)) => list(sink, numbers.borrow(), count),
            (element, Value::List(values), Shape::List(count)) => {
                sink.list(values.len(), count);
                for value in values {
                    write_one(element, value, sink);
                }
                sink.end_list();
            }
            (Element::Struct(layout), Value::Struct(fields), _) => {
                write_struct(layout, fields, sink);
            }
            (element, value, _) => write_one(element, value, sink),
        }
    }
}

/// Follows a path of names and indices, such as `transforms[2].child_frame_id`.
pub(super) fn find<'a>(message: &'a DynamicMessage, path: &str) -> Result<Part<'a>, DecodeError> {
    let mut here: Option<Part<'a>> = None;
    let mut gone = String::new();
    for step in path.split(['.', '[']) {
        let next = match (step.strip_suffix(']'), &here) {
            (Some(index), Some(part)) => element(part, index.trim()),
            (None, Some(part)) => match (part.element, &part.value, part.shape) {
                (Element::Struct(layout), Cow::Borrowed(Value::Struct(fields)), Shape::One) => {
                    field(layout, fields, step)
                }
                _ => Err(unexpected("the end of the path", step)),
            },
            (None, None) => field(message.layout(), message.fields(), step),
            (Some(_), None) => Err(unexpected("the name of a field", step)),
        };
        here = Some(next.map_err(|error| error.within(&gone))?);
        match step.strip_suffix(']') {
            Some(index) => gone.push_str(&format!("[{index}]")),
            None if gone.is_empty() => gone.push_str(step),
            None => gone.push_str(&format!(".{step}")),
        }
    }
    here.ok_or_else(|| unexpected("the name of a field", path))
}

fn field<'a>(layout: &'a Layout, fields: &'a [Value], name: &str) -> Result<Part<'a>, DecodeError> {
    match layout.fields.iter().zip(fields).find(|(field, _)| field.name == name) {
        Some((field, value)) => {
            Ok(Part { element: &field.element, shape: field.shape, value: Cow::Borrowed(value) })
        }
        None => {
            let known = layout.fields().map(str::to_owned).collect();
            Err(DecodeError::new(Problem::Unknown { name: name.to_owned(), known }, 0))
        }
    }
}

fn element<'a>(part: &Part<'a>, index: &str) -> Result<Part<'a>, DecodeError> {
    let length = match (&*part.value, part.shape) {
        (Value::Numbers(numbers), Shape::List(_)) => numbers.borrow().len(),
        (Value::List(list), Shape::List(_)) => list.len(),
        _ => return Err(unexpected("the end of the path", &format!("[{index}]"))),
    };
    // As in Python, -1 is the last element.
    let place = index.parse::<i64>().ok().and_then(|index| {
        let place = if index < 0 { index.checked_add_unsigned(length as u64)? } else { index };
        usize::try_from(place).ok().filter(|place| *place < length)
    });
    let Some(place) = place else {
        return Err(unexpected(&format!("an index below {length}"), index));
    };
    let value = match &part.value {
        Cow::Borrowed(Value::List(list)) => Cow::Borrowed(&list[place]),
        value => match &**value {
            Value::Numbers(numbers) => Cow::Owned(
                numbers.borrow().get(place).map_or(Value::List(Vec::new()), Value::Number),
            ),
            other => Cow::Owned(other.clone()),
        },
    };
    Ok(Part { element: part.element, shape: Shape::One, value })
}

fn unexpected(expected: &str, found: &str) -> DecodeError {
    let (expected, found) = (expected.to_owned(), format!("`{found}`"));
    DecodeError::new(Problem::Json { expected, found }, 0)
}
