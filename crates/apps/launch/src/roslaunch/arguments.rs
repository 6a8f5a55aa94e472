//! `<arg>`.

use periplus_diagnostics::DiagnosticCause;
use periplus_xml::Element;

use super::{Loader, Scope, wrong};
use crate::evaluate::Outcome;
use crate::plan::Argument;

impl Loader<'_, '_> {
    pub(super) fn argument(&mut self, element: &Element, scope: &mut Scope) -> Outcome<()> {
        let name = self.needed(element, "name", scope)?;
        let value = self.optional(element, "value", scope)?;
        let default = self.optional(element, "default", scope)?;
        if value.is_some() && default.is_some() {
            return Err(wrong(
                "launch-argument",
                "use `value` or `default` in `<arg>`, not both",
                element,
            ));
        }
        if scope.arguments.contains_key(&name) {
            let message = format!("the argument `{name}` is already defined in this file");
            return Err(wrong("launch-argument", &message, element));
        }
        let given = scope.given.get(&name).cloned();
        let is_constant = value.is_some();
        if is_constant && given.is_some() && !scope.is_passing_all {
            let message = format!(
                "the argument `{name}` cannot be set: this file defines it with `value`, not `default`"
            );
            return Err(wrong("launch-argument", &message, element));
        }
        let Some(chosen) = value.or(given).or_else(|| default.clone()) else {
            let message = format!("the argument `{name}` was not given");
            let missing = *wrong("launch-argument", &message, element);
            let mut missing = missing.caused_by(DiagnosticCause::MissingArgument);
            if let Some(doc) = element.value("doc") {
                missing = missing.note(format!("description: {doc}"));
            }
            return Err(missing.help(format!("add `{name}:=VALUE`")).into());
        };
        // Arguments of included files are set by the including files.
        let is_own = scope.depth == 0;
        if is_own && !is_constant && self.evaluation.plan.arguments.iter().all(|a| a.name != name) {
            self.evaluation.plan.arguments.push(Argument {
                name: name.clone(),
                description: element.value("doc").map(str::to_owned),
                default,
                choices: Vec::new(),
                value: Some(chosen.clone()),
            });
        }
        scope.arguments.insert(name, chosen);
        Ok(())
    }
}
