//! Friction and restitution.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose};
use periplus_scene::Collision;
use rapier3d_f64::dynamics::CoefficientCombineRule;
use rapier3d_f64::geometry::{
    ColliderBuilder, Group, InteractionGroups, InteractionTestMode, SharedShape,
};
use rapier3d_f64::pipeline::ActiveHooks;

use super::rapier_pose;
use crate::hooks::{ColliderTag, WheelPart};

/// Maximum coefficient of friction: no slope is steeper, and products stay finite.
const MAX_FRICTION_RATIO: f64 = 1e6;

/// Converts a coefficient for the solver; ODE treats a negative one as infinite.
pub(super) fn coefficient(mu: f64) -> f64 {
    if mu < 0.0 { MAX_FRICTION_RATIO } else { mu.min(MAX_FRICTION_RATIO) }
}

/// Friction and restitution of a collision.
pub(super) struct Surface {
    friction: f64,
    restitution: f64,
    mask: u32,
    reports: bool,
    is_softened: bool,
}

impl Surface {
    pub(super) fn of(
        collision: &Collision,
        name: &str,
        moves: bool,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let (friction, contact) = (&collision.surface.friction, &collision.surface.contact);
        let (mu, mu2) = (coefficient(friction.mu), coefficient(friction.mu2));
        // The floor of many worlds has 100 and 50: the other surface of a contact decides.
        let is_rough_ground = !moves && mu.min(mu2) >= 1.0;
        if mu != mu2 && friction.fdir1 == DVec3::ZERO && !is_rough_ground {
            diagnostics.push(
                Diagnostic::warning(
                    "friction-one-direction",
                    format!("collision `{name}` has friction {mu} in one direction and {mu2} in the other"),
                )
                .at(collision.origin)
                .note(
                    "the smaller one applies in all directions; set `<fdir1>` to define the first direction",
                ),
            );
        }
        // Gazebo's restitution has a threshold, whose default is never reached.
        let bounces = contact.bounce_threshold_m_s < 1000.0 && !contact.restitution.is_nan();
        let restitution = if bounces { contact.restitution.clamp(0.0, 1.0) } else { 0.0 };
        Self {
            friction: mu.min(mu2),
            restitution,
            mask: contact.collide_bitmask,
            reports: contact.collide_without_contact,
            is_softened: false,
        }
    }

    /// Returns the surface with its own stiffness.
    pub(super) fn softened(self, is_softened: bool) -> Self {
        Self { is_softened, ..self }
    }

    pub(super) fn collider(
        &self,
        shape: SharedShape,
        body_from_shape: Pose,
        tag: ColliderTag,
        several: bool,
    ) -> ColliderBuilder {
        let mask = Group::from_bits_retain(self.mask);
        let mut hooks = ActiveHooks::empty();
        if several || self.reports {
            hooks |= ActiveHooks::FILTER_CONTACT_PAIRS;
        }
        if tag.part != WheelPart::Whole || self.is_softened {
            hooks |= ActiveHooks::MODIFY_SOLVER_CONTACTS;
        }
        ColliderBuilder::new(shape)
            .position(rapier_pose(body_from_shape))
            .density(0.0)
            .friction(self.friction)
            .friction_combine_rule(CoefficientCombineRule::Min)
            .restitution(self.restitution)
            .restitution_combine_rule(CoefficientCombineRule::Min)
            // Sharing a bit is symmetric, so memberships and filter are the same mask.
            .collision_groups(InteractionGroups::new(mask, mask, InteractionTestMode::And))
            .active_hooks(hooks)
            .user_data(tag.pack())
    }
}
