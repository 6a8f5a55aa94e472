//! Parameters of nodes.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{Evaluation, Outcome};
use crate::front;
use crate::perform::UNCHANGED;
use crate::plan::PlanParameters;
use crate::tree::{Given, ParametersOf};
use crate::truth::{truth, typed};

/// Value of a parameter, with its type.
pub(super) fn value(evaluation: &mut Evaluation<'_>, given: &Given) -> Outcome<Value> {
    Ok(match given {
        Given::Value { value } => value.clone(),
        Given::Text { text, of_type: None } => typed(&evaluation.perform(text)?),
        Given::Text { text, of_type: Some(of_type) } => {
            let text = evaluation.perform(text)?;
            of(evaluation, &text, of_type)?
        }
        Given::Texts { texts } => {
            let texts = evaluation.perform_all(texts)?;
            let values: Vec<Value> = texts.iter().map(|text| typed(text)).collect();
            // Values of a list have one type: string, unless all have another.
            let is_uniform = values.iter().all(|value| kind(value) == kind(&values[0]));
            if is_uniform { Value::Array(values) } else { texts.into() }
        }
    })
}

fn kind(value: &Value) -> u8 {
    match value {
        Value::Bool(_) => 0,
        Value::Number(number) if number.is_f64() => 1,
        Value::Number(_) => 2,
        Value::String(_) => 3,
        _ => 4,
    }
}

/// Converts a text to an explicit type: `str`, `int`, `float`, `bool`, or a list of one.
fn of(evaluation: &Evaluation<'_>, text: &str, of_type: &str) -> Outcome<Value> {
    let value = typed(text);
    let fits = match of_type {
        "str" | "string" => return Ok(Value::String(text.to_owned())),
        "int" => value.is_i64(),
        "float" if value.is_number() => return Ok(value.as_f64().into()),
        "bool" => match truth(text) {
            Some(truth) => return Ok(truth.into()),
            None => value.is_boolean(),
        },
        "list_of_str" => match &value {
            Value::Array(list) => {
                let text = |value: &Value| match value {
                    Value::String(text) => text.clone(),
                    other => other.to_string(),
                };
                return Ok(list.iter().map(text).collect());
            }
            _ => false,
        },
        "list_of_int" => value.as_array().is_some_and(|list| list.iter().all(Value::is_i64)),
        "list_of_float" => value.as_array().is_some_and(|list| list.iter().all(Value::is_number)),
        "list_of_bool" => value.as_array().is_some_and(|list| list.iter().all(Value::is_boolean)),
        _ => false,
    };
    if fits {
        return Ok(value);
    }
    Err(evaluation
        .error("launch-parameter", format!("`{text}` is not a value of type `{of_type}`"))
        .into())
}

impl Evaluation<'_> {
    /// Parameters of a node: global ones first, overridden by its own.
    pub(super) fn parameters(&mut self, own: &[ParametersOf]) -> Outcome<Vec<PlanParameters>> {
        let mut all = self.context.parameters.clone();
        for parameters in own {
            all.push(match parameters {
                ParametersOf::Values { values } => {
                    let mut by_name = BTreeMap::new();
                    for (name, given) in values {
                        let name = self.perform(name)?;
                        by_name.insert(name, self.value(given)?);
                    }
                    PlanParameters::Values(by_name)
                }
                ParametersOf::File { file, with_substitutions } => {
                    let file = self.perform(file)?;
                    let is_resolved = match self.value(with_substitutions)? {
                        Value::Bool(is) => is,
                        Value::String(text) => truth(&text).unwrap_or_default(),
                        _ => false,
                    };
                    PlanParameters::File(if is_resolved {
                        self.resolved_file(&file)?
                    } else {
                        file
                    })
                }
            });
        }
        Ok(all)
    }

    /// Copy of a file with resolved `$(...)`.
    fn resolved_file(&mut self, file: &str) -> Outcome<String> {
        let text = self.read_or_miss(std::path::Path::new(file), UNCHANGED, None)?;
        let Some(text) = text else { return Ok(file.to_owned()) };
        let id = self.sources.add(file, text.as_str());
        let whole = self.sources.whole(id);
        let text = front::text(&text, whole)?;
        let text = self.perform(&text)?;
        let name = std::path::Path::new(file).file_name().and_then(|name| name.to_str());
        match self.outside.scratch(name.unwrap_or("parameters.yaml"), &text) {
            Ok(path) => Ok(path.display().to_string()),
            Err(why) => Err(self
                .error("launch-file", format!("cannot write the resolved copy of {file}: {why}"))
                .into()),
        }
    }
}
