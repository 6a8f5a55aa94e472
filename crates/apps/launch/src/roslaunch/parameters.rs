//! `<param>` and `<rosparam>`.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Origin};
use periplus_xml::{Element, Node, Text};
use serde_json::Value;

use super::{Loader, Scope, wrong};
use crate::context::within;
use crate::evaluate::Outcome;
use crate::truth::{truth, value_of};

impl Loader<'_, '_> {
    /// A parameter beside nodes.
    pub(super) fn parameter(&mut self, element: &Element, scope: &mut Scope) -> Outcome<()> {
        let (name, value) = self.parameter_of(element, scope)?;
        if value.is_null() {
            return Ok(());
        }
        match name.strip_prefix('~') {
            Some(private) => scope.private.push((private.to_owned(), value)),
            None => {
                let name = within(&scope.namespace, &name);
                self.evaluation.plan.parameters.insert(name, value);
            }
        }
        Ok(())
    }

    /// Name and value of a `<param>`; null for one that is left out.
    pub(super) fn parameter_of(
        &mut self,
        element: &Element,
        scope: &Scope,
    ) -> Outcome<(String, Value)> {
        let name = self.needed(element, "name", scope)?;
        let of_type = self.optional(element, "type", scope)?.unwrap_or_default();
        let sources = ["value", "textfile", "binfile", "command"];
        let given: Vec<&str> =
            sources.into_iter().filter(|source| element.attribute(source).is_some()).collect();
        let [source] = given.as_slice() else {
            let message =
                format!("`<param>` needs one of {}, and has {}", sources.join(", "), given.len());
            return Err(wrong("launch-parameter", &message, element));
        };
        let written = self.needed(element, source, scope)?;
        let value = match *source {
            "value" => {
                typed(&written, &of_type).map_err(|why| wrong("launch-parameter", &why, element))?
            }
            "textfile" => {
                let instead = "the parameter is left out of the plan";
                let origin = Some(element.name_origin());
                let text = self.evaluation.read_or_miss(Path::new(&written), instead, origin)?;
                text.map_or(Value::Null, Value::String)
            }
            "command" => match self.printed(&written, &of_type, element)? {
                Some(value) => value,
                None => return Ok((name, Value::Null)),
            },
            _ => {
                return Err(wrong(
                    "launch-parameter",
                    "`binfile` is not supported: give the content as `textfile`",
                    element,
                ));
            }
        };
        Ok((name, value))
    }

    /// What a command prints, as the value of a parameter; none, with a warning, when it cannot be run.
    fn printed(&mut self, line: &str, of_type: &str, element: &Element) -> Outcome<Option<Value>> {
        let ran = self.evaluation.ran(line).map_err(|wrong| wrong.at(element.name_origin()))?;
        match ran {
            Ok(printed) if of_type == "yaml" => {
                self.evaluation.yaml("command", &printed.output).map(Some)
            }
            Ok(printed) => Ok(Some(Value::String(printed.output))),
            Err(why) => {
                let instead = "the parameter is left out of the plan";
                self.evaluation.note_not_run(line, why, instead, Some(element.name_origin()));
                Ok(None)
            }
        }
    }

    /// `<rosparam>` beside nodes.
    pub(super) fn rosparam(&mut self, element: &Element, scope: &Scope) -> Outcome<()> {
        let mut namespace = scope.namespace.clone();
        if let Some(own) = self.optional(element, "ns", scope)? {
            namespace = within(&namespace, &own);
        }
        let command = self.optional(element, "command", scope)?;
        let parameter = self.optional(element, "param", scope)?;
        match command.as_deref().unwrap_or("load") {
            "load" => {
                let value = self.rosparam_value(element, scope)?;
                let root = match &parameter {
                    Some(parameter) => within(&namespace, parameter),
                    None => namespace,
                };
                spread(&root, &value, &mut |name, value| {
                    self.evaluation.plan.parameters.insert(name.to_owned(), value.clone());
                });
                Ok(())
            }
            "delete" => {
                let root = within(&namespace, parameter.as_deref().unwrap_or(""));
                let under = format!("{}/", root.trim_end_matches('/'));
                self.evaluation
                    .plan
                    .parameters
                    .retain(|name, _| *name != root && !name.starts_with(&under));
                Ok(())
            }
            "dump" => {
                self.left(element, "`rosparam dump` writes no file here");
                Ok(())
            }
            other => {
                let message = format!("`command` is load, delete or dump, not `{other}`");
                Err(wrong("launch-parameter", &message, element))
            }
        }
    }

    /// The tree that a `<rosparam>` loads.
    pub(super) fn rosparam_value(&mut self, element: &Element, scope: &Scope) -> Outcome<Value> {
        let file = self.optional(element, "file", scope)?;
        if let Some(file) = file.as_deref().filter(|file| file.starts_with("package://")) {
            let finding = Diagnostic::warning(
                "launch-file",
                format!("the parameters of {file} are left out: its package is not here"),
            )
            .at(element.name_origin());
            self.evaluation.found.push(finding);
            return Ok(Value::Object(serde_json::Map::new()));
        }
        let resolves = match element.attribute("subst_value") {
            Some(attribute) => self.truth(attribute, scope)?,
            None => false,
        };
        let tree = match file {
            None if !resolves => self.inline(element)?,
            None => {
                let text = content(element);
                let text = self.resolved_text(&text, &element.text_origin(), scope)?;
                let id = self.evaluation.sources.add("rosparam", text);
                periplus_yaml::parse(id, self.evaluation.sources)
                    .map_err(|wrong| moved(*wrong, &element.text_origin()))?
            }
            Some(path) => {
                let instead = "its parameters are left out of the plan";
                let origin = Some(element.name_origin());
                let read = self
                    .evaluation
                    .read_or_miss(Path::new(&path), instead, origin)
                    .map_err(|wrong| wrong.at(element.name_origin()))?;
                let Some(mut text) = read else {
                    return Ok(Value::Object(serde_json::Map::new()));
                };
                if resolves {
                    text = self.resolved_text(&text, &element.name_origin(), scope)?;
                }
                let id = self.evaluation.sources.add(path, text);
                periplus_yaml::parse(id, self.evaluation.sources)?
            }
        };
        Ok(tree.map_or(Value::Null, |node| value_of(&node)))
    }

    /// The YAML between the tags of an element, with its places in the launch file.
    fn inline(&mut self, element: &Element) -> Outcome<Option<periplus_yaml::Node>> {
        let text = content(element);
        let runs: Vec<_> = runs(element).collect();
        let span = match runs.as_slice() {
            // Without entities and CDATA it is as long as its source.
            [only] => only.origin.0.filter(|span| (span.end - span.start) as usize == text.len()),
            _ => None,
        };
        let begins_a_line = text.split('\n').next().is_some_and(|line| line.trim().is_empty());
        let Some(span) = span.filter(|_| begins_a_line) else {
            let id = self.evaluation.sources.add("rosparam", text);
            return periplus_yaml::parse(id, self.evaluation.sources)
                .map_err(|wrong| moved(*wrong, &element.text_origin()).into());
        };
        // Everything before it as blank lines, so that each line keeps its number.
        let launch = self.evaluation.sources.file(span.file);
        let name = launch.name.clone();
        let before = &launch.text[..span.start as usize];
        let blank = |byte| if byte == b'\n' { '\n' } else { ' ' };
        let padded: String = before.bytes().map(blank).chain(text.chars()).collect();
        let id = self.evaluation.sources.add(name, padded);
        periplus_yaml::parse(id, self.evaluation.sources)
    }
}

/// The characters of an element with all white space: in YAML it has a meaning.
fn content(element: &Element) -> String {
    runs(element).map(|text| text.text.as_str()).collect()
}

fn runs(element: &Element) -> impl Iterator<Item = &Text> {
    element.children.iter().filter_map(|node| match node {
        Node::Text(text) => Some(text),
        _ => None,
    })
}

/// A finding at another place.
fn moved(wrong: Diagnostic, origin: &Origin) -> Diagnostic {
    wrong.at(*origin)
}

/// The leaves of a tree by full name.
pub(super) fn spread(root: &str, value: &Value, take: &mut dyn FnMut(&str, &Value)) {
    match value {
        Value::Object(entries) => {
            for (key, value) in entries {
                spread(&within(root, key), value, take);
            }
        }
        Value::Null => {}
        value => take(root, value),
    }
}

/// A text as a value of a type; without one it is what it looks like.
fn typed(text: &str, of_type: &str) -> Result<Value, String> {
    let wrong = |what: &str| format!("`{text}` is no {what}");
    let integer = || text.trim().parse::<i64>().ok();
    let number = || text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    Ok(match of_type {
        "" | "auto" => {
            if let Some(integer) = integer() {
                integer.into()
            } else if let Some(number) = number() {
                number.into()
            } else {
                match text.trim().to_lowercase().as_str() {
                    "true" => true.into(),
                    "false" => false.into(),
                    _ => text.into(),
                }
            }
        }
        "str" | "string" => text.into(),
        "int" => integer().ok_or_else(|| wrong("whole number"))?.into(),
        "double" => number().ok_or_else(|| wrong("number"))?.into(),
        "bool" | "boolean" => truth(text).ok_or_else(|| wrong("truth value"))?.into(),
        "yaml" => crate::truth::typed(text),
        other => {
            return Err(format!("`{other}` is no type: str, int, double, bool, yaml or auto is"));
        }
    })
}
