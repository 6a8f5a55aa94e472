//! Parameters of the filter from keywords and files.

use std::path::Path;

use periplus::diagnostics::{Diagnostics, Origin, SourceMap};
use periplus::ekf::{EKF, SOURCE, Settings};
use periplus::nav_nodes::slam_toolbox::Written;
use periplus::params::Given;
use periplus::yaml::{YamlNode, YamlValue};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::estimator_parameters::{keyword_texts, parameter_list, read_yaml, require_valid};

/// Beginnings of the names of inputs.
const INPUTS: [&str; 4] = ["odom", "pose", "twist", "imu"];
/// Maximum nesting of namespaces around a node.
const MAX_NAMESPACE_DEPTH: usize = 4;

/// Reads the settings: keywords override the file.
pub(super) fn read(
    py: Python<'_>,
    yaml: Option<&Path>,
    node: &str,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Settings> {
    let mut sources = SourceMap::new();
    let mut findings = Diagnostics::new();
    let mut written = Vec::new();
    if let Some(tree) = yaml.map(|path| read_yaml(py, path, &mut sources)).transpose()?.flatten() {
        let mut sections = Vec::new();
        collect(&tree, node, 0, &mut sections);
        if sections.is_empty() {
            sections.push(tree.get(node).unwrap_or(&tree));
        }
        for section in sections {
            flatten(section, "", &mut written);
        }
    }
    let keywords = keyword_texts(keywords)?;
    // Without a graph an input needs no topic: its name stands for one.
    for (name, _) in &keywords {
        let input = name.split('_').next().unwrap_or(name);
        let is_named = |other: &str| other == input;
        if is_input(input)
            && input != name
            && !written.iter().any(|it| is_named(&it.name))
            && !keywords.iter().any(|it| is_named(&it.0))
        {
            written.push(plain(input, input));
        }
    }
    // Of a repeated parameter the last value applies.
    written.extend(keywords.iter().map(|(name, text)| plain(name, text)));
    let given: Vec<Given<'_>> = written.iter().map(Written::given).collect();
    let (settings, _) = Settings::read(given, &mut findings);
    require_valid(py, &findings, &sources)?;
    Ok(settings)
}

/// Parameters of the filter and of an input `odom0`.
pub(super) fn list(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let rows = parameter_list(py, &EKF, "")?;
    for row in parameter_list(py, &SOURCE, "odom0_")? {
        if row.get_item("name")?.eq("odom0_topic")? {
            // The name of the input alone sets its topic, and it is optional here.
            row.set_item("name", "odom0")?;
            row.set_item("is_required", false)?;
        }
        rows.append(row)?;
    }
    Ok(rows)
}

fn is_input(name: &str) -> bool {
    INPUTS.iter().any(|kind| {
        let number = name.strip_prefix(kind).unwrap_or_default();
        !number.is_empty() && number.bytes().all(|it| it.is_ascii_digit())
    })
}

fn plain(name: &str, text: &str) -> Written {
    let (name_origin, origin) = (Origin::default(), Origin::default());
    Written { name: name.to_owned(), text: text.to_owned(), name_origin, origin }
}

fn collect<'a>(at: &'a YamlNode, node: &str, depth: usize, found: &mut Vec<&'a YamlNode>) {
    for (key, value) in at.entries().filter(|_| depth < MAX_NAMESPACE_DEPTH).unwrap_or_default() {
        let Some(key) = key.text() else { continue };
        let name = key.trim_start_matches('/').rsplit('/').next().unwrap_or(key);
        match value.get("ros__parameters") {
            Some(parameters) if [node, "**", "*"].contains(&name) => found.push(parameters),
            Some(_) => {}
            None => collect(value, node, depth + 1, found),
        }
    }
}

/// Parameters with dotted names; the values of a list are joined.
fn flatten(at: &YamlNode, prefix: &str, flat: &mut Vec<Written>) {
    for (key, value) in at.entries().unwrap_or_default() {
        let Some(last) = key.text() else { continue };
        let name = format!("{prefix}{last}");
        let text = match &value.value {
            YamlValue::Map(_) => {
                flatten(value, &format!("{name}."), flat);
                continue;
            }
            YamlValue::Scalar { text, .. } => text.clone(),
            YamlValue::List(list) => {
                list.iter().filter_map(YamlNode::text).collect::<Vec<_>>().join(" ")
            }
        };
        flat.push(Written { name, text, name_origin: key.span.into(), origin: value.span.into() });
    }
}
