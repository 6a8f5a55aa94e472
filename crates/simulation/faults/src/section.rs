//! Sections of YAML files that are checked by tables of parameters.

use periplus_diagnostics::{Diagnostic, Diagnostics, Severity};
use periplus_params::{Given, ParamValues, Table};
use periplus_yaml::{YamlNode, YamlValue};

/// Reads a mapping with the parameters of a table. A scalar or a list instead of it is the value of the first required
/// parameter, or of the first one. Unknown names are errors.
pub fn read_section(
    table: &'static Table,
    node: &YamlNode,
    diagnostics: &mut Diagnostics,
) -> ParamValues {
    let mut given = Vec::new();
    match &node.value {
        YamlValue::Map(entries) => {
            for (key, value) in entries {
                let Some(name) = key.text() else {
                    diagnostics.push(
                        Diagnostic::error("bad-name", "the name of a parameter is a text")
                            .at(key.span),
                    );
                    continue;
                };
                let text = flat_text(value);
                if text.is_none() {
                    let message = format!(
                        "`{name}` is {}; it must be a single value or a list of values",
                        value.kind()
                    );
                    diagnostics.push(Diagnostic::error("bad-value", message).at(value.span));
                }
                given.push(Given {
                    name,
                    text: text.unwrap_or_default().into(),
                    name_origin: key.span.into(),
                    origin: value.span.into(),
                });
            }
        }
        _ if node.is_null() => {}
        _ => {
            let is_required =
                |it: &&periplus_params::Parameter| it.default == periplus_params::Default::Required;
            let main = table.parameters.iter().find(is_required).or(table.parameters.first());
            match main {
                Some(main) => given.push(Given {
                    name: main.name,
                    text: flat_text(node).unwrap_or_default().into(),
                    name_origin: node.span.into(),
                    origin: node.span.into(),
                }),
                None => diagnostics.push(
                    Diagnostic::error("bad-value", format!("`{}` has no parameters", table.name))
                        .at(node.span)
                        .help(format!("write `{}` alone", table.name)),
                ),
            }
        }
    }
    let mut found = Diagnostics::new();
    let values = table.check(given, Some(node.span), &mut found);
    for finding in found.iter() {
        let severity = match finding.severity {
            // A scenario with a parameter that has no effect tests something else than its author believes.
            Severity::Warning => Severity::Error,
            severity => severity,
        };
        diagnostics.push(Diagnostic { severity, ..finding.clone() });
    }
    values
}

/// Text of a scalar, or of a list with its values separated by blanks; `None` for a mapping or a nested list.
#[must_use]
pub fn flat_text(node: &YamlNode) -> Option<String> {
    match &node.value {
        YamlValue::Scalar { text, .. } => Some(text.clone()),
        YamlValue::List(items) => {
            let texts: Option<Vec<&str>> = items.iter().map(YamlNode::text).collect();
            texts.map(|texts| texts.join(" "))
        }
        YamlValue::Map(_) => None,
    }
}
