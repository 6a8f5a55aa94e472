//! What touches what.

use periplus_geometry::DVec3;
use rapier3d_f64::geometry::PairContacts;

use crate::build::scene_pose;
use crate::engine::Engine;
use crate::hooks::Tag;
use crate::state::LinkId;
use crate::world::World;

/// A collision of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Touching {
    /// The link.
    pub link: LinkId,
    /// Which of its collisions, in the order of the file.
    pub collision: usize,
}

/// Two collisions that touch, at the end of the last step.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// One of them.
    pub one: Touching,
    /// The other.
    pub two: Touching,
    /// From one to the other, in the world, unit length.
    pub normal: DVec3,
    /// Where, in the world [m], and how deep [m].
    pub points: Vec<(DVec3, f64)>,
    /// What pushes the second along the normal [N].
    pub force_n: f64,
}

impl World {
    /// What touches, in a fixed order. Shapes that only come near are not told; in
    /// [`Mode::Kinematic`](crate::Mode) nothing ever touches.
    #[must_use]
    pub fn contacts(&self) -> Vec<Contact> {
        let mut contacts = Vec::new();
        let Engine::Rigid(rigid) = &self.engine else { return contacts };
        let solver = &rigid.solver;
        let step_s = solver.integration_parameters.dt;
        for pair in solver.narrow_phase.contact_pairs() {
            let PairContacts::Rigid(rigid) = &pair.contacts else { continue };
            let (one, two) = (&solver.colliders[pair.collider1], &solver.colliders[pair.collider2]);
            let touching = |bits: u128| {
                let tag = Tag::unpack(bits);
                Touching { link: LinkId(tag.link), collision: usize::from(tag.collision) }
            };
            for manifold in rigid.solver_manifolds() {
                // The tread and core of a wheel drop what is not theirs.
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
                contacts.push(Contact {
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
