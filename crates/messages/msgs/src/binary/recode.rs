//! Conversion between binary formats without decoding.

use super::{Format, Reader, Writer};
use crate::dynamic::{Element, Layout, Shape};
use crate::{Count, DecodeError, Sink as _, Source as _};

/// Appends a message of one format to `out` in another. Values that are only copied are not validated:
/// texts may have any bytes, booleans any number.
///
/// # Errors
/// If the bytes are not such a message.
pub fn recode(
    layout: &Layout,
    from: Format,
    bytes: &[u8],
    to: Format,
    out: &mut Vec<u8>,
) -> Result<(), DecodeError> {
    let mut reader = Reader::new(from, bytes)?;
    let mut writer = Writer::new(to, out);
    structure(layout, &mut reader, &mut writer)?;
    reader.finish()?;
    // No value grows, and all lengths that were read have 32 bits.
    let _ = writer.finish();
    Ok(())
}

fn structure(
    layout: &Layout,
    reader: &mut Reader<'_>,
    writer: &mut Writer<'_>,
) -> Result<(), DecodeError> {
    reader.begin(&layout.type_name, &mut std::iter::empty())?;
    writer.begin(&layout.type_name);
    for field in &layout.fields {
        let copied = match field.shape {
            Shape::One => one(&field.element, reader, writer),
            Shape::List(count) => list(&field.element, count, reader, writer),
        };
        copied.map_err(|error| error.within(&field.name))?;
    }
    reader.end(layout.fields.is_empty())?;
    writer.end(layout.fields.is_empty());
    Ok(())
}

fn list(
    element: &Element,
    count: Count,
    reader: &mut Reader<'_>,
    writer: &mut Writer<'_>,
) -> Result<(), DecodeError> {
    let length = reader.list(count, element.min_bytes())?;
    // The reader has checked the bounds.
    let open = if matches!(count, Count::Fixed(_)) { count } else { Count::Any };
    writer.list(length, open);
    if let Element::Number { kind, .. } = element {
        return reader.copy(length, kind.size(), writer);
    }
    for index in 0..length {
        one(element, reader, writer).map_err(|error| error.within_element(index))?;
    }
    Ok(())
}

fn one(
    element: &Element,
    reader: &mut Reader<'_>,
    writer: &mut Writer<'_>,
) -> Result<(), DecodeError> {
    match element {
        Element::Number { kind, .. } => reader.copy(1, kind.size(), writer),
        Element::Text(_) => {
            writer.text_bytes(reader.text_bytes()?);
            Ok(())
        }
        Element::WideText(limit) => {
            writer.wide_text(&reader.wide_text(*limit)?, None);
            Ok(())
        }
        Element::Struct(layout) => structure(layout, reader, writer),
    }
}
