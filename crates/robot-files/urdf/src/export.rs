//! Export of a scene's model as URDF.
//!
//! URDF is less expressive than SDF: its joints form one tree, a link's frame is that of the joint above
//! it, it has few shapes, and Gazebo's settings apply to all shapes of a link at once. Data that URDF can
//! express goes into the robot, other SDF into `<gazebo>` blocks, and the rest is reported as lost. Merged
//! links get their shapes back.

mod joint;
mod link;
mod normal;
mod shape;
mod structure;

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{Model, Scene, TfEdge, tf_tree};
use periplus_xml::{Element, XmlNode};

use crate::robot::{GazeboBlock, UrdfOrigin, UrdfRobot};

/// Returns a robot that [`crate::to_model`] converts back to this model as far as URDF allows. Returns
/// `None`, with errors, if the model is not a tree of links with joints that URDF has. Errors also mark data
/// that is lost.
#[must_use]
pub fn from_model(model: &Model, diagnostics: &mut Diagnostics) -> Option<UrdfRobot> {
    let tree = tf_tree(model);
    if !structure::check(model, &tree, diagnostics) {
        return None;
    }
    let model = normal::joints_at_links(model, diagnostics);
    let scene = Scene { models: vec![model.clone()], ..Scene::default() };
    // URDF can express these, SDF cannot.
    let document = periplus_sdf::write(&scene, &mut Diagnostics::new());
    let mut written =
        document.root.child("model").cloned().unwrap_or_else(|| Element::new("model"));
    plain(&mut written);
    let tree = tf_tree(&model);
    let joint_above = joint::names(&model, &tree);
    let export = Export { model: &model, written: &written, tree: &tree, joint_above };
    Some(export.robot(diagnostics))
}

/// Removes attributes that only Periplus reads, as their prefix is undeclared in a URDF.
fn plain(element: &mut Element) {
    element.attributes.retain(|attribute| !attribute.name.starts_with("periplus:"));
    for child in &mut element.children {
        if let XmlNode::Element(child) = child {
            plain(child);
        }
    }
}

/// Model that can be exported, as a scene, as SDF and as a tree.
struct Export<'a> {
    model: &'a Model,
    written: &'a Element,
    tree: &'a [TfEdge],
    /// Name of the joint above each link and frame.
    joint_above: BTreeMap<&'a str, String>,
}

impl Export<'_> {
    fn robot(&self, diagnostics: &mut Diagnostics) -> UrdfRobot {
        let model = self.model;
        let mut robot = UrdfRobot {
            name: model.name.clone(),
            origin_in_world: (model.parent_from_model != periplus_geometry::Pose::IDENTITY)
                .then(|| UrdfOrigin::from_pose(model.parent_from_model)),
            origin: model.origin,
            ..UrdfRobot::default()
        };
        self.links(&mut robot, diagnostics);
        self.joints(&mut robot, diagnostics);
        self.settings_of_model(&mut robot);
        let root = self.root();
        if let Some(canonical) = &model.canonical_link
            && root.is_some_and(|root| root != canonical)
        {
            diagnostics.push(
                Diagnostic::warning(
                    "canonical-link",
                    format!("a URDF's root carries its frame, not `{canonical}`"),
                )
                .at(model.origin)
                .help("poses of the model will be those of its root"),
            );
        }
        robot
    }

    /// Link without a parent.
    fn root(&self) -> Option<&str> {
        let hung: BTreeSet<&str> = self.tree.iter().map(|edge| &*edge.child).collect();
        let links = self.model.links.iter().map(|link| &*link.name);
        links.into_iter().find(|link| !hung.contains(link))
    }

    /// Adds the settings of the model and its plugins.
    fn settings_of_model(&self, robot: &mut UrdfRobot) {
        let mut content = Vec::new();
        for part in self.written.elements() {
            match &*part.name {
                "pose" | "link" | "joint" | "frame" => {}
                "transmission" => robot.transmissions.push(part.clone()),
                "ros2_control" => robot.ros2_controls.push(part.clone()),
                // SDF models have no sensors, so this is URDF's own `<sensor>`.
                "sensor" => robot.sensors.push(part.clone()),
                "mujoco" | "isaac_sim" => robot.extra.elements.push(part.clone()),
                _ => content.push(part.clone()),
            }
        }
        push_block(robot, None, content);
    }
}

/// Adds a `<gazebo>` block, unless it is empty.
fn push_block(robot: &mut UrdfRobot, reference: Option<&str>, content: Vec<Element>) {
    if !content.is_empty() {
        let reference = reference.map(str::to_owned);
        robot.gazebo.push(GazeboBlock { reference, content, ..GazeboBlock::default() });
    }
}

/// Error about data that URDF cannot express.
fn lost(what: String) -> Diagnostic {
    Diagnostic::error("not-in-urdf", what).label("lost")
}

#[cfg(test)]
mod tests;
