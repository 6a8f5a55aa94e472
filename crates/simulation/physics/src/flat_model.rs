//! Name lookup in a model and its nested models.

use std::collections::BTreeMap;

use periplus_geometry::Pose;
use periplus_scene::{Joint, Link, Model, carrying_link};

/// A model and its nested models, flattened, with scoped names.
pub(crate) struct FlatModel<'a> {
    /// Links, each with its scoped name and `model_from_link`.
    pub(crate) links: Vec<(String, &'a Link, Pose)>,
    /// Joints, each with its scope (`nested::` or empty).
    pub(crate) joints: Vec<(String, &'a Joint)>,
    index: BTreeMap<String, usize>,
    poses: BTreeMap<String, Pose>,
    model: &'a Model,
}

/// Body of a joint's end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum JointEnd {
    PhysicsWorld,
    /// Index of the link, and `model_from_end` of the name itself.
    Link(usize, Pose),
}

impl<'a> FlatModel<'a> {
    pub(crate) fn new(model: &'a Model) -> Self {
        let mut flat = Self {
            links: Vec::new(),
            joints: Vec::new(),
            index: BTreeMap::new(),
            poses: BTreeMap::new(),
            model,
        };
        // Iterative: models can be nested deeper than the call stack allows.
        let mut open = vec![(model, String::new(), Pose::IDENTITY)];
        while let Some((model, scope, outer_from_model)) = open.pop() {
            for link in &model.links {
                let name = format!("{scope}{}", link.name);
                let pose = outer_from_model * link.model_from_link;
                flat.index.insert(name.clone(), flat.links.len());
                flat.poses.insert(name.clone(), pose);
                flat.links.push((name, link, pose));
            }
            for frame in &model.frames {
                let pose = outer_from_model * frame.parent_from_frame;
                flat.poses.insert(format!("{scope}{}", frame.name), pose);
            }
            flat.joints.extend(model.joints.iter().map(|joint| (scope.clone(), joint)));
            for nested in model.models.iter().rev() {
                let name = format!("{scope}{}", nested.name);
                let pose = outer_from_model * nested.parent_from_model;
                flat.poses.insert(name.clone(), pose);
                open.push((nested, name + "::", pose));
            }
        }
        flat
    }

    /// Resolves the end of a joint; returns `None` for an unknown name.
    pub(crate) fn end(&self, scope: &str, name: &str) -> Option<JointEnd> {
        if name == "world" {
            return Some(JointEnd::PhysicsWorld);
        }
        let scoped = format!("{scope}{name}");
        let pose = self.poses.get(&scoped).copied();
        let link = match self.index.get(&scoped) {
            Some(&link) => Some(link),
            None => {
                carrying_link(self.model, &scoped).and_then(|name| self.index.get(&name).copied())
            }
        };
        match (link, pose) {
            (Some(link), pose) => Some(JointEnd::Link(link, pose.unwrap_or(self.links[link].2))),
            // A frame attached to the world.
            (None, Some(_)) => Some(JointEnd::PhysicsWorld),
            (None, None) => None,
        }
    }
}
