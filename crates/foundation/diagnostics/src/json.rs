//! JSON form of findings, for scripts.

use serde_json::{Value, json};

use crate::Diagnostic;
use crate::source::{Expansion, SourceMap, Span};

/// One finding as a JSON object: `severity`, `code`, `message`, and where known `file`, `line`,
/// `column`, `end_line`, `end_column`, `label`, `related`, `trace`, `notes`, `help`, `replacement`.
#[must_use]
pub fn to_json(diagnostic: &Diagnostic, sources: &SourceMap) -> Value {
    let mut object = json!({
        "severity": diagnostic.severity.name(),
        "code": diagnostic.code,
        "message": diagnostic.message,
        "notes": diagnostic.notes,
        "help": diagnostic.help,
    });
    if let Some(span) = diagnostic.span {
        extend(&mut object, place(sources, span));
        let trace: Vec<Value> = sources
            .backtrace(span)
            .map(|expansion| {
                let mut step = place(sources, expansion.site());
                if let Expansion::Macro { name, .. } = expansion {
                    step["macro"] = json!(name);
                }
                step
            })
            .collect();
        object["trace"] = json!(trace);
    }
    if let Some(label) = &diagnostic.label {
        object["label"] = json!(label);
    }
    if !diagnostic.related.is_empty() {
        let related = diagnostic.related.iter().map(|(span, label)| {
            let mut value = place(sources, *span);
            value["label"] = json!(label);
            value
        });
        object["related"] = related.collect();
    }
    if let Some(replacement) = &diagnostic.replacement {
        let mut value = place(sources, replacement.span);
        value["text"] = json!(replacement.text);
        value["message"] = json!(replacement.message);
        object["replacement"] = value;
    }
    object
}

fn place(sources: &SourceMap, span: Span) -> Value {
    let file = sources.file(span.file);
    let (start, end) = (file.position(span.start), file.position(span.end));
    json!({
        "file": file.name,
        "line": start.line,
        "column": start.column,
        "end_line": end.line,
        "end_column": end.column,
    })
}

fn extend(object: &mut Value, more: Value) {
    if let (Value::Object(object), Value::Object(more)) = (object, more) {
        object.extend(more);
    }
}
