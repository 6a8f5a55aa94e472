//! Values of a parameter on the command line: `NAME=LOW:HIGH:COUNT` or `NAME=a,b,c`.

use std::fmt;
use std::str::FromStr;

/// Maximum number of values of one parameter.
const MAX_VALUES: usize = 10_000;

/// Maximum number of runs of a sweep.
pub const MAX_RUNS: usize = 1_000_000;

/// Significant digits of a computed value, so that the third of six from 0.3 to 0.8 is 0.5 and not 0.49999999999999994.
const SIGNIFICANT_DIGITS: usize = 12;

/// A parameter with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterRange {
    name: String,
    values: RangeValues,
}

#[derive(Clone, Debug, PartialEq)]
enum RangeValues {
    /// Values, in this order.
    List(Vec<String>),
    /// Interval of which a search chooses values.
    Interval { low: f64, high: f64 },
}

/// A text that is not a range.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RangeError(String);

impl fmt::Display for RangeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for RangeError {}

impl ParameterRange {
    /// A parameter with a list of values.
    #[must_use]
    pub fn of_values(name: impl Into<String>, values: Vec<String>) -> Self {
        Self { name: name.into(), values: RangeValues::List(values) }
    }

    /// Name, as the user wrote it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Values as texts; none of an interval.
    #[must_use]
    pub fn values(&self) -> &[String] {
        match &self.values {
            RangeValues::List(values) => values,
            RangeValues::Interval { .. } => &[],
        }
    }

    /// Ends of an interval; `None` for a list of values.
    #[must_use]
    pub fn interval(&self) -> Option<[f64; 2]> {
        match self.values {
            RangeValues::Interval { low, high } => Some([low, high]),
            RangeValues::List(_) => None,
        }
    }
}

impl FromStr for ParameterRange {
    type Err = RangeError;

    fn from_str(text: &str) -> Result<Self, RangeError> {
        let usage =
            "write NAME=LOW:HIGH:COUNT, such as inflation_radius=0.3:0.8:6, or NAME=VALUE,VALUE";
        let (name, values) = text
            .split_once('=')
            .ok_or_else(|| RangeError(format!("`{text}` has no values; {usage}")))?;
        let name = name.trim();
        if name.is_empty() {
            return Err(RangeError(format!("`{text}` has no name; {usage}")));
        }
        let values = read_values(name, values)?;
        Ok(Self { name: name.to_owned(), values })
    }
}

fn read_values(name: &str, text: &str) -> Result<RangeValues, RangeError> {
    let numbers: Option<Vec<f64>> = text.split(':').map(finite).collect();
    match numbers.as_deref() {
        Some([low, high]) => {
            check_order(name, *low, *high)?;
            Ok(RangeValues::Interval { low: *low, high: *high })
        }
        Some([low, high, count]) => spaced(name, *low, *high, *count).map(RangeValues::List),
        Some([_, _, _, _, ..]) => Err(RangeError(format!(
            "`{name}={text}` has too many colons; write LOW:HIGH:COUNT, such as 0.3:0.8:6"
        ))),
        _ => list(name, text).map(RangeValues::List),
    }
}

fn finite(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|value| value.is_finite())
}

fn check_order(name: &str, low: f64, high: f64) -> Result<(), RangeError> {
    if low < high && (high - low).is_finite() {
        return Ok(());
    }
    Err(RangeError(format!(
        "`{name}`: the range from {low} to {high} is empty; the first number is the smaller one"
    )))
}

/// Evenly spaced numbers with both ends.
fn spaced(name: &str, low: f64, high: f64, count: f64) -> Result<Vec<String>, RangeError> {
    if count < 2.0 || count > MAX_VALUES as f64 || count != count.trunc() {
        return Err(RangeError(format!(
            "`{name}`: the number of values is {count}; it must be a whole number from 2 to {MAX_VALUES}"
        )));
    }
    check_order(name, low, high)?;
    let count = count as usize;
    let value = |index: usize| low + (high - low) * (index as f64 / (count - 1) as f64);
    Ok((0..count).map(|index| rounded(value(index))).collect())
}

/// Shortest text of a number that is rounded to [`SIGNIFICANT_DIGITS`].
fn rounded(value: f64) -> String {
    let text = format!("{value:.*e}", SIGNIFICANT_DIGITS - 1);
    // The text of a number is a number.
    let value = text.parse().unwrap_or(value);
    // Not `-0`.
    format!("{}", value + 0.0)
}

/// Values between commas that are outside of brackets, braces and quotes.
fn list(name: &str, text: &str) -> Result<Vec<String>, RangeError> {
    let (mut values, mut value, mut depth, mut quote) = (Vec::new(), String::new(), 0_usize, None);
    for letter in text.chars() {
        match (letter, quote) {
            (',', None) if depth == 0 => {
                values.push(std::mem::take(&mut value));
                continue;
            }
            (_, Some(open)) if letter == open => quote = None,
            ('\'' | '"', None) => quote = Some(letter),
            ('[' | '{', None) => depth += 1,
            (']' | '}', None) => depth = depth.saturating_sub(1),
            _ => {}
        }
        value.push(letter);
    }
    values.push(value);
    let values: Vec<String> = values.iter().map(|value| value.trim().to_owned()).collect();
    if values.iter().any(String::is_empty) {
        return Err(RangeError(format!(
            "`{name}={text}` has an empty value; write NAME=VALUE,VALUE"
        )));
    }
    if values.len() > MAX_VALUES {
        let count = values.len();
        return Err(RangeError(format!(
            "`{name}` has {count} values; at most {MAX_VALUES} are possible"
        )));
    }
    if let Some(twice) = values.iter().enumerate().find(|(index, it)| values[..*index].contains(it))
    {
        return Err(RangeError(format!("`{name}` has the value `{}` twice", twice.1)));
    }
    Ok(values)
}

/// All combinations of the values of several parameters; the last one changes first.
///
/// # Errors
/// More than [`MAX_RUNS`] combinations, an interval without a number of values, or a parameter that is given twice.
pub fn grid(ranges: &[ParameterRange]) -> Result<Vec<Vec<String>>, RangeError> {
    for (index, range) in ranges.iter().enumerate() {
        let name = range.name();
        if let Some([low, high]) = range.interval() {
            return Err(RangeError(format!(
                "`{name}={low}:{high}` has no number of values; write {name}={low}:{high}:6, or let `--search` choose"
            )));
        }
        if ranges[..index].iter().any(|other| other.name() == name) {
            return Err(RangeError(format!(
                "the parameter `{name}` is given twice; write all its values in one"
            )));
        }
    }
    let count =
        ranges.iter().try_fold(1_usize, |count, range| count.checked_mul(range.values().len()));
    if count.is_none_or(|count| count > MAX_RUNS) {
        return Err(RangeError(format!(
            "the grid has more than {MAX_RUNS} combinations; take fewer values"
        )));
    }
    let mut points = vec![Vec::new()];
    for range in ranges {
        let longer = points.iter().flat_map(|point: &Vec<String>| {
            range.values().iter().map(move |value| {
                let mut point = point.clone();
                point.push(value.clone());
                point
            })
        });
        points = longer.collect();
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn values(text: &str) -> Result<Vec<String>, String> {
        let range: ParameterRange = text.parse().map_err(|error: RangeError| error.to_string())?;
        Ok(range.values().to_vec())
    }

    #[test]
    fn a_range_has_both_ends() {
        assert_eq!(values("a=0.3:0.8:6").unwrap(), ["0.3", "0.4", "0.5", "0.6", "0.7", "0.8"]);
        assert_eq!(values("a=1:3:3").unwrap(), ["1", "2", "3"]);
        assert_eq!(values("a=-1:1:3").unwrap(), ["-1", "0", "1"]);
        assert_eq!(values("a=0:1e-3:2").unwrap(), ["0", "0.001"]);
    }

    #[test]
    fn a_list_is_split_outside_of_brackets_and_quotes() {
        assert_eq!(values("a=x,y").unwrap(), ["x", "y"]);
        assert_eq!(values("a= 1 ").unwrap(), ["1"]);
        assert_eq!(values("a=[1, 2],[3]").unwrap(), ["[1, 2]", "[3]"]);
        assert_eq!(values("a='x,y',z").unwrap(), ["'x,y'", "z"]);
        assert_eq!(values("a=package://b/c.sdf").unwrap(), ["package://b/c.sdf"]);
    }

    #[test]
    fn mistakes_are_explained() {
        let check = |text: &str, part: &str| {
            let message = values(text).unwrap_err();
            assert!(message.contains(part), "{text}: {message}");
        };
        check("a", "has no values");
        check("=1", "has no name");
        check("a=", "an empty value");
        check("a=1,,2", "an empty value");
        check("a=1,1", "twice");
        check("a=0:1:1", "from 2 to");
        check("a=0:1:2.5", "whole number");
        check("a=1:0:3", "is empty");
        check("a=0:1:2:3", "too many colons");
    }

    #[test]
    fn an_interval_is_for_a_search() {
        let range: ParameterRange = "a=0:1".parse().unwrap();
        assert_eq!(range.interval(), Some([0.0, 1.0]));
        assert!(grid(&[range]).unwrap_err().to_string().contains("--search"));
    }

    #[test]
    fn the_last_parameter_of_a_grid_changes_first() {
        let ranges = ["a=1,2", "b=x,y"].map(|text| text.parse().unwrap());
        assert_eq!(grid(&ranges).unwrap(), [["1", "x"], ["1", "y"], ["2", "x"], ["2", "y"]]);
        assert_eq!(grid(&[]).unwrap(), [[""; 0]]);
        let twice = ["a=1,2", "a=3"].map(|text| text.parse().unwrap());
        assert!(grid(&twice).is_err());
    }

    #[test]
    fn a_grid_that_is_too_large_is_refused() {
        let large: ParameterRange = "a=0:1:10000".parse().unwrap();
        let other = ParameterRange { name: "b".into(), ..large.clone() };
        assert!(grid(&[large, other]).unwrap_err().to_string().contains("1000000"));
    }

    proptest! {
        #[test]
        fn any_text_is_a_range_or_an_error(text in ".{0,40}") {
            let _ = text.parse::<ParameterRange>();
        }

        #[test]
        fn spaced_values_rise_from_end_to_end(low in -1e3..1e3_f64, width in 1e-3..1e3_f64, count in 2_usize..50) {
            let range: ParameterRange = format!("a={low}:{}:{count}", low + width).parse().unwrap();
            let numbers: Vec<f64> = range.values().iter().map(|it| it.parse().unwrap()).collect();
            prop_assert_eq!(numbers.len(), count);
            prop_assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]));
            prop_assert!((numbers[0] - low).abs() < 1e-8);
            prop_assert!((numbers[count - 1] - low - width).abs() < 1e-8);
        }
    }
}
