//! What is known of a parameter before anyone sets it.

/// What a value looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `true` or `false`.
    Bool,
    /// A whole number.
    Integer,
    /// A number.
    Number,
    /// Any text.
    Text,
    /// Numbers side by side.
    NumberList,
    /// Words side by side.
    TextList,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Parameters of its own, which the table does not describe.
    Group,
}

/// What holds when nobody sets the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Default {
    /// Somebody must set it.
    Required,
    /// It stays unset.
    None,
    /// This value, written as a user would write it.
    Value(&'static str),
}

/// The numbers that make sense, both ends included unless `above`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
    /// Whether the smallest itself is excluded.
    pub above: bool,
}

/// What the text of a parameter names, for checks that know the things themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// A joint of the model.
    Joint,
    /// A link of the model.
    Link,
    /// A coordinate frame that must exist.
    Frame,
    /// A topic.
    Topic,
}

/// One parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What its values look like.
    pub kind: Kind,
    /// The unit of its numbers.
    pub unit: Option<&'static str>,
    /// What holds when nobody sets it.
    pub default: Default,
    /// The numbers that make sense.
    pub range: Option<Range>,
    /// What it means: one or two sentences.
    pub doc: &'static str,
    /// Other spellings that are read as well.
    pub aliases: &'static [&'static str],
    /// Whether it may be set several times, each time adding a value.
    pub repeated: bool,
    /// What its text names.
    pub names: Option<Names>,
    /// The flag that makes a required parameter optional when it is true.
    pub unless: Option<&'static str>,
}

/// Parameters that belong together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table {
    /// What they belong to.
    pub name: &'static str,
    /// What that does: one or two sentences.
    pub doc: &'static str,
    /// The parameters, in the order of reading.
    pub parameters: &'static [Parameter],
}

const fn plain(name: &'static str, kind: Kind, doc: &'static str) -> Parameter {
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

/// A yes or no.
#[must_use]
pub const fn flag(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, Kind::Bool, doc)
}

/// A whole number.
#[must_use]
pub const fn integer(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, Kind::Integer, doc)
}

/// A number in a unit; an empty unit means a pure number.
#[must_use]
pub const fn number(name: &'static str, unit: &'static str, doc: &'static str) -> Parameter {
    in_unit(plain(name, Kind::Number, doc), unit)
}

/// Numbers in a unit; an empty unit means pure numbers.
#[must_use]
pub const fn numbers(name: &'static str, unit: &'static str, doc: &'static str) -> Parameter {
    in_unit(plain(name, Kind::NumberList, doc), unit)
}

const fn in_unit(parameter: Parameter, unit: &'static str) -> Parameter {
    if unit.is_empty() { parameter } else { Parameter { unit: Some(unit), ..parameter } }
}

/// A text.
#[must_use]
pub const fn text(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, Kind::Text, doc)
}

/// Words.
#[must_use]
pub const fn texts(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, Kind::TextList, doc)
}

/// One of some words.
#[must_use]
pub const fn choice(
    name: &'static str,
    words: &'static [&'static str],
    doc: &'static str,
) -> Parameter {
    plain(name, Kind::Choice(words), doc)
}

/// A group with parameters of its own.
#[must_use]
pub const fn group(name: &'static str, doc: &'static str) -> Parameter {
    plain(name, Kind::Group, doc)
}

impl Parameter {
    /// With a default, written as a user would write it.
    #[must_use]
    pub const fn or(self, default: &'static str) -> Self {
        Self { default: Default::Value(default), ..self }
    }

    /// It must be set.
    #[must_use]
    pub const fn required(self) -> Self {
        Self { default: Default::Required, ..self }
    }

    /// It need not be set when this flag is true.
    #[must_use]
    pub const fn unless(self, flag: &'static str) -> Self {
        Self { unless: Some(flag), ..self }
    }

    /// It may be set several times.
    #[must_use]
    pub const fn repeated(self) -> Self {
        Self { repeated: true, ..self }
    }

    /// With other spellings that are read as well.
    #[must_use]
    pub const fn also(self, aliases: &'static [&'static str]) -> Self {
        Self { aliases, ..self }
    }

    /// At least this.
    #[must_use]
    pub const fn min(self, min: f64) -> Self {
        Self { range: Some(Range { min, max: f64::INFINITY, above: false }), ..self }
    }

    /// More than this.
    #[must_use]
    pub const fn above(self, min: f64) -> Self {
        Self { range: Some(Range { min, max: f64::INFINITY, above: true }), ..self }
    }

    /// Between these, both included.
    #[must_use]
    pub const fn within(self, min: f64, max: f64) -> Self {
        Self { range: Some(Range { min, max, above: false }), ..self }
    }

    /// Its text names something.
    #[must_use]
    pub const fn naming(self, names: Names) -> Self {
        Self { names: Some(names), ..self }
    }

    /// Whether a spelling means this parameter.
    #[must_use]
    pub fn is_spelled(&self, written: &str) -> bool {
        self.name == written || self.aliases.contains(&written)
    }
}

impl Table {
    /// The parameter of a name or alias.
    #[must_use]
    pub fn find(&self, written: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|parameter| parameter.is_spelled(written))
    }

    /// The names, without aliases.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.parameters.iter().map(|parameter| parameter.name)
    }

    /// What is wrong with the table itself: names or aliases twice, defaults that cannot be read
    /// or lie outside their range. A test of every table asks for this to be empty.
    #[must_use]
    pub fn slips(&self) -> Vec<String> {
        let mut slips = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        for parameter in self.parameters {
            for name in std::iter::once(&parameter.name).chain(parameter.aliases) {
                if !seen.insert(*name) {
                    slips.push(format!("{}: `{name}` is declared twice", self.name));
                }
            }
            if let Default::Value(default) = parameter.default
                && let Err(reason) = crate::Value::read(parameter, default)
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

impl Range {
    /// Whether a number makes sense.
    #[must_use]
    pub fn contains(&self, number: f64) -> bool {
        let high_enough = if self.above { self.min < number } else { self.min <= number };
        high_enough && number <= self.max
    }
}

impl std::fmt::Display for Range {
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

impl std::fmt::Display for Kind {
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
