//! Nodes, components and processes.

use std::collections::BTreeMap;

use super::{Evaluation, Outcome};
use crate::plan::{Component, Identity, PlanNode, Process, Running, What};
use crate::tree::{ComponentOf, IdentityOf, NodeOf, ProcessOf, RunningOf, Target, Text};
use crate::truth::truth;
use crate::words;

impl Evaluation<'_> {
    pub(super) fn node(&mut self, node: &NodeOf) -> Outcome<What> {
        let mut arguments = self.perform_all(&node.arguments)?;
        let mut ros_arguments = self.perform_all(&node.ros_arguments)?;
        if node.is_line {
            arguments = self.split(&arguments.join(" "))?;
            ros_arguments = self.split(&ros_arguments.join(" "))?;
        }
        let mut made = PlanNode {
            package: self.perform_some(node.package.as_ref())?,
            executable: self.perform(&node.executable)?,
            identity: self.identity(&node.identity)?,
            arguments,
            ros_arguments,
            is_lifecycle: node.is_lifecycle,
            components: self.components(&node.components)?,
            running: self.running(&node.running)?,
        };
        if made.executable.is_empty() {
            return Err(self.error("launch-node", "a node needs an executable").into());
        }
        if let Some(name) = made.identity.name.as_deref().filter(|name| name.contains('/')) {
            return Err(self
                .error("launch-node", format!("`{name}` is not a valid node name: it contains `/`"))
                .help("move the part before the last `/` to `namespace`")
                .into());
        }
        if node.is_lifecycle
            && let Some(autostart) = &node.autostart
            && self.truth_of(autostart)?
        {
            made.ros_arguments.push("--autostart".into());
        }
        Ok(What::Node(Box::new(made)))
    }

    pub(super) fn load(&mut self, container: &Target, components: &[ComponentOf]) -> Outcome<What> {
        let container = match container {
            Target::Name { name } => {
                let name = self.perform(name)?;
                self.context.within(&name)
            }
            Target::Action { action } => {
                let step = self.step_of(Some(*action));
                let started = self.plan.steps.iter().find(|started| started.id == step);
                match started.map(|started| &started.what) {
                    Some(What::Node(node)) => {
                        let name = node.identity.name.clone().unwrap_or_default();
                        crate::context::within(
                            node.identity.namespace.as_deref().unwrap_or(""),
                            &name,
                        )
                    }
                    _ => {
                        return Err(self
                            .error(
                                "launch-container",
                                "components are loaded into a container that was not started before",
                            )
                            .into());
                    }
                }
            }
        };
        Ok(What::Load { container, components: self.components(components)? })
    }

    fn components(&mut self, components: &[ComponentOf]) -> Outcome<Vec<Component>> {
        let mut made = Vec::new();
        for component in components {
            let is_wanted = match &component.condition {
                Some(condition) => self.holds(condition)?,
                None => true,
            };
            if !is_wanted {
                continue;
            }
            made.push(Component {
                package: self.perform(&component.package)?,
                plugin: self.perform(&component.plugin)?,
                identity: self.identity(&component.identity)?,
            });
        }
        Ok(made)
    }

    pub(super) fn process(&mut self, process: &ProcessOf) -> Outcome<What> {
        let is_shell = match &process.shell {
            Some(shell) => self.truth_of(shell)?,
            None => false,
        };
        let words = self.perform_all(&process.command)?;
        let command = match (is_shell, process.is_line) {
            (true, _) => vec![words.join(" ")],
            (false, true) => self.split(&words.join(" "))?,
            (false, false) => words,
        };
        if command.iter().all(String::is_empty) {
            return Err(self.error("launch-process", "a process needs a command").into());
        }
        Ok(What::Process(Process {
            command,
            is_shell,
            name: self.perform_some(process.name.as_ref())?,
            running: self.running(&process.running)?,
        }))
    }

    fn running(&mut self, running: &RunningOf) -> Outcome<Running> {
        let mut environment: BTreeMap<_, _> = match &running.only_environment {
            Some(only) => self
                .perform_pairs(only)?
                .into_iter()
                .map(|(name, value)| (name, Some(value)))
                .collect(),
            None => self.context.environment.clone(),
        };
        for (name, value) in self.perform_pairs(&running.environment)? {
            environment.insert(name, Some(value));
        }
        let respawn = self.perform_some(running.respawn.as_ref())?;
        let delay = self.perform_some(running.respawn_delay.as_ref())?;
        let respawn_after_s = match respawn.as_deref().map(truth) {
            Some(Some(true)) => Some(match delay {
                Some(delay) => delay.trim().parse().map_err(|_| {
                    self.error("launch-respawn", format!("`{delay}` is not a number of seconds"))
                })?,
                None => 0.0,
            }),
            Some(None) => {
                let said = respawn.unwrap_or_default();
                return Err(self
                    .error(
                        "launch-respawn",
                        format!("`respawn` must be true or false, not `{said}`"),
                    )
                    .into());
            }
            _ => None,
        };
        Ok(Running {
            prefix: self.perform_some(running.prefix.as_ref())?.filter(|text| !text.is_empty()),
            folder: self.perform_some(running.folder.as_ref())?,
            environment,
            replaces_environment: running.only_environment.is_some(),
            output: self.perform_some(running.output.as_ref())?,
            respawn_after_s,
            // Exit handlers become separate steps.
            is_required: false,
        })
    }

    fn identity(&mut self, of: &IdentityOf) -> Outcome<Identity> {
        Ok(Identity {
            name: self.perform_some(of.name.as_ref())?.filter(|name| !name.is_empty()),
            namespace: self.namespace(of.namespace.as_ref())?,
            parameters: self.parameters(&of.parameters)?,
            remaps: self.remaps(&of.remaps)?,
        })
    }

    /// Namespace of a node; `None` if neither it nor its scope has one.
    fn namespace(&mut self, own: Option<&Text>) -> Outcome<Option<String>> {
        let own = self.perform_some(own)?.filter(|own| !own.is_empty());
        Ok(match own {
            Some(own) => Some(self.context.within(&own)),
            None if self.context.namespace.is_empty() => None,
            None => Some(self.context.namespace.clone()),
        })
    }

    fn remaps(&mut self, own: &[(Text, Text)]) -> Outcome<Vec<(String, String)>> {
        let mut all = self.context.remaps.clone();
        all.extend(self.perform_pairs(own)?);
        Ok(all)
    }

    pub(crate) fn split(&mut self, line: &str) -> Outcome<Vec<String>> {
        words::split(line).ok_or_else(|| {
            self.error("launch-words", format!("`{}` has an unclosed quote", line.trim())).into()
        })
    }
}
