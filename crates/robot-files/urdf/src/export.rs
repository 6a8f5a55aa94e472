//! Scene to robot, for who needs a URDF of an SDF model.
//!
//! URDF says less than SDF: its joints make one tree, a link's frame is that of the joint above
//! it, shapes are few, and Gazebo's settings speak about all shapes of a link at once. What fits
//! goes into the robot, the rest of SDF into `<gazebo>` blocks, and what fits nowhere into the
//! diagnostics. Links that were merged get their shapes back.

mod joint;
mod link;
mod normal;
mod shape;
mod structure;

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{Model, Scene, TfEdge, tf_tree};
use periplus_xml::{Element, Node};

use crate::robot::{GazeboBlock, Placement, Robot};

/// A robot that [`crate::to_model`] would turn into this model again, as far as URDF can say it.
/// None, with errors that say why, if the model is no tree of links on joints that URDF has; an
/// error also marks what is lost.
#[must_use]
pub fn from_model(model: &Model, diagnostics: &mut Diagnostics) -> Option<Robot> {
    let tree = tf_tree(model);
    if !structure::check(model, &tree, diagnostics) {
        return None;
    }
    let model = normal::joints_at_links(model, diagnostics);
    let scene = Scene { models: vec![model.clone()], ..Scene::default() };
    // What SDF cannot say, URDF can.
    let document = periplus_sdf::write(&scene, &mut Diagnostics::new());
    let mut written =
        document.root.child("model").cloned().unwrap_or_else(|| Element::new("model"));
    plain(&mut written);
    let tree = tf_tree(&model);
    let joint_above = joint::names(&model, &tree);
    let export = Export { model: &model, written: &written, tree: &tree, joint_above };
    Some(export.robot(diagnostics))
}

/// Takes out attributes that only Periplus reads, for their prefix means nothing in a URDF.
fn plain(element: &mut Element) {
    element.attributes.retain(|attribute| !attribute.name.starts_with("periplus:"));
    for child in &mut element.children {
        if let Node::Element(child) = child {
            plain(child);
        }
    }
}

/// A model that fits, as a scene, as SDF, and as a tree.
struct Export<'a> {
    model: &'a Model,
    written: &'a Element,
    tree: &'a [TfEdge],
    /// The name of the joint above each link and frame.
    joint_above: BTreeMap<&'a str, String>,
}

impl Export<'_> {
    fn robot(&self, diagnostics: &mut Diagnostics) -> Robot {
        let model = self.model;
        let mut robot = Robot {
            name: model.name.clone(),
            origin_in_world: (model.parent_from_model != periplus_geometry::Pose::IDENTITY)
                .then(|| Placement::from_pose(model.parent_from_model)),
            origin: model.origin,
            ..Robot::default()
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

    /// The link that hangs on nothing.
    fn root(&self) -> Option<&str> {
        let hung: BTreeSet<&str> = self.tree.iter().map(|edge| &*edge.child).collect();
        let links = self.model.links.iter().map(|link| &*link.name);
        links.into_iter().find(|link| !hung.contains(link))
    }

    /// What SDF says about the model and its plugins.
    fn settings_of_model(&self, robot: &mut Robot) {
        let mut content = Vec::new();
        for part in self.written.elements() {
            match &*part.name {
                "pose" | "link" | "joint" | "frame" => {}
                "transmission" => robot.transmissions.push(part.clone()),
                "ros2_control" => robot.ros2_controls.push(part.clone()),
                // A model of SDF has no sensors, so this is the format's own.
                "sensor" => robot.sensors.push(part.clone()),
                "mujoco" | "isaac_sim" => robot.extra.elements.push(part.clone()),
                _ => content.push(part.clone()),
            }
        }
        push_block(robot, None, content);
    }
}

/// Adds a `<gazebo>` block, unless it is empty.
fn push_block(robot: &mut Robot, reference: Option<&str>, content: Vec<Element>) {
    if !content.is_empty() {
        let reference = reference.map(str::to_owned);
        robot.gazebo.push(GazeboBlock { reference, content, ..GazeboBlock::default() });
    }
}

/// What URDF cannot say is lost.
fn lost(what: String) -> Diagnostic {
    Diagnostic::error("not-in-urdf", what).label("lost")
}

#[cfg(test)]
mod tests;
