//! Parameters of the estimators: keyword arguments and YAML files, checked by the tables of the crates.

use std::path::Path;

use periplus::diagnostics::{Diagnostic, DiagnosticCause, Diagnostics, Severity, SourceMap};
use periplus::params::{Default, ParamType, ParamValue, ParamValues, Parameter, Table};
use periplus::yaml::YamlNode;
use periplus_session::files;
use pyo3::exceptions::{PyTypeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString};

use crate::errors::{file_error, finding_error, require_file};

/// Keyword arguments as a file would have them: names, with dots for nested dictionaries, and texts. `None` stands
/// for the default.
///
/// # Errors
/// `TypeError` for a value that no parameter can have.
pub(crate) fn keyword_texts(
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<(String, String)>> {
    let mut texts = Vec::new();
    for (name, value) in keywords.into_iter().flatten() {
        flatten(name.extract()?, &value, &mut texts)?;
    }
    Ok(texts)
}

fn flatten(
    name: String,
    value: &Bound<'_, PyAny>,
    texts: &mut Vec<(String, String)>,
) -> PyResult<()> {
    if let Ok(inner) = value.cast::<PyDict>() {
        for (key, value) in inner {
            flatten(format!("{name}.{}", key.str()?), &value, texts)?;
        }
    } else if !value.is_none() {
        let text = text(&name, value)?;
        texts.push((name, text));
    }
    Ok(())
}

fn text(name: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(text.to_string());
    }
    if let Ok(flag) = value.extract::<bool>() {
        return Ok(flag.to_string());
    }
    if value.len().is_ok() {
        let items: Vec<String> =
            value.try_iter()?.map(|item| text(name, &item?)).collect::<PyResult<_>>()?;
        return Ok(items.join(" "));
    }
    if let Ok(integer) = value.extract::<i64>() {
        return Ok(integer.to_string());
    }
    if let Ok(number) = value.extract::<f64>() {
        return Ok(number.to_string());
    }
    if let Ok(path) = value.call_method0("__fspath__") {
        return text(name, &path);
    }
    let kind = value.get_type();
    Err(PyTypeError::new_err(format!("`{name}` cannot be of the type {}", kind.name()?)))
}

/// Reads a YAML file. None if it is empty.
///
/// # Errors
/// `FileNotFoundError`, or `FileError` with the location of a fault.
pub(crate) fn read_yaml(
    py: Python<'_>,
    path: &Path,
    sources: &mut SourceMap,
) -> PyResult<Option<YamlNode>> {
    require_file(path)?;
    let text = files::text(path).map_err(|error| file_error(py, path, error))?;
    let file = sources.add(path.display().to_string(), text);
    periplus::yaml::parse(file, sources).map_err(|fault| finding_error(py, &fault, sources))
}

/// Raises the first fault of parameters: `FileError` for a wrong value or a misspelled name in a file, `TypeError` for
/// an unknown keyword and `ValueError` for a wrong value of one. Warnings are warnings of Python, also unknown names in
/// a file that are similar to none.
pub(crate) fn require_valid(
    py: Python<'_>,
    findings: &Diagnostics,
    sources: &SourceMap,
) -> PyResult<()> {
    for finding in findings.iter() {
        let is_unknown = finding.cause == Some(DiagnosticCause::UnknownParameter);
        let is_in_file = finding.span.is_some_and(|span| sources.holds(span));
        // One of a newer release has no similar name: its file still loads, with a warning.
        let is_misspelled = is_unknown && finding.replacement.is_some();
        if is_in_file && (is_misspelled || finding.severity == Severity::Error) {
            return Err(finding_error(py, &advised(finding), sources));
        }
        if is_unknown && !is_in_file {
            return Err(PyTypeError::new_err(sentence(finding)));
        }
        if finding.severity == Severity::Error {
            return Err(PyValueError::new_err(sentence(finding)));
        }
    }
    for finding in findings.iter().filter(|it| it.severity == Severity::Warning) {
        let place = finding.span.filter(|span| sources.holds(*span));
        let place = place
            .map(|span| sources.locate(span))
            .map_or_else(String::new, |(file, at)| format!("{file}:{}:{}: ", at.line, at.column));
        warn(py, &format!("{place}{}", sentence(finding)))?;
    }
    Ok(())
}

/// Issues a `UserWarning` at the line that calls Periplus.
pub(crate) fn warn(py: Python<'_>, text: &str) -> PyResult<()> {
    let text = std::ffi::CString::new(text.replace('\0', " "))?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)
}

/// The finding with its replacement as advice, and without the note that a default is used: an exception is raised
/// instead.
fn advised(finding: &Diagnostic) -> Diagnostic {
    let mut finding = finding.clone();
    finding.notes.retain(|note| !is_about_default(note));
    if let Some(replacement) = &finding.replacement {
        finding.help.push(replacement.message.clone());
    }
    finding
}

fn is_about_default(note: &str) -> bool {
    note.starts_with("the default is used")
}

/// Message, notes and advice in one line.
pub(crate) fn sentence(finding: &Diagnostic) -> String {
    let finding = advised(finding);
    let mut text = finding.message;
    for more in finding.notes.iter().chain(&finding.help).filter(|it| !is_about_default(it)) {
        text.push_str("; ");
        text.push_str(more);
    }
    text
}

/// The parameters of a table as a list of dictionaries.
pub(crate) fn parameter_list<'py>(
    py: Python<'py>,
    table: &'static Table,
    prefix: &str,
) -> PyResult<Bound<'py, PyList>> {
    let rows = PyList::empty(py);
    for parameter in table.parameters {
        let row = PyDict::new(py);
        row.set_item("name", format!("{prefix}{}", parameter.name))?;
        row.set_item("type", type_name(parameter.kind))?;
        row.set_item("unit", parameter.unit)?;
        row.set_item("default", default_value(py, parameter)?)?;
        row.set_item("is_required", parameter.default == Default::Required)?;
        row.set_item("minimum", parameter.range.map(|it| it.min))?;
        row.set_item("maximum", parameter.range.map(|it| it.max))?;
        row.set_item("excludes_minimum", parameter.range.is_some_and(|it| it.above))?;
        let choices = match parameter.kind {
            ParamType::Choice(words) => Some(words.to_vec()),
            _ => None,
        };
        row.set_item("choices", choices)?;
        row.set_item("aliases", parameter.aliases.to_vec())?;
        row.set_item("doc", parameter.doc)?;
        rows.append(row)?;
    }
    Ok(rows)
}

const fn type_name(kind: ParamType) -> &'static str {
    match kind {
        ParamType::Bool => "bool",
        ParamType::Integer => "int",
        ParamType::Number => "float",
        ParamType::Text | ParamType::Choice(_) => "str",
        ParamType::NumberList => "list[float]",
        ParamType::TextList => "list[str]",
        ParamType::Group => "dict",
    }
}

fn default_value<'py>(
    py: Python<'py>,
    parameter: &Parameter,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Default::Value(written) = parameter.default else { return Ok(None) };
    ParamValue::read(parameter, written).ok().map(|value| value_object(py, value)).transpose()
}

/// Value of a parameter as an object of Python.
fn value_object<'py>(py: Python<'py>, value: ParamValue) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        ParamValue::Bool(value) => value.into_pyobject(py)?.to_owned().into_any(),
        ParamValue::Integer(value) => value.into_pyobject(py)?.into_any(),
        ParamValue::Number(value) => value.into_pyobject(py)?.into_any(),
        ParamValue::Text(value) => value.into_pyobject(py)?.into_any(),
        ParamValue::Numbers(value) => value.into_pyobject(py)?.into_any(),
        ParamValue::Texts(value) => value.into_pyobject(py)?.into_any(),
    })
}

/// All values by name.
pub(crate) fn values_dict<'py>(
    py: Python<'py>,
    values: &ParamValues,
) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for name in values.table().names() {
        all.set_item(name, values.get(name).map(|it| value_object(py, it)).transpose()?)?;
    }
    Ok(all)
}
