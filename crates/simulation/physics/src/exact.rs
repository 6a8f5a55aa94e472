//! Motion without physics: bases follow their commands exactly, joints follow theirs, and child
//! links follow both. There are no contacts, gravity or slip, so a step may be of any length.

mod axes;
mod base;
mod tree;

use periplus_geometry::{DVec3, Pose};

use crate::engine::BodyMotion;
use crate::exact::base::{Base, BaseMotion};
use crate::exact::tree::Tree;
use crate::kinematic::Twist;
use crate::records::Records;

/// Motions of all bodies, by their indices.
#[derive(Clone, Default)]
pub(crate) struct Exact {
    motions: Vec<BodyMotion>,
    /// Bodies that changed since the end of the last step.
    changed: Vec<bool>,
    /// Kinematic tree; `None` after models were added or removed.
    tree: Option<Tree>,
    /// Moving models, by their indices.
    bases: Vec<Base>,
}

impl Exact {
    pub(crate) fn insert(&mut self, records: &Records) {
        let new = &records.bodies[self.motions.len()..];
        self.motions.extend(new.iter().map(|body| BodyMotion::resting(body.world_from_body)));
        self.changed.resize(self.motions.len(), true);
        self.tree = None;
    }

    pub(crate) fn forget(&mut self, model: u32) {
        self.bases.retain(|base| base.model != model);
        self.tree = None;
    }

    pub(crate) fn body(&self, records: &Records, body: usize) -> Option<BodyMotion> {
        let motion = self.motions.get(body)?;
        (!records.bodies[body].removed).then_some(*motion)
    }

    /// Sets the poses of bodies. Child bodies return to their parents in the next step.
    pub(crate) fn place(&mut self, records: &Records, model: u32, places: &[(usize, Pose)]) {
        for &(body, world_from_body) in places {
            self.motions[body] = BodyMotion::resting(world_from_body);
            self.changed[body] = true;
        }
        self.move_base(records, model, DVec3::ZERO, BaseMotion::Nowhere);
    }

    /// Starts motion of a model along an arc in the plane about a point of its frame; returns false
    /// if it cannot move.
    pub(crate) fn follow(
        &mut self,
        records: &Records,
        model: u32,
        centre_in_model_m: DVec3,
        twist: Twist,
    ) -> bool {
        if let Some(base) = self.base_of(model)
            && base.steer(centre_in_model_m, twist)
        {
            return true;
        }
        self.move_base(records, model, centre_in_model_m, BaseMotion::along(twist))
    }

    /// Sets the velocity of a model's frame in world axes; returns false if it cannot move.
    pub(crate) fn set_velocity(
        &mut self,
        records: &Records,
        model: u32,
        linear_m_s: DVec3,
        angular_rad_s: DVec3,
    ) -> bool {
        let going = BaseMotion::Flying { linear_m_s, angular_rad_s };
        self.move_base(records, model, DVec3::ZERO, going)
    }

    fn base_of(&mut self, model: u32) -> Option<&mut Base> {
        let found = self.bases.binary_search_by_key(&model, |base| base.model).ok()?;
        Some(&mut self.bases[found])
    }

    fn move_base(
        &mut self,
        records: &Records,
        model: u32,
        centre_in_model_m: DVec3,
        going: BaseMotion,
    ) -> bool {
        let Some((body, body_from_model)) = records.canonical(model) else { return false };
        let world_from_model = self.motions[body].world_from_body * body_from_model;
        let tree = self.tree.get_or_insert_with(|| Tree::of(records));
        let roots: Vec<(usize, Pose)> = records
            .bodies_of(model)
            .filter(|&body| tree.is_free_root(records, body))
            .map(|body| (body, self.motions[body].world_from_body))
            .collect();
        if roots.is_empty() {
            return false;
        }
        let base = Base::new(model, world_from_model, centre_in_model_m, going, &roots);
        match self.bases.binary_search_by_key(&model, |base| base.model) {
            Ok(found) => self.bases[found] = base,
            Err(place) => self.bases.insert(place, base),
        }
        true
    }

    /// Advances by a time [s].
    pub(crate) fn step(&mut self, records: &mut Records, dt_s: f64) {
        if self.tree.is_none() {
            self.tree = Some(Tree::of(records));
        }
        for base in &mut self.bases {
            base.advance(dt_s, &mut self.motions, &mut self.changed);
        }
        let Some(tree) = &self.tree else { return };
        axes::advance(&mut records.axes, &tree.followers, dt_s);
        for limb in &tree.children {
            limb.follow_parent(&records.axes, &mut self.motions, &mut self.changed);
        }
        self.changed.fill(false);
    }
}
