//! Python objects of decoded values.

use std::sync::Arc;

use numpy::PyArray1;
use periplus::msgs::{Number, NumberKind, NumberVec};
use periplus_rosidl::ArrayShape;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyFloat, PyString};

use super::plan::{Element, Plan, PlanField};
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
            _ if field.element.number().is_some() => {
                array(py, tape.arrays.next().ok_or_else(short)?)
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
