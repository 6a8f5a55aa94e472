//! Scores of a run, as `periplus score` and `periplus compare` print them.

use std::fmt::Write as _;

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
    let body = match (scores(first, settings), scores(second, settings)) {
        (Ok(a), Ok(b)) => {
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
            table("Scores; names end with their unit", &["score", "A", "B", "B - A"], &rows)
        }
        (a, b) => [(a, "A"), (b, "B")]
            .into_iter()
            .filter_map(|(scores, label)| Some(without(&format!("{label}: {}", scores.err()?))))
            .collect(),
    };
    Section { title: "Scores".to_owned(), body }
}

fn without(why: &str) -> String {
    paragraph(&format!("No scores against the truth: {why}"))
}

fn scores(run: &OpenRun, settings: &ScoreSettings) -> Result<RunScores, String> {
    let text = |error: CliError| error.message();
    RunScores::of(&Run::read(&run.path, settings).map_err(text)?, settings).map_err(text)
}
