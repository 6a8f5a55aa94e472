//! Robot and world files.

use periplus::diagnostics::{Diagnostics, Severity, SourceMap};
use pyo3::prelude::*;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyFinding>()?;
    Ok(())
}

/// Problem found in a file, or a hint.
///
/// >>> import periplus, tempfile, pathlib
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     path = pathlib.Path(folder) / "cart.urdf"
/// ...     _ = path.write_text("<robot name='cart'>\n<link name='a'/><lnk name='b'/>\n</robot>")
/// ...     finding = periplus.check(path)[0]
/// >>> finding.severity, finding.line, finding.column
/// ('warning', 2, 17)
#[pyclass(name = "Finding", module = "periplus", frozen, eq, get_all)]
#[derive(Clone, PartialEq)]
pub(crate) struct PyFinding {
    /// ``error``, ``warning`` or ``hint``.
    severity: String,
    /// Short stable name, such as ``unknown-element``.
    code: String,
    /// What is wrong.
    message: String,
    /// Path of the file; None if it concerns no place in a file.
    file: Option<String>,
    /// Line, from 1.
    line: Option<usize>,
    /// Column, from 1.
    column: Option<usize>,
    /// Facts that explain it.
    notes: Vec<String>,
    /// Advice.
    help: Vec<String>,
}

#[pymethods]
impl PyFinding {
    fn __repr__(&self) -> String {
        format!("Finding({} {}: {})", self.severity, self.code, self)
    }

    fn __str__(&self) -> String {
        self.to_string()
    }
}

impl std::fmt::Display for PyFinding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}:")?;
            if let (Some(line), Some(column)) = (self.line, self.column) {
                write!(f, "{line}:{column}:")?;
            }
            write!(f, " ")?;
        }
        f.write_str(&self.message)
    }
}

impl PyFinding {
    /// Warning without a place.
    pub(crate) fn warning(code: &str, message: &str) -> Self {
        Self {
            severity: Severity::Warning.name().to_owned(),
            code: code.to_owned(),
            message: message.to_owned(),
            file: None,
            line: None,
            column: None,
            notes: Vec::new(),
            help: Vec::new(),
        }
    }

    /// Warning about a line of a file.
    pub(crate) fn of_line(code: &str, message: &str, file: &str, line: usize) -> Self {
        Self {
            file: Some(file.to_owned()),
            line: Some(line),
            column: Some(1),
            ..Self::warning(code, message)
        }
    }
}

/// Findings with their places.
pub(crate) fn findings_of(found: &Diagnostics, sources: &SourceMap) -> Vec<PyFinding> {
    let one = |finding: &periplus::diagnostics::Diagnostic| {
        let place =
            finding.span.filter(|span| sources.holds(*span)).map(|span| sources.locate(span));
        PyFinding {
            severity: finding.severity.name().to_owned(),
            code: finding.code.to_owned(),
            message: finding.message.clone(),
            file: place.map(|(file, _)| file.to_owned()),
            line: place.map(|(_, at)| at.line),
            column: place.map(|(_, at)| at.column),
            notes: finding.notes.clone(),
            help: finding.help.clone(),
        }
    };
    found.iter().map(one).collect()
}
