//! Joints between the bodies of a model.

use periplus_diagnostics::{Diagnostic, closest};
use periplus_scene::{Joint, JointKind};

use super::Builder;
use crate::flat_model::JointEnd;
use crate::joints::{Axes, axes_of};
use crate::limits::is_pose;
use crate::records::{JointRecord, WORLD_BODY_INDEX};

/// Mass ratio across a joint that is reported: impulses only partly reach the far side of such a
/// joint.
const MAX_MASS_RATIO: f64 = 1000.0;

impl Builder<'_, '_> {
    /// Returns `None` for a joint that makes the model invalid.
    pub(super) fn joint(&mut self, scope: &str, joint: &Joint) -> Option<()> {
        let name = format!("{scope}{}", joint.name);
        let ends = (self.flat.end(scope, &joint.parent), self.flat.end(scope, &joint.child));
        let body_of = |end: JointEnd| match end {
            JointEnd::PhysicsWorld => WORLD_BODY_INDEX,
            JointEnd::Link(link, _) => self.records.links[self.first_link + link].body,
        };
        let (parent, child, model_from_child) = match ends {
            (Some(parent), Some(child @ JointEnd::Link(_, pose))) => {
                (body_of(parent), body_of(child), pose)
            }
            (parent, _) => {
                let missing = if parent.is_none() { &joint.parent } else { &joint.child };
                let known: Vec<&str> =
                    self.flat.links.iter().map(|(name, ..)| name.as_str()).collect();
                let mut found = Diagnostic::error(
                    "joint-end-unknown",
                    format!(
                        "joint `{name}` connects `{missing}`, which is not a link, frame or model"
                    ),
                )
                .at(joint.origin)
                .note("the joint is omitted");
                if let Some(near) = closest(missing, known) {
                    found = found.help(format!("did you mean `{near}`?"));
                }
                self.diagnostics.push(found);
                return Some(());
            }
        };
        let mut record = JointRecord {
            model: self.number,
            name,
            axes: self.records.axes.len()..self.records.axes.len(),
        };
        let rigid =
            matches!(joint.kind, JointKind::Fixed | JointKind::Floating | JointKind::Gearbox);
        let world_from_joint = self.world_from_model * model_from_child * joint.child_from_joint;
        if !is_pose(world_from_joint) {
            self.diagnostics.push(
                Diagnostic::error(
                    "joint-impossible",
                    format!("the pose of joint `{}` is not finite, or too far away", record.name),
                )
                .at(joint.origin),
            );
            return None;
        }
        if !rigid && parent == child {
            self.diagnostics.push(
                Diagnostic::warning(
                    "joint-inside-a-body",
                    format!(
                        "joint `{}` has no effect: both links are fixed to each other",
                        record.name
                    ),
                )
                .at(joint.origin),
            );
        } else if !rigid {
            let place = Axes { parent, child, world_from_joint };
            axes_of(joint, &record.name, place, self.records, self.diagnostics)?;
        }
        record.axes.end = self.records.axes.len();
        self.records.joints.push(record);
        Some(())
    }

    pub(super) fn warn_of_mass_ratios(&mut self) {
        let axes = self.records.joints.iter().filter(|joint| joint.model == self.number);
        for joint in axes {
            for axis in &self.records.axes[joint.axes.clone()] {
                let mass = |body: usize| self.records.bodies[body].mass.mass();
                let (a, b) = (mass(axis.body1), mass(axis.body2));
                if a > 0.0 && b > 0.0 && (a / b).max(b / a) > MAX_MASS_RATIO {
                    self.diagnostics.push(
                        Diagnostic::warning(
                            "steep-masses",
                            format!(
                                "joint `{}` connects {a} kg and {b} kg; it may yield under load",
                                joint.name
                            ),
                        )
                        .help("increase the mass of the lighter link, or fix it to the other"),
                    );
                }
            }
        }
    }
}
