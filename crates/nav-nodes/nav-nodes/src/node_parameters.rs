//! Parameters of a node in the tree of a parameter file of ROS 2.

use periplus_diagnostics::Origin;
use periplus_params::Given;
use periplus_yaml::{YamlNode, YamlValue};

/// Maximum depth of nested namespaces.
pub(crate) const MAX_NAMESPACE_DEPTH: usize = 4;

/// Parameters with dotted names, as written for one node. Values of a list are separated by blanks, those of a list
/// in a list have brackets.
#[derive(Clone, Debug, Default)]
pub struct NodeParameters {
    entries: Vec<Written>,
}

/// A parameter as written in a file.
#[derive(Clone, Debug)]
pub struct Written {
    /// Name, with dots.
    pub name: String,
    /// Value; for a list, its values joined.
    pub text: String,
    /// Location of the name in the file.
    pub name_origin: Origin,
    /// Location of the value in the file.
    pub origin: Origin,
}

impl Written {
    /// For a table to check.
    #[must_use]
    pub fn given(&self) -> Given<'_> {
        Given {
            name: &self.name,
            text: self.text.as_str().into(),
            name_origin: self.name_origin,
            origin: self.origin,
        }
    }
}

impl NodeParameters {
    /// Reads the sections of a node: `NAME: ros__parameters:`, also within namespaces or with a leading slash, and
    /// `/**:`. In the order of the file; later values of a name apply.
    #[must_use]
    pub fn of_node(file: &YamlNode, node: &str) -> Self {
        let mut sections = Vec::new();
        collect(file, node, 0, &mut sections);
        Self::of_sections(sections)
    }

    /// Reads mappings of parameters.
    #[must_use]
    pub fn of_sections<'a>(sections: impl IntoIterator<Item = &'a YamlNode>) -> Self {
        let mut read = Self::default();
        for section in sections {
            flatten(section, "", &mut read.entries);
        }
        read
    }

    /// Adds a parameter without a source location; it overrides those of the file.
    pub fn push(&mut self, name: impl Into<String>, text: impl Into<String>) {
        self.entries.push(Written {
            name: name.into(),
            text: text.into(),
            name_origin: Origin::default(),
            origin: Origin::default(),
        });
    }

    /// Returns true if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Returns the last value of a parameter, as written.
    #[must_use]
    pub fn text(&self, name: &str) -> Option<&str> {
        self.entries.iter().rev().find(|entry| entry.name == name).map(|entry| &*entry.text)
    }

    /// Iterates over the parameters, each name once, with its last value.
    pub fn given(&self) -> impl Iterator<Item = Given<'_>> {
        let is_last = |index: usize, name: &str| {
            self.entries[index + 1..].iter().all(|later| later.name != name)
        };
        let last = self.entries.iter().enumerate();
        let last = last.filter(move |(index, entry)| is_last(*index, &entry.name));
        last.map(|(_, entry)| entry.given())
    }
}

/// Adds the values of a mapping with dotted names; values of a list are separated by blanks.
pub(crate) fn flatten(at: &YamlNode, prefix: &str, flat: &mut Vec<Written>) {
    for (key, value) in at.entries().unwrap_or_default() {
        let Some(last) = key.text() else { continue };
        let name = if prefix.is_empty() { last.to_owned() } else { format!("{prefix}.{last}") };
        let text = match &value.value {
            YamlValue::Map(_) => {
                flatten(value, &name, flat);
                continue;
            }
            YamlValue::Scalar { text, .. } => text.clone(),
            YamlValue::List(list) => items(list),
        };
        flat.push(Written { name, text, name_origin: key.span.into(), origin: value.span.into() });
    }
}

/// Returns the mappings below `ros__parameters` of a node and of all nodes.
pub(crate) fn collect<'a>(
    at: &'a YamlNode,
    node: &str,
    depth: usize,
    found: &mut Vec<&'a YamlNode>,
) {
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

/// Returns the items of a list, separated by blanks.
fn items(list: &[YamlNode]) -> String {
    let item = |item: &YamlNode| match &item.value {
        YamlValue::Scalar { text, .. } => text.clone(),
        YamlValue::List(inner) => format!("[{}]", items(inner)),
        YamlValue::Map(_) => String::new(),
    };
    list.iter().map(item).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::SourceMap;

    use super::*;

    fn check(text: &str, expected: &[(&str, &str)]) {
        let mut sources = SourceMap::new();
        let file = sources.add("params.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).ok().flatten();
        let read = tree.map(|tree| NodeParameters::of_node(&tree, "planner_server"));
        let read = read.unwrap_or_else(|| panic!("{text}"));
        let given: Vec<(&str, String)> =
            read.given().map(|one| (one.name, one.text.into_owned())).collect();
        let given: Vec<(&str, &str)> = given.iter().map(|(name, text)| (*name, &**text)).collect();
        assert_eq!(given, expected, "{text}");
    }

    #[test]
    fn sections_of_a_node_and_of_all_nodes() {
        check("amcl: {ros__parameters: {alpha1: 0.1}}", &[]);
        check(
            "/**: {ros__parameters: {use_sim_time: true, rate: 1}}\n\
             bot: {planner_server: {ros__parameters: {rate: 2, GridBased: {tolerance: 0.5}}}}",
            &[("use_sim_time", "true"), ("rate", "2"), ("GridBased.tolerance", "0.5")],
        );
        check("/bot/planner_server: {ros__parameters: {rate: 2}}", &[("rate", "2")]);
    }

    #[test]
    fn lists_are_separated_by_blanks() {
        check(
            "planner_server: {ros__parameters: {plugins: [a, b], points: [[1, 2], [3, 4]]}}",
            &[("plugins", "a b"), ("points", "[1 2] [3 4]")],
        );
    }
}
