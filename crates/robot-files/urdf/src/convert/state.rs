//! State shared by the parts of a conversion.

use std::collections::BTreeMap;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose;

use super::ConversionOptions;
use super::extension::Extensions;
use super::names::JointNames;
use super::settings::{ShapeSettings, are_few};
use crate::lump::{LumpOutcome, LumpPlan, Preserved};
use crate::robot::{GazeboBlock, UrdfJoint, UrdfLink, UrdfMaterial, UrdfRobot};
use crate::tree::Tree;

/// Robot and the results of its analysis.
pub(super) struct ConversionState<'a> {
    pub(super) robot: &'a UrdfRobot,
    pub(super) tree: Tree<'a>,
    pub(super) extensions: Extensions<'a>,
    pub(super) preserved: Preserved<'a>,
    pub(super) plan: LumpPlan,
    /// For each link that carries a body: the links of the body, itself first.
    pub(super) members: Vec<Vec<(usize, Pose)>>,
    pub(super) joint_names: JointNames<'a>,
    /// Definitions by name, as ROS resolves them: those of the robot, then those in visuals.
    pub(super) materials: BTreeMap<&'a str, &'a UrdfMaterial>,
    /// Settings for shapes, by the name of the link.
    shape_settings: BTreeMap<&'a str, ShapeSettings>,
}

impl<'a> ConversionState<'a> {
    pub(super) fn new(robot: &'a UrdfRobot, options: ConversionOptions) -> Self {
        let tree = Tree::new(robot);
        let extensions = Extensions::new(robot);
        let mut preserved = extensions.preserved();
        preserved.all = options.preserve_fixed_joints;
        // The reader has reported a robot with several trees; the first is converted.
        let plan = match tree.roots.first() {
            Some(&root) => LumpPlan::new(robot, &tree, root, &preserved),
            None => LumpPlan::nothing(robot),
        };
        let members = plan.members();
        let joint_names = JointNames::new(robot);
        let in_place = robot.links.iter().flat_map(|link| &link.visuals);
        let in_place = in_place.filter_map(|visual| visual.material.as_ref());
        let mut materials = BTreeMap::new();
        for material in robot.materials.iter().chain(in_place).filter(|one| one.is_definition()) {
            materials.entry(&*material.name).or_insert(material);
        }
        let merged =
            |(name, blocks): (&'a str, &[&'a GazeboBlock])| (name, ShapeSettings::new(blocks));
        let shape_settings = extensions.all().map(merged).collect();
        Self {
            robot,
            tree,
            extensions,
            preserved,
            plan,
            members,
            joint_names,
            materials,
            shape_settings,
        }
    }

    /// Settings for the shapes of a link; `None` if no block refers to it.
    pub(super) fn shape_settings(&self, link: &UrdfLink) -> Option<&ShapeSettings> {
        self.shape_settings.get(&*link.name)
    }

    /// Returns true if the settings for shapes are few enough; else reports an error.
    pub(super) fn are_settings_few(&self, diagnostics: &mut Diagnostics) -> bool {
        let copied = self.robot.links.iter().map(|link| {
            let (collisions, visuals) = (link.collisions.len(), link.visuals.len());
            self.shape_settings(link).map_or(0, |one| one.copied_elements(collisions, visuals))
        });
        let copied = copied.fold(0, usize::saturating_add);
        are_few(copied, self.robot.origin, diagnostics)
    }

    /// The model's name.
    pub(super) fn name(&self) -> &'a str {
        if self.robot.name.is_empty() { "robot" } else { &self.robot.name }
    }

    pub(super) fn link(&self, link: usize) -> &'a UrdfLink {
        &self.robot.links[link]
    }

    /// The joint above a link.
    pub(super) fn joint_above(&self, link: usize) -> Option<&'a UrdfJoint> {
        self.tree.joint_above[link].map(|joint| &self.robot.joints[joint])
    }

    /// The link above a link.
    pub(super) fn parent(&self, link: usize) -> Option<&'a UrdfLink> {
        self.tree.parent[link].map(|parent| self.link(parent))
    }

    /// Returns true if the parent of a link is the world.
    pub(super) fn on_world(&self, link: usize) -> bool {
        self.tree.parent[link].is_some_and(|parent| self.plan.outcome[parent] == LumpOutcome::World)
    }
}
