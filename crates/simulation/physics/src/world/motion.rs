//! Where things are and how they move.

use periplus_geometry::{DVec3, Pose};

use super::World;
use crate::joints::{AxisRecord, AxisState};
use crate::state::{JointId, LinkId, LinkState, ModelId};

impl World {
    /// Where a link is and how it moves.
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

    /// All links of all models that are there, in the order of adding.
    #[must_use]
    pub fn snapshot(&self) -> Vec<(LinkId, LinkState)> {
        let numbers = (0..self.records.links.len() as u32).map(LinkId);
        numbers.filter_map(|link| Some((link, self.link_state(link)?))).collect()
    }

    /// A model's frame in the world, carried by its canonical link.
    #[must_use]
    pub fn model_pose(&self, model: ModelId) -> Option<Pose> {
        let (body, body_from_model) = self.records.canonical(model.0)?;
        Some(self.engine.body(&self.records, body)?.world_from_body * body_from_model)
    }

    /// The axes of a joint: none of a fixed or ball joint, two of a universal joint.
    #[must_use]
    pub fn joint_state(&self, joint: JointId) -> Vec<AxisState> {
        self.axes(joint).iter().map(|axis| axis.state).collect()
    }

    /// The first axis of a joint.
    #[must_use]
    pub fn axis_state(&self, joint: JointId) -> Option<AxisState> {
        self.axes(joint).first().map(|axis| axis.state)
    }

    /// The middle between some joints, in their model's frame [m]: what a robot turns about on the
    /// spot if they are its driven wheels. None without joints that move.
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
