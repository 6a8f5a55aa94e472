//! Warnings about elements that Gazebo would drop.

use periplus_diagnostics::{Diagnostic, Diagnostics, Severity};

use super::state::ConversionState;
use crate::lump::{LumpOutcome, WORLD};

impl ConversionState<'_> {
    /// Warns about links without mass and everything that is dropped with them.
    pub(super) fn check_losses(&self, diagnostics: &mut Diagnostics) {
        for &link in &self.plan.unpreserved {
            let link = self.link(link);
            diagnostics.push(
                Diagnostic::warning(
                    "massless-link",
                    format!("the link `{}` has no mass, so its fixed joint is not kept", link.name),
                )
                .at(link.origin)
                .label("merged into the link above")
                .note("Gazebo would leave it out, with everything below it")
                .help("give it an <inertial>, or leave <preserveFixedJoint> out"),
            );
        }
        for &link in &self.plan.massless {
            diagnostics.push(self.massless(link));
        }
        self.check_world_link(diagnostics);
        self.check_merged_joints(diagnostics);
    }

    /// Diagnostic for a link that cannot be simulated; an error if the whole robot is dropped with it.
    fn massless(&self, link: usize) -> Diagnostic {
        let name = &self.link(link).name;
        let branch: Vec<usize> = self
            .tree
            .below(link)
            .into_iter()
            .filter(|&below| self.plan.outcome[below] == LumpOutcome::Lost)
            .collect();
        let mut lost: Vec<String> = Vec::new();
        let mut count = |number: usize, one: &str, more: &str| {
            if number > 0 {
                lost.push(format!("{number} {}", if number == 1 { one } else { more }));
            }
        };
        let total = |of: &dyn Fn(usize) -> usize| branch.iter().map(|&link| of(link)).sum();
        count(total(&|link| self.link(link).visuals.len()), "visual", "visuals");
        count(total(&|link| self.link(link).collisions.len()), "collision", "collisions");
        count(total(&|link| usize::from(self.link(link).inertial.is_some())), "mass", "masses");
        let settings = |link: usize| self.extensions.settings(&self.link(link).name).count();
        count(total(&settings), "setting of Gazebo", "settings of Gazebo");
        // A robot without any mass was written for visualization only.
        let only_shown = self.plan.massless.len() == 1 && self.is_only_shown();
        // For a branch below the root, Gazebo loads the rest of the robot; for the root, it loads nothing.
        let has_rest = self.joint_above(link).is_some();
        let severity = if lost.is_empty() || only_shown || has_rest {
            Severity::Warning
        } else {
            Severity::Error
        };
        let what = match self.joint_above(link) {
            Some(joint) => format!(
                "the link `{name}` has no mass, and its joint `{}` does not merge it into another",
                joint.name
            ),
            None => format!("the root link `{name}` has no mass, and nothing merges into it"),
        };
        let others = branch.len() - 1;
        let with = match others {
            0 => String::new(),
            1 => " with the link below it".to_owned(),
            _ => format!(" with the {others} links below it"),
        };
        let warning = Diagnostic::new(severity, "massless-link", what)
            .at(self.link(link).origin)
            .label(if lost.is_empty() {
                "it is kept as a frame".to_owned()
            } else {
                format!("lost: {}", lost.join(", "))
            })
            .note(format!("Gazebo leaves it out{with}; here frames stay, at joint position zero"));
        warning.help(crate::advice::mass::advised(self.link(link)))
    }

    /// Returns true if no link of the robot has a mass.
    fn is_only_shown(&self) -> bool {
        let order = &self.plan.order;
        order.iter().all(|&link| self.link(link).inertial.is_none())
    }

    /// The link `world` is not a body, so shapes and masses of it are dropped.
    fn check_world_link(&self, diagnostics: &mut Diagnostics) {
        for &link in &self.plan.order {
            let data = self.link(link);
            let is_world = self.plan.outcome[link] == LumpOutcome::World;
            let full = !data.visuals.is_empty() || !data.collisions.is_empty();
            if is_world && full {
                diagnostics.push(
                    Diagnostic::error(
                        "world-link",
                        "shapes and masses of the root link `world` are lost: this link represents the world",
                    )
                    .at(data.origin)
                    .help("move it to a link of another name, on a fixed joint to `world`"),
                );
            } else if !is_world && data.name == WORLD {
                diagnostics.push(
                    Diagnostic::error("reserved-name", "only the root link may be named `world`")
                        .at(data.origin)
                        .help("rename it"),
                );
            }
        }
    }

    /// Settings of a joint that is merged away have nothing to act on.
    fn check_merged_joints(&self, diagnostics: &mut Diagnostics) {
        for &link in &self.plan.order {
            let LumpOutcome::Merged { .. } = self.plan.outcome[link] else { continue };
            let Some(joint) = self.joint_above(link) else { continue };
            // A link of the same name takes the settings.
            if self.tree.index.contains_key(&*joint.name) {
                continue;
            }
            for setting in self.extensions.settings(&joint.name) {
                if ["preserveFixedJoint", "disableFixedJointLumping"].contains(&&*setting.name) {
                    continue;
                }
                diagnostics.push(
                    Diagnostic::warning(
                        "merged-joint",
                        format!("the fixed joint `{}` is merged away", joint.name),
                    )
                    .at(setting.origin)
                    .label("lost, in Gazebo too")
                    .help(format!(
                        "keep the joint: <gazebo reference=\"{}\"><preserveFixedJoint>true\
                         </preserveFixedJoint></gazebo>",
                        joint.name
                    )),
                );
            }
        }
    }
}
