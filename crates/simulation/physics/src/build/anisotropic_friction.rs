//! Anisotropic friction of a collision.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::DVec3;
use periplus_scene::Collision;

use super::Builder;
use super::surface::coefficient;
use crate::anisotropic_friction::AnisotropicFriction;
use crate::flat_model::JointEnd;
use crate::records::WORLD_BODY_INDEX;

impl Builder<'_, '_> {
    /// Returns the anisotropic friction of a link's collision, if any.
    ///
    /// # Errors
    /// When the direction refers to a frame that the model does not have.
    pub(super) fn anisotropic_friction(
        &self,
        link: usize,
        collision: &Collision,
        name: &str,
    ) -> Result<Option<AnisotropicFriction>, Box<Diagnostic>> {
        let friction = &collision.surface.friction;
        let (mu, mu2) = (coefficient(friction.mu), coefficient(friction.mu2));
        let Some(first) = friction.fdir1.try_normalize().filter(|_| mu != mu2) else {
            return Ok(None);
        };
        let (frame_body, body_from_frame) = match &friction.fdir1_expressed_in {
            None => {
                let own = &self.records.links[self.first_link + link];
                (own.body, own.body_from_link * collision.link_from_collision)
            }
            Some(frame) => {
                let scoped = &self.flat.links[link].0;
                let scope = scoped.rfind("::").map_or("", |end| &scoped[..end + 2]);
                match self.flat.end(scope, frame) {
                    Some(JointEnd::Link(carrier, model_from_frame)) => {
                        let record = &self.records.links[self.first_link + carrier];
                        let link_from_frame =
                            self.flat.links[carrier].2.inverse() * model_from_frame;
                        (record.body, record.body_from_link * link_from_frame)
                    }
                    Some(JointEnd::PhysicsWorld) => (WORLD_BODY_INDEX, self.world_from_model),
                    None => return Err(Box::new(no_frame(collision, name, frame))),
                }
            }
        };
        let first_in_frame: DVec3 = body_from_frame.rotation * first;
        Ok(Some(AnisotropicFriction { frame_body, first_in_frame, mu, mu2 }))
    }
}

fn no_frame(collision: &Collision, name: &str, frame: &str) -> Diagnostic {
    Diagnostic::warning(
        "unknown-frame",
        format!("the friction direction of `{name}` is in frame `{frame}`, which the model does not have"),
    )
    .at(collision.origin)
    .note("the smaller coefficient applies in all directions")
}
