//! Serialization of Python objects.

use std::cell::RefCell;
use std::sync::Arc;

use numpy::{PyArray1, PyArrayMethods as _};
use periplus::msgs::{
    Codec, Count, DecodeError, Format, Number, NumberKind, Numbers, Sink, Source, encode,
};
use periplus_rosidl::ArrayShape;
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList, PyString};

use super::TypeHandle;
use super::plan::{Element, Plan, PlanField};
use super::tape::count;
use super::value::{
    Fault, array_of, byte_of, each_kind, number_of, require_length, require_message, text_of,
};
use crate::errors::value_error;

/// Type of a message object or of its class.
///
/// # Errors
/// `TypeError` if it is no message.
pub(crate) fn plan_of(message: &Bound<'_, PyAny>) -> PyResult<Arc<Plan>> {
    let handle = message.getattr(intern!(message.py(), "__type_handle__"));
    let handle = handle.ok().and_then(|it| it.cast_into::<TypeHandle>().ok());
    handle.map(|handle| handle.get().0.clone()).ok_or_else(|| {
        let name = message.get_type().name().map_or_else(|_| "?".into(), |it| it.to_string());
        PyTypeError::new_err(format!("expected a message of periplus.msgs, not {name}"))
    })
}

/// Appends the binary form of a message.
///
/// # Errors
/// `TypeError` or `ValueError` that names the field whose value does not fit.
pub(crate) fn encode_message(
    plan: &Arc<Plan>,
    message: &Bound<'_, PyAny>,
    format: Format,
    out: &mut Vec<u8>,
) -> PyResult<()> {
    let writing = Writing { message: Some((plan, message)), fault: RefCell::new(None) };
    let encoded = encode(&writing, format, out);
    if let Some(fault) = writing.fault.into_inner() {
        return Err(fault.into_error(&plan.label));
    }
    encoded.map_err(|error| value_error(format!("{}: {error}", plan.label)))
}

/// Message that is being written.
struct Writing<'a, 'py> {
    message: Option<(&'a Arc<Plan>, &'a Bound<'py, PyAny>)>,
    fault: RefCell<Option<Fault>>,
}

impl Codec for Writing<'_, '_> {
    const MIN_BYTES: usize = 0;

    fn blank() -> Self {
        Self { message: None, fault: RefCell::new(None) }
    }

    fn write(&self, sink: &mut dyn Sink, _: Option<u32>) {
        if let Some((plan, message)) = self.message {
            *self.fault.borrow_mut() = write_message(plan, message, sink).err();
        }
    }

    fn read(&mut self, _: &mut dyn Source, _: Option<u32>) -> Result<(), DecodeError> {
        Ok(())
    }
}

fn write_message(
    plan: &Arc<Plan>,
    message: &Bound<'_, PyAny>,
    sink: &mut dyn Sink,
) -> Result<(), Fault> {
    sink.begin(&plan.type_name);
    for field in &plan.fields {
        sink.field(&field.name);
        let value = message
            .getattr(field.slot(message.py()))
            .map_err(|_| Fault::from(super::missing(&plan.label, &field.name)))?;
        write_field(field, &value, sink).map_err(|fault| fault.within(&field.name))?;
    }
    sink.end(plan.fields.is_empty());
    Ok(())
}

fn write_field(
    field: &PlanField,
    value: &Bound<'_, PyAny>,
    sink: &mut dyn Sink,
) -> Result<(), Fault> {
    let Some(count) = count(field.shape) else { return write_one(&field.element, value, sink) };
    if let Some(kind) = field.element.number() {
        return write_array(kind, field.shape, count, value, sink);
    }
    let list = value.cast::<PyList>().map_err(|_| Fault::of_type("must be a list"))?;
    require_length(field.shape, list.len())?;
    sink.list(list.len(), count);
    for (index, item) in list.iter().enumerate() {
        write_one(&field.element, &item, sink).map_err(|fault| fault.within_element(index))?;
    }
    sink.end_list();
    Ok(())
}

fn write_array(
    kind: NumberKind,
    shape: ArrayShape,
    count: Count,
    value: &Bound<'_, PyAny>,
    sink: &mut dyn Sink,
) -> Result<(), Fault> {
    // Without numpy, which short lists do not need.
    if let Ok(list) = value.cast_exact::<PyList>()
        && (kind == NumberKind::Bool || list.is_empty() || is_of_bytes(list))
    {
        return write_list(kind, list, shape, count, sink);
    }
    if let Some(bytes) = array_bytes(kind, value)? {
        return write_array_bytes(kind, shape, count, bytes.as_bytes(), sink);
    }
    let array = array_of(kind, shape, value)?;
    macro_rules! write {
        ($kind:ident $rust:ident) => {{
            let array = array.cast::<PyArray1<$rust>>().map_err(PyErr::from)?;
            let array = array
                .try_readonly()
                .map_err(|_| Fault::of_value("is being written by another thread"))?;
            let values = array.as_slice().map_err(PyErr::from)?;
            sink.list(values.len(), count);
            sink.numbers(Numbers::$kind(values));
            sink.end_list();
        }};
    }
    each_kind!(kind, write);
    Ok(())
}

/// True for a list of bytes of length 1.
fn is_of_bytes(list: &Bound<'_, PyList>) -> bool {
    list.get_item(0).is_ok_and(|first| first.is_instance_of::<PyBytes>())
}

fn write_list(
    kind: NumberKind,
    list: &Bound<'_, PyList>,
    shape: ArrayShape,
    count: Count,
    sink: &mut dyn Sink,
) -> Result<(), Fault> {
    if kind == NumberKind::Bool {
        let mut values = Vec::with_capacity(list.len());
        for (index, item) in list.iter().enumerate() {
            match number_of(kind, &item).map_err(|fault| fault.within_element(index))? {
                Number::Bool(value) => values.push(value),
                _ => values.push(false),
            }
        }
        return write_numbers(Numbers::Bool(&values), values.len(), shape, count, sink);
    }
    let mut values = Vec::with_capacity(list.len());
    for (index, item) in list.iter().enumerate() {
        values.push(byte_of(&item).map_err(|fault| fault.within_element(index))?);
    }
    if values.is_empty() {
        return write_array_bytes(kind, shape, count, &values, sink);
    }
    write_numbers(Numbers::U8(&values), values.len(), shape, count, sink)
}

/// Bytes of an `array.array` of exactly this kind.
fn array_bytes<'py>(
    kind: NumberKind,
    value: &Bound<'py, PyAny>,
) -> PyResult<Option<Bound<'py, PyBytes>>> {
    let py = value.py();
    if !value.get_type().is(super::build::array_class(py)?) {
        return Ok(None);
    }
    let code = value.getattr(intern!(py, "typecode"))?;
    if code.cast::<PyString>()?.to_str()? != super::build::type_code(kind) {
        return Ok(None);
    }
    Ok(Some(value.call_method0(intern!(py, "tobytes"))?.cast_into()?))
}

fn write_array_bytes(
    kind: NumberKind,
    shape: ArrayShape,
    count: Count,
    bytes: &[u8],
    sink: &mut dyn Sink,
) -> Result<(), Fault> {
    macro_rules! write {
        (Bool bool) => {{
            let values: Vec<bool> = bytes.iter().map(|byte| *byte != 0).collect();
            write_numbers(Numbers::Bool(&values), values.len(), shape, count, sink)
        }};
        (U8 u8) => {
            write_numbers(Numbers::U8(bytes), bytes.len(), shape, count, sink)
        };
        ($kind:ident $rust:ident) => {{
            let chunks = bytes.as_chunks::<{ size_of::<$rust>() }>().0.iter();
            let values: Vec<$rust> = chunks.map(|chunk| $rust::from_ne_bytes(*chunk)).collect();
            write_numbers(Numbers::$kind(&values), values.len(), shape, count, sink)
        }};
    }
    each_kind!(kind, write)
}

fn write_numbers(
    numbers: Numbers<'_>,
    length: usize,
    shape: ArrayShape,
    count: Count,
    sink: &mut dyn Sink,
) -> Result<(), Fault> {
    require_length(shape, length)?;
    sink.list(length, count);
    sink.numbers(numbers);
    sink.end_list();
    Ok(())
}

fn write_one(
    element: &Element,
    value: &Bound<'_, PyAny>,
    sink: &mut dyn Sink,
) -> Result<(), Fault> {
    match element {
        Element::Number(kind) => sink.number(number_of(*kind, value)?),
        Element::Byte => sink.number(Number::U8(byte_of(value)?)),
        Element::Text(limit) => sink.text(&text_of(value, *limit, false)?, *limit),
        Element::WideText(limit) => sink.wide_text(&text_of(value, *limit, true)?, *limit),
        Element::Message(plan) => {
            require_message(plan, value)?;
            write_message(plan, value, sink)?;
        }
    }
    Ok(())
}
