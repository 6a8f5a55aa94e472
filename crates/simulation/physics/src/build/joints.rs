//! What joins the bodies of a model.

use periplus_diagnostics::{Diagnostic, closest};
use periplus_scene::{Joint, JointKind};

use super::Builder;
use crate::joints::{Axes, axes_of};
use crate::limits::is_pose;
use crate::places::End;
use crate::records::{JointRecord, WORLD_BODY};

/// A mass this many times another one across a joint is worth a warning: impulses reach the far
/// side of such a joint only in part.
const STEEP_RATIO: f64 = 1000.0;

impl Builder<'_, '_> {
    /// None where the joint makes the model impossible.
    pub(super) fn joint(&mut self, scope: &str, joint: &Joint) -> Option<()> {
        let name = format!("{scope}{}", joint.name);
        let ends = (self.flat.end(scope, &joint.parent), self.flat.end(scope, &joint.child));
        let body_of = |end: End| match end {
            End::World => WORLD_BODY,
            End::Link(link, _) => self.records.links[self.first_link + link].body,
        };
        let (parent, child, model_from_child) = match ends {
            (Some(parent), Some(child @ End::Link(_, pose))) => {
                (body_of(parent), body_of(child), pose)
            }
            (parent, _) => {
                let missing = if parent.is_none() { &joint.parent } else { &joint.child };
                let known: Vec<&str> =
                    self.flat.links.iter().map(|(name, ..)| name.as_str()).collect();
                let mut found = Diagnostic::error(
                    "joint-end-unknown",
                    format!(
                        "joint `{name}` holds `{missing}`, which is no link, frame or model here"
                    ),
                )
                .at(joint.origin)
                .note("the joint is left out");
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
                    format!("the pose of joint `{}` is no number, or too far away", record.name),
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
                        "joint `{}` moves nothing: both sides are fixed to each other",
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

    pub(super) fn warn_of_steep_masses(&mut self) {
        let axes = self.records.joints.iter().filter(|joint| joint.model == self.number);
        for joint in axes {
            for axis in &self.records.axes[joint.axes.clone()] {
                let mass = |body: usize| self.records.bodies[body].mass.mass();
                let (a, b) = (mass(axis.body1), mass(axis.body2));
                if a > 0.0 && b > 0.0 && (a / b).max(b / a) > STEEP_RATIO {
                    self.diagnostics.push(
                        Diagnostic::warning(
                            "steep-masses",
                            format!(
                                "joint `{}` holds {a} kg against {b} kg; it may give way",
                                joint.name
                            ),
                        )
                        .help("make the lighter link heavier, or fix it to the other"),
                    );
                }
            }
        }
    }
}
