//! Friction and bounce.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose};
use periplus_scene::Collision;
use rapier3d_f64::dynamics::CoefficientCombineRule;
use rapier3d_f64::geometry::{
    ColliderBuilder, Group, InteractionGroups, InteractionTestMode, SharedShape,
};
use rapier3d_f64::pipeline::ActiveHooks;

use super::rapier_pose;
use crate::hooks::{Part, Tag};

/// Beyond this no slope is too steep, and products stay finite.
const ROUGHEST: f64 = 1e6;

/// A coefficient as the solver can use it; ODE takes a negative one for infinite.
pub(super) fn coefficient(mu: f64) -> f64 {
    if mu < 0.0 { ROUGHEST } else { mu.min(ROUGHEST) }
}

/// Friction and bounce of one collision.
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
        // The ground of nearly every world says 100 and 50: what stands on it decides.
        let is_rough_ground = !moves && mu.min(mu2) >= 1.0;
        if mu != mu2 && friction.fdir1 == DVec3::ZERO && !is_rough_ground {
            diagnostics.push(
                Diagnostic::warning(
                    "friction-one-direction",
                    format!("collision `{name}` has friction {mu} one way and {mu2} the other"),
                )
                .at(collision.origin)
                .note(
                    "the smaller one holds in every direction; `<fdir1>` says which way is which",
                ),
            );
        }
        // Gazebo bounces only above a threshold, whose default nothing ever reaches.
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

    /// The same with a stiffness of its own.
    pub(super) fn softened(self, is_softened: bool) -> Self {
        Self { is_softened, ..self }
    }

    pub(super) fn collider(
        &self,
        shape: SharedShape,
        body_from_shape: Pose,
        tag: Tag,
        several: bool,
    ) -> ColliderBuilder {
        let mask = Group::from_bits_retain(self.mask);
        let mut hooks = ActiveHooks::empty();
        if several || self.reports {
            hooks |= ActiveHooks::FILTER_CONTACT_PAIRS;
        }
        if tag.part != Part::Whole || self.is_softened {
            hooks |= ActiveHooks::MODIFY_SOLVER_CONTACTS;
        }
        ColliderBuilder::new(shape)
            .position(rapier_pose(body_from_shape))
            .density(0.0)
            .friction(self.friction)
            .friction_combine_rule(CoefficientCombineRule::Min)
            .restitution(self.restitution)
            .restitution_combine_rule(CoefficientCombineRule::Min)
            // Sharing a bit is symmetric, so members and filter are the same mask.
            .collision_groups(InteractionGroups::new(mask, mask, InteractionTestMode::And))
            .active_hooks(hooks)
            .user_data(tag.pack())
    }
}
