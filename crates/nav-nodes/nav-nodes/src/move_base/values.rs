//! Private parameters of a node of ROS 1, in the tree of a file.

use periplus_diagnostics::Diagnostics;
use periplus_params::Given;
use periplus_yaml::{YamlNode, YamlValue};

use crate::node_parameters::Written;

/// Parameters by names with dots. A list of mappings with `name` and `type` is a list of names; the types are
/// separate values, `NAME.plugin`.
#[derive(Clone, Debug, Default)]
pub(super) struct PrivateParameters {
    entries: Vec<Written>,
}

impl PrivateParameters {
    pub(super) fn of_tree(tree: Option<&YamlNode>) -> Self {
        let mut read = Self::default();
        if let Some(tree) = tree {
            read.add(tree, "");
        }
        read
    }

    fn add(&mut self, at: &YamlNode, prefix: &str) {
        for (key, value) in at.entries().unwrap_or_default() {
            let Some(last) = key.text() else { continue };
            let last = last.trim_matches('/').replace('/', ".");
            let name = if prefix.is_empty() { last } else { format!("{prefix}.{last}") };
            let text = match &value.value {
                YamlValue::Map(_) => {
                    self.add(value, &name);
                    continue;
                }
                YamlValue::Scalar { text, .. } => text.clone(),
                YamlValue::List(list) => self.list(list, prefix),
            };
            let (name_origin, origin) = (key.span.into(), value.span.into());
            self.entries.push(Written { name, text, name_origin, origin });
        }
    }

    /// Text of a list; adds the types of its mappings.
    fn list(&mut self, list: &[YamlNode], prefix: &str) -> String {
        let item = |item: &YamlNode| match &item.value {
            YamlValue::Scalar { text, .. } => text.clone(),
            YamlValue::List(inner) => self.list(inner, prefix),
            YamlValue::Map(_) => {
                let text = |name: &str| item.get(name).and_then(YamlNode::text);
                let Some(name) = text("name") else { return String::new() };
                if let (Some(class), Some(node)) = (text("type"), item.get("type")) {
                    let group =
                        if prefix.is_empty() { String::new() } else { format!("{prefix}.") };
                    self.entries.push(Written {
                        name: format!("{group}{name}.plugin"),
                        text: class.to_owned(),
                        name_origin: node.span.into(),
                        origin: node.span.into(),
                    });
                }
                name.to_owned()
            }
        };
        let items: Vec<String> = list.iter().map(item).collect();
        format!("[{}]", items.join(", "))
    }

    /// Parameters of a group, by their names in it.
    pub(super) fn group(&self, group: &str) -> Self {
        let within = |entry: &Written| {
            let name = entry.name.strip_prefix(group)?.strip_prefix('.')?;
            Some(Written { name: name.to_owned(), ..entry.clone() })
        };
        Self { entries: self.entries.iter().filter_map(within).collect() }
    }

    /// Last value of a parameter.
    pub(super) fn entry(&self, name: &str) -> Option<&Written> {
        self.entries.iter().rev().find(|entry| entry.name == name)
    }

    /// Last value of a parameter, as written.
    pub(super) fn text(&self, name: &str) -> Option<&str> {
        self.entry(name).map(|entry| entry.text.trim())
    }

    /// Items of a list, or words of a text.
    pub(super) fn words(&self, name: &str) -> Vec<String> {
        let text = self.text(name).unwrap_or_default();
        let words = text.split(|letter: char| letter.is_whitespace() || "[],\"'".contains(letter));
        words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
    }

    /// Truth of a parameter; none if it is missing or no truth value.
    pub(super) fn flag(&self, name: &str) -> Option<bool> {
        match self.text(name)?.to_ascii_lowercase().as_str() {
            "true" | "1" => Some(true),
            "false" | "0" => Some(false),
            _ => None,
        }
    }

    /// Replaces a parameter by a value without another source than the old one.
    pub(super) fn set(&mut self, name: &str, text: impl Into<String>) {
        let old = self.entry(name).cloned();
        self.remove(name);
        let (name_origin, origin) =
            old.map(|old| (old.name_origin, old.origin)).unwrap_or_default();
        self.entries.push(Written {
            name: name.to_owned(),
            text: text.into(),
            name_origin,
            origin,
        });
    }

    /// Sets a parameter that is not given.
    pub(super) fn set_default(&mut self, name: &str, text: &str) {
        if self.entry(name).is_none() {
            self.set(name, text);
        }
    }

    pub(super) fn remove(&mut self, name: &str) {
        self.entries.retain(|entry| entry.name != name);
    }

    /// Copies a parameter to a name for which there is none.
    pub(super) fn copy(&mut self, from: &str, to: &str) {
        if self.entry(to).is_none()
            && let Some(entry) = self.entry(from).cloned()
        {
            self.entries.push(Written { name: to.to_owned(), ..entry });
        }
    }

    /// Moves a parameter, or a group of them.
    pub(super) fn rename(&mut self, from: &str, to: &str) {
        for entry in &mut self.entries {
            if let Some(rest) = entry.name.strip_prefix(from)
                && (rest.is_empty() || rest.starts_with('.'))
            {
                entry.name = format!("{to}{rest}");
            }
        }
    }

    /// Adds a value of another set of parameters.
    pub(super) fn push(&mut self, entry: Written) {
        self.entries.push(entry);
    }

    /// Iterates over the parameters, each name once, with its last value.
    pub(super) fn given(&self) -> impl Iterator<Item = Given<'_>> {
        let is_last = |index: usize, name: &str| {
            self.entries[index + 1..].iter().all(|later| later.name != name)
        };
        let all = self.entries.iter().enumerate();
        let last = all.filter(move |(index, entry)| is_last(*index, &entry.name));
        last.map(|(_, entry)| entry.given())
    }
}

/// Codes of findings that are right for Nav2 and wrong for ROS 1: old names, and whole numbers with a fraction.
const NAV2_ONLY: [&str; 3] = ["ros1-name", "old-name", "not-whole"];

/// Runs `read` without the findings that do not apply to ROS 1.
pub(super) fn reading<R>(
    diagnostics: &mut Diagnostics,
    read: impl FnOnce(&mut Diagnostics) -> R,
) -> R {
    let mut found = Diagnostics::new();
    let result = read(&mut found);
    for one in found.iter().filter(|one| !NAV2_ONLY.contains(&one.code)) {
        diagnostics.push(one.clone());
    }
    result
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::SourceMap;

    use super::*;

    pub(crate) fn parameters(text: &str) -> PrivateParameters {
        let mut sources = SourceMap::new();
        let file = sources.add("move_base.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).ok().flatten();
        PrivateParameters::of_tree(tree.as_ref())
    }

    fn check(text: &str, expected: &[(&str, &str)]) {
        let read = parameters(text);
        let given: Vec<(&str, String)> =
            read.given().map(|one| (one.name, one.text.into_owned())).collect();
        let given: Vec<(&str, &str)> = given.iter().map(|(name, text)| (*name, &**text)).collect();
        assert_eq!(given, expected, "{text}");
    }

    #[test]
    fn groups_slashes_and_lists() {
        check("a: {b: 1, c/d: 2}\na/b: 3", &[("a.c.d", "2"), ("a.b", "3")]);
        check("footprint: [[1, 2], [3, 4]]", &[("footprint", "[[1, 2], [3, 4]]")]);
    }

    #[test]
    fn a_list_of_names_and_types() {
        check(
            "local: {plugins: [{name: walls, type: 'costmap_2d::StaticLayer'}]}",
            &[("local.walls.plugin", "costmap_2d::StaticLayer"), ("local.plugins", "[walls]")],
        );
        let read = parameters("local: {plugins: [{name: a, type: b}, {name: c, type: d}]}");
        assert_eq!(read.group("local").words("plugins"), ["a", "c"]);
    }

    #[test]
    fn a_group_moves_as_a_whole() {
        let mut read = parameters("{scan: {topic: front}, scanner: 1}");
        read.rename("scan", "obstacle_layer.scan");
        assert_eq!(read.text("obstacle_layer.scan.topic"), Some("front"));
        assert_eq!(read.text("scanner"), Some("1"));
    }
}
