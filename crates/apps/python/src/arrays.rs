//! Arrays of numpy: views of memory of the crates, and inputs of any kind.

use std::any::Any;

use numpy::{
    Element, PyArrayDyn, PyArrayMethods as _, PyReadonlyArrayDyn, PyUntypedArrayMethods as _,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

/// Memory that numpy reads without a copy. It owns what the memory belongs to, and numpy owns it.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct SharedMemory {
    /// Keeps the memory alive.
    _owner: Box<dyn Any + Send + Sync>,
    address: usize,
    shape: Vec<usize>,
    /// Type of an element, as in numpy's `typestr`.
    type_text: String,
    /// Name and `typestr` of each field of a structured element; empty for a plain one. A field without a name
    /// is padding.
    fields: Vec<(String, String)>,
}

#[pymethods]
impl SharedMemory {
    /// Numpy's array interface, version 3: read-only.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("data", (self.address, true))?;
        interface.set_item("shape", PyTuple::new(py, &self.shape)?)?;
        interface.set_item("typestr", &self.type_text)?;
        if !self.fields.is_empty() {
            interface.set_item("descr", PyList::new(py, &self.fields)?)?;
        }
        Ok(interface)
    }
}

/// Returns a read-only array over `values`, which `owner` keeps alive, without a copy.
///
/// # Errors
/// `ValueError` if the shape does not fit the number of values.
pub(crate) fn shared<'py, T: Element>(
    py: Python<'py>,
    owner: impl Any + Send + Sync,
    values: (*const T, usize),
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let type_text: String = T::get_dtype(py).getattr("str")?.extract()?;
    let (address, count) = values;
    if shape.iter().product::<usize>() != count {
        return Err(PyValueError::new_err(format!(
            "{count} values do not fill the shape {shape:?}"
        )));
    }
    shared_bytes(py, owner, address.cast(), shape, type_text, Vec::new())
}

/// Returns a read-only array of elements that are described by their `typestr` and fields, without a copy. The
/// caller has checked that the memory has the size of the shape.
pub(crate) fn shared_bytes<'py>(
    py: Python<'py>,
    owner: impl Any + Send + Sync,
    address: *const u8,
    shape: &[usize],
    type_text: String,
    fields: Vec<(String, String)>,
) -> PyResult<Bound<'py, PyAny>> {
    let memory = SharedMemory {
        _owner: Box::new(owner),
        // Numpy refuses an address of zero; an empty array has no memory to read.
        address: address.addr().max(1),
        shape: shape.to_vec(),
        type_text,
        fields,
    };
    let numpy = py.import(pyo3::intern!(py, "numpy"))?;
    numpy.getattr(pyo3::intern!(py, "asarray"))?.call1((Bound::new(py, memory)?,))
}

/// Returns an array with the values of a vector, which is moved, not copied.
///
/// # Errors
/// `ValueError` if the shape does not fit the number of values.
pub(crate) fn moved<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    numpy::PyArray1::from_vec(py, values).reshape(shape)
}

/// Reads an argument as a contiguous array of `T`: arrays of this type without a copy, others (lists, other types,
/// strides) converted by numpy. `None` in `shape` is any length.
///
/// # Errors
/// `TypeError` or `ValueError` that names the argument.
pub(crate) fn input<'py, T: Element>(
    argument: &Bound<'py, PyAny>,
    name: &str,
    shape: &[Option<usize>],
) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let array = contiguous::<T>(argument, name)?;
    let found = array.shape();
    let fits = found.len() == shape.len()
        && found.iter().zip(shape).all(|(found, wanted)| wanted.is_none_or(|it| it == *found));
    if !fits {
        let wanted: Vec<String> =
            shape.iter().map(|it| it.map_or("any".to_owned(), |it| it.to_string())).collect();
        return Err(PyValueError::new_err(format!(
            "`{name}` must have the shape ({}), not {found:?}",
            wanted.join(", ")
        )));
    }
    Ok(array)
}

/// Reads an argument as a contiguous array of `T` of any shape.
///
/// # Errors
/// `TypeError` or `ValueError` that names the argument.
pub(crate) fn contiguous<'py, T: Element>(
    argument: &Bound<'py, PyAny>,
    name: &str,
) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let py = argument.py();
    if let Ok(array) = argument.cast::<PyArrayDyn<T>>()
        && array.is_c_contiguous()
    {
        return array.try_readonly().map_err(|_| busy(name));
    }
    let numpy = py.import(pyo3::intern!(py, "numpy"))?;
    let settings = PyDict::new(py);
    settings.set_item("dtype", T::get_dtype(py))?;
    let converted = numpy
        .getattr(pyo3::intern!(py, "ascontiguousarray"))?
        .call((argument,), Some(&settings))
        .map_err(|error| {
            let told = PyTypeError::new_err(format!("`{name}` is not an array of numbers"));
            told.set_cause(py, Some(error));
            told
        })?;
    let array = converted
        .cast_into::<PyArrayDyn<T>>()
        .map_err(|_| PyTypeError::new_err(format!("`{name}` is not an array of numbers")))?;
    array.try_readonly().map_err(|_| busy(name))
}

fn busy(name: &str) -> PyErr {
    PyValueError::new_err(format!("another thread writes to `{name}`"))
}

/// Fails with `ValueError` if a value of an argument is NaN or infinite; names the argument and the index.
pub(crate) fn require_finite(values: &[f64], name: &str) -> PyResult<()> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(at) => Err(PyValueError::new_err(format!(
            "`{name}` must be finite; value {at} of the flat array is {}",
            values[at]
        ))),
    }
}
