//! Scores as text and JSON.

use std::io::{self, Write};

use serde_json::Value;

use super::scores::RunScores;

/// Prints the scores of one run.
pub(crate) fn table(out: &mut dyn Write, scores: &RunScores) -> io::Result<()> {
    let width = name_width(&[scores]);
    for score in scores.scores.iter().filter(|it| it.is_shown) {
        writeln!(out, "{:<width$}  {:>12}", score.name, number(score.value))?;
    }
    out.flush()
}

/// Prints the scores of two runs and their differences, the second minus the first.
pub(crate) fn difference_table(
    out: &mut dyn Write,
    [first, second]: [&RunScores; 2],
) -> io::Result<()> {
    let width = name_width(&[first, second]);
    writeln!(out, "{:<width$}  {:>12}  {:>12}  {:>12}", "", "A", "B", "B - A")?;
    for name in names([first, second], |it| it.is_shown) {
        let [a, b] = [value(first, &name), value(second, &name)];
        let difference = number(b - a);
        let sign = if b > a { "+" } else { "" };
        let difference = format!("{sign}{difference}");
        writeln!(out, "{name:<width$}  {:>12}  {:>12}  {difference:>12}", number(a), number(b))?;
    }
    out.flush()
}

/// Names of the scores of two runs: those of the first, then those that only the second has.
pub(crate) fn names(
    [first, second]: [&RunScores; 2],
    is_wanted: impl Fn(&super::scores::Score) -> bool,
) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for score in first.scores.iter().chain(&second.scores).filter(|it| is_wanted(it)) {
        if !names.contains(&score.name) {
            names.push(score.name.clone());
        }
    }
    names
}

/// Value of a score; NaN if the run has none.
pub(crate) fn value(scores: &RunScores, name: &str) -> f64 {
    scores.scores.iter().find(|it| it.name == name).map_or(f64::NAN, |it| it.value)
}

/// Prints JSON.
pub(crate) fn put_json(value: &Value) -> io::Result<()> {
    let mut out = anstream::stdout().lock();
    writeln!(out, "{value:#}")?;
    out.flush()
}

fn name_width(runs: &[&RunScores]) -> usize {
    let scores = runs.iter().flat_map(|it| &it.scores).filter(|it| it.is_shown);
    scores.map(|it| it.name.len()).max().unwrap_or(0)
}

/// Four significant digits are enough to compare runs; `-` for an undefined score.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if value.is_nan() {
        "-".into()
    } else if value == 0.0 || size >= 1000.0 && value == value.round() {
        format!("{value:.0}")
    } else if size >= 100.0 {
        format!("{value:.1}")
    } else if size >= 1.0 {
        format!("{value:.3}")
    } else if size >= 1e-4 {
        format!("{value:.5}")
    } else {
        format!("{value:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::super::scores::Score;
    use super::*;

    fn scores(values: &[(&str, f64)]) -> RunScores {
        let score =
            |&(name, value): &(&str, f64)| Score { name: name.into(), value, is_shown: true };
        RunScores { scores: values.iter().map(score).collect(), ..RunScores::default() }
    }

    #[test]
    fn differences_of_undefined_scores_are_undefined() {
        let (a, b) =
            (scores(&[("x_m", 1.5), ("y_m", 2.0)]), scores(&[("x_m", 1.75), ("z_m", 0.0)]));
        let mut text = Vec::new();
        difference_table(&mut text, [&a, &b]).unwrap();
        let text = String::from_utf8(text).unwrap();
        let rows: Vec<Vec<&str>> =
            text.lines().skip(1).map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(
            rows,
            [
                ["x_m", "1.500", "1.750", "+0.25000"],
                ["y_m", "2.000", "-", "-"],
                ["z_m", "-", "0", "-"]
            ]
        );
    }
}
