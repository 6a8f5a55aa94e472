//! Collision shapes of a model.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose};
use periplus_scene::{JointKind, Model};
use rapier3d_f64::geometry::SharedShape;

use super::Builder;
use super::surface::Surface;
use crate::compliance::stiffness;
use crate::flat_model::JointEnd;
use crate::hooks::{ColliderTag, WheelPart};
use crate::limits::{MAX_POSITION_M, is_pose};
use crate::records::BodyKind;
use crate::shapes::{Meshes, shape};
use crate::wheels::wheel;

/// Radius of a wheel's core relative to its tread, so that the core never carries load.
const CORE_RADIUS_RATIO: f64 = 0.9;

impl Builder<'_, '_> {
    pub(super) fn collisions(&mut self, model: &Model, meshes: &dyn Meshes) {
        let first = self.first_link;
        // A hook costs time in every step: only models of several bodies need self-collision data.
        let bodies: std::collections::BTreeSet<usize> =
            self.records.links[first..].iter().map(|link| link.body).collect();
        let several = bodies.len() > 1;
        let mut own: Vec<usize> = bodies.into_iter().collect();
        own.retain(|&body| self.records.bodies[body].kind == BodyKind::Dynamic);
        let mass_kg: f64 = own.iter().map(|&body| self.records.bodies[body].mass.mass()).sum();
        let axles = self.axles();
        for (number, axle) in axles.into_iter().enumerate() {
            let (name, link, _) = &self.flat.links[number];
            let link_number = first + number;
            let (body, body_from_link) = (
                self.records.links[link_number].body,
                self.records.links[link_number].body_from_link,
            );
            let moves = self.records.bodies[body].kind != BodyKind::Fixed;
            for (index, collision) in link.collisions.iter().enumerate() {
                let scoped = format!("{name}::{}", collision.name);
                let Ok(index) = u16::try_from(index) else {
                    self.diagnostics.push(
                        Diagnostic::warning(
                            "too-many-collisions",
                            format!(
                                "`{name}` has more than 65536 collisions; the others are ignored"
                            ),
                        )
                        .at(link.origin),
                    );
                    break;
                };
                let finite = is_pose(collision.link_from_collision)
                    && collision.surface.friction.mu.is_finite()
                        | (collision.surface.friction.mu > 0.0);
                if !finite {
                    self.diagnostics.push(
                        Diagnostic::error(
                            "collision-out-of-range",
                            format!("the pose or friction of collision `{scoped}` is not finite, or beyond {MAX_POSITION_M} m"),
                        )
                        .at(collision.origin),
                    );
                    continue;
                }
                let Some((collision_from_shape, solid)) =
                    shape(collision, &scoped, moves, meshes, self.diagnostics)
                else {
                    continue;
                };
                let body_from_collision = body_from_link * collision.link_from_collision;
                let tag = |part| ColliderTag {
                    link: link_number as u32,
                    collision: index,
                    self_collide: link.self_collide || model.self_collide,
                    is_sensor: collision.surface.contact.collide_without_contact,
                    part,
                };
                let contact = &collision.surface.contact;
                let stiffness = stiffness(mass_kg, own.len() > 1, contact.kp, contact.min_depth_m);
                let stiffness = stiffness.filter(|_| moves);
                if let Some(slot) =
                    self.records.links[link_number].stiffness_n_m.get_mut(usize::from(index))
                {
                    *slot = stiffness;
                }
                let surface = Surface::of(collision, &scoped, moves, self.diagnostics)
                    .softened(stiffness.is_some());
                let anisotropic_friction = self.anisotropic_friction(number, collision, &scoped);
                let anisotropic_friction = anisotropic_friction.unwrap_or_else(|missing| {
                    self.diagnostics.push(*missing);
                    None
                });
                let mut push =
                    |solid: SharedShape, pose: Pose, tag: ColliderTag| {
                        let collider = surface.collider(solid, pose, tag, several);
                        let body = &mut self.records.bodies[body];
                        body.anisotropic_colliders.extend(anisotropic_friction.map(
                            |anisotropic_friction| (body.colliders.len(), anisotropic_friction),
                        ));
                        body.colliders.push(collider);
                    };
                let found = axle
                    .and_then(|axle| wheel(&collision.shape, collision.link_from_collision, axle));
                match found {
                    Some(wheel) => {
                        let tread = SharedShape::ball(wheel.radius_m);
                        push(tread, body_from_collision, tag(WheelPart::Tread(wheel.half_width_m)));
                        let core = SharedShape::cylinder(
                            wheel.half_width_m,
                            wheel.radius_m * CORE_RADIUS_RATIO,
                        );
                        push(
                            core,
                            body_from_collision * collision_from_shape,
                            tag(WheelPart::Core),
                        );
                    }
                    None => {
                        push(
                            solid,
                            body_from_collision * collision_from_shape,
                            tag(WheelPart::Whole),
                        );
                    }
                }
            }
        }
    }

    /// Returns for each link with exactly one parent hinge a point and the direction of the hinge
    /// axis, in the link's frame.
    fn axles(&self) -> Vec<Option<(DVec3, DVec3)>> {
        let mut axles = vec![None; self.flat.links.len()];
        for (scope, joint) in &self.flat.joints {
            let turns = matches!(joint.kind, JointKind::Revolute | JointKind::Continuous);
            let (Some(JointEnd::Link(link, model_from_child)), Some(axis), true) =
                (self.flat.end(scope, &joint.child), &joint.axis, turns)
            else {
                continue;
            };
            let link_from_joint =
                self.flat.links[link].2.inverse() * model_from_child * joint.child_from_joint;
            let direction = link_from_joint.rotation * axis.direction_in_joint.normalize_or_zero();
            axles[link] = Some((link_from_joint.translation, direction));
        }
        axles
    }
}
