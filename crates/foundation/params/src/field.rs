//! Rust types of parameters: the types of the fields that [`params!`](crate::params) declares.

use crate::{Default, ParamType, ParamValue, ParamValues, Parameter};

/// Rust type of a field that [`params!`](crate::params) declares.
pub trait ParamField: Sized {
    /// Type of the values.
    const TYPE: ParamType;

    /// True if the field has a separate value for a parameter that is not set, so that it needs no
    /// default.
    const IS_OPTIONAL: bool = false;

    /// True if the field cannot hold negative numbers, so that the parameter needs a minimum.
    const IS_UNSIGNED: bool = false;

    /// Converts the value of a parameter; `None` if it is not set.
    ///
    /// [`ParamValues`] hold values of the declared type only, and the macro demands a default where this
    /// type needs one. `None` therefore reaches a type that is not optional only if a required parameter
    /// is missing, which [`Table::check`](crate::Table::check) reports as an error.
    fn from_param(value: Option<ParamValue>) -> Self;

    /// Converts to the value of a parameter; `None` if it is not set.
    fn to_param(&self) -> Option<ParamValue>;
}

/// Enumeration whose variants are the words of a [`ParamType::Choice`].
pub trait ParamChoice: Copy {
    /// All words, as documented.
    const WORDS: &'static [&'static str];

    /// Variant of one of [`Self::WORDS`]; the default variant for any other text.
    fn of_word(word: &str) -> Self;

    /// Word of the variant.
    fn word(self) -> &'static str;
}

impl<T: ParamChoice> ParamField for T {
    const TYPE: ParamType = ParamType::Choice(T::WORDS);

    fn from_param(value: Option<ParamValue>) -> Self {
        match value {
            Some(ParamValue::Text(word)) => T::of_word(&word),
            _ => T::of_word(""),
        }
    }

    fn to_param(&self) -> Option<ParamValue> {
        Some(ParamValue::Text(self.word().to_owned()))
    }
}

impl ParamField for bool {
    const TYPE: ParamType = ParamType::Bool;

    fn from_param(value: Option<ParamValue>) -> Self {
        matches!(value, Some(ParamValue::Bool(true)))
    }

    fn to_param(&self) -> Option<ParamValue> {
        Some(ParamValue::Bool(*self))
    }
}

impl ParamField for i64 {
    const TYPE: ParamType = ParamType::Integer;

    fn from_param(value: Option<ParamValue>) -> Self {
        match value {
            Some(ParamValue::Integer(value)) => value,
            _ => 0,
        }
    }

    fn to_param(&self) -> Option<ParamValue> {
        Some(ParamValue::Integer(*self))
    }
}

impl ParamField for usize {
    const TYPE: ParamType = ParamType::Integer;
    const IS_UNSIGNED: bool = true;

    fn from_param(value: Option<ParamValue>) -> Self {
        Self::try_from(i64::from_param(value).max(0)).unwrap_or(Self::MAX)
    }

    fn to_param(&self) -> Option<ParamValue> {
        i64::try_from(*self).unwrap_or(i64::MAX).to_param()
    }
}

impl ParamField for f64 {
    const TYPE: ParamType = ParamType::Number;

    fn from_param(value: Option<ParamValue>) -> Self {
        match value {
            Some(ParamValue::Number(value)) => value,
            Some(ParamValue::Integer(value)) => value as Self,
            _ => 0.0,
        }
    }

    fn to_param(&self) -> Option<ParamValue> {
        Some(ParamValue::Number(*self))
    }
}

impl ParamField for String {
    const TYPE: ParamType = ParamType::Text;

    fn from_param(value: Option<ParamValue>) -> Self {
        match value {
            Some(ParamValue::Text(value)) => value,
            _ => Self::new(),
        }
    }

    fn to_param(&self) -> Option<ParamValue> {
        Some(ParamValue::Text(self.clone()))
    }
}

impl ParamField for Vec<f64> {
    const TYPE: ParamType = ParamType::NumberList;
    const IS_OPTIONAL: bool = true;

    fn from_param(value: Option<ParamValue>) -> Self {
        match value {
            Some(ParamValue::Numbers(values)) => values,
            _ => Self::new(),
        }
    }

    fn to_param(&self) -> Option<ParamValue> {
        (!self.is_empty()).then(|| ParamValue::Numbers(self.clone()))
    }
}

impl ParamField for Vec<String> {
    const TYPE: ParamType = ParamType::TextList;
    const IS_OPTIONAL: bool = true;

    fn from_param(value: Option<ParamValue>) -> Self {
        match value {
            Some(ParamValue::Texts(values)) => values,
            _ => Self::new(),
        }
    }

    fn to_param(&self) -> Option<ParamValue> {
        Some(ParamValue::Texts(self.clone()))
    }
}

impl<T: ParamField> ParamField for Option<T> {
    const TYPE: ParamType = T::TYPE;
    const IS_OPTIONAL: bool = true;

    fn from_param(value: Option<ParamValue>) -> Self {
        value.map(|value| T::from_param(Some(value)))
    }

    fn to_param(&self) -> Option<ParamValue> {
        self.as_ref().and_then(T::to_param)
    }
}

/// Structure that [`params!`](crate::params) declares: one field for each parameter.
pub trait Params: Sized {
    /// Description: one or two sentences.
    const DOC: &'static str;

    /// Parameters, in the order of the table.
    const PARAMETERS: &'static [Parameter];

    /// Converts values of a table that contains these parameters.
    #[must_use]
    fn from_values(values: &ParamValues) -> Self;

    /// Sets the parameters in values of a table that contains them.
    fn write_to(&self, values: &mut ParamValues);
}

/// Declares the parameter of a field; called by [`params!`](crate::params).
///
/// # Panics
/// At compile time, if the default is not written as a value of the type.
#[doc(hidden)]
#[must_use]
pub const fn declare<T: ParamField>(
    name: &'static str,
    doc: &'static str,
    literal: &[&'static str],
) -> Parameter {
    let default = match literal {
        [literal, ..] => Default::Value(default_text(T::TYPE, literal)),
        [] => Default::None,
    };
    Parameter { default, ..crate::parameter::plain(name, T::TYPE, doc) }
}

/// Checks a declaration when it is compiled: a field needs a default unless its type is optional or the
/// parameter is required. Called by [`params!`](crate::params).
///
/// # Panics
/// At compile time, if the declaration is wrong.
#[doc(hidden)]
#[must_use]
pub const fn checked<T: ParamField>(parameter: Parameter) -> Parameter {
    assert!(
        T::IS_OPTIONAL || !matches!(parameter.default, Default::None),
        "a parameter needs a default, `required()`, or a field of type `Option`"
    );
    let has_negatives = match parameter.range {
        Some(range) => range.min < 0.0,
        None => true,
    };
    assert!(
        !T::IS_UNSIGNED || !has_negatives,
        "a parameter with an unsigned field needs a minimum of at least 0"
    );
    parameter
}

/// Default as a user would write it, from the Rust literal: text without its quotes.
const fn default_text(kind: ParamType, literal: &'static str) -> &'static str {
    let bytes = literal.as_bytes();
    let is_text = matches!(bytes, [b'"', .., b'"']);
    match kind {
        ParamType::Bool => assert!(
            matches!(bytes, b"true" | b"false"),
            "the default of a `bool` is `true` or `false`"
        ),
        ParamType::Integer | ParamType::Number => {
            assert!(
                matches!(bytes, [b'0'..=b'9' | b'-', ..]),
                "the default of a number is a number"
            );
            let mut index = 0;
            while index < bytes.len() {
                assert!(
                    bytes[index] != b'_',
                    "the default of a number is written without `_`, as in YAML"
                );
                index += 1;
            }
        }
        _ => assert!(is_text, "the default of a text, choice or list is written in quotes"),
    }
    if !is_text {
        return literal;
    }
    let (_, rest) = literal.split_at(1);
    let (text, _) = rest.split_at(rest.len() - 1);
    text
}

/// Number of parameters of all parts.
#[doc(hidden)]
#[must_use]
pub const fn count(parts: &[&[Parameter]]) -> usize {
    let mut count = 0;
    let mut part = 0;
    while part < parts.len() {
        count += parts[part].len();
        part += 1;
    }
    count
}

/// Parameters of all parts in one list of length [`count`].
#[doc(hidden)]
#[must_use]
pub const fn concat<const N: usize>(parts: &[&[Parameter]]) -> [Parameter; N] {
    let mut all = [crate::flag("", ""); N];
    let (mut part, mut at) = (0, 0);
    while part < parts.len() {
        let mut index = 0;
        while index < parts[part].len() {
            all[at] = parts[part][index];
            at += 1;
            index += 1;
        }
        part += 1;
    }
    all
}
