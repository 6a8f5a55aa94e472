//! Models as trees of frames, as tf publishes them.

use std::collections::{BTreeMap, BTreeSet};

use periplus_geometry::Pose;

use crate::{FrameRole, JointKind, Model, NamedFrame};

/// Transform between two frames.
#[derive(Clone, Debug, PartialEq)]
pub struct TfEdge {
    /// Parent frame: a link, a frame, or `world`.
    pub parent: String,
    /// Child frame: a link or a frame.
    pub child: String,
    /// Child frame in the parent frame, all joints at zero.
    pub parent_from_child: Pose,
    /// Movable joint between them, if any.
    pub joint: Option<String>,
}

/// Returns the links and frames of a model as a tree, nested ones with scoped names; parents come before
/// their children. For a model from a URDF these are the links of the URDF, merged or not, as published by
/// `robot_state_publisher`.
///
/// A link with several parent joints is the child of the first; links without one are roots. Frames are
/// children of the frame that they are attached to. Joint frames equal those of their child links and are
/// not included.
#[must_use]
pub fn tf_tree(model: &Model) -> Vec<TfEdge> {
    let flat = Flat::new(model);
    let mut hung = BTreeSet::new();
    let mut edges: BTreeMap<String, Vec<TfEdge>> = BTreeMap::new();
    let mut nodes: Vec<String> = Vec::new();
    let mut groups = Groups::default();
    let mut add = |parent: String, child: String, joint: Option<String>| {
        if hung.contains(&child) || !groups.join(&parent, &child) {
            return;
        }
        hung.insert(child.clone());
        let parent_from_child = flat.pose(&parent).inverse() * flat.pose(&child);
        nodes.push(parent.clone());
        let edge = TfEdge { parent: parent.clone(), child, parent_from_child, joint };
        edges.entry(parent).or_default().push(edge);
    };
    for joint in &flat.joints {
        let Some(parent) = flat.node(&joint.parent) else { continue };
        let Some(child) = flat.link(&joint.child) else { continue };
        add(parent, child, joint.moves.then(|| joint.name.clone()));
    }
    for (name, frame) in &flat.frames {
        // Root of a URDF, if it has no body.
        let root = frame.role == FrameRole::MergedLink && frame.attached_to_model;
        if frame.role != FrameRole::MergedJoint
            && !root
            && let Some(parent) = flat.node(&frame.attached_to)
        {
            add(parent, name.clone(), None);
        }
    }
    let mut tree = Vec::new();
    let roots: Vec<&String> = nodes.iter().filter(|node| !hung.contains(*node)).collect();
    let mut open: Vec<String> = roots.into_iter().rev().cloned().collect();
    while let Some(node) = open.pop() {
        let below = edges.remove(&node).unwrap_or_default();
        open.extend(below.iter().rev().map(|edge| edge.child.clone()));
        tree.extend(below);
    }
    tree
}

/// Connected nodes, so that no edge closes a loop (union-find with path halving).
#[derive(Default)]
struct Groups {
    index: BTreeMap<String, usize>,
    above: Vec<usize>,
}

impl Groups {
    /// Joins the groups of two nodes. Returns false if they are already in one group.
    fn join(&mut self, a: &str, b: &str) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.above[b] = a;
        a != b
    }

    fn find(&mut self, node: &str) -> usize {
        let mut member = match self.index.get(node) {
            Some(&member) => member,
            None => {
                self.index.insert(node.to_owned(), self.above.len());
                self.above.push(self.above.len());
                self.above.len() - 1
            }
        };
        while self.above[member] != member {
            self.above[member] = self.above[self.above[member]];
            member = self.above[member];
        }
        member
    }
}

/// Returns the link of a model that carries a link, joint, frame or nested model, all by scoped names;
/// `None` for `world`, an unknown name, or a circle of frames.
#[must_use]
pub fn carrying_link(model: &Model, name: &str) -> Option<String> {
    Flat::new(model).link(name)
}

/// Model with its nested models, all names scoped, all poses in the frame of the outermost.
#[derive(Default)]
struct Flat {
    links: BTreeMap<String, Pose>,
    frames: Vec<(String, FlatFrame)>,
    frame_index: BTreeMap<String, usize>,
    joints: Vec<FlatJoint>,
    joint_index: BTreeMap<String, usize>,
    /// Canonical link of each model; the outermost has an empty name.
    canonical: BTreeMap<String, String>,
    /// Pose of the world in the model frame.
    model_from_world: Pose,
}

struct FlatFrame {
    pose: Pose,
    role: FrameRole,
    attached_to: String,
    attached_to_model: bool,
}

struct FlatJoint {
    name: String,
    parent: String,
    child: String,
    moves: bool,
}

/// Maximum number of attachments that are followed; more are a circle, as real files have a few.
const MAX_STEPS: usize = 10_000;

const WORLD: &str = "world";

impl Flat {
    fn new(model: &Model) -> Self {
        let mut flat =
            Self { model_from_world: model.parent_from_model.inverse(), ..Self::default() };
        flat.add(model, "", Pose::IDENTITY);
        flat
    }

    fn add(&mut self, model: &Model, scope: &str, outer_from_model: Pose) {
        let scoped = |name: &str| format!("{scope}{name}");
        let reference = |name: &str| match name {
            WORLD => WORLD.to_owned(),
            // The outermost model has an empty name.
            "__model__" | "" => scope.strip_suffix("::").unwrap_or_default().to_owned(),
            name => scoped(name),
        };
        for link in &model.links {
            self.links.insert(scoped(&link.name), outer_from_model * link.model_from_link);
        }
        for frame in &model.frames {
            let NamedFrame { name, parent_from_frame, attached_to, role, .. } = frame;
            self.frame_index.insert(scoped(name), self.frames.len());
            let flat = FlatFrame {
                pose: outer_from_model * *parent_from_frame,
                role: *role,
                attached_to: reference(attached_to),
                attached_to_model: attached_to == "__model__",
            };
            self.frames.push((scoped(name), flat));
        }
        for joint in &model.joints {
            self.joint_index.insert(scoped(&joint.name), self.joints.len());
            self.joints.push(FlatJoint {
                name: scoped(&joint.name),
                parent: reference(&joint.parent),
                child: reference(&joint.child),
                moves: joint.kind != JointKind::Fixed,
            });
        }
        let first = model.links.first().map(|link| link.name.clone());
        if let Some(canonical) = model.canonical_link.clone().or(first) {
            self.canonical.insert(reference("__model__"), scoped(&canonical));
        }
        for nested in &model.models {
            let scope = format!("{scope}{}::", nested.name);
            self.add(nested, &scope, outer_from_model * nested.parent_from_model);
        }
    }

    /// Follows one attachment towards a link; returns the name itself at the end.
    fn step<'a>(&'a self, name: &'a str, through_frames: bool) -> Option<&'a str> {
        if name == WORLD || self.links.contains_key(name) {
            return Some(name);
        }
        if let Some(frame) = self.frame_index.get(name).map(|&frame| &self.frames[frame].1) {
            if frame.role == FrameRole::MergedJoint && frame.attached_to_model && !through_frames {
                // Root of a URDF that was its link `world`.
                return Some(WORLD);
            }
            let stops = frame.role != FrameRole::MergedJoint && !through_frames;
            return Some(if stops { name } else { &frame.attached_to });
        }
        if let Some(&joint) = self.joint_index.get(name) {
            return Some(&self.joints[joint].child);
        }
        self.canonical.get(name).map(String::as_str)
    }

    /// Node of the tree for a name.
    fn node(&self, name: &str) -> Option<String> {
        self.walk(name, false)
    }

    /// Link that carries the named frame.
    fn link(&self, name: &str) -> Option<String> {
        self.walk(name, true).filter(|link| link != WORLD)
    }

    fn walk(&self, name: &str, through_frames: bool) -> Option<String> {
        let mut name = name;
        for _ in 0..MAX_STEPS {
            let next = self.step(name, through_frames)?;
            if next == name {
                return Some(name.to_owned());
            }
            name = next;
        }
        None
    }

    fn pose(&self, node: &str) -> Pose {
        if node == WORLD {
            return self.model_from_world;
        }
        let frame = || self.frame_index.get(node).map(|&frame| self.frames[frame].1.pose);
        self.links.get(node).copied().or_else(frame).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Joint, Link};

    fn frame(name: &str, attached_to: &str, x: f64, role: FrameRole) -> NamedFrame {
        NamedFrame {
            name: name.into(),
            parent_from_frame: Pose::from_xyz(x, 0.0, 0.0),
            attached_to: attached_to.into(),
            role,
            origin: crate::Origin::default(),
        }
    }

    fn link(name: &str, x: f64) -> Link {
        Link { model_from_link: Pose::from_xyz(x, 0.0, 0.0), ..Link::new(name) }
    }

    fn check(model: &Model, expected: &[(&str, &str, f64, Option<&str>)]) {
        let tree = tf_tree(model);
        let found: Vec<_> = tree
            .iter()
            .map(|edge| {
                let x = edge.parent_from_child.translation.x;
                (&*edge.parent, &*edge.child, x, edge.joint.as_deref())
            })
            .collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn merged_links_stand_between() {
        // foot - (fixed) - base - (wheel joint) - wheel, and base is merged into foot.
        let mut model = Model::new("robot");
        model.links = vec![link("foot", 0.0), link("wheel", 3.0)];
        model.frames = vec![
            frame("base_joint", "foot", 1.0, FrameRole::MergedJoint),
            frame("base", "base_joint", 1.0, FrameRole::MergedLink),
        ];
        model.joints = vec![Joint::new("turn", JointKind::Continuous, "base", "wheel")];
        check(&model, &[("foot", "base", 1.0, None), ("base", "wheel", 2.0, Some("turn"))]);
        assert_eq!(carrying_link(&model, "base").as_deref(), Some("foot"));
        assert_eq!(carrying_link(&model, "turn").as_deref(), Some("wheel"));
        assert_eq!(carrying_link(&model, "nobody"), None);
    }

    #[test]
    fn the_world_and_models_inside() {
        let mut arm = Model::new("arm");
        arm.parent_from_model = Pose::from_xyz(5.0, 0.0, 0.0);
        arm.links = vec![link("hand", 1.0)];
        let mut model = Model::new("robot");
        model.parent_from_model = Pose::from_xyz(10.0, 0.0, 0.0);
        model.links = vec![link("base", 0.0)];
        model.models = vec![arm];
        model.frames = vec![frame("mark", "__model__", 2.0, FrameRole::Declared)];
        model.joints = vec![
            Joint::new("anchor", JointKind::Fixed, "world", "base"),
            Joint::new("reach", JointKind::Prismatic, "mark", "arm::hand"),
        ];
        check(
            &model,
            &[
                ("world", "base", 10.0, None),
                ("base", "mark", 2.0, None),
                ("mark", "arm::hand", 4.0, Some("reach")),
            ],
        );
    }

    #[test]
    fn circles_end() {
        let mut model = Model::new("knot");
        model.links = vec![link("a", 0.0), link("b", 0.0)];
        model.joints = vec![
            Joint::new("there", JointKind::Fixed, "a", "b"),
            Joint::new("back", JointKind::Fixed, "b", "a"),
        ];
        model.frames = vec![
            frame("x", "y", 0.0, FrameRole::MergedJoint),
            frame("y", "x", 0.0, FrameRole::MergedJoint),
            frame("z", "x", 0.0, FrameRole::Declared),
        ];
        check(&model, &[("a", "b", 0.0, None)]);
        assert_eq!(carrying_link(&model, "z"), None);
    }
}
