//! Grouping of links into rigid bodies.

use periplus_diagnostics::Severity;
use periplus_scene::{JointKind, Model};
use rapier3d_f64::parry::mass_properties::MassProperties;

use super::{Builder, rapier_pose};
use crate::flat_model::JointEnd;
use crate::inertia::{mass_properties, no_mass, transformed};
use crate::records::{Body, BodyKind, LinkRecord};

impl Builder<'_, '_> {
    /// Returns for each link the lowest link of the same rigid body; `None` for the world's body.
    pub(super) fn groups(&mut self, is_static: bool) -> Vec<Option<usize>> {
        let count = self.flat.links.len();
        if is_static {
            return vec![None; count];
        }
        // Union-find in which the world has the number after the last link.
        let mut above: Vec<usize> = (0..=count).collect();
        fn find(above: &mut [usize], mut member: usize) -> usize {
            while above[member] != member {
                above[member] = above[above[member]];
                member = above[member];
            }
            member
        }
        for (scope, joint) in &self.flat.joints {
            let rigid = joint.kind == JointKind::Fixed;
            let number = |end: Option<JointEnd>| match end {
                Some(JointEnd::PhysicsWorld) => Some(count),
                Some(JointEnd::Link(link, _)) => Some(link),
                None => None,
            };
            let ends = (
                number(self.flat.end(scope, &joint.parent)),
                number(self.flat.end(scope, &joint.child)),
            );
            if let (true, (Some(a), Some(b))) = (rigid, ends) {
                let (a, b) = (find(&mut above, a), find(&mut above, b));
                // The world is the root of its group; otherwise the lowest link is the root.
                let (low, high) = if a == count || (b != count && a < b) { (a, b) } else { (b, a) };
                above[high] = low;
            }
        }
        (0..count).map(|link| Some(find(&mut above, link)).filter(|&root| root != count)).collect()
    }

    pub(super) fn bodies(&mut self, model: &Model, group_of_link: &[Option<usize>]) -> Option<()> {
        let mut refused = false;
        let mut body_of_group: Vec<Option<usize>> = vec![None; self.flat.links.len() + 1];
        for (number, group) in group_of_link.iter().enumerate() {
            let (name, link, model_from_link) = &self.flat.links[number];
            let world_from_link = self.world_from_model * *model_from_link;
            let slot = group.unwrap_or(self.flat.links.len());
            let body = match body_of_group[slot] {
                Some(body) => body,
                None => {
                    let kind = match (group, link.kinematic) {
                        (None, _) => BodyKind::Fixed,
                        (_, true) => BodyKind::Kinematic,
                        _ => BodyKind::Dynamic,
                    };
                    self.records.bodies.push(Body {
                        name: format!("{}::{name}", model.name),
                        kind,
                        world_from_body: world_from_link,
                        mass: MassProperties::default(),
                        weight_share: 0.0,
                        damping: link.velocity_decay,
                        can_sleep: model.allow_auto_disable,
                        colliders: Vec::new(),
                        anisotropic_colliders: Vec::new(),
                        removed: false,
                    });
                    self.records.bodies.len() - 1
                }
            };
            body_of_group[slot] = Some(body);
            let record = &mut self.records.bodies[body];
            let body_from_link = record.world_from_body.inverse() * world_from_link;
            if record.kind == BodyKind::Dynamic {
                let warnings = self.diagnostics.count(Severity::Warning);
                let Some(mass) = mass_properties(link, name, self.diagnostics) else {
                    // Continue, so that problems of the other links are reported too.
                    refused = true;
                    continue;
                };
                if self.diagnostics.count(Severity::Warning) > warnings {
                    self.without_inertia.push(body);
                }
                record.mass += transformed(mass, &rapier_pose(body_from_link));
                if link.gravity {
                    record.weight_share += link.inertial.mass_kg;
                }
            }
            self.records.links.push(LinkRecord {
                model: self.number,
                name: name.clone(),
                body,
                body_from_link,
                collisions: link.collisions.iter().map(|found| found.name.clone()).collect(),
                stiffness_n_m: vec![None; link.collisions.len()],
            });
        }
        for (slot, body) in body_of_group.iter().enumerate() {
            let Some(body) = body.map(|body| &self.records.bodies[body]) else { continue };
            if !refused && body.kind == BodyKind::Dynamic && body.mass.mass() <= 0.0 {
                let (name, link, _) = &self.flat.links[slot];
                self.diagnostics.push(no_mass(link, name));
                refused = true;
            }
        }
        (!refused).then_some(())
    }
}
