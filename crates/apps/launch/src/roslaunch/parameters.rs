//! `<param>` and `<rosparam>`.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Origin};
use periplus_xml::{Element, Text, XmlNode};
use serde_json::Value;

use super::{Loader, Scope, wrong};
use crate::context::within;
use crate::evaluate::Outcome;
use crate::truth::{truth, value_of};

impl Loader<'_, '_> {
    /// Parameter outside nodes.
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

    /// Output of a command as the value of a parameter; `None`, with a warning, when it cannot be
    /// run.
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

    /// `<rosparam>` outside nodes.
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
                self.left(element, "`rosparam dump` is not supported");
                Ok(())
            }
            other => {
                let message = format!("`command` must be load, delete or dump, not `{other}`");
                Err(wrong("launch-parameter", &message, element))
            }
        }
    }

    /// Tree of parameters of a `<rosparam>`.
    pub(super) fn rosparam_value(&mut self, element: &Element, scope: &Scope) -> Outcome<Value> {
        let file = self.optional(element, "file", scope)?;
        if let Some(file) = file.as_deref().filter(|file| file.starts_with("package://")) {
            let finding = Diagnostic::warning(
                "launch-file",
                format!(
                    "the parameters of {file} are left out: its package is not on this machine"
                ),
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

    /// YAML between the tags of an element, with its positions in the launch file.
    fn inline(&mut self, element: &Element) -> Outcome<Option<periplus_yaml::YamlNode>> {
        let text = content(element);
        let runs: Vec<_> = runs(element).collect();
        let span = match runs.as_slice() {
            // Without entities and CDATA it has the length of its source.
            [only] => only.origin.0.filter(|span| (span.end - span.start) as usize == text.len()),
            _ => None,
        };
        let begins_a_line = text.split('\n').next().is_some_and(|line| line.trim().is_empty());
        let Some(span) = span.filter(|_| begins_a_line) else {
            let id = self.evaluation.sources.add("rosparam", text);
            return periplus_yaml::parse(id, self.evaluation.sources)
                .map_err(|wrong| moved(*wrong, &element.text_origin()).into());
        };
        // Preceding text becomes blank lines, so that line numbers are kept.
        let launch = self.evaluation.sources.file(span.file);
        let name = launch.name.clone();
        let before = &launch.text[..span.start as usize];
        let blank = |byte| if byte == b'\n' { '\n' } else { ' ' };
        let padded: String = before.bytes().map(blank).chain(text.chars()).collect();
        let id = self.evaluation.sources.add(name, padded);
        periplus_yaml::parse(id, self.evaluation.sources)
    }
}

/// Text of an element with all white space, which is significant in YAML.
fn content(element: &Element) -> String {
    runs(element).map(|text| text.text.as_str()).collect()
}

fn runs(element: &Element) -> impl Iterator<Item = &Text> {
    element.children.iter().filter_map(|node| match node {
        XmlNode::Text(text) => Some(text),
        _ => None,
    })
}

/// Finding with another position.
fn moved(wrong: Diagnostic, origin: &Origin) -> Diagnostic {
    wrong.at(*origin)
}

/// Leaves of a tree by full name.
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

/// Converts a text to a type; without one the type is detected.
fn typed(text: &str, of_type: &str) -> Result<Value, String> {
    let wrong = |what: &str| format!("`{text}` is not a {what}");
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
        "int" => integer().ok_or_else(|| wrong("integer"))?.into(),
        "double" => number().ok_or_else(|| wrong("number"))?.into(),
        "bool" | "boolean" => truth(text).ok_or_else(|| wrong("Boolean"))?.into(),
        "yaml" => crate::truth::typed(text),
        other => {
            return Err(format!(
                "unknown type `{other}`; expected str, int, double, bool, yaml or auto"
            ));
        }
    })
}
