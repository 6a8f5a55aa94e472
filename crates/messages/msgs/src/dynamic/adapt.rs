//! A message of one revision of a type as one of another.

use std::sync::Arc;

use super::layout::{Element, Field, Layout, Shape};
use super::{DynamicMessage, Value};
use crate::Count;

/// How messages of one revision of a type become those of another: fields of the same name and kind
/// keep their values, whatever the case of their names; others are left out or blank.
#[derive(Debug)]
pub struct Adaptation {
    to: Arc<Layout>,
    plan: Plan,
    lost: Vec<String>,
    blank: Vec<String>,
}

/// For each field of the target, where its value comes from.
type Plan = Vec<Option<Origin>>;

#[derive(Debug)]
struct Origin {
    /// Which of the fields.
    at: usize,
    /// How a structure is made that is not the same.
    inner: Option<Plan>,
}

impl Layout {
    /// Whether values of both are the same bytes. Names do not count, nor do bounds.
    #[must_use]
    pub fn has_bytes_of(&self, other: &Self) -> bool {
        self.fields.len() == other.fields.len()
            && self.fields.iter().zip(&other.fields).all(|(a, b)| same_bytes(a, b))
    }
}

fn same_bytes(a: &Field, b: &Field) -> bool {
    let same_element = match (&a.element, &b.element) {
        // Truth values, bytes and small numbers are one byte each, but not the same thing.
        (Element::Number { kind: a, .. }, Element::Number { kind: b, .. }) => {
            a == b || a.size() == 1 && b.size() == 1
        }
        (Element::Text(_), Element::Text(_)) | (Element::WideText(_), Element::WideText(_)) => true,
        (Element::Struct(a), Element::Struct(b)) => {
            // Headers have a counter in front in ROS 1.
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
    /// From one revision to another.
    #[must_use]
    pub fn new(from: &Layout, to: &Arc<Layout>) -> Self {
        let mut adaptation =
            Self { to: to.clone(), plan: Vec::new(), lost: Vec::new(), blank: Vec::new() };
        adaptation.plan = adaptation.plan(from, to, "");
        adaptation
    }

    /// Fields whose values are left out.
    #[must_use]
    pub fn lost(&self) -> &[String] {
        &self.lost
    }

    /// Fields that get no value.
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

    /// A message of the first as one of the second.
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
