//! Contact filters beyond bit masks.

use rapier3d_f64::dynamics::{IntegrationParameters, RigidBody};
use rapier3d_f64::geometry::SolverFlags;
use rapier3d_f64::math::Vector;
use rapier3d_f64::pipeline::{ContactModificationContext, PairFilterContext, PhysicsHooks};
use rapier3d_f64::prelude::ColliderHandle;

use crate::compliance::{effective_mass, in_series, seen_depth};
use crate::records::LinkRecord;

/// Data of a collider, packed into its 128 bits of user data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ColliderTag {
    pub(crate) link: u32,
    /// Index of the link's collision.
    pub(crate) collision: u16,
    pub(crate) self_collide: bool,
    /// True for a sensor: reports contacts without forces.
    pub(crate) is_sensor: bool,
    pub(crate) part: WheelPart,
}

/// Part of a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum WheelPart {
    /// An ordinary shape.
    Whole,
    /// Tread, a ball; its contacts count within this distance of the wheel's plane [m].
    Tread(f64),
    /// Core; its contacts count if they point along the axle.
    Core,
}

const SELF_COLLIDE_MASK: u128 = 1 << 48;
const SENSOR_MASK: u128 = 1 << 49;
const TREAD_MASK: u128 = 1 << 50;
const CORE_MASK: u128 = 1 << 51;

impl ColliderTag {
    pub(crate) fn pack(self) -> u128 {
        let mut bits = u128::from(self.link) | u128::from(self.collision) << 32;
        if self.self_collide {
            bits |= SELF_COLLIDE_MASK;
        }
        if self.is_sensor {
            bits |= SENSOR_MASK;
        }
        match self.part {
            WheelPart::Whole => bits,
            WheelPart::Tread(half_width_m) => {
                bits | TREAD_MASK | u128::from(half_width_m.to_bits()) << 64
            }
            WheelPart::Core => bits | CORE_MASK,
        }
    }

    pub(crate) fn unpack(bits: u128) -> Self {
        let part = if bits & TREAD_MASK != 0 {
            WheelPart::Tread(f64::from_bits((bits >> 64) as u64))
        } else if bits & CORE_MASK != 0 {
            WheelPart::Core
        } else {
            WheelPart::Whole
        };
        Self {
            link: bits as u32,
            collision: (bits >> 32) as u16,
            self_collide: bits & SELF_COLLIDE_MASK != 0,
            is_sensor: bits & SENSOR_MASK != 0,
            part,
        }
    }
}

/// Contact filter and modifier for rapier.
pub(crate) struct Hooks<'a> {
    /// The model of each link.
    pub(crate) model_of_link: &'a [u32],
    /// The links, for the stiffness of their contacts.
    pub(crate) links: &'a [LinkRecord],
    /// Integration parameters of the step.
    pub(crate) parameters: IntegrationParameters,
}

impl Hooks<'_> {
    /// Returns the stiffness of the contacts of a collision [N/m].
    fn stiffness(&self, tag: ColliderTag) -> Option<f64> {
        let link = self.links.get(tag.link as usize)?;
        link.stiffness_n_m.get(usize::from(tag.collision)).copied().flatten()
    }

    /// Scales penetrating contacts by their stiffness.
    fn soften(&self, context: &mut ContactModificationContext<'_>) {
        let tag = |handle: ColliderHandle| ColliderTag::unpack(context.colliders[handle].user_data);
        let (one, two) = (tag(context.collider1), tag(context.collider2));
        let Some(stiffness_n_m) = in_series(self.stiffness(one), self.stiffness(two)) else {
            return;
        };
        let bodies = [context.rigid_body1, context.rigid_body2]
            .map(|handle| handle.and_then(|handle| context.bodies.get(handle)));
        let on_fixed = bodies.iter().any(|body| body.is_none_or(RigidBody::is_fixed));
        let parameters = &self.parameters;
        let spring = if on_fixed {
            &parameters.static_contact_softness
        } else {
            &parameters.contact_softness
        };
        let Some(manifold) = context.rigid_mut() else { return };
        let normal = *manifold.normal;
        for contact in manifold.solver_contacts.iter_mut().filter(|contact| contact.dist < 0.0) {
            let at_m = (contact.anchor1 + contact.anchor2) / 2.0;
            let mass_kg = effective_mass(bodies, at_m, normal);
            contact.dist = -seen_depth(-contact.dist, stiffness_n_m, mass_kg, spring, parameters);
        }
    }
}

impl PhysicsHooks for Hooks<'_> {
    fn filter_contact_pair(&self, context: &PairFilterContext<'_>) -> Option<SolverFlags> {
        let tag = |handle: ColliderHandle| ColliderTag::unpack(context.colliders[handle].user_data);
        let (a, b) = (tag(context.collider1), tag(context.collider2));
        let model = |tag: ColliderTag| self.model_of_link.get(tag.link as usize);
        if model(a) == model(b) && !(a.self_collide && b.self_collide) {
            return None;
        }
        let pushes = !(a.is_sensor || b.is_sensor);
        Some(if pushes { SolverFlags::COMPUTE_RIGID_IMPULSES } else { SolverFlags::empty() })
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext<'_>) {
        let normal = match context.rigid() {
            Some(manifold) => *manifold.normal,
            None => return,
        };
        let colliders = context.colliders;
        let keeps = |handle: ColliderHandle| {
            let collider = &colliders[handle];
            let part = ColliderTag::unpack(collider.user_data).part;
            // The ball keeps the frame of the collision; the solver's cylinders have their axis
            // along y.
            let along = if part == WheelPart::Core { Vector::Y } else { Vector::Z };
            let axle = collider.rotation() * along;
            let reach = collider.shape().as_ball().map_or(0.0, |ball| ball.radius);
            touches(part, normal.dot(axle).abs(), reach)
        };
        let keep = keeps(context.collider1) && keeps(context.collider2);
        if !keep && let Some(manifold) = context.rigid_mut() {
            manifold.solver_contacts.clear();
        }
        if keep {
            self.soften(context);
        }
    }
}

/// Returns true if a contact of a part of a wheel counts, by the sine of the angle between its
/// normal and the wheel's plane.
fn touches(part: WheelPart, sine: f64, ball_radius_m: f64) -> bool {
    match part {
        WheelPart::Whole => true,
        // The contact point of a ball is `radius * sine` beside the wheel's plane.
        WheelPart::Tread(half_width_m) => ball_radius_m * sine <= half_width_m,
        // More along the axle than across.
        WheelPart::Core => sine > std::f64::consts::FRAC_1_SQRT_2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_come_back() {
        for part in [WheelPart::Whole, WheelPart::Tread(0.02), WheelPart::Core] {
            let tag = ColliderTag {
                link: u32::MAX,
                collision: 7,
                self_collide: true,
                is_sensor: false,
                part,
            };
            assert_eq!(ColliderTag::unpack(tag.pack()), tag);
        }
    }

    #[test]
    fn a_tread_of_four_centimetres() {
        // A wheel of 10 cm radius leaning by 0.1 rad has its contact 1 cm beside its middle.
        assert!(touches(WheelPart::Tread(0.02), 0.1, 0.1));
        // A wall beside it is in contact with the core.
        assert!(!touches(WheelPart::Tread(0.02), 1.0, 0.1));
        assert!(touches(WheelPart::Core, 1.0, 0.0) && !touches(WheelPart::Core, 0.1, 0.0));
    }
}
