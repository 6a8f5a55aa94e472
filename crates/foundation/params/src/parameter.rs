//! Declaration of a parameter.

/// Type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParamType {
    /// `true` or `false`.
    Bool,
    /// Integer.
    Integer,
    /// Floating-point number.
    Number,
    /// Any text.
    Text,
    /// List of numbers.
    NumberList,
    /// List of words.
    TextList,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Nested parameters, which the table does not describe.
    Group,
}

/// Value of a parameter that is not set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Default {
    /// None: it must be set.
    Required,
    /// None: it stays unset.
    None,
    /// Value written as a user would write it.
    Value(&'static str),
}

/// Valid range, both ends included unless `above`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParamRange {
    /// Minimum.
    pub min: f64,
    /// Maximum.
    pub max: f64,
    /// True if the minimum itself is excluded.
    pub above: bool,
}

/// Entity whose name is the value, for checks against the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedEntity {
    /// A joint of the model.
    Joint,
    /// A link of the model.
    Link,
    /// A coordinate frame that must exist.
    Frame,
    /// A topic.
    Topic,
}

/// Declaration of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Type of its values.
    pub kind: ParamType,
    /// Unit of its numbers.
    pub unit: Option<&'static str>,
    /// Default value.
    pub default: Default,
    /// Valid range.
    pub range: Option<ParamRange>,
    /// Description: one or two sentences.
    pub doc: &'static str,
    /// Alternative names.
    pub aliases: &'static [&'static str],
    /// True if it may be set several times, each time adding a value.
    pub repeated: bool,
    /// Entity whose name is the value.
    pub names: Option<NamedEntity>,
    /// Flag that makes a required parameter optional if it is true.
    pub unless: Option<&'static str>,
}

/// Declarations of the parameters of one component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table {
    /// Name of the component.
    pub name: &'static str,
    /// Description of the component: one or two sentences.
    pub doc: &'static str,
    /// Parameters, in the order of reading.
    pub parameters: &'static [Parameter],
}

pub(crate) const fn plain(name: &'static str, kind: ParamType, doc: &'static str) -> Parameter {
    Parameter {
        name,
        kind,
        unit: None,
        default: Default::None,
        range: None,
        doc,
        aliases: &[],
        repeated: false,
        names: None,
        unless: None,
    }
}

/// Declares a boolean.
#[must_use]
pub const fn flag(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, ParamType::Bool, doc)
}

/// Declares an integer.
#[must_use]
pub const fn integer(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, ParamType::Integer, doc)
}

/// Declares a number in a unit; an empty unit is dimensionless.
#[must_use]
pub const fn number(name: &'static str, unit: &'static str, doc: &'static str) -> Parameter {
    in_unit(plain(name, ParamType::Number, doc), unit)
}

/// Declares a list of numbers in a unit; an empty unit is dimensionless.
#[must_use]
pub const fn numbers(name: &'static str, unit: &'static str, doc: &'static str) -> Parameter {
    in_unit(plain(name, ParamType::NumberList, doc), unit)
}

const fn in_unit(parameter: Parameter, unit: &'static str) -> Parameter {
    if unit.is_empty() { parameter } else { Parameter { unit: Some(unit), ..parameter } }
}

/// Declares a text.
#[must_use]
pub const fn text(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, ParamType::Text, doc)
}

/// Declares a list of words.
#[must_use]
pub const fn texts(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, ParamType::TextList, doc)
}

/// Declares a choice of words.
#[must_use]
pub const fn choice(
    name: &'static str,
    words: &'static [&'static str],
    doc: &'static str,
) -> Parameter {
    plain(name, ParamType::Choice(words), doc)
}

/// Declares a group of nested parameters.
#[must_use]
pub const fn group(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, ParamType::Group, doc)
}

impl Parameter {
    /// Sets the default, written as a user would write it.
    #[must_use]
    pub const fn or(self, default: &'static str) -> Self {
        Self { default: Default::Value(default), ..self }
    }

    /// Sets the unit of its numbers.
    #[must_use]
    pub const fn unit(self, unit: &'static str) -> Self {
        in_unit(self, unit)
    }

    /// Makes it required.
    #[must_use]
    pub const fn required(self) -> Self {
        Self { default: Default::Required, ..self }
    }

    /// Makes it optional if this flag is true.
    #[must_use]
    pub const fn unless(self, flag: &'static str) -> Self {
        Self { unless: Some(flag), ..self }
    }

    /// Allows several values.
    #[must_use]
    pub const fn repeated(self) -> Self {
        Self { repeated: true, ..self }
    }

    /// Adds alternative names.
    #[must_use]
    pub const fn also(self, aliases: &'static [&'static str]) -> Self {
        Self { aliases, ..self }
    }

    /// Sets the minimum.
    #[must_use]
    pub const fn min(self, min: f64) -> Self {
        Self { range: Some(ParamRange { min, max: f64::INFINITY, above: false }), ..self }
    }

    /// Sets the minimum, itself excluded.
    #[must_use]
    pub const fn above(self, min: f64) -> Self {
        Self { range: Some(ParamRange { min, max: f64::INFINITY, above: true }), ..self }
    }

    /// Sets minimum and maximum, both included.
    #[must_use]
    pub const fn within(self, min: f64, max: f64) -> Self {
        Self { range: Some(ParamRange { min, max, above: false }), ..self }
    }

    /// Sets the entity whose name is the value.
    #[must_use]
    pub const fn naming(self, names: NamedEntity) -> Self {
        Self { names: Some(names), ..self }
    }

    /// Returns true if a name is this parameter's name or an alternative.
    #[must_use]
    pub fn is_spelled(&self, written: &str) -> bool {
        self.name == written || self.aliases.contains(&written)
    }
}

impl Table {
    /// Parameter of a name or alternative name.
    #[must_use]
    pub fn find(&self, written: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|parameter| parameter.is_spelled(written))
    }

    /// Names, without alternatives.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.parameters.iter().map(|parameter| parameter.name)
    }

    /// Returns the faults of the table itself: duplicate names, and defaults that cannot be read or are out
    /// of range. A test of every table requires this to be empty.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let mut slips = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        for parameter in self.parameters {
            for name in std::iter::once(&parameter.name).chain(parameter.aliases) {
                if !seen.insert(*name) {
                    slips.push(format!("{}: `{name}` is declared twice", self.name));
                }
            }
            if let Default::Value(default) = parameter.default
                && let Err(reason) = crate::ParamValue::read(parameter, default)
            {
                slips.push(format!(
                    "{}: the default `{default}` of `{}` {reason}",
                    self.name, parameter.name
                ));
            }
        }
        slips
    }
}

impl ParamRange {
    /// Returns true if a number is in the range.
    #[must_use]
    pub fn contains(&self, number: f64) -> bool {
        let high_enough = if self.above { self.min < number } else { self.min <= number };
        high_enough && number <= self.max
    }
}

impl std::fmt::Display for ParamRange {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let bounded_below = self.min > f64::NEG_INFINITY;
        let bounded_above = self.max < f64::INFINITY;
        match (bounded_below, bounded_above) {
            (true, true) if self.above => write!(f, "above {}, at most {}", self.min, self.max),
            (true, true) => write!(f, "{} to {}", self.min, self.max),
            (true, false) if self.above => write!(f, "above {}", self.min),
            (true, false) => write!(f, "at least {}", self.min),
            (false, true) => write!(f, "at most {}", self.max),
            (false, false) => write!(f, "any"),
        }
    }
}

impl std::fmt::Display for ParamType {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bool => write!(f, "bool"),
            Self::Integer => write!(f, "integer"),
            Self::Number => write!(f, "number"),
            Self::Text => write!(f, "text"),
            Self::NumberList => write!(f, "numbers"),
            Self::TextList => write!(f, "words"),
            Self::Choice(words) => write!(f, "{}", words.join(" \\| ")),
            Self::Group => write!(f, "group"),
        }
    }
}
