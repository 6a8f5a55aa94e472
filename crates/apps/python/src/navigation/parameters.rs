//! Parameters of the servers: a file, or values that change the defaults, and the plugins that are given by name.

use std::path::PathBuf;
use std::sync::Arc;

use periplus::diagnostics::SourceMap;
use periplus::yaml::{YamlNode, YamlValue};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value, json};

use super::file_text;
use super::plugin::Factory;
use crate::errors::{require_file, value_error};

/// Section of the parameters of a node.
const SECTION: &str = "ros__parameters";

/// Type of a plugin that is given by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shortcut {
    Planner,
    Controller,
    Behavior,
}

impl Shortcut {
    /// Node, list of its plugins, and the default of the list.
    fn list(self) -> (&'static str, &'static str, &'static [&'static str]) {
        match self {
            Self::Planner => ("planner_server", "planner_plugins", &["GridBased"]),
            Self::Controller => ("controller_server", "controller_plugins", &["FollowPath"]),
            Self::Behavior => (
                "behavior_server",
                "behavior_plugins",
                &["spin", "backup", "drive_on_heading", "assisted_teleop", "wait"],
            ),
        }
    }
}

/// A plugin that is given by its name: its type, name and class.
type NamedPlugin = (Shortcut, String, String);

/// Classes of an argument. A key without `/` and `::` is the name of a plugin, which goes to `shortcuts`.
pub(super) fn classes(
    given: Option<&Bound<'_, PyDict>>,
    argument: &str,
    shortcut: Shortcut,
    shortcuts: &mut Vec<NamedPlugin>,
) -> PyResult<Vec<(String, Factory)>> {
    let mut classes = Vec::new();
    for (key, factory) in given.into_iter().flatten() {
        let key: String = key.extract().map_err(|_| {
            PyTypeError::new_err(format!("the keys of `{argument}` are names of classes"))
        })?;
        if !factory.is_callable() {
            return Err(PyTypeError::new_err(format!(
                "`{argument}[{key:?}]` must be a class or a function, not {}",
                factory.repr()?
            )));
        }
        let class = if key.contains('/') || key.contains("::") {
            key
        } else {
            let class = format!("python::{key}");
            shortcuts.push((shortcut, key, class.clone()));
            class
        };
        classes.push((class, Arc::new(factory.unbind())));
    }
    Ok(classes)
}

/// Parameters as the user gives them.
pub(super) struct ServerParameters {
    file: Option<PathBuf>,
    /// Values by node, which replace those of the file.
    changes: Vec<(String, Value)>,
    shortcuts: Vec<NamedPlugin>,
}

impl ServerParameters {
    /// Reads the argument `parameters`.
    ///
    /// # Errors
    /// `TypeError` or `ValueError` that names the argument; `FileNotFoundError`.
    pub(super) fn new(
        argument: Option<&Bound<'_, PyAny>>,
        shortcuts: Vec<NamedPlugin>,
    ) -> PyResult<Self> {
        let mut parameters = Self { file: None, changes: Vec::new(), shortcuts };
        let Some(argument) = argument else { return Ok(parameters) };
        if argument.is_instance_of::<PyDict>() {
            let json = argument.py().import("json")?;
            let text: String = json.call_method1("dumps", (argument,))?.extract()?;
            let Value::Object(nodes) = serde_json::from_str(&text).map_err(value_error)? else {
                return Ok(parameters);
            };
            for (node, values) in nodes {
                if !values.is_object() {
                    return Err(PyTypeError::new_err(format!(
                        "`parameters[{node:?}]` must be a dict of the parameters of that node"
                    )));
                }
                parameters.changes.push((node, values));
            }
        } else {
            let path: PathBuf = argument.extract().map_err(|_| {
                PyTypeError::new_err("`parameters` must be a path or a dict of values by node")
            })?;
            require_file(&path)?;
            parameters.file = Some(path);
        }
        Ok(parameters)
    }

    /// Name and text of the parameter file; `default_text` is the one for the robot.
    ///
    /// # Errors
    /// A sentence when a file cannot be read.
    pub(super) fn file(&self, default_text: String) -> Result<(String, String), String> {
        let (name, text) = match &self.file {
            Some(path) => (path.display().to_string(), file_text(path)?),
            None => ("the default parameters".to_owned(), default_text),
        };
        if self.changes.is_empty() && self.shortcuts.is_empty() {
            return Ok((name, text));
        }
        let mut sources = SourceMap::new();
        let file = sources.add(name.clone(), text);
        let tree = periplus::yaml::parse(file, &sources).map_err(|fault| fault.message)?;
        let mut root = match tree.as_ref().map(to_json) {
            Some(Value::Object(root)) => root,
            _ => Map::new(),
        };
        for (node, values) in &self.changes {
            merge(&mut root, &section(node, values.clone()));
        }
        for (shortcut, id, class) in &self.shortcuts {
            let (node, list, usual) = shortcut.list();
            let known = root.get(node).and_then(|node| node.get(SECTION)?.get(list));
            let mut ids = known.cloned().unwrap_or_else(|| json!(usual));
            if let Value::Array(ids) = &mut ids
                && !ids.iter().any(|one| one == id)
            {
                ids.push(json!(id));
            }
            merge(&mut root, &section(node, json!({ list: ids, id: { "plugin": class } })));
        }
        Ok((format!("{name} with changes"), format!("{:#}\n", Value::Object(root))))
    }
}

/// File with the parameters of one node. The section of a costmap is within a namespace of its name.
fn section(node: &str, values: Value) -> Value {
    let section = json!({ node: { SECTION: values } });
    let is_costmap = matches!(node, "local_costmap" | "global_costmap");
    if is_costmap { json!({ node: section }) } else { section }
}

/// Replaces values. A mapping with `plugin` replaces another one as a whole.
fn merge(into: &mut Map<String, Value>, changes: &Value) {
    for (key, change) in changes.as_object().into_iter().flatten() {
        match (into.get_mut(key), change) {
            (Some(Value::Object(known)), Value::Object(more)) if !more.contains_key("plugin") => {
                merge(known, change);
            }
            _ => {
                into.insert(key.clone(), change.clone());
            }
        }
    }
}

/// A tree as JSON, which is YAML, too.
fn to_json(node: &YamlNode) -> Value {
    match &node.value {
        YamlValue::Map(entries) => {
            let entries = entries.iter();
            let pair = |(key, value): &(YamlNode, YamlNode)| {
                Some((key.text()?.to_owned(), to_json(value)))
            };
            Value::Object(entries.filter_map(pair).collect())
        }
        YamlValue::List(items) => Value::Array(items.iter().map(to_json).collect()),
        YamlValue::Scalar { .. } => {
            if let Some(truth) = node.truth() {
                json!(truth)
            } else if let Some(integer) = node.integer() {
                json!(integer)
            } else if let Some(number) = node.number().filter(|number| number.is_finite()) {
                json!(number)
            } else {
                json!(node.text().unwrap_or_default())
            }
        }
    }
}
