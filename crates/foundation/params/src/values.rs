//! Parameters of a table with their values.

use std::collections::BTreeMap;

use periplus_diagnostics::Origin;

use crate::{Default, ParamType, ParamValue, Parameter, Table};

/// Value with its source location.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Located {
    pub(crate) value: ParamValue,
    pub(crate) origin: Origin,
}

/// Values of a [`Table`]: those that were given, and the defaults of the rest. A name that the table does
/// not declare is a programming error and returns the same as an unset value.
///
/// Groups ([`ParamValues::add_group`]) are the values of nested components. The name of a parameter in a
/// group is that of the group, a dot, and its own, as in `obstacle_layer.scan.topic`.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamValues {
    table: &'static Table,
    given: BTreeMap<&'static str, Vec<Located>>,
    groups: BTreeMap<String, ParamValues>,
}

impl ParamValues {
    pub(crate) fn new(table: &'static Table, given: BTreeMap<&'static str, Vec<Located>>) -> Self {
        Self { table, given, groups: BTreeMap::new() }
    }

    /// Returns the defaults of a table.
    #[must_use]
    pub fn defaults(table: &'static Table) -> Self {
        Self::new(table, BTreeMap::new())
    }

    /// Adds the values of a nested component, or replaces those of that name.
    pub fn add_group(&mut self, name: impl Into<String>, values: Self) {
        self.groups.insert(name.into(), values);
    }

    /// Values of a nested component; an empty name is for these values themselves.
    #[must_use]
    pub fn group(&self, name: &str) -> Option<&Self> {
        if name.is_empty() { Some(self) } else { self.groups.get(name) }
    }

    /// Declaration of a parameter by its name, in the table or in a group. Parameters of groups have no
    /// alternative names.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&'static Parameter> {
        let (owner, name) = self.owner(name);
        owner.table.find(name)
    }

    /// Names of all parameters, with those of the groups; without nested parameters that no table
    /// describes ([`ParamType::Group`]).
    pub fn names(&self) -> impl Iterator<Item = String> {
        let own = std::iter::once((None, self.table));
        let groups = self.groups.iter().map(|(group, values)| (Some(group.as_str()), values.table));
        own.chain(groups).flat_map(|(group, table)| {
            let parameters = table.parameters.iter().filter(|it| it.kind != ParamType::Group);
            parameters.map(move |parameter| match group {
                Some(group) => format!("{group}.{}", parameter.name),
                None => parameter.name.to_owned(),
            })
        })
    }

    /// Group with a parameter, and its name there.
    fn group_of<'a>(&self, name: &'a str) -> Option<(&str, &'a str)> {
        self.groups.iter().find_map(|(group, values)| {
            let rest = name.strip_prefix(group.as_str())?.strip_prefix('.')?;
            values.table.names().any(|name| name == rest).then_some((group.as_str(), rest))
        })
    }

    /// Values that contain a parameter, and its name there, not an alternative.
    fn owner<'a>(&self, name: &'a str) -> (&Self, &'a str) {
        if let Some(parameter) = self.table.find(name) {
            return (self, parameter.name);
        }
        let found = self.group_of(name);
        found
            .and_then(|(group, rest)| Some((self.groups.get(group)?, rest)))
            .unwrap_or((self, name))
    }

    /// Sets a value that fits ([`ParamValue::fit`]) and replaces all given ones. Returns false if no
    /// table declares the name.
    pub fn set(&mut self, name: &str, value: ParamValue) -> bool {
        let Some(parameter) = self.table.find(name) else {
            let group = self.group_of(name).map(|(group, rest)| (group.to_owned(), rest));
            let owner = group.and_then(|(group, rest)| Some((self.groups.get_mut(&group)?, rest)));
            return owner.is_some_and(|(owner, name)| owner.set(name, value));
        };
        let located = Located { value, origin: Origin::default() };
        self.given.insert(parameter.name, vec![located]);
        true
    }

    /// Table of the values.
    #[must_use]
    pub fn table(&self) -> &'static Table {
        self.table
    }

    /// Returns true if a readable value was given.
    #[must_use]
    pub fn is_given(&self, name: &str) -> bool {
        let (owner, name) = self.owner(name);
        owner.given.contains_key(name)
    }

    /// Source location of its first value.
    #[must_use]
    pub fn origin(&self, name: &str) -> Origin {
        let (owner, name) = self.owner(name);
        let first = owner.given.get(name).and_then(|values| values.first());
        first.map(|first| first.origin).unwrap_or_default()
    }

    /// All values of a repeatable parameter with their source locations; the default if none was given.
    #[must_use]
    pub fn all(&self, name: &str) -> Vec<(ParamValue, Origin)> {
        let (owner, name) = self.owner(name);
        match owner.given.get(name) {
            Some(values) => values.iter().map(|v| (v.value.clone(), v.origin)).collect(),
            None => {
                owner.default(name).map(|value| (value, Origin::default())).into_iter().collect()
            }
        }
    }

    /// Value, or the default.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<ParamValue> {
        let (owner, name) = self.owner(name);
        debug_assert!(owner.table.find(name).is_some(), "{} has no `{name}`", owner.table.name);
        match owner.given.get(name).and_then(|values| values.first()) {
            Some(located) => Some(located.value.clone()),
            None => owner.default(name),
        }
    }

    fn default(&self, name: &str) -> Option<ParamValue> {
        let parameter = self.table.find(name)?;
        match parameter.default {
            Default::Value(default) => ParamValue::read(parameter, default).ok(),
            Default::Required | Default::None => None,
        }
    }

    /// Value of a boolean.
    #[must_use]
    pub fn flag(&self, name: &str) -> Option<bool> {
        match self.get(name)? {
            ParamValue::Bool(value) => Some(value),
            _ => None,
        }
    }

    /// Value of an integer.
    #[must_use]
    pub fn integer(&self, name: &str) -> Option<i64> {
        match self.get(name)? {
            ParamValue::Integer(value) => Some(value),
            _ => None,
        }
    }

    /// Value of a number, in the unit of its table.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            ParamValue::Number(value) => Some(value),
            ParamValue::Integer(value) => Some(value as f64),
            _ => None,
        }
    }

    /// Value of a text or choice.
    #[must_use]
    pub fn text(&self, name: &str) -> Option<String> {
        match self.get(name)? {
            ParamValue::Text(value) => Some(value),
            _ => None,
        }
    }

    /// All numbers of a list or of a repeated number, in the unit of its table.
    #[must_use]
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        let mut numbers = Vec::new();
        for (value, _) in self.all(name) {
            match value {
                ParamValue::Number(value) => numbers.push(value),
                ParamValue::Integer(value) => numbers.push(value as f64),
                ParamValue::Numbers(values) => numbers.extend(values),
                _ => {}
            }
        }
        numbers
    }

    /// All words of a list or of a repeated text.
    #[must_use]
    pub fn texts(&self, name: &str) -> Vec<String> {
        let mut texts = Vec::new();
        for (value, _) in self.all(name) {
            match value {
                ParamValue::Text(value) => texts.push(value),
                ParamValue::Texts(values) => texts.extend(values),
                _ => {}
            }
        }
        texts
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Diagnostics;

    use super::*;
    use crate::{Given, flag, number, text};

    static COSTMAP: Table = Table {
        name: "costmap",
        doc: "Layers.",
        parameters: &[number("resolution", "m", "Size of a cell.").or("0.05")],
    };
    static LAYER: Table = Table {
        name: "layer",
        doc: "A layer.",
        parameters: &[
            flag("enabled", "Enables it.").or("true").also(&["on"]),
            text("topic", "Topic."),
        ],
    };

    #[test]
    fn parameters_of_groups_are_named_with_the_group() {
        let mut values = ParamValues::defaults(&COSTMAP);
        let given = [Given::new("topic", "scan")];
        values.add_group("obstacles", LAYER.check(given, None, &mut Diagnostics::new()));
        values.add_group("obstacles.inner", ParamValues::defaults(&LAYER));
        let names: Vec<String> = values.names().collect();
        assert_eq!(
            names,
            [
                "resolution",
                "obstacles.enabled",
                "obstacles.topic",
                "obstacles.inner.enabled",
                "obstacles.inner.topic"
            ]
        );
        assert_eq!(values.text("obstacles.topic").as_deref(), Some("scan"));
        assert!(values.is_given("obstacles.topic") && !values.is_given("obstacles.inner.topic"));
        assert_eq!(values.flag("obstacles.inner.enabled"), Some(true));
        assert!(values.set("obstacles.inner.enabled", ParamValue::Bool(false)));
        assert_eq!(values.flag("obstacles.inner.enabled"), Some(false));
        assert_eq!(values.flag("obstacles.enabled"), Some(true));
        let group = values.group("obstacles.inner").and_then(|group| group.flag("enabled"));
        assert_eq!(group, Some(false));
        for unknown in ["obstacles.on", "obstacles", "obstacles.radius", "other.topic"] {
            assert!(values.find(unknown).is_none(), "{unknown}");
            assert!(!values.set(unknown, ParamValue::Bool(true)), "{unknown}");
        }
    }
}
