//! Python objects of decoded values.

use std::sync::Arc;

use numpy::PyArray1;
use periplus::msgs::{Number, NumberKind, NumberVec};
use periplus_rosidl::ArrayShape;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBool, PyBytes, PyFloat, PyList, PyString, PyTuple};

use super::plan::{Element, Plan, PlanField, Style};
use super::{TapeReader, list};
use crate::errors::runtime_error;

/// Next message of a tape.
pub(crate) fn build<'py>(
    py: Python<'py>,
    plan: &Arc<Plan>,
    tape: &mut TapeReader,
) -> PyResult<Bound<'py, PyAny>> {
    let message = plan.class(py)?.new_object(py)?;
    for field in &plan.fields {
        let value = match field.shape {
            ArrayShape::One => element(py, &field.element, tape)?,
            shape if field.element.number().is_some() => {
                let numbers = tape.arrays.next().ok_or_else(short)?;
                match plan.style {
                    Style::Numpy => array(py, numbers),
                    Style::Rosidl => rosidl_array(py, field, shape, numbers)?,
                    Style::Genpy => genpy_array(py, numbers)?,
                }
            }
            _ => {
                let length = tape.lengths.next().ok_or_else(short)?;
                let values: PyResult<Vec<_>> =
                    (0..length).map(|_| element(py, &field.element, tape)).collect();
                list(py, values?)?
            }
        };
        message.setattr(field.slot(py), value)?;
    }
    Ok(message)
}

fn short() -> PyErr {
    runtime_error("a message has fewer values than its type, which is a fault of Periplus")
}

fn element<'py>(
    py: Python<'py>,
    element: &Element,
    tape: &mut TapeReader,
) -> PyResult<Bound<'py, PyAny>> {
    match element {
        Element::Number(_) => number(py, tape.numbers.next().ok_or_else(short)?),
        Element::Byte => match tape.numbers.next() {
            Some(Number::U8(byte)) => Ok(PyBytes::new(py, &[byte]).into_any()),
            _ => Err(short()),
        },
        Element::Text(_) | Element::WideText(_) => {
            Ok(PyString::new(py, &tape.texts.next().ok_or_else(short)?).into_any())
        }
        Element::Message(plan) => build(py, plan, tape),
    }
}

/// Array as rosidl has it.
fn rosidl_array<'py>(
    py: Python<'py>,
    field: &PlanField,
    shape: ArrayShape,
    numbers: NumberVec,
) -> PyResult<Bound<'py, PyAny>> {
    if matches!(field.element, Element::Byte)
        && let NumberVec::U8(bytes) = &numbers
    {
        let bytes = bytes.iter().map(|byte| PyBytes::new(py, &[*byte]));
        return Ok(PyList::new(py, bytes)?.into_any());
    }
    if let NumberVec::Bool(values) = &numbers {
        return Ok(PyList::new(py, values)?.into_any());
    }
    if matches!(shape, ArrayShape::Fixed(_)) {
        return Ok(array(py, numbers));
    }
    let class = array_class(py)?;
    let (code, bytes) = with_bytes(py, &numbers);
    class.call1((code, bytes))
}

/// `array.array`.
pub(super) fn array_class(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
    static CLASS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let import = || Ok::<_, PyErr>(py.import("array")?.getattr("array")?.unbind());
    Ok(CLASS.get_or_try_init(py, import)?.bind(py))
}

/// Type code of `array.array` of a kind of numbers.
pub(super) fn type_code(kind: NumberKind) -> &'static str {
    match kind {
        NumberKind::I8 => "b",
        NumberKind::Bool | NumberKind::U8 => "B",
        NumberKind::I16 => "h",
        NumberKind::U16 => "H",
        NumberKind::I32 => "i",
        NumberKind::U32 => "I",
        NumberKind::I64 => "q",
        NumberKind::U64 => "Q",
        NumberKind::F32 => "f",
        NumberKind::F64 => "d",
    }
}

/// Type code and bytes of numbers.
fn with_bytes<'py>(py: Python<'py>, numbers: &NumberVec) -> (&'static str, Bound<'py, PyBytes>) {
    macro_rules! bytes {
        ($($kind:ident)*) => {
            match numbers {
                NumberVec::Bool(values) => {
                    let bytes: Vec<u8> = values.iter().map(|it| u8::from(*it)).collect();
                    ("B", PyBytes::new(py, &bytes))
                }
                NumberVec::U8(values) => ("B", PyBytes::new(py, values)),
                $(NumberVec::$kind(values) => {
                    let bytes: Vec<u8> = values.iter().flat_map(|it| it.to_ne_bytes()).collect();
                    (type_code(NumberKind::$kind), PyBytes::new(py, &bytes))
                })*
            }
        };
    }
    bytes!(I8 I16 U16 I32 U32 I64 U64 F32 F64)
}

/// Array as genpy has it.
fn genpy_array(py: Python<'_>, numbers: NumberVec) -> PyResult<Bound<'_, PyAny>> {
    macro_rules! tuple {
        ($($kind:ident)*) => {
            match numbers {
                NumberVec::U8(values) => PyBytes::new(py, &values).into_any(),
                $(NumberVec::$kind(values) => PyTuple::new(py, values)?.into_any(),)*
            }
        };
    }
    Ok(tuple!(Bool I8 I16 U16 I32 U32 I64 U64 F32 F64))
}

pub(super) fn number(py: Python<'_>, number: Number) -> PyResult<Bound<'_, PyAny>> {
    Ok(match number {
        Number::Bool(value) => PyBool::new(py, value).to_owned().into_any(),
        Number::I8(value) => value.into_pyobject(py)?.into_any(),
        Number::U8(value) => value.into_pyobject(py)?.into_any(),
        Number::I16(value) => value.into_pyobject(py)?.into_any(),
        Number::U16(value) => value.into_pyobject(py)?.into_any(),
        Number::I32(value) => value.into_pyobject(py)?.into_any(),
        Number::U32(value) => value.into_pyobject(py)?.into_any(),
        Number::I64(value) => value.into_pyobject(py)?.into_any(),
        Number::U64(value) => value.into_pyobject(py)?.into_any(),
        Number::F32(value) => PyFloat::new(py, value.into()).into_any(),
        Number::F64(value) => PyFloat::new(py, value).into_any(),
    })
}

/// Number of elements up to which a copy into memory of numpy is cheaper than an owner for the vector.
const COPIED_ELEMENTS: usize = 128;

/// Array with the values of a vector.
pub(crate) fn array(py: Python<'_>, numbers: NumberVec) -> Bound<'_, PyAny> {
    macro_rules! moved {
        ($($kind:ident)*) => {
            match numbers {
                $(NumberVec::$kind(values) if values.len() <= COPIED_ELEMENTS => {
                    PyArray1::from_slice(py, &values).into_any()
                })*
                $(NumberVec::$kind(values) => PyArray1::from_vec(py, values).into_any(),)*
            }
        };
    }
    moved!(Bool I8 U8 I16 U16 I32 U32 I64 U64 F32 F64)
}

/// Default value of a field.
pub(crate) fn default<'py>(py: Python<'py>, field: &PlanField) -> PyResult<Bound<'py, PyAny>> {
    if let Some(default) = &field.default {
        if field.shape == ArrayShape::One {
            return default.to_object(py);
        }
        let values = default.to_list(py)?.into_any();
        return super::value::checked(field, &values)
            .map_err(|fault| fault.within(&field.name).into_error("default"));
    }
    let length = match field.shape {
        ArrayShape::One => return default_element(py, &field.element),
        ArrayShape::Fixed(length) => usize::try_from(length).unwrap_or_default(),
        _ => 0,
    };
    match field.element.number() {
        Some(kind) => Ok(array(py, kind.zeros(length))),
        None => {
            let values: PyResult<Vec<_>> =
                (0..length).map(|_| default_element(py, &field.element)).collect();
            list(py, values?)
        }
    }
}

fn default_element<'py>(py: Python<'py>, element: &Element) -> PyResult<Bound<'py, PyAny>> {
    match element {
        Element::Number(kind) => number(py, zero(*kind)),
        Element::Byte => Ok(PyBytes::new(py, &[0]).into_any()),
        Element::Text(_) | Element::WideText(_) => Ok(PyString::new(py, "").into_any()),
        Element::Message(plan) => {
            let message = plan.class(py)?.new_object(py)?;
            for field in &plan.fields {
                message.setattr(field.slot(py), default(py, field)?)?;
            }
            Ok(message)
        }
    }
}

fn zero(kind: NumberKind) -> Number {
    kind.zero()
}
