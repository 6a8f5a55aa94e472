//! Parameters of environments from dictionaries.

use periplus::diagnostics::{Diagnostics, SourceMap};
use periplus::environments::{
    ENVIRONMENT_ROBOT, NAVIGATION_REWARD, NAVIGATION_TASK, WORLD_GENERATOR,
};
use periplus::params::{Given, ParamValues, Table};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::estimator_parameters::{keyword_texts, parameter_list, require_valid};

/// Tables of parameters by the name of their dictionary.
const TABLES: [(&str, &Table); 4] = [
    ("robot", &ENVIRONMENT_ROBOT),
    ("task", &NAVIGATION_TASK),
    ("reward", &NAVIGATION_REWARD),
    ("world", &WORLD_GENERATOR),
];

/// Reads a dictionary by a table.
///
/// # Errors
/// `TypeError` for an unknown name, `ValueError` for a wrong value.
pub(super) fn read(
    py: Python<'_>,
    table: &'static Table,
    given: Option<&Bound<'_, PyDict>>,
) -> PyResult<ParamValues> {
    let texts = keyword_texts(given)?;
    let mut findings = Diagnostics::new();
    let given = texts.iter().map(|(name, text)| Given::new(name, text.as_str()));
    let values = table.check(given, None, &mut findings);
    require_valid(py, &findings, &SourceMap::new())?;
    Ok(values)
}

/// Parameters of a table by its name.
pub(super) fn list<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyList>> {
    let Some((_, table)) = TABLES.iter().find(|(other, _)| *other == name) else {
        let names = TABLES.map(|(name, _)| name).join(", ");
        return Err(PyValueError::new_err(format!("`name` must be one of {names}, not {name:?}")));
    };
    parameter_list(py, table, "")
}
