//! `<node>`.

use std::collections::BTreeMap;

use periplus_diagnostics::Diagnostic;
use periplus_xml::Element;

use super::parameters::spread;
use super::{Loader, Scope, wrong};
use crate::context::within;
use crate::evaluate::Outcome;
use crate::plan::{Identity, PlanNode, PlanParameters, Running, What};

impl Loader<'_, '_> {
    pub(super) fn node(&mut self, element: &Element, scope: &Scope) -> Outcome<()> {
        let mut inner = scope.clone();
        let package = self.needed(element, "pkg", scope)?;
        let executable = self.needed(element, "type", scope)?;
        let name = self.needed(element, "name", scope)?;
        if name.contains('/') {
            let message = format!("`{name}` is not a valid node name: it contains `/`; use `ns`");
            return Err(wrong("launch-node", &message, element));
        }
        if let Some(namespace) = self.optional(element, "ns", scope)? {
            inner.namespace = within(&inner.namespace, &namespace);
        }
        let full = within(&inner.namespace, &name);
        let under = format!("{full}/");
        if let Some(clear) = element.attribute("clear_params")
            && self.truth(clear, scope)?
        {
            self.evaluation.plan.parameters.retain(|name, _| !name.starts_with(&under));
        }

        let mut values: BTreeMap<_, _> = scope.private.iter().cloned().collect();
        for child in element.elements() {
            if !self.is_wanted(child, &inner)? {
                continue;
            }
            match child.local_name() {
                "param" => {
                    let (name, value) = self.parameter_of(child, &inner)?;
                    if value.is_null() {
                        continue;
                    }
                    let name = name.trim_start_matches('~');
                    match name.strip_prefix('/') {
                        Some(_) => drop(self.evaluation.plan.parameters.insert(name.into(), value)),
                        None => drop(values.insert(name.replace('/', "."), value)),
                    }
                }
                "rosparam" => {
                    let value = self.rosparam_value(child, &inner)?;
                    let root = [
                        self.optional(child, "ns", &inner)?,
                        self.optional(child, "param", &inner)?,
                    ];
                    let root = root
                        .into_iter()
                        .flatten()
                        .fold(String::new(), |root, part| within(&root, &part));
                    spread(&root, &value, &mut |name, value| {
                        let name = name.trim_start_matches('/').replace('/', ".");
                        values.insert(name, value.clone());
                    });
                }
                "remap" => {
                    let pair =
                        (self.needed(child, "from", &inner)?, self.needed(child, "to", &inner)?);
                    inner.remaps.push(pair);
                }
                "env" => {
                    let (name, value) =
                        (self.needed(child, "name", &inner)?, self.needed(child, "value", &inner)?);
                    self.set_variable(child, &mut inner, name, value);
                }
                other => {
                    let message = format!("unknown element `<{other}>` in `<node>`");
                    let finding =
                        Diagnostic::warning("launch-element", message).at(child.name_origin());
                    self.evaluation.found.push(finding);
                }
            }
        }

        let line = self.optional(element, "args", &inner)?.unwrap_or_default();
        let arguments = crate::words::split(&line)
            .ok_or_else(|| wrong("launch-words", "`args` has an unclosed quote", element))?;
        let running = self.running(element, &inner)?;
        let what = What::Node(Box::new(PlanNode {
            package: Some(package),
            executable,
            identity: Identity {
                name: Some(name),
                namespace: (inner.namespace != "/").then(|| inner.namespace.clone()),
                parameters: if values.is_empty() {
                    Vec::new()
                } else {
                    vec![PlanParameters::Values(values)]
                },
                remaps: std::mem::take(&mut inner.remaps),
            },
            arguments,
            running,
            ..PlanNode::default()
        }));
        self.step(element, &inner, what);
        Ok(())
    }

    fn running(&mut self, element: &Element, scope: &Scope) -> Outcome<Running> {
        let mut truth = |name: &str| match element.attribute(name) {
            Some(attribute) => self.truth(attribute, scope),
            None => Ok(false),
        };
        let (respawn, is_required) = (truth("respawn")?, truth("required")?);
        if respawn && is_required {
            return Err(wrong(
                "launch-node",
                "a node cannot have both `required` and `respawn`",
                element,
            ));
        }
        let delay = self.optional(element, "respawn_delay", scope)?.unwrap_or_else(|| "0".into());
        let delay_s: f64 = delay.trim().parse().map_err(|_| {
            wrong("launch-node", &format!("`{delay}` is not a number of seconds"), element)
        })?;
        Ok(Running {
            // Variables of `<env>` are added to those of the launch.
            replaces_environment: false,
            prefix: self.optional(element, "launch-prefix", scope)?.filter(|text| !text.is_empty()),
            folder: self.optional(element, "cwd", scope)?,
            environment: scope.environment.clone(),
            output: self.optional(element, "output", scope)?,
            respawn_after_s: respawn.then_some(delay_s),
            is_required,
        })
    }
}
