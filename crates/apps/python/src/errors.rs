//! Errors of the crates as exceptions of Python.

use std::fmt::Display;
use std::path::Path;

use periplus::diagnostics::{Diagnostic, Diagnostics, Severity, SourceMap};
use pyo3::create_exception;
use pyo3::exceptions::{PyFileNotFoundError, PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

create_exception!(
    periplus,
    FileError,
    PyValueError,
    "A file that cannot be used.\n\n\
     Attributes: `file` (path), `line` and `column` (from 1) and `hint` (advice), each None where unknown.\n\n\
     >>> import periplus\n\
     >>> issubclass(periplus.FileError, ValueError)\n\
     True"
);

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("FileError", module.py().get_type::<FileError>())
}

/// Wrong value of an argument: `ValueError`.
pub(crate) fn value_error(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Failed job: `RuntimeError`.
pub(crate) fn runtime_error(error: impl Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// Fails with `FileNotFoundError` if there is no such file.
pub(crate) fn require_file(path: &Path) -> PyResult<()> {
    match std::fs::metadata(path) {
        Ok(_) => Ok(()),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            Err(PyFileNotFoundError::new_err((2, "No such file or directory", path.to_path_buf())))
        }
        Err(error) => Err(PyOSError::new_err(format!("{}: {error}", path.display()))),
    }
}

/// Error about a file as a whole: `FileError`.
pub(crate) fn file_error(py: Python<'_>, path: &Path, message: impl Display) -> PyErr {
    let error = FileError::new_err(format!("{}: {message}", path.display()));
    with_place(py, error, Some(path.display().to_string()), None, None)
}

/// The first error among findings as a `FileError`. `Ok` if there is none.
pub(crate) fn require_no_errors(
    py: Python<'_>,
    findings: &Diagnostics,
    sources: &SourceMap,
) -> PyResult<()> {
    match findings.iter().find(|finding| finding.severity == Severity::Error) {
        None => Ok(()),
        Some(finding) => Err(finding_error(py, finding, sources)),
    }
}

/// A finding as a `FileError` with its location.
pub(crate) fn finding_error(py: Python<'_>, finding: &Diagnostic, sources: &SourceMap) -> PyErr {
    let place = finding.span.filter(|span| sources.holds(*span)).map(|span| sources.locate(span));
    let hint = (!finding.help.is_empty()).then(|| finding.help.join("; "));
    let mut text = finding.message.clone();
    if let Some((file, at)) = place {
        text = format!("{file}:{}:{}: {text}", at.line, at.column);
    }
    for note in finding.notes.iter().chain(&finding.help) {
        text.push_str("\n  ");
        text.push_str(note);
    }
    let error = FileError::new_err(text);
    let file = place.map(|(file, _)| file.to_owned());
    with_place(py, error, file, place.map(|(_, at)| (at.line, at.column)), hint)
}

fn with_place(
    py: Python<'_>,
    error: PyErr,
    file: Option<String>,
    at: Option<(usize, usize)>,
    hint: Option<String>,
) -> PyErr {
    let value = error.value(py);
    let set = value
        .setattr("file", file)
        .and_then(|()| value.setattr("line", at.map(|at| at.0)))
        .and_then(|()| value.setattr("column", at.map(|at| at.1)))
        .and_then(|()| value.setattr("hint", hint));
    match set {
        Ok(()) => error,
        Err(error) => error,
    }
}
