//! Lookup by name.

use super::PhysicsWorld;
use crate::records::BodyKind;
use crate::state::{JointId, LinkId, ModelId};

impl PhysicsWorld {
    /// Returns the first model of a name.
    #[must_use]
    pub fn find_model(&self, name: &str) -> Option<ModelId> {
        let found =
            self.records.models.iter().position(|model| !model.removed && model.name == name);
        found.map(|number| ModelId(number as u32))
    }

    /// Returns a link of a model by its scoped name.
    #[must_use]
    pub fn find_link(&self, model: ModelId, name: &str) -> Option<LinkId> {
        self.links(model).find(|&link| self.link_name(link) == Some(name))
    }

    /// Returns a joint of a model by its scoped name.
    #[must_use]
    pub fn find_joint(&self, model: ModelId, name: &str) -> Option<JointId> {
        self.joints(model).find(|&joint| self.joint_name(joint) == Some(name))
    }

    /// Returns a joint between models, by its name in the world.
    #[must_use]
    pub fn find_world_joint(&self, name: &str) -> Option<JointId> {
        let mut joints = self.records.joints.iter().enumerate();
        let found = joints.find(|(number, joint)| {
            let model = self.records.present(joint.model);
            joint.name == name && model.is_some_and(|it| !it.joints.contains(&(*number as u32)))
        });
        found.map(|(number, _)| JointId(number as u32))
    }

    /// Returns the links of a model, in the order of the file.
    pub fn links(&self, model: ModelId) -> impl Iterator<Item = LinkId> + use<> {
        self.records.present(model.0).map_or(0..0, |model| model.links.clone()).map(LinkId)
    }

    /// Returns the joints of a model, in the order of the file, including fixed ones.
    pub fn joints(&self, model: ModelId) -> impl Iterator<Item = JointId> + use<> {
        self.records.present(model.0).map_or(0..0, |model| model.joints.clone()).map(JointId)
    }

    /// Returns a link's name, scoped within its model.
    #[must_use]
    pub fn link_name(&self, link: LinkId) -> Option<&str> {
        self.records.links.get(link.0 as usize).map(|link| link.name.as_str())
    }

    /// Returns a joint's name, scoped within its model.
    #[must_use]
    pub fn joint_name(&self, joint: JointId) -> Option<&str> {
        self.records.joints.get(joint.0 as usize).map(|joint| joint.name.as_str())
    }

    /// Returns the name of a collision of a link.
    #[must_use]
    pub fn collision_name(&self, link: LinkId, collision: usize) -> Option<&str> {
        let link = self.records.links.get(link.0 as usize)?;
        link.collisions.get(collision).map(String::as_str)
    }

    /// Returns the model of a link.
    #[must_use]
    pub fn model_of(&self, link: LinkId) -> Option<ModelId> {
        self.records.model_of_link.get(link.0 as usize).map(|&model| ModelId(model))
    }

    /// Returns true for a model without bodies that can move.
    #[must_use]
    pub fn is_static(&self, model: ModelId) -> bool {
        let kinds = self.records.bodies_of(model.0).map(|body| self.records.bodies[body].kind);
        kinds.into_iter().all(|kind| kind == BodyKind::Fixed)
    }

    /// Returns all models in the order of adding, with their names.
    pub fn models(&self) -> impl Iterator<Item = (ModelId, &str)> {
        let models = self.records.models.iter().enumerate();
        models
            .filter(|(_, model)| !model.removed)
            .map(|(number, model)| (ModelId(number as u32), model.name.as_str()))
    }
}
