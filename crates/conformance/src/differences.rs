//! What is not as expected.

use std::fmt::{Debug, Display};

use crate::case::Case;

/// More differences of a case are only counted.
const MOST_TOLD: usize = 20;

/// What is not as expected, in words.
#[derive(Clone, Debug)]
pub struct Differences {
    told: Vec<String>,
    count: usize,
    checked: usize,
    tolerance: f64,
    whole_tolerance: f64,
}

impl Differences {
    /// None yet, for the tolerance of a case.
    #[must_use]
    pub fn new(case: &Case) -> Self {
        Self {
            told: Vec::new(),
            count: 0,
            checked: 0,
            tolerance: case.tolerance(),
            whole_tolerance: case.tolerance.unwrap_or(0.0),
        }
    }

    /// Tells one.
    pub fn push(&mut self, words: impl Into<String>) {
        self.checked += 1;
        self.count += 1;
        if self.told.len() < MOST_TOLD {
            self.told.push(words.into());
        }
    }

    /// Two things that must be the same.
    pub fn same<T: PartialEq + Debug + ?Sized>(
        &mut self,
        what: impl Display,
        got: &T,
        expected: &T,
    ) {
        self.checked += 1;
        if got != expected {
            self.checked -= 1;
            self.push(format!("{what}: {got:?}, expected {expected:?}"));
        }
    }

    /// Two whole numbers, which may differ only where the case says by how much.
    pub fn whole(&mut self, what: impl Display, got: i64, expected: i64) {
        self.checked += 1;
        if got.abs_diff(expected) as f64 > self.whole_tolerance {
            self.checked -= 1;
            self.push(format!("{what}: {got}, expected {expected}"));
        }
    }

    /// Two numbers, which may differ by the tolerance of the case. What is no number equals its like.
    pub fn near(&mut self, what: impl Display, got: f64, expected: f64) {
        self.near_by(what, got, expected, self.tolerance);
    }

    /// Two numbers, which may differ by so much.
    pub fn near_by(&mut self, what: impl Display, got: f64, expected: f64, tolerance: f64) {
        self.checked += 1;
        let is_same = got == expected || got.is_nan() && expected.is_nan();
        // Written so that what is no number is a difference.
        if !(is_same || (got - expected).abs() <= tolerance) {
            self.checked -= 1;
            self.push(format!("{what}: {got}, expected {expected}"));
        }
    }

    /// Two lists of numbers.
    pub fn all_near(&mut self, what: impl Display, got: &[f64], expected: &[f64]) {
        if got.len() != expected.len() {
            self.push(format!("{what}: {} values, expected {}", got.len(), expected.len()));
            return;
        }
        for (at, (got, expected)) in got.iter().zip(expected).enumerate() {
            self.near(format_args!("{what}[{at}]"), *got, *expected);
        }
    }

    /// Whether there are none, and anything was compared at all.
    #[must_use]
    pub fn is_passed(&self) -> bool {
        self.count == 0 && self.checked > 0
    }

    /// All of them, or as many as are told.
    #[must_use]
    pub fn into_words(mut self) -> Vec<String> {
        if self.count == 0 && self.checked == 0 {
            self.told.push("nothing was compared: the check found nothing in the case".into());
        }
        let more = self.count.saturating_sub(self.told.len());
        if more > 0 {
            self.told.push(format!("and {more} more"));
        }
        self.told
    }
}
