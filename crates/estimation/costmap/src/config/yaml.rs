//! Parameter files in YAML of Nav2 and ROS 1.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_params::Given;
use periplus_yaml::{YamlNode, YamlValue};

use super::CostmapConfig;
use crate::Nav2Release;

/// Maximum nesting depth of namespaces around a node.
const MAX_NAMESPACE_DEPTH: usize = 4;

impl CostmapConfig {
    /// Returns true if a file has parameters for a node.
    #[must_use]
    pub fn is_in(file: &YamlNode, node: &str) -> bool {
        let names = |at: &YamlNode| {
            let keys = at.entries().unwrap_or_default().iter();
            keys.filter_map(|(key, _)| key.text())
                .any(|key| key.trim_start_matches('/').rsplit('/').next() == Some(node))
        };
        names(file) || file.entries().unwrap_or_default().iter().any(|(_, inner)| names(inner))
    }

    /// Reads the parameters of a node from a file: for `local_costmap` from `local_costmap:
    /// local_costmap: ros__parameters:` and `/**`; in files of ROS 1 from `local_costmap:` or,
    /// without such a section, from the whole file.
    pub fn read_yaml(
        file: &YamlNode,
        node: &str,
        compat: Option<Nav2Release>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let mut flat = Vec::new();
        for section in sections(file, node) {
            flatten(section, "", &mut flat, diagnostics);
        }
        let given = flat.iter().map(|one| Given {
            name: &one.name,
            text: one.text.as_str().into(),
            name_origin: one.name_origin,
            origin: one.origin,
        });
        Self::read(given, compat, diagnostics)
    }
}

/// Returns the mappings with parameters for a node.
fn sections<'a>(file: &'a YamlNode, node: &str) -> Vec<&'a YamlNode> {
    let mut found = Vec::new();
    let last = node.rsplit('/').next().unwrap_or(node);
    collect(file, last, &mut found, 0);
    if found.is_empty() {
        // ROS 1: without `ros__parameters`.
        found.push(file.get(last).unwrap_or(file));
    }
    found
}

fn collect<'a>(at: &'a YamlNode, node: &str, found: &mut Vec<&'a YamlNode>, depth: usize) {
    let Some(entries) = at.entries().filter(|_| depth < MAX_NAMESPACE_DEPTH) else { return };
    for (key, value) in entries {
        let Some(key) = key.text() else { continue };
        // A namespace, a node in a namespace (`/local_costmap/local_costmap`), or a wildcard for
        // either.
        let name = key.trim_start_matches('/').rsplit('/').next().unwrap_or(key);
        if name != node && name != "**" && name != "*" {
            continue;
        }
        match value.get("ros__parameters") {
            Some(parameters) => found.push(parameters),
            None => collect(value, node, found, depth + 1),
        }
    }
}

struct Flat {
    name: String,
    text: String,
    name_origin: Origin,
    origin: Origin,
}

/// Flattens nested mappings to names with dots.
fn flatten(at: &YamlNode, prefix: &str, flat: &mut Vec<Flat>, diagnostics: &mut Diagnostics) {
    for (key, value) in at.entries().unwrap_or_default() {
        let Some(key_text) = key.text() else { continue };
        let name =
            if prefix.is_empty() { key_text.to_owned() } else { format!("{prefix}.{key_text}") };
        let text = match &value.value {
            YamlValue::Map(_) => {
                flatten(value, &name, flat, diagnostics);
                continue;
            }
            YamlValue::Scalar { text, .. } => text.clone(),
            YamlValue::List(list) => {
                match named_types(list) {
                    None => written(list),
                    Some(layers) => {
                        diagnostics.push(
                        Diagnostic::hint(
                            "ros1-name",
                            "a list of names and types is the syntax of ROS 1",
                        )
                        .at(key.span)
                        .help("in Nav2 `plugins` is a list of names, and each layer has a `plugin`"),
                    );
                        let names: Vec<&str> = layers.iter().map(|(name, _, _)| *name).collect();
                        for (layer, plugin, origin) in &layers {
                            flat.push(Flat {
                                name: format!("{layer}.plugin"),
                                text: (*plugin).to_owned(),
                                name_origin: *origin,
                                origin: *origin,
                            });
                        }
                        names.join(" ")
                    }
                }
            }
        };
        flat.push(Flat { name, text, name_origin: key.span.into(), origin: value.span.into() });
    }
}

/// ROS 1: `plugins: [{name: static_layer, type: "costmap_2d::StaticLayer"}]`.
fn named_types(list: &[YamlNode]) -> Option<Vec<(&str, &str, Origin)>> {
    if list.is_empty() {
        return None;
    }
    list.iter()
        .map(|item| {
            let plugin = item.get("type")?;
            Some((item.get("name")?.text()?, plugin.text()?, plugin.span.into()))
        })
        .collect()
}

/// Formats a list as a text that can be parsed again, with nested lists in brackets.
fn written(list: &[YamlNode]) -> String {
    let items: Vec<String> = list
        .iter()
        .map(|item| match &item.value {
            YamlValue::Scalar { text, .. } => text.clone(),
            YamlValue::List(inner) => written(inner),
            YamlValue::Map(_) => String::new(),
        })
        .collect();
    format!("[{}]", items.join(", "))
}
