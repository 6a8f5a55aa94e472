//! Which links become bodies of a simulation, and which are merged into one above them.
//!
//! Gazebo merges a link that hangs on a fixed joint into its parent, so that solvers see one body
//! where the file says "screwed on". It cannot simulate a body without mass, and leaves it out
//! with everything below it (libsdformat, parser_urdf.cc, `ReduceFixedJoints` and `CreateSDF`).

mod combine;
mod matrix;

use std::collections::BTreeSet;

use periplus_geometry::Pose;

use crate::robot::{JointType, Robot};
use crate::tree::Tree;
pub(crate) use combine::combine;

/// The name of the link that stands for the world, when it is the root.
pub(crate) const WORLD: &str = "world";

/// What becomes of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fate {
    /// It carries a body of its own.
    Body,
    /// It is part of the body that `head` carries.
    Merged {
        /// The link that carries the body.
        head: usize,
        /// Its frame in the head's.
        head_from_link: Pose,
    },
    /// It stands for the world.
    World,
    /// It has no mass, or what holds it has none, and a joint that moves is in between.
    Lost,
}

/// What becomes of all links of a tree.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// All links below the root, parents first, children by name of their joint.
    pub(crate) order: Vec<usize>,
    /// Per link.
    pub(crate) fate: Vec<Fate>,
    /// Per link: its frame in the model's, all joints at zero.
    pub(crate) model_from_link: Vec<Pose>,
    /// Links without mass on a fixed joint that the file wants kept, and that is merged all the
    /// same.
    pub(crate) kept_in_vain: Vec<usize>,
    /// Links without mass that are the first lost of their branch.
    pub(crate) massless: Vec<usize>,
}

/// Fixed joints that are not merged, by name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Preserved<'a> {
    /// `preserveFixedJoint`: they stay fixed.
    pub(crate) fixed: BTreeSet<&'a str>,
    /// `disableFixedJointLumping`: they become hinges that cannot turn.
    pub(crate) hinge: BTreeSet<&'a str>,
    /// None is merged.
    pub(crate) all: bool,
}

impl Preserved<'_> {
    fn keeps(&self, joint: &str) -> bool {
        self.all || self.fixed.contains(joint) || self.hinge.contains(joint)
    }
}

impl Plan {
    /// The plan of a robot without links.
    pub(crate) fn nothing(robot: &Robot) -> Self {
        Self {
            order: Vec::new(),
            fate: vec![Fate::Lost; robot.links.len()],
            model_from_link: vec![Pose::IDENTITY; robot.links.len()],
            kept_in_vain: Vec::new(),
            massless: Vec::new(),
        }
    }

    /// Plans for the tree under `root`.
    pub(crate) fn new(
        robot: &Robot,
        tree: &Tree<'_>,
        root: usize,
        preserved: &Preserved<'_>,
    ) -> Self {
        let order = tree.below(root);
        let count = robot.links.len();
        let mut model_from_link = vec![Pose::IDENTITY; count];
        // First as if mass did not matter: the head of each link, and the way to it.
        let mut head: Vec<usize> = (0..count).collect();
        let mut head_from_link = vec![Pose::IDENTITY; count];
        let mut mass_kg = vec![0.0; count];
        let world = |link: usize| link == root && robot.links[link].name == WORLD;
        for &link in &order {
            if let (Some(parent), Some(joint)) = (tree.parent[link], tree.joint_above[link]) {
                let joint = &robot.joints[joint];
                let parent_from_link = joint.parent_from_joint.pose();
                model_from_link[link] = model_from_link[parent] * parent_from_link;
                let fixed = joint.kind == JointType::Fixed;
                if fixed && !world(parent) && !preserved.keeps(&joint.name) {
                    head[link] = head[parent];
                    head_from_link[link] = head_from_link[parent] * parent_from_link;
                }
            }
            if let Some(inertial) = &robot.links[link].inertial {
                mass_kg[head[link]] += inertial.mass_kg;
            }
        }
        let mut plan = Self {
            fate: vec![Fate::Lost; count],
            model_from_link,
            kept_in_vain: Vec::new(),
            massless: Vec::new(),
            order,
        };
        for place in 0..plan.order.len() {
            let link = plan.order[place];
            plan.fate[link] = if world(link) {
                Fate::World
            } else if head[link] != link {
                plan.on(head[link], head_from_link[link])
            } else {
                let heavy = mass_kg[link] > 0.0;
                plan.of_head(robot, tree, link, heavy)
            };
        }
        plan
    }

    /// The fate of a link that is screwed to `link`, which has been decided already.
    fn on(&self, link: usize, link_from_other: Pose) -> Fate {
        match self.fate[link] {
            Fate::Body => Fate::Merged { head: link, head_from_link: link_from_other },
            Fate::Merged { head, head_from_link } => {
                Fate::Merged { head, head_from_link: head_from_link * link_from_other }
            }
            Fate::World | Fate::Lost => Fate::Lost,
        }
    }

    /// The fate of a link that would carry a body.
    fn of_head(&mut self, robot: &Robot, tree: &Tree<'_>, link: usize, heavy: bool) -> Fate {
        let above = tree.parent[link].map(|parent| self.fate[parent]);
        if above == Some(Fate::Lost) {
            return Fate::Lost;
        }
        if heavy {
            return Fate::Body;
        }
        let joint = tree.joint_above[link].map(|joint| &robot.joints[joint]);
        if let (Some(parent), Some(joint)) = (tree.parent[link], joint)
            && joint.kind == JointType::Fixed
            && let merged @ Fate::Merged { .. } = self.on(parent, joint.parent_from_joint.pose())
        {
            self.kept_in_vain.push(link);
            return merged;
        }
        self.massless.push(link);
        Fate::Lost
    }

    /// The links of the body that `head` carries, itself first, each with its frame in the head's.
    /// Bodies are small and there may be many, so all are gathered at once.
    pub(crate) fn members(&self) -> Vec<Vec<(usize, Pose)>> {
        let mut members = vec![Vec::new(); self.fate.len()];
        for &link in &self.order {
            match self.fate[link] {
                Fate::Body => members[link].push((link, Pose::IDENTITY)),
                Fate::Merged { head, head_from_link } => members[head].push((link, head_from_link)),
                Fate::World | Fate::Lost => {}
            }
        }
        members
    }
}
