//! TODO.

use pyo3::prelude::*;

pub(crate) fn register(_module: &Bound<'_, PyModule>) -> PyResult<()> {
    Ok(())
}

pub(crate) fn to_python<'py>(
    _py: Python<'py>,
    _type_name: &str,
    _cdr: &[u8],
) -> PyResult<Bound<'py, PyAny>> {
    Err(crate::errors::runtime_error("soon"))
}

pub(crate) fn from_python(_object: &Bound<'_, PyAny>) -> PyResult<(String, Vec<u8>)> {
    Err(crate::errors::runtime_error("soon"))
}

pub(crate) fn type_name_of(_class: &Bound<'_, PyAny>) -> PyResult<String> {
    Err(crate::errors::runtime_error("soon"))
}
