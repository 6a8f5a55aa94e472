//! Parameter files: nodes, each with a mapping `ros__parameters`.
//!
//! Source: `rcl_yaml_param_parser`. Node names may be nested by namespace, parameter names by
//! group.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, SourceMap};
use periplus_msgs::rcl_interfaces::ParameterValue;
use periplus_yaml::YamlNode;

use super::scalar::{self, parameter_to_yaml};
use super::{Arguments, Pattern};

const PARAMETERS: &str = "ros__parameters";

/// Adds the parameters of a file to the arguments.
pub(super) fn read(
    arguments: &mut Arguments,
    file: FileId,
    sources: &SourceMap,
    diagnostics: &mut Diagnostics,
) {
    match periplus_yaml::parse(file, sources) {
        Ok(Some(node)) => nodes(arguments, "", &node, diagnostics),
        Ok(None) => {
            let empty = Diagnostic::warning("no-parameters", "the file has no parameters");
            diagnostics.push(empty.at(sources.whole(file)));
        }
        Err(wrong) => diagnostics.push(*wrong),
    }
}

fn nodes(arguments: &mut Arguments, path: &str, at: &YamlNode, diagnostics: &mut Diagnostics) {
    let Some(entries) = at.entries() else {
        let message = format!("{} where a node name is expected", at.kind());
        let wrong = Diagnostic::error("bad-parameter-file", message).at(at.span);
        diagnostics.push(wrong.help(format!(
            "write the node name (or `/**` for all), below it `{PARAMETERS}`, below that \
             the parameters"
        )));
        return;
    };
    for (key, value) in entries {
        let Some(name) = key.text() else {
            diagnostics
                .push(Diagnostic::error("bad-parameter-file", "this is not a name").at(key.span));
            continue;
        };
        if name != PARAMETERS {
            nodes(arguments, &format!("{path}/{}", name.trim_matches('/')), value, diagnostics);
            continue;
        }
        if path.is_empty() {
            let message = format!("`{PARAMETERS}` must be below a node name");
            let wrong = Diagnostic::error("bad-parameter-file", message).at(key.span);
            diagnostics.push(wrong.help("write `/**` above it for all nodes"));
            continue;
        }
        match Pattern::read(path) {
            Ok(pattern) => group(arguments, &pattern, "", value, diagnostics),
            Err(reason) => {
                let message = format!("the node name `{path}` {reason}");
                diagnostics.push(Diagnostic::error("bad-parameter-file", message).at(key.span));
            }
        }
    }
}

fn group(
    arguments: &mut Arguments,
    pattern: &Pattern,
    path: &str,
    at: &YamlNode,
    diagnostics: &mut Diagnostics,
) {
    let Some(entries) = at.entries() else {
        // A node without parameters.
        if !at.is_null() {
            let message = format!("{} where parameter names and values are expected", at.kind());
            diagnostics.push(Diagnostic::error("bad-parameter-file", message).at(at.span));
        }
        return;
    };
    for (key, value) in entries {
        let Some(name) = key.text().filter(|name| !name.is_empty()) else {
            diagnostics
                .push(Diagnostic::error("bad-parameter-file", "this is not a name").at(key.span));
            continue;
        };
        let name = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        if value.entries().is_some() {
            group(arguments, pattern, &name, value, diagnostics);
            continue;
        }
        match scalar::value(value) {
            Ok(value) => arguments.give(pattern.clone(), name, value),
            Err(wrong) => {
                let message = format!("`{name}`: the value {}", wrong.message);
                diagnostics.push(Diagnostic { message, ..*wrong });
            }
        }
    }
}

/// Formats the parameters of a node as a file, as `ros2 param dump` does.
///
/// ```
/// use periplus_graph::{parameter_from_yaml, parameters_to_yaml};
///
/// let value = |text| parameter_from_yaml(text).unwrap();
/// let file = parameters_to_yaml("/demo/scan", &[
///     ("min.range".into(), value("0.1")),
///     ("use_sim_time".into(), value("true")),
/// ]);
/// assert_eq!(file, "/demo/scan:\n  ros__parameters:\n    min:\n      range: 0.1\n    use_sim_time: true\n");
/// ```
#[must_use]
pub fn parameters_to_yaml(node: &str, parameters: &[(String, ParameterValue)]) -> String {
    let mut tree = Tree::default();
    for (name, value) in parameters {
        tree.add(name, value);
    }
    let mut out = format!("{node}:\n  {PARAMETERS}:\n");
    tree.write(2, &mut out);
    out
}

/// Tree of groups and values by name.
#[derive(Default)]
struct Tree<'v> {
    values: BTreeMap<String, &'v ParameterValue>,
    groups: BTreeMap<String, Self>,
}

impl<'v> Tree<'v> {
    fn add(&mut self, name: &str, value: &'v ParameterValue) {
        match name.split_once('.') {
            Some((group, rest)) if !group.is_empty() && !rest.is_empty() => {
                self.groups.entry(group.to_owned()).or_default().add(rest, value);
            }
            _ => {
                self.values.insert(name.to_owned(), value);
            }
        }
    }

    fn write(&self, depth: usize, out: &mut String) {
        let names: std::collections::BTreeSet<&String> =
            self.values.keys().chain(self.groups.keys()).collect();
        let indent = "  ".repeat(depth);
        for name in names {
            if let Some(value) = self.values.get(name) {
                let _ = writeln!(out, "{indent}{name}: {}", parameter_to_yaml(value));
            }
            if let Some(group) = self.groups.get(name) {
                let _ = writeln!(out, "{indent}{name}:");
                group.write(depth + 1, out);
            }
        }
    }
}
