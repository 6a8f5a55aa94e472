//! What is said to the interpreter of launch files in Python, and what it asks. One line of JSON each way:
//! `{"ask": "load" | "call" | "for_each" | "perform" | "holds", ..., "context": {...}}` is answered by
//! `{"answer": ..., "configurations": {...}, "environment": {...}}`; the latter two are what a function of
//! the launch file has changed.

use periplus_diagnostics::Diagnostic;
use serde_json::{Value, json};

use crate::context::Snapshot;
use crate::evaluate::Evaluation;
use crate::tree::{Condition, Text};

/// Answers what a launch file asks while it is evaluated.
pub(crate) fn answer(evaluation: &mut Evaluation<'_>, question: &Value) -> Result<Value, String> {
    let text = |name: &str| question[name].as_str().unwrap_or_default().to_owned();
    let before = evaluation.context.clone();
    if let Some(snapshot) = question.get("context") {
        let snapshot: Snapshot =
            serde_json::from_value(snapshot.clone()).map_err(|why| why.to_string())?;
        evaluation.context.configurations = snapshot.configurations;
        evaluation.context.environment = snapshot.environment;
    }
    let answer = match question["question"].as_str().unwrap_or_default() {
        "package" => Ok(json!(evaluation.package(&text("name"), question["is_prefix"] == true))),
        "perform" => serde_json::from_value::<Text>(question["text"].clone())
            .map_err(|why| why.to_string())
            .and_then(|text| evaluation.perform(&text).map_err(|wrong| in_words(&wrong)))
            .map(Value::from),
        "holds" => serde_json::from_value::<Condition>(question["condition"].clone())
            .map_err(|why| why.to_string())
            .and_then(|condition| evaluation.holds(&condition).map_err(|wrong| in_words(&wrong)))
            .map(Value::from),
        "command" => evaluation
            .command(&text("line"), question["on_stderr"].as_str().unwrap_or("fail"))
            .map(Value::from)
            .map_err(|wrong| in_words(&wrong)),
        "yaml" => evaluation.yaml("text", &text("text")).map_err(|wrong| in_words(&wrong)),
        other => Err(format!("`{other}` is no question")),
    };
    evaluation.context = before;
    answer
}

/// A finding in one text, for the way through Python.
fn in_words(wrong: &Diagnostic) -> String {
    let further = wrong.notes.iter().chain(&wrong.help);
    std::iter::once(&wrong.message).chain(further).cloned().collect::<Vec<_>>().join("; ")
}

/// What went wrong in a launch file, as a finding. The interpreter gives the place as `file:line: `.
pub(crate) fn complaint(evaluation: &Evaluation<'_>, why: &str) -> Box<Diagnostic> {
    evaluation.error("launch-python", why.trim()).into()
}
