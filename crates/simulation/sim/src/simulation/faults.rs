//! Faults of joints and surfaces of models.

use periplus_geometry::Pose;

use super::Simulation;

impl Simulation {
    /// Returns the name of the first robot; see [`Simulation::robot_pose`].
    #[must_use]
    pub fn robot_name(&self) -> Option<&str> {
        self.robot().map(|robot| robot.member.name.as_str())
    }

    /// Returns the pose of a model by its name.
    #[must_use]
    pub fn model_pose(&self, model: &str) -> Option<Pose> {
        self.motion.model_pose(self.running[self.place_of(model)?].model)
    }

    /// Seizes a joint of a model or releases it: a seized joint stays at its position and ignores commands. Returns
    /// false for an unknown model or joint, and for a joint without an axis.
    pub fn set_joint_seized(&mut self, model: &str, joint: &str, is_seized: bool) -> bool {
        let Some(place) = self.place_of(model) else { return false };
        let model = self.running[place].model;
        let joint = self.motion.find_joint(model, joint);
        joint.is_some_and(|joint| self.motion.set_seized(joint, is_seized))
    }

    /// Limits the coefficient of friction of a link of a model, or of all its links without a name; `None` removes the
    /// limit. Returns false if no collision is affected, as for an unknown name and with kinematic motion.
    pub fn limit_friction(
        &mut self,
        model: &str,
        link: Option<&str>,
        max_friction: Option<f64>,
    ) -> bool {
        let Some(place) = self.place_of(model) else { return false };
        let model = self.running[place].model;
        let mut has_any = false;
        for id in self.motion.links(model) {
            let is_meant = link.is_none_or(|name| self.motion.link_name(id) == Some(name));
            has_any |= is_meant && self.motion.limit_friction(id, max_friction);
        }
        has_any
    }

    /// Returns the names of the joints of a model that have an axis; none for an unknown model.
    #[must_use]
    pub fn joint_names(&self, model: &str) -> Vec<&str> {
        let Some(place) = self.place_of(model) else { return Vec::new() };
        let joints = self.motion.joints(self.running[place].model);
        let moves = |joint| self.motion.axis_state(joint).is_some();
        joints.filter(|joint| moves(*joint)).filter_map(|it| self.motion.joint_name(it)).collect()
    }

    /// Returns the names of the links of a model; none for an unknown model.
    #[must_use]
    pub fn link_names(&self, model: &str) -> Vec<&str> {
        let Some(place) = self.place_of(model) else { return Vec::new() };
        let links = self.motion.links(self.running[place].model);
        links.filter_map(|it| self.motion.link_name(it)).collect()
    }
}
