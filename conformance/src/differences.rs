//! Differences between expected and actual results.

use std::fmt::Display;

use serde_json::{Map, Value};

use crate::case::Case;
use crate::expected::Expected;
use crate::reader::number_named;
use crate::used::is_remark;

/// More differences of a case are only counted.
const MAX_LISTED: usize = 20;

/// Differences between expected and actual results, as text.
#[derive(Clone, Debug)]
pub struct Differences {
    listed: Vec<String>,
    count: usize,
    compared: usize,
    unknown: Vec<String>,
    tolerance: f64,
    whole_tolerance: f64,
}

impl Differences {
    /// None yet, for the tolerance of a case.
    #[must_use]
    pub fn new(case: &Case) -> Self {
        Self {
            listed: Vec::new(),
            count: 0,
            compared: 0,
            unknown: Vec::new(),
            tolerance: case.tolerance(),
            whole_tolerance: case.tolerance.unwrap_or(0.0),
        }
    }

    /// Adds one.
    pub fn push(&mut self, words: impl Into<String>) {
        self.count += 1;
        if self.listed.len() < MAX_LISTED {
            self.listed.push(words.into());
        }
    }

    /// Compares what came of a check with what is expected, part by part. All that is expected is
    /// compared: lists must be of one length, and a member that `got` does not have makes the case one
    /// that is not understood. What is only in `got` is not asked for. Whole numbers of `got` must be
    /// met exactly unless the case has a tolerance, others by the tolerance.
    pub fn compare(&mut self, what: impl Display, got: &Value, expected: &Expected<'_>) {
        self.at(&what.to_string(), expected.path(), got, expected.compared());
    }

    /// Compares with a separate tolerance, for numbers that are inexact by nature.
    pub fn compare_by(
        &mut self,
        what: impl Display,
        got: &Value,
        expected: &Expected<'_>,
        tolerance: f64,
    ) {
        let usual = std::mem::replace(&mut self.tolerance, tolerance);
        self.compare(what, got, expected);
        self.tolerance = usual;
    }

    /// Compares every member of an expected object with one of the results, which are named as cases
    /// may name them.
    pub fn compare_members(&mut self, got: &[(&[&str], Value)], expected: &Expected<'_>) {
        let mut named = Map::new();
        for (names, value) in got {
            for name in *names {
                named.insert((*name).to_owned(), value.clone());
            }
        }
        self.at("", expected.path(), &Value::Object(named), expected.compared());
    }

    /// Compares two lists whatever their order.
    pub fn compare_sets(&mut self, what: impl Display, got: Vec<Value>, expected: &Expected<'_>) {
        let sorted = |mut list: Vec<Value>| {
            list.sort_by_key(Value::to_string);
            Value::Array(list)
        };
        let wanted = match expected.compared() {
            Value::Array(list) => sorted(list.clone()),
            other => other.clone(),
        };
        self.at(&what.to_string(), expected.path(), &sorted(got), &wanted);
    }

    /// Compares how many there are with how many are expected.
    pub fn same_count(&mut self, what: impl Display, got: usize, expected: usize) {
        self.compared += 1;
        if got != expected {
            self.push(format!("{what}: {got}, expected {expected}"));
        }
    }

    /// Holds what came of a check against a condition that is stated otherwise than by a value.
    pub fn hold(
        &mut self,
        what: impl Display,
        got: impl Display,
        expected: &Expected<'_>,
        is_met: impl FnOnce(&Value) -> bool,
    ) {
        self.compared += 1;
        let stated = expected.compared();
        if !is_met(stated) {
            self.push(format!("{what}: {got}, expected {stated}"));
        }
    }

    fn at(&mut self, what: &str, path: &str, got: &Value, expected: &Value) {
        match (got, expected) {
            (Value::Object(got), Value::Object(expected)) => {
                for (name, expected) in expected.iter().filter(|(name, it)| !is_remark(name, it)) {
                    let path = format!("{path}.{name}");
                    let what =
                        if what.is_empty() { name.clone() } else { format!("{what}, {name}") };
                    match got.get(name) {
                        Some(got) => self.at(&what, &path, got, expected),
                        None => self.unknown.push(format!("`{path}` (known: {})", names(got))),
                    }
                }
            }
            (Value::Array(got), Value::Array(expected)) => {
                self.compared += 1;
                if got.len() != expected.len() {
                    let (count, wanted) = (got.len(), expected.len());
                    self.push(format!("{what}: {count} values, expected {wanted}"));
                    return;
                }
                for (at, (got, expected)) in got.iter().zip(expected).enumerate() {
                    self.at(&format!("{what}[{at}]"), &format!("{path}[{at}]"), got, expected);
                }
            }
            _ => {
                self.compared += 1;
                if !self.is_same(got, expected) {
                    self.push(format!("{what}: {got}, expected {expected}"));
                }
            }
        }
    }

    fn is_same(&self, got: &Value, expected: &Value) -> bool {
        let (Some(number), Some(wanted)) = (number_of(got), number_of(expected)) else {
            return got == expected;
        };
        let is_whole = got.is_i64() || got.is_u64();
        let tolerance = if is_whole { self.whole_tolerance } else { self.tolerance };
        // Written so that what is not a number is a difference, unless it is expected.
        let is_equal = number == wanted || number.is_nan() && wanted.is_nan();
        is_equal || (number - wanted).abs() <= tolerance
    }

    /// Notes a name that the check does not know.
    pub fn not_known(&mut self, words: impl Into<String>) {
        self.unknown.push(words.into());
    }

    /// Names that the check does not know.
    #[must_use]
    pub fn unknown(&self) -> &[String] {
        &self.unknown
    }

    /// True if nothing has been compared.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0 && self.compared == 0
    }

    /// True if something has been compared, and all of it was as expected.
    #[must_use]
    pub fn is_passed(&self) -> bool {
        self.count == 0 && self.compared > 0 && self.unknown.is_empty()
    }

    /// All of them, or as many as are listed.
    #[must_use]
    pub fn into_words(mut self) -> Vec<String> {
        let more = self.count.saturating_sub(self.listed.len());
        if more > 0 {
            self.listed.push(format!("and {more} more"));
        }
        self.listed
    }
}

fn names(got: &Map<String, Value>) -> String {
    let names: Vec<&str> = got.keys().map(String::as_str).take(30).collect();
    format!("`{}`", names.join("`, `"))
}

/// A number, also one that JSON cannot write and is written by its name.
fn number_of(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => number.as_f64(),
        Value::String(name) => number_named(name),
        _ => None,
    }
}

/// A number as a value for [`Differences::compare`], whatever it is.
#[must_use]
pub fn number(number: f64) -> Value {
    match serde_json::Number::from_f64(number) {
        Some(number) => Value::Number(number),
        None if number.is_nan() => Value::from("nan"),
        None if number > 0.0 => Value::from("inf"),
        None => Value::from("-inf"),
    }
}

/// Numbers as a value for [`Differences::compare`].
#[must_use]
pub fn numbers(all: impl IntoIterator<Item = f64>) -> Value {
    all.into_iter().map(number).collect()
}
