//! Contacts.

use periplus_geometry::DVec3;
use rapier3d_f64::geometry::PairContacts;

use crate::build::scene_pose;
use crate::engine::Engine;
use crate::hooks::ColliderTag;
use crate::state::LinkId;
use crate::world::PhysicsWorld;

/// A collision of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CollisionId {
    /// The link.
    pub link: LinkId,
    /// Index of the collision, in the order of the file.
    pub collision: usize,
}

/// Two collisions in contact at the end of the last step.
#[derive(Clone, Debug, PartialEq)]
pub struct PhysicsContact {
    /// First collision.
    pub one: CollisionId,
    /// Second collision.
    pub two: CollisionId,
    /// Unit normal from the first to the second, in the world.
    pub normal: DVec3,
    /// Points in the world [m] with their depths [m].
    pub points: Vec<(DVec3, f64)>,
    /// Normal force on the second collision [N].
    pub force_n: f64,
}

impl PhysicsWorld {
    /// Returns all contacts, in a fixed order. Shapes without overlap are not included. In
    /// [`PhysicsMode::Kinematic`](crate::PhysicsMode) there are no contacts.
    #[must_use]
    pub fn contacts(&self) -> Vec<PhysicsContact> {
        let mut contacts = Vec::new();
        let Engine::Rigid(rigid) = &self.engine else { return contacts };
        let solver = &rigid.solver;
        let step_s = solver.integration_parameters.dt;
        for pair in solver.narrow_phase.contact_pairs() {
            let PairContacts::Rigid(rigid) = &pair.contacts else { continue };
            let [one, two] =
                [pair.collider1, pair.collider2].map(|handle| solver.colliders.get(handle));
            // The pair of a removed collider stays until the next step.
            let (Some(one), Some(two)) = (one, two) else { continue };
            let touching = |bits: u128| {
                let tag = ColliderTag::unpack(bits);
                CollisionId { link: LinkId(tag.link), collision: usize::from(tag.collision) }
            };
            for manifold in rigid.solver_manifolds() {
                // Tread and core of a wheel discard contacts of the other part.
                if manifold.data.solver_contacts.is_empty() {
                    continue;
                }
                let from_shape = manifold.subshape_pos1().map(scene_pose).unwrap_or_default();
                let world_from_one = scene_pose(one.position()) * from_shape;
                let touched = manifold.points.iter().filter(|point| point.dist <= 0.0);
                let points: Vec<(DVec3, f64)> = touched
                    .clone()
                    .map(|point| (world_from_one.transform_point(point.local_p1), -point.dist))
                    .collect();
                if points.is_empty() {
                    continue;
                }
                contacts.push(PhysicsContact {
                    one: touching(one.user_data),
                    two: touching(two.user_data),
                    normal: manifold.data.normal,
                    force_n: touched.map(|point| point.data.impulse).sum::<f64>() / step_s,
                    points,
                });
            }
        }
        contacts
    }
}
