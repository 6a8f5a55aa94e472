//! Forces of anisotropic friction.

use periplus_geometry::DVec3;
use rapier3d_f64::dynamics::RigidBody;
use rapier3d_f64::geometry::PairContacts;

use super::{Rigid, apply_force_at};
use crate::build::scene_pose;

/// A force in the next step.
struct FrictionForce {
    bodies: [Option<rapier3d_f64::dynamics::RigidBodyHandle>; 2],
    at_m: DVec3,
    /// Force on the first body; the second gets the opposite.
    force_n: DVec3,
}

impl Rigid {
    /// Applies forces at the contacts of the last step against slip along the direction of higher
    /// friction, by Coulomb's law with that step's pressure, limited to the force that stops the
    /// slip at once. (Force = slip / (compliance of both bodies at the point * step), after Baraff
    /// 1989, for one point and one direction.)
    pub(super) fn apply_friction(&mut self, dt_s: f64) {
        if self.anisotropic_colliders.is_empty() {
            return;
        }
        let friction_forces = self.friction_forces(dt_s);
        for apply_force in friction_forces {
            for (body, sign) in apply_force.bodies.into_iter().zip([1.0, -1.0]) {
                let Some(body) = body.and_then(|handle| self.solver.bodies.get_mut(handle)) else {
                    continue;
                };
                if body.is_dynamic() {
                    let com = body.mass_properties().local_mprops.local_com;
                    apply_force_at(body, com, apply_force.at_m, apply_force.force_n * sign);
                    self.has_external_forces = true;
                }
            }
        }
    }

    fn friction_forces(&self, dt_s: f64) -> Vec<FrictionForce> {
        let (solver, mut friction_forces) = (&self.solver, Vec::new());
        for (handle, anisotropic_friction) in &self.anisotropic_colliders {
            let frame = self.bodies.get(anisotropic_friction.frame_body).copied().flatten();
            let own = solver.colliders[*handle].parent();
            let (Some(frame), Some(own)) = (frame, own) else { continue };
            if solver.bodies[own].is_sleeping() {
                continue;
            }
            let first = solver.bodies[frame].rotation() * anisotropic_friction.first_in_frame;
            for pair in solver.narrow_phase.contact_pairs_with(*handle) {
                let PairContacts::Rigid(rigid) = &pair.contacts else { continue };
                let is_first = pair.collider1 == *handle;
                let other = if is_first { pair.collider2 } else { pair.collider1 };
                // The pair of a removed collider stays until the next step.
                let Some(other) = solver.colliders.get(other) else { continue };
                let bodies = [Some(own), other.parent()];
                for manifold in rigid.solver_manifolds() {
                    if manifold.data.solver_contacts.is_empty() {
                        continue;
                    }
                    let along =
                        anisotropic_friction.along(first, manifold.data.normal, other.friction());
                    let Some((way, mu)) = along else { continue };
                    let from_shape = manifold.subshape_pos1().map(scene_pose).unwrap_or_default();
                    let world_from_one =
                        scene_pose(solver.colliders[pair.collider1].position()) * from_shape;
                    let pressed = || manifold.points.iter().filter(|it| it.data.impulse > 0.0);
                    let share = 1.0 / pressed().count().max(1) as f64;
                    for point in pressed() {
                        let at_m = world_from_one.transform_point(point.local_p1);
                        let (mut slip_m_s, mut compliance) = (0.0, 0.0);
                        for (body, sign) in bodies.into_iter().zip([1.0, -1.0]) {
                            let Some(body) = body.map(|handle| &solver.bodies[handle]) else {
                                continue;
                            };
                            slip_m_s += sign * body.velocity_at_point(at_m).dot(way);
                            compliance += compliance_along(body, at_m, way);
                        }
                        if compliance <= 0.0 {
                            continue;
                        }
                        let most_n = mu * point.data.impulse / dt_s;
                        let stop_n = share * slip_m_s / (compliance * dt_s);
                        let force_n = way * -stop_n.clamp(-most_n, most_n);
                        friction_forces.push(FrictionForce { bodies, at_m, force_n });
                    }
                }
            }
        }
        friction_forces
    }
}

/// Returns the velocity change of a body's point along a direction per unit impulse there [1/kg].
fn compliance_along(body: &RigidBody, at_m: DVec3, way: DVec3) -> f64 {
    if !body.is_dynamic() {
        return 0.0;
    }
    let mass = body.mass_properties();
    let lever = (at_m - mass.world_com).cross(way);
    mass.effective_inv_mass.x + lever.dot(mass.effective_world_inv_inertia * lever)
}
