//! Parameters of plugins: reading, and changes while a plugin runs.

use std::fmt;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_params::{Given, ParamError, ParamType, ParamValue, ParamValues, Table};

/// Result of a change that is accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterChange {
    /// The plugin uses the new value.
    Applied,
    /// The value is stored, and has an effect only after the plugin is configured again.
    AfterRestart,
}

/// Parameters of a controller.
#[derive(Clone, Debug)]
pub struct ParameterGroup<'a> {
    /// Group within that of the controller; empty for its own parameters.
    pub group: String,
    /// Parameters with their values.
    pub values: &'a ParamValues,
}

impl<'a> ParameterGroup<'a> {
    /// Returns the own parameters of a controller.
    #[must_use]
    pub fn own(values: &'a ParamValues) -> Self {
        Self { group: String::new(), values }
    }

    /// Returns the same parameters within another group; an empty name is for none.
    #[must_use]
    pub fn within(mut self, outer: &str) -> Self {
        self.group = match (outer, self.group.as_str()) {
            ("", inner) => inner.to_owned(),
            (outer, "") => outer.to_owned(),
            (outer, inner) => format!("{outer}.{inner}"),
        };
        self
    }

    /// Returns the names of the parameters within the group of the controller.
    pub fn names(&self) -> impl Iterator<Item = String> {
        self.values.names().map(|name| match self.group.as_str() {
            "" => name,
            group => format!("{group}.{name}"),
        })
    }
}

/// Reason for which a parameter cannot have a value.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterRefusal {
    /// The plugin has no parameter of this name.
    Unknown(String),
    /// The value has another type or is out of range.
    Unfit {
        /// Name of the parameter.
        name: String,
        /// Reason.
        error: ParamError,
    },
    /// The value is negative.
    Negative {
        /// Name of the parameter.
        name: String,
        /// The value.
        value: f64,
    },
    /// The value contradicts others; the sentence states which.
    Conflict(String),
}

impl fmt::Display for ParameterRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => write!(f, "there is no parameter `{name}`"),
            Self::Unfit { name, error } => write!(f, "`{name}`: the value {error}"),
            Self::Negative { name, value } => {
                write!(f, "`{name}` must be at least 0; {value} is refused")
            }
            Self::Conflict(reason) => f.write_str(reason),
        }
    }
}

impl std::error::Error for ParameterRefusal {}

/// Rules by which the parameters of a plugin change while it runs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChangeRules {
    /// Names that have an effect only after a restart.
    pub fixed: &'static [&'static str],
    /// Names of numbers that may be negative.
    pub signed: &'static [&'static str],
}

impl ChangeRules {
    /// Every parameter changes at once, and no number may be negative.
    pub(crate) const NON_NEGATIVE: Self = Self { fixed: &[], signed: &[] };
}

/// Sets a parameter by the rules of Nav2 main: an unknown name, another type and a negative number are refused.
pub(crate) fn change(
    values: &mut ParamValues,
    rules: ChangeRules,
    name: &str,
    value: ParamValue,
) -> Result<ParameterChange, ParameterRefusal> {
    let Some(parameter) = values.find(name) else {
        return Err(ParameterRefusal::Unknown(name.to_owned()));
    };
    let value = value
        .fit(parameter)
        .map_err(|error| ParameterRefusal::Unfit { name: name.to_owned(), error })?;
    if let ParamValue::Number(number) = value
        && number < 0.0
        && !rules.signed.contains(&parameter.name)
    {
        return Err(ParameterRefusal::Negative { name: name.to_owned(), value: number });
    }
    values.set(name, value);
    let is_fixed = rules.fixed.contains(&parameter.name) || name.contains('.');
    Ok(if is_fixed { ParameterChange::AfterRestart } else { ParameterChange::Applied })
}

/// Sets a parameter to a value of its type and range.
pub(crate) fn store(
    values: &mut ParamValues,
    name: &str,
    value: ParamValue,
) -> Result<(), ParameterRefusal> {
    let Some(parameter) = values.find(name) else {
        return Err(ParameterRefusal::Unknown(name.to_owned()));
    };
    let value = value
        .fit(parameter)
        .map_err(|error| ParameterRefusal::Unfit { name: name.to_owned(), error })?;
    values.set(name, value);
    Ok(())
}

/// Parameters of a group as written, each name without that of the group.
#[derive(Clone, Debug, Default)]
pub struct GivenParameters<'a> {
    entries: Vec<Given<'a>>,
}

impl<'a> GivenParameters<'a> {
    /// Collects parameters. As in ROS 2 the last value of a name applies.
    #[must_use]
    pub fn new(given: impl IntoIterator<Item = Given<'a>>) -> Self {
        let mut entries: Vec<Given<'a>> = Vec::new();
        for given in given {
            match entries.iter_mut().find(|entry| entry.name == given.name) {
                Some(earlier) => *earlier = given,
                None => entries.push(given),
            }
        }
        Self { entries }
    }

    /// Selects the parameters of a group, `group.name`, from those of a node.
    #[must_use]
    pub fn of_group(given: &[Given<'a>], group: &str) -> Self {
        let within = |given: &Given<'a>| {
            let name = given.name.strip_prefix(group)?.strip_prefix('.')?;
            Some(Given { name, ..given.clone() })
        };
        Self::new(given.iter().filter_map(within))
    }

    /// Returns the parameters.
    #[must_use]
    pub fn entries(&self) -> &[Given<'a>] {
        &self.entries
    }

    /// Returns the text of a parameter.
    #[must_use]
    pub fn text(&self, name: &str) -> Option<&str> {
        self.entries.iter().find(|entry| entry.name == name).map(|entry| entry.text.trim())
    }

    /// Removes and returns the parameters of a nested group.
    #[must_use]
    pub fn take_group(&mut self, group: &str) -> Self {
        let taken = Self::of_group(&self.entries, group);
        self.entries.retain(|entry| {
            entry.name.strip_prefix(group).is_none_or(|rest| !rest.starts_with('.'))
        });
        taken
    }

    /// Keeps the parameters with such names.
    pub fn retain(&mut self, keeps: impl Fn(&str) -> bool) {
        self.entries.retain(|entry| keeps(entry.name));
    }

    /// Removes and returns a parameter.
    pub fn take(&mut self, name: &str) -> Option<Given<'a>> {
        let index = self.entries.iter().position(|entry| entry.name == name)?;
        Some(self.entries.remove(index))
    }

    /// Reads the parameters by a table. Parameters of `neighbours`, which are in the same group, are no findings;
    /// `plugin` names the class.
    pub fn read(
        &self,
        table: &'static Table,
        neighbours: &[&'static Table],
        diagnostics: &mut Diagnostics,
    ) -> ParamValues {
        let is_foreign = |name: &str| {
            let is_known = |table: &&'static Table| table.find(name).is_some();
            !is_known(&table) && (name == "plugin" || neighbours.iter().any(is_known))
        };
        let own = self.entries.iter().filter(|entry| !is_foreign(entry.name));
        let own = own.map(|entry| modern(table, entry.clone(), diagnostics)).collect::<Vec<_>>();
        table.check_given(own, diagnostics)
    }
}

/// Reports old names and integers that are written with a fraction, and accepts both.
fn modern<'a>(table: &Table, given: Given<'a>, diagnostics: &mut Diagnostics) -> Given<'a> {
    if let Some(parameter) = table.find(given.name).filter(|it| it.name != given.name) {
        diagnostics.push(
            Diagnostic::hint(
                "old-name",
                format!("`{}` is an old name of `{}`", given.name, parameter.name),
            )
            .at(given.name_origin)
            .note("it is used here; ROS may ignore it")
            .replace(
                given.name_origin,
                parameter.name,
                format!("write `{}`", parameter.name),
            ),
        );
    }
    whole(table, given, diagnostics)
}

/// Rounds an integer that is written with a fraction, and reports it: Nav2 would not start.
fn whole<'a>(table: &Table, given: Given<'a>, diagnostics: &mut Diagnostics) -> Given<'a> {
    let is_integer = table.find(given.name).is_some_and(|it| it.kind == ParamType::Integer);
    let Ok(number) = given.text.trim().parse::<f64>() else { return given };
    if !is_integer || !given.text.contains(['.', 'e', 'E']) || !number.is_finite() {
        return given;
    }
    let rounded = libm::round(number);
    diagnostics.push(
        Diagnostic::warning(
            "not-whole",
            format!("`{}` is written as {}, and must be a whole number", given.name, given.text),
        )
        .at(given.origin)
        .note("Nav2 refuses to start with `parameter has invalid type`")
        .replace(given.origin, format!("{rounded}"), format!("write `{rounded}`")),
    );
    Given { text: format!("{rounded}").into(), ..given }
}

/// Changes the default of a parameter that was not given.
pub(crate) fn set_default(values: &mut ParamValues, name: &str, value: ParamValue) {
    if !values.is_given(name) {
        values.set(name, value);
    }
}
