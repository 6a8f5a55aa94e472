//! Scores of a run, as `periplus score` and `periplus compare` print them.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::{Value, json};

use super::OpenRun;
use super::html::{Section, escape, paragraph, table};
use crate::error::CliError;
use crate::score::{Run, RunScores, ScoreSettings, names, number, value};

pub(super) fn section(run: &OpenRun, settings: &ScoreSettings) -> Section {
    let body = match scores(run, settings) {
        Ok(scores) => {
            let mut rows = String::new();
            for score in scores.scores.iter().filter(|it| it.is_shown) {
                let _ = writeln!(
                    rows,
                    "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td></tr>",
                    escape(&score.name),
                    number(score.value)
                );
            }
            let truth = paragraph(&format!("Truth: {}.", scores.truth_source));
            format!(
                "{truth}{}",
                table("Scores; names end with their unit", &["score", "value"], &rows)
            )
        }
        Err(why) => without(&why),
    };
    Section { title: run.heading("Scores"), body }
}

pub(super) fn comparison(first: &OpenRun, second: &OpenRun, settings: &ScoreSettings) -> Section {
    let found = (scores(first, settings), scores(second, settings));
    let mut body = String::new();
    for (scores, label) in [(&found.0, "A"), (&found.1, "B")] {
        if let Err(why) = scores {
            body.push_str(&without(&format!("{label}: {why}")));
        }
    }
    // A run without a truth has no values in the table.
    let is_known = found.0.is_ok() || found.1.is_ok();
    let (a, b) = (found.0.unwrap_or_default(), found.1.unwrap_or_default());
    let mut rows = String::new();
    for name in names([&a, &b], |it| it.is_shown) {
        let (of_a, of_b) = (value(&a, &name), value(&b, &name));
        let sign = if of_b > of_a { "+" } else { "" };
        let _ = writeln!(
            rows,
            "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"number\">{}</td>\
             <td class=\"number\">{sign}{}</td></tr>",
            escape(&name),
            number(of_a),
            number(of_b),
            number(of_b - of_a)
        );
    }
    if is_known {
        let head = ["score", "A", "B", "B - A"];
        body.push_str(&table("Scores; names end with their unit", &head, &rows));
    }
    Section { title: "Scores".to_owned(), body }
}

fn without(why: &str) -> String {
    paragraph(&format!("No scores against the truth: {why}"))
}

/// Scores of a run as `periplus score --json` prints them, or the reason for which there are none.
pub(super) fn to_json(run: &Path, settings: &ScoreSettings) -> Value {
    match of(run, settings) {
        Ok(scores) => scores.to_json(),
        Err(why) => json!({
            "run": run.display().to_string(), "truth": null, "scores": null, "reason": why,
        }),
    }
}

fn scores(run: &OpenRun, settings: &ScoreSettings) -> Result<RunScores, String> {
    of(&run.path, settings)
}

fn of(run: &Path, settings: &ScoreSettings) -> Result<RunScores, String> {
    let text = |error: CliError| error.message();
    RunScores::of(&Run::read(run, settings).map_err(text)?, settings).map_err(text)
}
