//! Parameters of a table with their values.

use std::collections::BTreeMap;

use periplus_diagnostics::Origin;

use crate::{Default, ParamValue, Table};

/// Value with its source location.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Located {
    pub(crate) value: ParamValue,
    pub(crate) origin: Origin,
}

/// Values of a [`Table`]: those that were given, and the defaults of the rest. A name that the table does
/// not declare is a programming error and returns the same as an unset value.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamValues {
    table: &'static Table,
    given: BTreeMap<&'static str, Vec<Located>>,
}

impl ParamValues {
    pub(crate) fn new(table: &'static Table, given: BTreeMap<&'static str, Vec<Located>>) -> Self {
        Self { table, given }
    }

    /// Returns the defaults of a table.
    #[must_use]
    pub fn defaults(table: &'static Table) -> Self {
        Self::new(table, BTreeMap::new())
    }

    /// Sets a value that fits ([`ParamValue::fit`]) and replaces all given ones. Returns false if the
    /// table does not declare the name.
    pub fn set(&mut self, name: &str, value: ParamValue) -> bool {
        let Some(parameter) = self.table.find(name) else { return false };
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
        self.given.contains_key(name)
    }

    /// Source location of its first value.
    #[must_use]
    pub fn origin(&self, name: &str) -> Origin {
        self.given.get(name).and_then(|values| values.first()).map(|v| v.origin).unwrap_or_default()
    }

    /// All values of a repeatable parameter with their source locations; the default if none was given.
    #[must_use]
    pub fn all(&self, name: &str) -> Vec<(ParamValue, Origin)> {
        match self.given.get(name) {
            Some(values) => values.iter().map(|v| (v.value.clone(), v.origin)).collect(),
            None => {
                self.default(name).map(|value| (value, Origin::default())).into_iter().collect()
            }
        }
    }

    /// Value, or the default.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<ParamValue> {
        debug_assert!(self.table.find(name).is_some(), "{} has no `{name}`", self.table.name);
        match self.given.get(name).and_then(|values| values.first()) {
            Some(located) => Some(located.value.clone()),
            None => self.default(name),
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
