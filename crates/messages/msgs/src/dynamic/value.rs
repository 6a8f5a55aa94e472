//! Values of types known only at run time.

use std::sync::Arc;

use super::layout::{Element, Field, Layout, Shape};
use super::part::{self, Part};
use crate::binary::{Reader, Writer};
use crate::{
    Count, DecodeError, EncodeError, Format, Message, Number, NumberVec, Numbers, Sink, Source,
    TypeRegistry, YamlStyle, json, yaml,
};

/// Value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Single number.
    Number(Number),
    /// Text of `string` or `wstring`.
    Text(String),
    /// List of numbers.
    Numbers(NumberVec),
    /// Other list.
    List(Vec<Self>),
    /// Fields of a message.
    Struct(Vec<Self>),
}

/// Message of a type known only at run time.
#[derive(Clone, Debug, PartialEq)]
pub struct DynamicMessage {
    layout: Arc<Layout>,
    fields: Vec<Value>,
}

impl DynamicMessage {
    /// Returns a message with default values.
    #[must_use]
    pub fn blank(layout: &Arc<Layout>) -> Self {
        Self { layout: layout.clone(), fields: layout.blank() }
    }

    /// Converts a message of a type of this crate.
    ///
    /// # Errors
    /// If a string or list is longer than its type allows.
    ///
    /// # Panics
    /// For a message type of another crate.
    pub fn of<T: Message>(message: &T) -> Result<Self, EncodeError> {
        let layout = TypeRegistry::builtin().layout(T::TYPE_NAME);
        let layout = layout.expect("the types of this crate are in its registry");
        let bytes = message.to_cdr()?;
        Ok(Self::decode(layout, Format::CDR, &bytes).expect("both forms of a type are the same"))
    }

    /// Decodes bytes.
    ///
    /// # Errors
    /// If the bytes are not such a message.
    pub fn decode(layout: &Arc<Layout>, format: Format, bytes: &[u8]) -> Result<Self, DecodeError> {
        let mut reader = Reader::new(format, bytes)?;
        let fields = read_struct(layout, &mut reader)?;
        reader.finish()?;
        Ok(Self { layout: layout.clone(), fields })
    }

    /// Appends its binary form to `out`.
    ///
    /// # Errors
    /// If a string or list is longer than its type allows.
    pub fn encode(&self, format: Format, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        let mut writer = Writer::new(format, out);
        write_struct(&self.layout, &self.fields, &mut writer);
        writer.finish()
    }

    /// JSON form; see [`crate::to_json`].
    #[must_use]
    pub fn to_json(&self) -> serde_json::Value {
        let mut writer = json::Writer::default();
        write_struct(&self.layout, &self.fields, &mut writer);
        writer.done
    }

    /// Parses JSON; missing fields have their default values.
    ///
    /// # Errors
    /// If the JSON does not match the type.
    pub fn from_json(layout: &Arc<Layout>, json: &serde_json::Value) -> Result<Self, DecodeError> {
        let fields = read_struct(layout, &mut json::Reader::new(json))?;
        Ok(Self { layout: layout.clone(), fields })
    }

    /// YAML in the format of `ros2 topic echo`, without the line `---`.
    #[must_use]
    pub fn to_yaml(&self, style: &YamlStyle) -> String {
        yaml::print(&self.layout, &self.fields, style)
    }

    /// Type of the message.
    #[must_use]
    pub fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    /// Values without the type.
    pub(super) fn into_fields(self) -> Vec<Value> {
        self.fields
    }

    /// Message with values that match the type.
    pub(super) fn from_fields(layout: &Arc<Layout>, fields: Vec<Value>) -> Self {
        Self { layout: layout.clone(), fields }
    }

    /// Values of its fields, in the order of the type.
    #[must_use]
    pub fn fields(&self) -> &[Value] {
        &self.fields
    }

    pub(super) fn of_fields(layout: &Arc<Layout>, fields: Vec<Value>) -> Self {
        Self { layout: layout.clone(), fields }
    }

    /// Writes its values to `sink`, in order.
    pub fn write(&self, sink: &mut dyn Sink) {
        write_struct(&self.layout, &self.fields, sink);
    }

    /// Value at a path, such as `header.frame_id` or `transforms[2].child_frame_id`.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<Value> {
        self.part(path).ok().map(|part| part.value())
    }

    /// Part at a path, as for [`DynamicMessage::get`].
    ///
    /// # Errors
    /// If the path does not exist; with the wrong step and the existing fields.
    pub fn part(&self, path: &str) -> Result<Part<'_>, DecodeError> {
        part::find(self, path)
    }
}

pub(super) fn write_struct(layout: &Layout, values: &[Value], sink: &mut dyn Sink) {
    sink.begin(&layout.type_name);
    for (field, value) in layout.fields.iter().zip(values) {
        sink.field(&field.name);
        match (value, field.shape) {
            (Value::Numbers(numbers), Shape::List(count)) => {
                list(sink, numbers.borrow(), count);
            }
            (Value::List(list), Shape::List(count)) => {
                sink.list(list.len(), count);
                for value in list {
                    write_one(&field.element, value, sink);
                }
                sink.end_list();
            }
            (value, _) => write_one(&field.element, value, sink),
        }
    }
    sink.end(layout.fields.is_empty());
}

pub(super) fn list(sink: &mut dyn Sink, numbers: Numbers<'_>, count: Count) {
    sink.list(numbers.len(), count);
    sink.numbers(numbers);
    sink.end_list();
}

pub(super) fn write_one(element: &Element, value: &Value, sink: &mut dyn Sink) {
    match (element, value) {
        (_, Value::Number(number)) => sink.number(*number),
        (Element::WideText(limit), Value::Text(text)) => sink.wide_text(text, *limit),
        (Element::Text(limit), Value::Text(text)) => sink.text(text, *limit),
        (Element::Struct(layout), Value::Struct(fields)) => write_struct(layout, fields, sink),
        // Values are created from layouts only.
        _ => {}
    }
}

fn read_struct(layout: &Layout, source: &mut dyn Source) -> Result<Vec<Value>, DecodeError> {
    source.begin(&layout.type_name, &mut layout.fields())?;
    let mut values = Vec::with_capacity(layout.fields.len());
    for field in &layout.fields {
        values.push(if source.enter(&field.name)? {
            let value = read_field(field, source).map_err(|error| error.within(&field.name))?;
            source.leave();
            value
        } else {
            field.blank()
        });
    }
    source.end(layout.fields.is_empty())?;
    Ok(values)
}

fn read_field(field: &Field, source: &mut dyn Source) -> Result<Value, DecodeError> {
    let Shape::List(count) = field.shape else { return read_one(&field.element, source) };
    let length = source.list(count, field.element.min_bytes())?;
    if let Element::Number { kind, .. } = field.element {
        let mut numbers = kind.zeros(length);
        source.numbers(numbers.borrow_mut())?;
        return Ok(Value::Numbers(numbers));
    }
    let mut list = Vec::with_capacity(length);
    for index in 0..length {
        source.enter_element(index)?;
        let value = read_one(&field.element, source);
        list.push(value.map_err(|error| error.within_element(index))?);
        source.leave();
    }
    Ok(Value::List(list))
}

fn read_one(element: &Element, source: &mut dyn Source) -> Result<Value, DecodeError> {
    Ok(match element {
        Element::Number { kind, .. } => Value::Number(source.number(*kind)?),
        Element::Text(limit) => Value::Text(source.text(*limit)?),
        Element::WideText(limit) => Value::Text(source.wide_text(*limit)?),
        Element::Struct(layout) => Value::Struct(read_struct(layout, source)?),
    })
}
