//! Values and their parsers.

use crate::{ParamError, ParamType, Parameter};

/// Value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum ParamValue {
    /// Value of [`ParamType::Bool`].
    Bool(bool),
    /// Value of [`ParamType::Integer`].
    Integer(i64),
    /// Value of [`ParamType::Number`].
    Number(f64),
    /// Value of [`ParamType::Text`] and [`ParamType::Choice`]; empty for [`ParamType::Group`].
    Text(String),
    /// Value of [`ParamType::NumberList`].
    Numbers(Vec<f64>),
    /// Value of [`ParamType::TextList`].
    Texts(Vec<String>),
}

/// Maximum length of a value that is quoted in a message [characters].
const MAX_QUOTED_CHARS: usize = 40;

impl ParamValue {
    /// Parses a value as written. Lists are separated by white space or commas, with or without brackets,
    /// so SDF and YAML have the same syntax.
    ///
    /// # Errors
    /// If the text is not a value of the parameter's type, or out of range.
    pub fn read(parameter: &Parameter, written: &str) -> Result<Self, ParamError> {
        let written = written.trim();
        let value = match parameter.kind {
            ParamType::Bool => Self::Bool(read_bool(written)?),
            ParamType::Integer => Self::Integer(read_integer(written)?),
            ParamType::Number => Self::Number(read_number(parameter, written)?),
            ParamType::Text => Self::Text(written.to_owned()),
            ParamType::Group => Self::Text(String::new()),
            ParamType::NumberList => Self::Numbers(
                items(written)
                    .map(|item| read_number(parameter, item))
                    .collect::<Result<_, _>>()?,
            ),
            ParamType::TextList => Self::Texts(items(written).map(str::to_owned).collect()),
            ParamType::Choice(words) => {
                match words.iter().find(|word| word.eq_ignore_ascii_case(written)) {
                    Some(word) => Self::Text((*word).to_owned()),
                    None => return Err(ParamError::NotAChoice(words)),
                }
            }
        };
        value.check_range(parameter)?;
        Ok(value)
    }

    /// Converts a typed value, as received over a network, to the type of the parameter and checks its
    /// range. An integer is accepted as a number.
    ///
    /// # Errors
    /// The rest of the sentence "the value ...", as [`ParamValue::read`].
    pub fn fit(self, parameter: &Parameter) -> Result<Self, ParamError> {
        let value = match (parameter.kind, self) {
            (ParamType::Number, Self::Integer(integer)) => Self::Number(integer as f64),
            (ParamType::Choice(_), Self::Text(text)) => Self::read(parameter, &text)?,
            (ParamType::Number | ParamType::NumberList, Self::Number(number))
                if number.is_nan() =>
            {
                return Err(ParamError::NotNumber(None));
            }
            (ParamType::NumberList, Self::Numbers(list)) if list.iter().any(|n| n.is_nan()) => {
                return Err(ParamError::NanInList);
            }
            (ParamType::Bool, value @ Self::Bool(_))
            | (ParamType::Integer, value @ Self::Integer(_))
            | (ParamType::Number, value @ Self::Number(_))
            | (ParamType::Text, value @ Self::Text(_))
            | (ParamType::NumberList, value @ Self::Numbers(_))
            | (ParamType::TextList, value @ Self::Texts(_)) => value,
            (kind, value) => {
                return Err(ParamError::WrongType { value, expected: kind });
            }
        };
        value.check_range(parameter)?;
        Ok(value)
    }

    fn check_range(&self, parameter: &Parameter) -> Result<(), ParamError> {
        let numbers = match self {
            Self::Integer(integer) => vec![*integer as f64],
            Self::Number(number) => vec![*number],
            Self::Numbers(numbers) => numbers.clone(),
            _ => Vec::new(),
        };
        if let Some(range) = parameter.range
            && let Some(number) = numbers.iter().find(|number| !range.contains(**number))
        {
            return Err(ParamError::OutOfRange { number: *number, unit: parameter.unit, range });
        }
        Ok(())
    }
}

fn read_bool(written: &str) -> Result<bool, ParamError> {
    match written.to_ascii_lowercase().as_str() {
        "true" | "1" => Ok(true),
        "false" | "0" => Ok(false),
        "" => Err(ParamError::Empty("`true` or `false`")),
        _ => Err(ParamError::NotBool),
    }
}

fn read_integer(written: &str) -> Result<i64, ParamError> {
    if let Ok(integer) = written.parse() {
        return Ok(integer);
    }
    match written.parse::<f64>() {
        // Up to 2^53 every integer is exact.
        Ok(number) if number.fract() == 0.0 && number.abs() <= 9_007_199_254_740_992.0 =>
        {
            #[expect(clippy::cast_possible_truncation, reason = "it is whole and small")]
            Ok(number as i64)
        }
        _ if written.is_empty() => Err(ParamError::Empty("a whole number")),
        _ => Err(ParamError::NotInteger),
    }
}

fn read_number(parameter: &Parameter, written: &str) -> Result<f64, ParamError> {
    if let Ok(number) = written.parse::<f64>()
        && !number.is_nan()
    {
        return Ok(number);
    }
    if written.is_empty() {
        return Err(ParamError::Empty("a number"));
    }
    let digits = written.trim_end_matches(|c: char| c.is_alphabetic() || "/°%².³".contains(c));
    match (digits.trim().parse::<f64>(), parameter.unit) {
        (Ok(_), Some(unit)) if digits.len() < written.len() => {
            Err(ParamError::NotNumber(Some(unit)))
        }
        _ => Err(ParamError::NotNumber(None)),
    }
}

fn items(written: &str) -> impl Iterator<Item = &str> {
    written
        .trim_matches(['[', ']'])
        .split(|c: char| c.is_whitespace() || c == ',')
        .filter(|item| !item.is_empty())
        .map(|item| item.trim_matches(['"', '\'']))
}

pub(crate) fn quoted_list(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    quoted.join(", ")
}

/// Shortens a written value for a message.
pub(crate) fn quote(written: &str) -> String {
    let written = written.trim();
    if written.chars().count() <= MAX_QUOTED_CHARS {
        return format!("`{written}`");
    }
    let start: String = written.chars().take(MAX_QUOTED_CHARS).collect();
    format!("`{start}...`")
}

impl std::fmt::Display for ParamValue {
    /// YAML form.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bool(value) => write!(f, "{value}"),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Number(value) => write!(f, "{}", yaml_number(*value)),
            Self::Text(value) => write!(f, "{}", yaml_text(value)),
            Self::Numbers(values) => {
                let items: Vec<String> = values.iter().map(|value| yaml_number(*value)).collect();
                write!(f, "[{}]", items.join(", "))
            }
            Self::Texts(values) => {
                let items: Vec<String> = values.iter().map(|value| yaml_text(value)).collect();
                write!(f, "[{}]", items.join(", "))
            }
        }
    }
}

fn yaml_number(number: f64) -> String {
    if number == f64::INFINITY {
        return ".inf".into();
    }
    if number == f64::NEG_INFINITY {
        return "-.inf".into();
    }
    // `{:?}` keeps a decimal point or exponent, so that it stays a float in YAML.
    format!("{number:?}")
}

fn yaml_text(text: &str) -> String {
    let plain = !text.is_empty()
        && text.chars().all(|c| c.is_ascii_alphanumeric() || "_/-.".contains(c))
        && text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '/' || c == '_')
        && !["true", "false", "null", "yes", "no", "on", "off"]
            .contains(&text.to_ascii_lowercase().as_str());
    if plain { text.to_owned() } else { format!("\"{}\"", text.escape_default()) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::{choice, flag, integer, number, numbers, text, texts};

    proptest! {
        #[test]
        fn any_text_gives_a_value_or_a_reason(written: String) {
            for parameter in [
                flag("p", ""),
                integer("p", "").within(0.0, 5.0),
                number("p", "m", "").above(0.0),
                text("p", ""),
                numbers("p", "m", ""),
                texts("p", ""),
                choice("p", &["a", "b"], ""),
            ] {
                if let Err(reason) = ParamValue::read(&parameter, &written) {
                    prop_assert!(reason.to_string().starts_with("is "), "{reason}");
                }
            }
        }

        #[test]
        fn numbers_come_back_bit_for_bit(number in prop::num::f64::NORMAL) {
            let written = ParamValue::Number(number).to_string();
            let parameter = crate::number("p", "m", "");
            prop_assert_eq!(ParamValue::read(&parameter, &written), Ok(ParamValue::Number(number)));
        }

        #[test]
        fn lists_come_back(list in prop::collection::vec(-1e9..1e9f64, 0..5)) {
            let written = ParamValue::Numbers(list.clone()).to_string();
            let parameter = numbers("p", "m", "");
            prop_assert_eq!(ParamValue::read(&parameter, &written), Ok(ParamValue::Numbers(list)));
        }
    }

    #[test]
    fn numbers_are_read_or_the_reason_is_said() {
        let length = number("length", "m", "").above(0.0);
        assert_eq!(ParamValue::read(&length, " 1e-1 "), Ok(ParamValue::Number(0.1)));
        let reason = |written| ParamValue::read(&length, written).unwrap_err().to_string();
        assert_eq!(reason("0.3m"), "is not a number; write it in m, without the unit");
        assert_eq!(reason("wide"), "is not a number");
        assert_eq!(reason("nan"), "is not a number");
        assert_eq!(reason(""), "is empty; write a number");
        assert_eq!(reason("0"), "is out of range: 0 m must be above 0");
    }

    #[test]
    fn values_from_a_wire_must_fit() {
        let length = number("length", "m", "").above(0.0);
        assert_eq!(ParamValue::Integer(2).fit(&length), Ok(ParamValue::Number(2.0)));
        let reason = |value: ParamValue| value.fit(&length).unwrap_err().to_string();
        assert_eq!(reason(ParamValue::Number(0.0)), "is out of range: 0 m must be above 0");
        assert_eq!(reason(ParamValue::Number(f64::NAN)), "is not a number");
        assert_eq!(reason(ParamValue::Bool(true)), "is of another kind: true where number belongs");
        let side = choice("side", &["left", "right"], "");
        assert_eq!(ParamValue::Text("Left".into()).fit(&side), Ok(ParamValue::Text("left".into())));
        assert!(ParamValue::Text("up".into()).fit(&side).is_err());
    }

    #[test]
    fn other_kinds() {
        assert_eq!(ParamValue::read(&flag("f", ""), "True"), Ok(ParamValue::Bool(true)));
        assert_eq!(ParamValue::read(&flag("f", ""), "0"), Ok(ParamValue::Bool(false)));
        assert!(ParamValue::read(&flag("f", ""), "yes").is_err());
        assert_eq!(ParamValue::read(&integer("i", ""), "2.0"), Ok(ParamValue::Integer(2)));
        assert!(ParamValue::read(&integer("i", ""), "2.5").is_err());
        assert!(ParamValue::read(&integer("i", ""), "1e300").is_err());
        let list = ParamValue::Numbers(vec![1.0, 2.0]);
        assert_eq!(ParamValue::read(&numbers("n", "", ""), "1 2"), Ok(list.clone()));
        assert_eq!(ParamValue::read(&numbers("n", "", ""), "[1, 2]"), Ok(list));
        let words = ParamValue::Texts(vec!["a".into(), "b".into()]);
        assert_eq!(ParamValue::read(&texts("t", ""), "[\"a\", b]"), Ok(words));
        let side = choice("side", &["left", "right"], "");
        assert_eq!(ParamValue::read(&side, "Left"), Ok(ParamValue::Text("left".into())));
        let refused = ParamValue::read(&side, "up").unwrap_err();
        assert_eq!(refused.to_string(), "is none of `left`, `right`");
    }
}
