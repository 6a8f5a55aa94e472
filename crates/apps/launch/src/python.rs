//! Protocol of the interpreter of Python launch files. One line of JSON in each direction: `{"ask":
//! "load" | "call" | "for_each" | "perform" | "holds" | "expression", ..., "context": {...}}` is
//! answered by `{"answer": ..., "configurations": {...}, "environment": {...}}`; the latter two
//! contain the changes made by a function of the launch file.

use std::path::Path;

use periplus_diagnostics::Diagnostic;
use serde_json::{Value, json};

use crate::context::Snapshot;
use crate::evaluate::Evaluation;
use crate::modules;
use crate::outside::LaunchError;
use crate::tree::{Condition, Place, Text};

/// Answers a question that a launch file asks during its evaluation.
pub(crate) fn answer(
    evaluation: &mut Evaluation<'_>,
    question: &Value,
) -> Result<Value, LaunchError> {
    let text = |name: &str| question[name].as_str().unwrap_or_default().to_owned();
    let before = evaluation.context.clone();
    let line = question["line"].as_str().map(str::to_owned);
    let place = evaluation.set_place(Place { line, span: None });
    if let Some(snapshot) = question.get("context") {
        let snapshot: Snapshot = serde_json::from_value(snapshot.clone()).map_err(invalid)?;
        evaluation.context.configurations = snapshot.configurations;
        evaluation.context.environment = snapshot.environment;
    }
    let answer = match question["question"].as_str().unwrap_or_default() {
        "package" => Ok(json!(evaluation.package(&text("name"), question["is_prefix"] == true))),
        "perform" => serde_json::from_value::<Text>(question["text"].clone())
            .map_err(invalid)
            .and_then(|text| evaluation.perform(&text).map_err(in_words))
            .map(Value::from),
        "holds" => serde_json::from_value::<Condition>(question["condition"].clone())
            .map_err(invalid)
            .and_then(|condition| evaluation.holds(&condition).map_err(in_words))
            .map(Value::from),
        "command" => evaluation
            .command(&text("line"), question["on_stderr"].as_str().unwrap_or("fail"))
            .map(Value::from)
            .map_err(in_words),
        "packages" => {
            let file = evaluation.context.file.clone();
            let packages = evaluation.resolver.packages(&file).into_iter();
            let prefixes = packages.map(|(name, folder)| (name, prefix(&folder)));
            Ok(json!(prefixes.collect::<std::collections::BTreeMap<_, _>>()))
        }
        "module" => Ok(json!(modules::folder(evaluation, &text("name")))),
        "xacro" => xacro(evaluation, question),
        "in_sources" => Ok(json!(evaluation.in_sources(&text("path")))),
        "missing" => {
            let instead = "it is taken to be empty in the plan";
            evaluation.note_missing_file(&text("path"), instead, None);
            Ok(Value::Null)
        }
        "scratch" => {
            evaluation.scratch(&text("name"), &text("text")).map(Value::from).map_err(in_words)
        }
        "yaml" => evaluation.yaml("text", &text("text")).map_err(in_words),
        other => Err(format!("unknown question `{other}`").into()),
    };
    evaluation.context = before;
    evaluation.set_place(place);
    answer
}

/// Finding as one text, to be passed through Python.
fn in_words(wrong: Box<Diagnostic>) -> LaunchError {
    let further = wrong.notes.iter().chain(&wrong.help);
    let words: Vec<String> = std::iter::once(&wrong.message).chain(further).cloned().collect();
    words.join("; ").into()
}

/// Error of a question that does not follow the protocol.
fn invalid(error: serde_json::Error) -> LaunchError {
    error.to_string().into()
}

/// Text of an expanded file; null, with a warning, if files that it needs are missing on this
/// machine.
fn xacro(evaluation: &mut Evaluation<'_>, question: &Value) -> Result<Value, LaunchError> {
    let file = question["file"].as_str().unwrap_or_default();
    let instead = "its output is left empty in the plan";
    if file.starts_with("package:/") {
        evaluation.note_missing_file(file, instead, None);
        return Ok(Value::Null);
    }
    let mappings: Vec<(String, String)> =
        serde_json::from_value(question["mappings"].clone()).map_err(invalid)?;
    let mut words = vec!["xacro".to_owned(), evaluation.in_sources(file)];
    words.extend(mappings.iter().map(|(name, value)| format!("{name}:={value}")));
    let printed = evaluation.outside.run(&words)?;
    if let Some(missing) = printed.missing {
        let message = format!("{file} cannot be expanded, and {instead}");
        evaluation.note_missing(missing, message, None, printed.errors.trim());
        return Ok(Value::Null);
    }
    if !printed.is_success {
        return Err(format!("{file} cannot be expanded: {}", printed.errors.trim()).into());
    }
    Ok(printed.output.into())
}

/// Prefix of a package's folder: PREFIX/share/NAME of an installed one; otherwise the folder
/// itself.
pub(crate) fn prefix(folder: &Path) -> String {
    let share = folder.parent().filter(|above| above.ends_with("share"));
    share.and_then(Path::parent).unwrap_or(folder).display().to_string()
}

/// Converts an error of a launch file to a finding.
pub(crate) fn complaint(evaluation: &Evaluation<'_>, why: &LaunchError) -> Box<Diagnostic> {
    let message = match &why.line {
        Some(line) => format!("{line}: {}", why.message.trim()),
        None => why.message.trim().to_owned(),
    };
    let wrong = evaluation.error("launch-python", message);
    match &why.help {
        Some(help) => wrong.help(help).into(),
        None => wrong.into(),
    }
}
