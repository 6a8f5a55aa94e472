//! Poses and velocities.

use periplus_geometry::{DVec3, Pose};

use super::PhysicsWorld;
use crate::joints::{AxisRecord, AxisState};
use crate::state::{JointId, LinkId, LinkState, ModelId};

impl PhysicsWorld {
    /// Returns pose and velocity of a link.
    #[must_use]
    pub fn link_state(&self, link: LinkId) -> Option<LinkState> {
        let record = self.records.links.get(link.0 as usize)?;
        let motion = self.engine.body(&self.records, record.body)?;
        let world_from_link = motion.world_from_body * record.body_from_link;
        Some(LinkState {
            world_from_link,
            linear_m_s: motion.velocity_at(world_from_link.translation),
            angular_rad_s: motion.angular_rad_s,
        })
    }

    /// Returns the states of all links of all models, in the order of adding.
    #[must_use]
    pub fn snapshot(&self) -> Vec<(LinkId, LinkState)> {
        let numbers = (0..self.records.links.len() as u32).map(LinkId);
        numbers.filter_map(|link| Some((link, self.link_state(link)?))).collect()
    }

    /// Returns a model's pose, carried by its canonical link.
    #[must_use]
    pub fn model_pose(&self, model: ModelId) -> Option<Pose> {
        let (body, body_from_model) = self.records.canonical(model.0)?;
        Some(self.engine.body(&self.records, body)?.world_from_body * body_from_model)
    }

    /// Returns the axes of a joint: none for a fixed or ball joint, two for a universal joint.
    #[must_use]
    pub fn joint_state(&self, joint: JointId) -> Vec<AxisState> {
        self.axes(joint).iter().map(|axis| axis.state).collect()
    }

    /// Returns the first axis of a joint.
    #[must_use]
    pub fn axis_state(&self, joint: JointId) -> Option<AxisState> {
        self.axes(joint).first().map(|axis| axis.state)
    }

    /// Returns the midpoint of some joints, in their model's frame [m]: the centre of rotation in
    /// place if they are driven wheels. `None` without movable joints.
    #[must_use]
    pub fn middle_of(&self, model: ModelId, joints: &[JointId]) -> Option<DVec3> {
        let model_from_world = self.model_pose(model)?.inverse();
        let mut sum = DVec3::ZERO;
        let mut count = 0.0;
        for &joint in joints {
            let axis = self.axes(joint).first()?;
            let motion = self.engine.body(&self.records, axis.body1)?;
            let world_from_axis = motion.world_from_body * axis.body1_from_axis;
            sum += model_from_world.transform_point(world_from_axis.translation);
            count += 1.0;
        }
        (count > 0.0).then(|| sum / count)
    }

    pub(super) fn axes(&self, joint: JointId) -> &[AxisRecord] {
        let record = self.records.joints.get(joint.0 as usize);
        let record = record.filter(|joint| self.records.present(joint.model).is_some());
        record.map_or(&[], |joint| &self.records.axes[joint.axes.clone()])
    }
}
