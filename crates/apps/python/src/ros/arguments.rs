//! Arguments of nodes on a command line.

use periplus::diagnostics::{Diagnostics, RenderStyle, Severity, SourceMap, render};
use periplus::graph::{Arguments, ParameterFileError, split_arguments};
use periplus::msgs::rcl_interfaces::{ParameterType, ParameterValue};
use periplus::os::Machine;
use periplus::resources::{FileReadError, Host as _};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

create_exception!(
    periplus,
    RosArgumentsError,
    PyValueError,
    "Arguments after `--ros-args` that cannot be used. Attribute `unknown`: the words that are no arguments."
);

/// Arguments of a program, and those for nodes after ``--ros-args``.
#[pyfunction]
pub(crate) fn ros_split_arguments(words: Vec<String>) -> (Vec<String>, Vec<String>) {
    split_arguments(words)
}

/// Reads the words after `--ros-args`.
///
/// # Errors
/// [`RosArgumentsError`] with the findings.
pub(crate) fn read(py: Python<'_>, words: &[String]) -> PyResult<Arguments> {
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let mut open = |path: &std::path::Path| {
        let bytes = Machine.read(path).map_err(|error| match error {
            FileReadError::Missing => ParameterFileError::Missing,
            error => ParameterFileError::Unreadable(error.to_string()),
        })?;
        String::from_utf8(bytes).map_err(|_| ParameterFileError::NotText)
    };
    let arguments = Arguments::read(words, &mut sources, &mut findings, &mut open);
    let wrong = findings.iter().filter(|finding| finding.severity == Severity::Error);
    let mut text = String::new();
    for finding in wrong {
        text.push_str(&render(finding, &sources, RenderStyle::Plain));
    }
    if text.is_empty() {
        return Ok(arguments);
    }
    let error = RosArgumentsError::new_err(text.trim_end().to_owned());
    error.value(py).setattr("unknown", arguments.unknown_words().to_vec())?;
    Err(error)
}

/// Value of a parameter as an object.
pub(crate) fn parameter_object<'py>(
    py: Python<'py>,
    value: &ParameterValue,
) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value.r#type {
        ParameterType::PARAMETER_BOOL => value.bool_value.into_pyobject(py)?.to_owned().into_any(),
        ParameterType::PARAMETER_INTEGER => value.integer_value.into_pyobject(py)?.into_any(),
        ParameterType::PARAMETER_DOUBLE => value.double_value.into_pyobject(py)?.into_any(),
        ParameterType::PARAMETER_STRING => (&value.string_value).into_pyobject(py)?.into_any(),
        ParameterType::PARAMETER_BYTE_ARRAY => {
            let bytes = value.byte_array_value.iter().map(|byte| PyBytes::new(py, &[*byte]));
            pyo3::types::PyList::new(py, bytes)?.into_any()
        }
        ParameterType::PARAMETER_BOOL_ARRAY => {
            value.bool_array_value.clone().into_pyobject(py)?.into_any()
        }
        ParameterType::PARAMETER_INTEGER_ARRAY => {
            value.integer_array_value.clone().into_pyobject(py)?.into_any()
        }
        ParameterType::PARAMETER_DOUBLE_ARRAY => {
            value.double_array_value.clone().into_pyobject(py)?.into_any()
        }
        ParameterType::PARAMETER_STRING_ARRAY => {
            value.string_array_value.clone().into_pyobject(py)?.into_any()
        }
        _ => py.None().into_bound(py),
    })
}
