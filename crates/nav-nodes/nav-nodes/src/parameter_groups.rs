//! Parameters of nodes whose components are named by other parameters, such as
//! `PolygonStop.action_type` for a component of `polygons`.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_params::{Given, ParamValues, Table};

use crate::common_parameters::is_common;

/// Given parameters by group: the name before the last dot, empty for those of the node.
pub struct ParameterGroups<'a, 'd> {
    groups: BTreeMap<String, Vec<Given<'a>>>,
    /// Findings so far.
    pub diagnostics: &'d mut Diagnostics,
}

impl<'a, 'd> ParameterGroups<'a, 'd> {
    /// Sorts parameters into groups. As in ROS 2, the last value of a name applies.
    pub fn new(
        given: impl IntoIterator<Item = Given<'a>>,
        diagnostics: &'d mut Diagnostics,
    ) -> Self {
        let mut groups: BTreeMap<String, Vec<Given<'a>>> = BTreeMap::new();
        for one in given {
            let (group, name) = one.name.rsplit_once('.').unwrap_or(("", one.name));
            let entries = groups.entry(group.to_owned()).or_default();
            entries.retain(|entry| entry.name != name);
            entries.push(Given { name, ..one });
        }
        Self { groups, diagnostics }
    }

    /// Reads the parameters of the node. Unknown ones are reported by [`Self::finish`].
    pub fn node_values(&mut self, table: &'static Table) -> ParamValues {
        let entries = self.groups.remove("").unwrap_or_default();
        let (known, rest): (Vec<_>, Vec<_>) =
            entries.into_iter().partition(|entry| table.find(entry.name).is_some());
        for entry in rest.iter().filter(|entry| !is_common(entry.name)) {
            self.diagnostics.push(table.unknown(entry));
        }
        table.check(known, None, self.diagnostics)
    }

    /// Reads the parameters of a group; `at` is the position of errors about missing ones.
    pub fn group_values(&mut self, table: &'static Table, group: &str, at: Origin) -> ParamValues {
        let entries = self.groups.remove(group).unwrap_or_default();
        table.check(entries, at.0, self.diagnostics)
    }

    /// True if a parameter of the group was given and not read yet.
    #[must_use]
    pub fn has(&self, group: &str) -> bool {
        self.groups.contains_key(group)
    }

    /// Removes a group and those in it, which a component reads by itself.
    pub fn discard(&mut self, group: &str) {
        self.groups.retain(|name, _| {
            name.strip_prefix(group).is_none_or(|rest| !rest.is_empty() && !rest.starts_with('.'))
        });
    }

    /// Reports groups that no component has read.
    pub fn finish(self) {
        for (group, entries) in &self.groups {
            let Some(entry) = entries.first() else { continue };
            if is_common(group) {
                continue;
            }
            let mut hint = Diagnostic::hint(
                "unused-group",
                format!("no component is named `{group}`; its parameters are unused"),
            );
            hint.span = entry.name_origin.0;
            self.diagnostics.push(hint.help("name it in the list of components, or remove it"));
        }
    }
}
