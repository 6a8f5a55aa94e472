//! Limits of the friction of links.

use rapier3d_f64::prelude::ColliderHandle;

use super::Rigid;
use crate::hooks::ColliderTag;

/// A collider with limited friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LimitedCollider {
    collider: ColliderHandle,
    /// Coefficient of friction without the limit.
    friction: f64,
}

impl Rigid {
    /// Limits the friction of a link's colliders on a body, or removes the limit; returns false without a collider.
    pub(crate) fn limit_friction(
        &mut self,
        body: usize,
        link: u32,
        max_friction: Option<f64>,
    ) -> bool {
        let Some(handle) = self.bodies.get(body).copied().flatten() else { return false };
        let colliders: Vec<ColliderHandle> = self.solver.bodies[handle].colliders().to_vec();
        let mut has_any = false;
        for handle in colliders {
            let collider = &mut self.solver.colliders[handle];
            if ColliderTag::unpack(collider.user_data).link != link {
                continue;
            }
            has_any = true;
            let known = self.limited_colliders.iter().position(|it| it.collider == handle);
            let original = match known {
                Some(index) => self.limited_colliders.swap_remove(index).friction,
                None => collider.friction(),
            };
            collider.set_friction(max_friction.map_or(original, |limit| original.min(limit)));
            if max_friction.is_some() {
                let limited = LimitedCollider { collider: handle, friction: original };
                self.limited_colliders.push(limited);
            }
        }
        if has_any {
            self.solver.bodies[handle].wake_up(true);
        }
        has_any
    }
}
