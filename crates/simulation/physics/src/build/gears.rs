//! Coupled axes: mimic joints and gearboxes.

use periplus_diagnostics::Diagnostic;
use periplus_scene::{Axis, DVec3, Joint, JointKind};

use super::Builder;
use crate::flat_model::JointEnd;
use crate::joints::MimicCoupling;
use crate::records::JointRecord;

impl Builder<'_, '_> {
    /// Couples mimic axes to their leaders.
    pub(super) fn mimics(&mut self) {
        for number in 0..self.flat.joints.len() {
            let (scope, joint) = self.flat.joints[number].clone();
            for (which, axis) in [&joint.axis, &joint.axis2].into_iter().enumerate() {
                if let Some(axis) = axis {
                    self.mimic(&scope, joint, axis, which);
                }
            }
            if joint.kind == JointKind::Gearbox {
                self.gearbox(&scope, joint);
            }
        }
    }

    fn mimic(&mut self, scope: &str, joint: &Joint, axis: &Axis, which: usize) {
        let Some(mimic) = &axis.mimic else { return };
        let leader = self.record_of(scope, &mimic.joint).and_then(|leader| {
            let second = usize::from(mimic.axis == "axis2");
            leader.axes.clone().nth(second)
        });
        let follower =
            self.record_of(scope, &joint.name).and_then(|record| record.axes.clone().nth(which));
        match (leader, follower) {
            (Some(leader), Some(follower)) if leader != follower => {
                self.records.axes[follower].mimics = Some(MimicCoupling {
                    leader,
                    multiplier: mimic.multiplier,
                    offset: mimic.offset - mimic.multiplier * mimic.reference,
                });
            }
            _ => self.diagnostics.push(
                Diagnostic::warning(
                    "mimic-of-nothing",
                    format!(
                        "joint `{}` mimics `{}`, which is not a movable joint; it moves freely",
                        joint.name, mimic.joint
                    ),
                )
                .at(joint.origin),
            ),
        }
    }

    fn record_of(&self, scope: &str, name: &str) -> Option<&JointRecord> {
        let scoped = format!("{scope}{name}");
        let mut records = self.records.joints.iter();
        records.find(|record| record.model == self.number && record.name == scoped)
    }

    /// Couples `angle 2 = -ratio * angle 1` of child and parent relative to the reference body, each
    /// about its axis (SDF, `<gearbox_ratio>`). The child's hinge follows the parent's.
    fn gearbox(&mut self, scope: &str, joint: &Joint) {
        let text = |name: &str| {
            let element = joint.extra.iter().find(|element| element.local_name() == name);
            element.map(|element| element.text().trim().to_owned())
        };
        let ratio = text("gearbox_ratio").map_or(Some(1.0), |text| text.parse::<f64>().ok());
        let reference = text("gearbox_reference_body").unwrap_or_default();
        let axes = (&joint.axis, joint.axis2.as_ref().or(joint.axis.as_ref()));
        let found = match (ratio.filter(|ratio| ratio.is_finite()), axes) {
            (Some(ratio), (Some(axis), Some(axis2))) => {
                let direction = |axis: &Axis| self.direction_in_model(scope, joint, axis);
                let parent = self.hinge(scope, &reference, &joint.parent, direction(axis));
                let child = self.hinge(scope, &reference, &joint.child, direction(axis2));
                parent.zip(child).map(|(parent, child)| (ratio, parent, child))
            }
            _ => None,
        };
        match found {
            Some((ratio, (leader, one), (follower, two))) if leader != follower => {
                let multiplier = -ratio * one * two;
                self.records.axes[follower].mimics =
                    Some(MimicCoupling { leader, multiplier, offset: 0.0 });
            }
            _ => self.diagnostics.push(
                Diagnostic::warning(
                    "joint-not-simulated",
                    format!("gearbox `{}` has no effect", joint.name),
                )
                .at(joint.origin)
                .help("connect its parent and its child each by a hinge to the <gearbox_reference_body>"),
            ),
        }
    }

    fn direction_in_model(&self, scope: &str, joint: &Joint, axis: &Axis) -> DVec3 {
        match self.flat.end(scope, &joint.child) {
            Some(JointEnd::Link(_, model_from_child)) => {
                (model_from_child * joint.child_from_joint).rotation * axis.direction_in_joint
            }
            _ => axis.direction_in_joint,
        }
    }

    /// Returns the axis of the hinge between two bodies, and the sign of the second body's rotation
    /// relative to the first about this direction.
    fn hinge(
        &self,
        scope: &str,
        reference: &str,
        other: &str,
        direction_in_model: DVec3,
    ) -> Option<(usize, f64)> {
        let body = |name: &str| match self.flat.end(scope, name)? {
            JointEnd::PhysicsWorld => Some(crate::records::WORLD_BODY_INDEX),
            JointEnd::Link(link, _) => Some(self.records.links[self.first_link + link].body),
        };
        let named = Some(reference).filter(|name| !name.is_empty())?;
        let (reference, other) = (body(named)?, body(other)?);
        let direction = self.world_from_model.rotation * direction_in_model;
        let axes = self.records.axes.iter().enumerate().filter(|(_, axis)| !axis.slides);
        let mut signs = axes.filter_map(|(number, axis)| {
            let order = match (axis.body1, axis.body2) {
                (one, two) if (one, two) == (reference, other) => 1.0,
                (one, two) if (two, one) == (reference, other) => -1.0,
                _ => return None,
            };
            let world_from_axis =
                self.records.bodies[axis.body1].world_from_body * axis.body1_from_axis;
            let along = (world_from_axis.rotation * DVec3::X).dot(direction);
            Some((number, order * f64::copysign(1.0, along)))
        });
        signs.next_back()
    }
}
