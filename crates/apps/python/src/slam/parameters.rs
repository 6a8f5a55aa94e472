//! Parameters of the mapping methods from keywords and files.

use std::path::Path;

use periplus::diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap};
use periplus::nav_nodes::slam_toolbox::{Written, in_file};
use periplus::params::{Given, ParamValues};
use periplus::slam::Method;
use periplus::slam::tables::{self, SlamToolboxParams, ToolboxMode};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::estimator_parameters::{keyword_texts, read_yaml, require_valid, sentence};

/// Reads the parameters: keywords override the file. The method is the given one, or the one that the parameters
/// are of.
pub(super) fn read(
    py: Python<'_>,
    method: Option<Method>,
    yaml: Option<&Path>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<(Method, ParamValues)> {
    let mut sources = SourceMap::new();
    let mut findings = Diagnostics::new();
    let tree = yaml.map(|path| read_yaml(py, path, &mut sources)).transpose()?.flatten();
    let file = tree.map(|tree| in_file(&tree, method, &mut findings)).unwrap_or_default();
    let keywords: Vec<Written> = keyword_texts(keywords)?
        .into_iter()
        .map(|(name, text)| {
            let (name_origin, origin) = (Origin::default(), Origin::default());
            Written { name, text, name_origin, origin }
        })
        .collect();
    let given = |layer: &[Written]| {
        tables::method_of(&layer.iter().map(Written::given).collect::<Vec<_>>())
    };
    let method = method
        .or_else(|| given(&keywords))
        .or(file.method)
        .or_else(|| given(&file.written))
        .unwrap_or_default();
    let table = method.table();
    if let Some(one) = keywords.iter().find(|one| table.find(&one.name).is_none()) {
        return Err(unknown(method, &one.given()));
    }
    let canonical = |name: &str| table.find(name).map(|it| it.name);
    let is_overridden = |one: &&Written| {
        canonical(&one.name).is_some()
            && keywords.iter().any(|it| canonical(&it.name) == canonical(&one.name))
    };
    let of_file = file.written.iter().filter(|one| !is_overridden(one));
    let given: Vec<Given<'_>> = keywords.iter().chain(of_file).map(Written::given).collect();
    let values = table.check(given, None, &mut findings);
    for finding in tables::conflicts(&values).into_iter().chain(tables::idle(&values)) {
        findings.push(finding);
    }
    require_valid(py, &findings, &sources)?;
    let is_localization = method == Method::Graph
        && SlamToolboxParams::from_values(&values).mode == ToolboxMode::Localization;
    if is_localization {
        return Err(PyValueError::new_err(
            "`mode: localization` is not for Slam; use Amcl on the map, or Slam.load to go on with a session",
        ));
    }
    Ok((method, values))
}

/// Unknown keyword; names the method that has it.
fn unknown(method: Method, given: &Given<'_>) -> PyErr {
    let finding: Diagnostic = method.table().unknown(given);
    let other = Method::ALL.into_iter().find(|it| it.table().find(given.name).is_some());
    match other {
        Some(other) => PyTypeError::new_err(format!(
            "{}; it is a parameter of method=\"{other}\"",
            finding.message
        )),
        None => PyTypeError::new_err(sentence(&finding)),
    }
}
