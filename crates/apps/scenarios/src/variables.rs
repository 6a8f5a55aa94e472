//! Variables of a scenario: `$(name)` in any value.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_yaml::{YamlNode, YamlValue};

/// Values of variables by name, as texts.
pub type Variables = BTreeMap<String, String>;

/// Reads the section `variables`, with other values for those that the caller sets.
///
/// # Errors
/// A message about a variable that the file does not declare.
pub(crate) fn read(
    section: Option<&YamlNode>,
    set: &[(String, String)],
    diagnostics: &mut Diagnostics,
) -> Result<Variables, String> {
    let mut variables = Variables::new();
    for (key, value) in section.and_then(YamlNode::entries).unwrap_or_default() {
        let name = key.text().unwrap_or_default().to_owned();
        match periplus_faults::flat_text(value) {
            Some(text) => {
                variables.insert(name, text);
            }
            None => {
                let message = format!("the variable `{name}` is {}", value.kind());
                diagnostics.push(Diagnostic::error("bad-variable", message).at(value.span));
            }
        }
    }
    for (name, value) in set {
        match variables.get_mut(name) {
            Some(variable) => variable.clone_from(value),
            None => {
                let known: Vec<&str> = variables.keys().map(String::as_str).collect();
                let known = match known.as_slice() {
                    [] => "it declares none; add a section `variables`".to_owned(),
                    names => format!("it declares {}", names.join(", ")),
                };
                return Err(format!("the scenario has no variable `{name}`; {known}"));
            }
        }
    }
    Ok(variables)
}

/// Replaces `$(name)` in all values of a tree.
pub(crate) fn substitute(
    node: &mut YamlNode,
    variables: &Variables,
    diagnostics: &mut Diagnostics,
) {
    let span = node.span;
    match &mut node.value {
        YamlValue::Scalar { text, .. } => {
            if text.contains("$(") {
                *text = replaced(text, |name| match variables.get(name) {
                    Some(value) => Some(value.clone()),
                    None => {
                        diagnostics.push(
                            Diagnostic::error(
                                "unknown-variable",
                                format!("there is no variable `{name}`"),
                            )
                            .at(span)
                            .did_you_mean(span, name, variables.keys().map(String::as_str))
                            .help("declare it in the section `variables`"),
                        );
                        None
                    }
                });
            }
        }
        YamlValue::List(items) => {
            items.iter_mut().for_each(|item| substitute(item, variables, diagnostics));
        }
        YamlValue::Map(entries) => {
            entries.iter_mut().for_each(|(_, value)| substitute(value, variables, diagnostics));
        }
    }
}

/// Text with each `$(name)` replaced by its value, where there is one.
fn replaced(text: &str, mut value_of: impl FnMut(&str) -> Option<String>) -> String {
    let (mut out, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once("$(") {
        out.push_str(before);
        let Some((name, behind)) = after.split_once(')') else {
            out.push_str("$(");
            rest = after;
            continue;
        };
        match value_of(name.trim()) {
            Some(value) => out.push_str(&value),
            None => {
                out.push_str("$(");
                out.push_str(name);
                out.push(')');
            }
        }
        rest = behind;
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_parentheses_are_replaced() {
        let value = |name: &str| (name == "x").then(|| "1.5".to_owned());
        assert_eq!(replaced("$(x) and $( x ), $(y) $( $", value), "1.5 and 1.5, $(y) $( $");
        assert_eq!(replaced("plain", value), "plain");
    }
}
