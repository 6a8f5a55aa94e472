//! Conversion of a message between revisions of its type.

use std::sync::Arc;

use super::layout::{Element, Field, Layout, Shape};
use super::{DynamicMessage, Value};
use crate::Count;

/// Conversion between two revisions of a type: fields of the same name and type keep their values, ignoring
/// the case of names; others are dropped or get default values.
#[derive(Debug)]
pub struct Adaptation {
    to: Arc<Layout>,
    plan: Plan,
    lost: Vec<String>,
    blank: Vec<String>,
}

/// Source of the value of each field of the target.
type Plan = Vec<Option<Origin>>;

#[derive(Debug)]
struct Origin {
    /// Index of the field.
    at: usize,
    /// Conversion of a structure that differs.
    inner: Option<Plan>,
}

impl Layout {
    /// Returns true if both have the same serialization. Names and bounds are ignored.
    #[must_use]
    pub fn has_bytes_of(&self, other: &Self) -> bool {
        self.fields.len() == other.fields.len()
            && self.fields.iter().zip(&other.fields).all(|(a, b)| same_bytes(a, b))
    }
}

fn same_bytes(a: &Field, b: &Field) -> bool {
    let same_element = match (&a.element, &b.element) {
        // Booleans, bytes and 8-bit integers are one byte each, but different types.
        (Element::Number { kind: a, .. }, Element::Number { kind: b, .. }) => {
            a == b || a.size() == 1 && b.size() == 1
        }
        (Element::Text(_), Element::Text(_)) | (Element::WideText(_), Element::WideText(_)) => true,
        (Element::Struct(a), Element::Struct(b)) => {
            // In ROS 1, headers have an additional sequence number.
            let is_header = |layout: &Layout| layout.type_name == crate::binary::HEADER;
            is_header(a) == is_header(b) && a.has_bytes_of(b)
        }
        _ => false,
    };
    let same_shape = match (a.shape, b.shape) {
        (Shape::One, Shape::One) => true,
        (Shape::List(Count::Fixed(a)), Shape::List(Count::Fixed(b))) => a == b,
        (Shape::List(Count::Fixed(_)), _) | (_, Shape::List(Count::Fixed(_))) => false,
        (Shape::List(_), Shape::List(_)) => true,
        _ => false,
    };
    same_element && same_shape
}

impl Adaptation {
    /// Creates the conversion from one revision to another.
    #[must_use]
    pub fn new(from: &Layout, to: &Arc<Layout>) -> Self {
        let mut adaptation =
            Self { to: to.clone(), plan: Vec::new(), lost: Vec::new(), blank: Vec::new() };
        adaptation.plan = adaptation.plan(from, to, "");
        adaptation
    }

    /// Fields whose values are dropped.
    #[must_use]
    pub fn lost(&self) -> &[String] {
        &self.lost
    }

    /// Fields that get default values.
    #[must_use]
    pub fn blank(&self) -> &[String] {
        &self.blank
    }

    fn plan(&mut self, from: &Layout, to: &Layout, above: &str) -> Plan {
        let mut plan = Plan::new();
        for field in &to.fields {
            let exact = from.fields.iter().position(|one| one.name == field.name);
            let any_case =
                || from.fields.iter().position(|one| one.name.eq_ignore_ascii_case(&field.name));
            let source = exact.or_else(any_case).and_then(|at| {
                let one = &from.fields[at];
                if same_bytes(one, field) {
                    return Some(Origin { at, inner: None });
                }
                match (&one.element, &field.element, one.shape == field.shape) {
                    (Element::Struct(a), Element::Struct(b), true) => {
                        let above = format!("{above}{}.", field.name);
                        Some(Origin { at, inner: Some(self.plan(a, b, &above)) })
                    }
                    _ => None,
                }
            });
            if source.is_none() {
                self.blank.push(format!("{above}{}", field.name));
            }
            plan.push(source);
        }
        for (at, field) in from.fields.iter().enumerate() {
            if !plan.iter().flatten().any(|origin| origin.at == at) {
                self.lost.push(format!("{above}{}", field.name));
            }
        }
        plan
    }

    /// Converts a message.
    #[must_use]
    pub fn apply(&self, message: DynamicMessage) -> DynamicMessage {
        let fields = structure(&self.plan, message.into_fields(), &self.to);
        DynamicMessage::from_fields(&self.to, fields)
    }
}

fn structure(plan: &[Option<Origin>], from: Vec<Value>, to: &Layout) -> Vec<Value> {
    let mut from: Vec<Option<Value>> = from.into_iter().map(Some).collect();
    let mut fields = Vec::with_capacity(to.fields.len());
    for (source, field) in plan.iter().zip(&to.fields) {
        let value = source.as_ref().and_then(|origin| {
            let value = from.get_mut(origin.at)?.take()?;
            let (Some(plan), Element::Struct(layout)) = (&origin.inner, &field.element) else {
                return Some(value);
            };
            Some(match value {
                Value::Struct(values) => Value::Struct(structure(plan, values, layout.as_ref())),
                Value::List(list) => {
                    let one = |value| match value {
                        Value::Struct(values) => {
                            Value::Struct(structure(plan, values, layout.as_ref()))
                        }
                        other => other,
                    };
                    Value::List(list.into_iter().map(one).collect())
                }
                other => other,
            })
        });
        fields.push(value.unwrap_or_else(|| field.blank()));
    }
    fields
}
