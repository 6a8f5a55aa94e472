//! Table of a sweep: a row for each job, in the order of the plan.

use std::collections::BTreeMap;

use crate::job::JobFailure;
use crate::plan::SweepPlan;
use crate::result::JobResult;

/// Values of a column, one for each row; `None` where there is none.
#[derive(Clone, Debug, PartialEq)]
pub enum ColumnValues {
    /// True or false.
    Bool(Vec<Option<bool>>),
    /// Whole numbers.
    Int(Vec<Option<i64>>),
    /// Numbers.
    Double(Vec<Option<f64>>),
    /// Texts.
    Text(Vec<Option<String>>),
}

impl ColumnValues {
    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Bool(values) => values.len(),
            Self::Int(values) => values.len(),
            Self::Double(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Returns true without rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Values as numbers: true is 1; `None` for a text.
    #[must_use]
    pub fn numbers(&self) -> Vec<Option<f64>> {
        match self {
            Self::Bool(values) => {
                values.iter().map(|it| it.map(|it| f64::from(u8::from(it)))).collect()
            }
            Self::Int(values) => values.iter().map(|it| it.map(|it| it as f64)).collect(),
            Self::Double(values) => values.clone(),
            Self::Text(values) => vec![None; values.len()],
        }
    }
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name, with the unit at its end.
    pub name: String,
    /// Values.
    pub values: ColumnValues,
    /// True for a score, an assertion or `passed`: a result that can be compared between points.
    pub is_metric: bool,
}

/// Table of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepTable {
    /// Columns: run, swept parameters, seed, passed, outcome, failure, simulated time, scores, assertions, digest, key.
    pub columns: Vec<Column>,
    /// Number of rows.
    pub row_count: usize,
}

impl SweepTable {
    /// Table of the results of all jobs. A job without a result has the outcome `not run: REASON`. Columns and rows depend
    /// on the plan and the results only.
    #[must_use]
    pub fn assemble(plan: &SweepPlan, results: &[Result<JobResult, JobFailure>]) -> Self {
        let mut table = Self { columns: Vec::new(), row_count: plan.jobs.len() };
        let done = |index: usize| results.get(index).and_then(|it| it.as_ref().ok());
        let rows = 0..plan.jobs.len();
        table.push(
            "run",
            false,
            ColumnValues::Int(rows.clone().map(|row| i64::try_from(row).ok()).collect()),
        );
        for (place, name) in plan.names.iter().enumerate() {
            let texts: Vec<&str> = plan.jobs.iter().map(|job| job.values[place].as_str()).collect();
            table.push(name, false, typed(&texts));
        }
        let seeds = plan.jobs.iter().map(|job| i64::try_from(job.seed).ok());
        table.push("seed", false, ColumnValues::Int(seeds.collect()));
        let passed = rows.clone().map(|row| Some(done(row).is_some_and(|it| it.passed)));
        table.push("passed", true, ColumnValues::Bool(passed.collect()));
        let outcome = rows.clone().map(|row| match results.get(row) {
            Some(Ok(result)) => Some(result.outcome.clone()),
            Some(Err(reason)) => Some(format!("not run: {reason}")),
            None => Some("not run".to_owned()),
        });
        table.push("outcome", false, ColumnValues::Text(outcome.collect()));
        let failure = rows.clone().map(|row| {
            let failures = &done(row)?.failures;
            (!failures.is_empty()).then(|| failures.join("; "))
        });
        table.push("failure", false, ColumnValues::Text(failure.collect()));
        let duration = rows.clone().map(|row| Some(done(row)?.duration_s));
        table.push("duration_s", true, ColumnValues::Double(duration.collect()));
        let all: Vec<Option<&JobResult>> = rows.map(done).collect();
        table.push_scores(&all);
        table.push_assertions(&all);
        let digest = all.iter().map(|it| it.map(|it| it.digest.clone()));
        table.push("digest", false, ColumnValues::Text(digest.collect()));
        let keys = plan.jobs.iter().map(|job| Some(job.key.clone()));
        table.push("key", false, ColumnValues::Text(keys.collect()));
        table
    }

    /// Adds a column; a name that is taken gets a number.
    fn push(&mut self, name: &str, is_metric: bool, values: ColumnValues) {
        let is_taken = |name: &str| self.columns.iter().any(|column| column.name == name);
        let mut name = name.to_owned();
        let mut number = 2;
        while is_taken(&name) {
            name = format!("{}_{number}", name.trim_end_matches(&format!("_{}", number - 1)));
            number += 1;
        }
        self.columns.push(Column { name, values, is_metric });
    }

    fn push_scores(&mut self, results: &[Option<&JobResult>]) {
        // In the order of the first run that has them.
        let mut names: Vec<&str> = Vec::new();
        for (name, _) in results.iter().flatten().flat_map(|result| &result.scores) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        for wanted in names {
            let value = |result: &Option<&JobResult>| {
                result
                    .and_then(|it| it.scores.iter().find(|(name, _)| name == wanted).map(|it| it.1))
            };
            self.push(wanted, true, ColumnValues::Double(results.iter().map(value).collect()));
        }
    }

    /// Adds two columns for each assertion: `assertN_WORD_UNIT` with the measured value, and `assertN_WORD_passed`.
    fn push_assertions(&mut self, results: &[Option<&JobResult>]) {
        let count = results.iter().flatten().map(|it| it.assertions.len()).max().unwrap_or(0);
        for place in 0..count {
            let of = |result: &Option<&JobResult>| {
                result.and_then(|it| it.assertions.get(place)).cloned()
            };
            let all: Vec<_> = results.iter().map(of).collect();
            let word = all.iter().flatten().map(|it| it.word.as_str()).next().unwrap_or_default();
            let unit =
                all.iter().flatten().map(|it| it.unit.as_str()).find(|unit| !unit.is_empty());
            let unit = unit.map(|unit| format!("_{}", unit_suffix(unit))).unwrap_or_default();
            let number = place + 1;
            let measured: Vec<Option<f64>> = all.iter().map(|it| it.as_ref()?.measured).collect();
            if measured.iter().any(Option::is_some) {
                let name = format!("assert{number}_{word}{unit}");
                self.push(&name, true, ColumnValues::Double(measured));
            }
            let passed = all.iter().map(|it| Some(it.as_ref()?.passed));
            let name = format!("assert{number}_{word}_passed");
            self.push(&name, true, ColumnValues::Bool(passed.collect()));
        }
    }

    /// Column by name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }
}

/// Unit as the end of a name: `m/s` is `m_s`, and `Hz` is `hz`.
fn unit_suffix(unit: &str) -> String {
    let letter = |it: char| if it.is_alphanumeric() { it.to_ascii_lowercase() } else { '_' };
    unit.chars().map(letter).collect()
}

/// Values of a parameter: whole numbers, numbers, true or false if all of them are, otherwise texts.
fn typed(texts: &[&str]) -> ColumnValues {
    fn all<T: std::str::FromStr>(texts: &[&str]) -> Option<Vec<Option<T>>> {
        let mut known = BTreeMap::new();
        for text in texts {
            if !known.contains_key(text) {
                known.insert(*text, ());
                text.parse::<T>().ok()?;
            }
        }
        Some(texts.iter().map(|text| text.parse().ok()).collect())
    }
    if let Some(values) = all::<i64>(texts) {
        return ColumnValues::Int(values);
    }
    if let Some(values) = all::<f64>(texts)
        && values.iter().flatten().all(|it: &f64| it.is_finite())
    {
        return ColumnValues::Double(values);
    }
    match all::<bool>(texts) {
        Some(values) => ColumnValues::Bool(values),
        None => ColumnValues::Text(texts.iter().map(|text| Some((*text).to_owned())).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_have_the_narrowest_type() {
        assert_eq!(typed(&["1", "2"]), ColumnValues::Int(vec![Some(1), Some(2)]));
        assert_eq!(typed(&["1", "2.5"]), ColumnValues::Double(vec![Some(1.0), Some(2.5)]));
        assert_eq!(typed(&["true"]), ColumnValues::Bool(vec![Some(true)]));
        assert_eq!(
            typed(&["true", "1"]),
            ColumnValues::Text(vec![Some("true".into()), Some("1".into())])
        );
        assert_eq!(typed(&["inf"]), ColumnValues::Text(vec![Some("inf".into())]));
    }

    #[test]
    fn a_unit_ends_a_name() {
        assert_eq!([unit_suffix("m/s"), unit_suffix("Hz")], ["m_s", "hz"]);
    }

    #[test]
    fn a_taken_name_gets_a_number() {
        let mut table = SweepTable { columns: Vec::new(), row_count: 0 };
        for _ in 0..3 {
            table.push("seed", false, ColumnValues::Int(Vec::new()));
        }
        let names: Vec<&str> = table.columns.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["seed", "seed_2", "seed_3"]);
    }
}
