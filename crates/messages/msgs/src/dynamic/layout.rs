//! Layout of a type.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_rosidl as interfaces;
use periplus_rosidl::{Literal, Registry, Scalar, TypeName};

use super::Value;
use crate::{Count, Number, NumberKind};

/// Type with all data needed to read and write its values.
#[derive(Debug, PartialEq)]
pub struct Layout {
    pub(crate) type_name: String,
    pub(crate) fields: Vec<Field>,
    /// Minimum size of a value in any binary format [bytes].
    pub(crate) min_bytes: usize,
}

#[derive(Debug, PartialEq)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) element: Element,
    pub(crate) shape: Shape,
    /// Default value of the text, if given.
    pub(crate) default: Option<Value>,
}

#[derive(Debug, PartialEq)]
pub(crate) enum Element {
    Number {
        kind: NumberKind,
        /// True for `byte`, which is printed as a character.
        is_byte: bool,
    },
    Text(Option<u32>),
    WideText(Option<u32>),
    Struct(Arc<Layout>),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    One,
    List(Count),
}

impl Layout {
    /// Full name of the type.
    #[must_use]
    pub fn type_name(&self) -> &str {
        &self.type_name
    }

    /// Names of its fields.
    pub fn fields(&self) -> impl Iterator<Item = &str> {
        self.fields.iter().map(|field| field.name.as_str())
    }

    /// Type of a field that is a message or a list of messages.
    #[must_use]
    pub fn nested(&self, field: &str) -> Option<&Arc<Self>> {
        match &self.fields.iter().find(|one| one.name == field)?.element {
            Element::Struct(layout) => Some(layout),
            _ => None,
        }
    }

    /// Default values of the fields.
    pub(crate) fn blank(&self) -> Vec<Value> {
        self.fields.iter().map(Field::blank).collect()
    }
}

impl Field {
    pub(crate) fn blank(&self) -> Value {
        match (&self.default, self.shape) {
            (Some(default), _) => default.clone(),
            (None, Shape::One) => self.element.blank(),
            (None, Shape::List(Count::Fixed(length))) => self.element.blank_list(length),
            (None, Shape::List(_)) => self.element.blank_list(0),
        }
    }
}

impl Element {
    fn blank(&self) -> Value {
        match self {
            Self::Number { kind, .. } => Value::Number(kind.zero()),
            Self::Text(_) | Self::WideText(_) => Value::Text(String::new()),
            Self::Struct(layout) => Value::Struct(layout.blank()),
        }
    }

    fn blank_list(&self, length: usize) -> Value {
        match self {
            Self::Number { kind, .. } => Value::Numbers(kind.zeros(length)),
            _ => Value::List(vec![self.blank(); length]),
        }
    }

    pub(crate) fn min_bytes(&self) -> usize {
        match self {
            Self::Number { kind, .. } => kind.size(),
            Self::Text(_) | Self::WideText(_) => 4,
            Self::Struct(layout) => layout.min_bytes,
        }
    }
}

/// Layouts of all types of a checked registry.
pub(crate) fn all(registry: &Registry) -> BTreeMap<String, Arc<Layout>> {
    let mut made = BTreeMap::new();
    for definition in registry.types() {
        make(registry, &definition.name, &mut made);
    }
    made
}

fn make(
    registry: &Registry,
    name: &TypeName,
    made: &mut BTreeMap<String, Arc<Layout>>,
) -> Option<Arc<Layout>> {
    let type_name = name.to_string();
    if let Some(known) = made.get(&type_name) {
        return Some(known.clone());
    }
    let mut fields = Vec::new();
    for field in &registry.get(name)?.fields {
        let element = match &field.r#type.element {
            interfaces::ElementType::Scalar(scalar) => {
                Element::Number { kind: kind(*scalar), is_byte: *scalar == Scalar::Byte }
            }
            interfaces::ElementType::String(limit) => Element::Text(limit.map(narrow)),
            interfaces::ElementType::WString(limit) => Element::WideText(limit.map(narrow)),
            interfaces::ElementType::Nested(nested) => {
                Element::Struct(make(registry, nested, made)?)
            }
        };
        let shape = match field.r#type.shape {
            interfaces::ArrayShape::One => Shape::One,
            interfaces::ArrayShape::Fixed(size) => Shape::List(Count::Fixed(narrow(size) as usize)),
            interfaces::ArrayShape::Bounded(most) => {
                Shape::List(Count::AtMost(narrow(most) as usize))
            }
            interfaces::ArrayShape::Unbounded => Shape::List(Count::Any),
        };
        let default = field.default.as_ref().map(|default| value(default, &element));
        fields.push(Field { name: field.name.clone(), element, shape, default });
    }
    let least = |field: &Field| match field.shape {
        Shape::One => field.element.min_bytes(),
        Shape::List(Count::Fixed(length)) => field.element.min_bytes().saturating_mul(length),
        Shape::List(_) => 4,
    };
    let min_bytes = fields.iter().map(least).fold(0, usize::saturating_add);
    let layout = Arc::new(Layout { type_name: type_name.clone(), fields, min_bytes });
    made.insert(type_name, layout.clone());
    Some(layout)
}

fn narrow(size: u64) -> u32 {
    u32::try_from(size).unwrap_or(u32::MAX)
}

fn kind(scalar: Scalar) -> NumberKind {
    match scalar {
        Scalar::Bool => NumberKind::Bool,
        Scalar::Byte | Scalar::Char | Scalar::U8 => NumberKind::U8,
        Scalar::I8 | Scalar::Ros1Byte => NumberKind::I8,
        Scalar::I16 => NumberKind::I16,
        Scalar::U16 => NumberKind::U16,
        Scalar::I32 => NumberKind::I32,
        Scalar::U32 => NumberKind::U32,
        Scalar::I64 => NumberKind::I64,
        Scalar::U64 => NumberKind::U64,
        Scalar::F32 => NumberKind::F32,
        Scalar::F64 => NumberKind::F64,
    }
}

fn value(literal: &Literal, element: &Element) -> Value {
    match (literal, element) {
        (Literal::Text(text), _) => Value::Text(text.clone()),
        (Literal::List(list), Element::Number { kind, .. }) => {
            let mut numbers = kind.zeros(list.len());
            for (index, literal) in list.iter().enumerate() {
                numbers.borrow_mut().set(index, number(literal, *kind));
            }
            Value::Numbers(numbers)
        }
        (Literal::List(list), _) => {
            Value::List(list.iter().map(|literal| value(literal, element)).collect())
        }
        (literal, Element::Number { kind, .. }) => Value::Number(number(literal, *kind)),
        (_, element) => element.blank(),
    }
}

/// A literal is in the range of its type.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is in range")]
fn number(literal: &Literal, kind: NumberKind) -> Number {
    match (*literal == Literal::Bool(true), literal, kind) {
        (is_true, _, NumberKind::Bool) => Number::Bool(is_true),
        (_, Literal::Int(value), NumberKind::I8) => Number::I8(*value as i8),
        (_, Literal::Int(value), NumberKind::U8) => Number::U8(*value as u8),
        (_, Literal::Int(value), NumberKind::I16) => Number::I16(*value as i16),
        (_, Literal::Int(value), NumberKind::U16) => Number::U16(*value as u16),
        (_, Literal::Int(value), NumberKind::I32) => Number::I32(*value as i32),
        (_, Literal::Int(value), NumberKind::U32) => Number::U32(*value as u32),
        (_, Literal::Int(value), NumberKind::I64) => Number::I64(*value as i64),
        (_, Literal::Int(value), NumberKind::U64) => Number::U64(*value as u64),
        (_, Literal::Float(value), NumberKind::F32) => Number::F32(*value as f32),
        (_, Literal::Float(value), NumberKind::F64) => Number::F64(*value),
        (_, _, kind) => kind.zero(),
    }
}
