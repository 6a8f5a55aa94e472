//! Lumping of fixed joints: links with their own body and links merged into a parent.
//!
//! Gazebo merges a link on a fixed joint into its parent, so that solvers see one body. It cannot simulate
//! a body without mass, and drops it with everything below it (libsdformat, parser_urdf.cc,
//! `ReduceFixedJoints` and `CreateSDF`).

mod combine;
mod matrix;

use std::collections::BTreeSet;

use periplus_geometry::Pose;

use crate::robot::{JointType, UrdfRobot};
use crate::tree::Tree;
pub(crate) use combine::combine;

/// Name of the link that represents the world, if it is the root.
pub(crate) const WORLD: &str = "world";

/// Result of lumping for a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LumpOutcome {
    /// Carries its own body.
    Body,
    /// Part of the body that `head` carries.
    Merged {
        /// The link that carries the body.
        head: usize,
        /// Link frame in the head's frame.
        head_from_link: Pose,
    },
    /// Represents the world.
    World,
    /// Dropped: it or its parent body has no mass, and a movable joint prevents merging.
    Lost,
}

/// Lumping result for all links of a tree.
#[derive(Clone, Debug)]
pub(crate) struct LumpPlan {
    /// All links below the root, parents first, children by name of their joint.
    pub(crate) order: Vec<usize>,
    /// Per link.
    pub(crate) outcome: Vec<LumpOutcome>,
    /// Per link: its frame in the model frame, all joints at zero.
    pub(crate) model_from_link: Vec<Pose>,
    /// Links without mass on a fixed joint that the file wants kept, but that must be merged.
    pub(crate) unpreserved: Vec<usize>,
    /// Links without mass at the top of a dropped branch.
    pub(crate) massless: Vec<usize>,
}

/// Fixed joints that are not merged, by name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Preserved<'a> {
    /// `preserveFixedJoint`: they stay fixed.
    pub(crate) fixed: BTreeSet<&'a str>,
    /// `disableFixedJointLumping`: they become revolute joints with zero range.
    pub(crate) hinge: BTreeSet<&'a str>,
    /// None is merged.
    pub(crate) all: bool,
}

impl Preserved<'_> {
    fn keeps(&self, joint: &str) -> bool {
        self.all || self.fixed.contains(joint) || self.hinge.contains(joint)
    }
}

impl LumpPlan {
    /// LumpPlan of a robot without links.
    pub(crate) fn nothing(robot: &UrdfRobot) -> Self {
        Self {
            order: Vec::new(),
            outcome: vec![LumpOutcome::Lost; robot.links.len()],
            model_from_link: vec![Pose::IDENTITY; robot.links.len()],
            unpreserved: Vec::new(),
            massless: Vec::new(),
        }
    }

    /// Plans for the tree under `root`.
    pub(crate) fn new(
        robot: &UrdfRobot,
        tree: &Tree<'_>,
        root: usize,
        preserved: &Preserved<'_>,
    ) -> Self {
        let order = tree.below(root);
        let count = robot.links.len();
        let mut model_from_link = vec![Pose::IDENTITY; count];
        // First without regard to mass: the head of each link, and its frame in the head.
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
            outcome: vec![LumpOutcome::Lost; count],
            model_from_link,
            unpreserved: Vec::new(),
            massless: Vec::new(),
            order,
        };
        for place in 0..plan.order.len() {
            let link = plan.order[place];
            plan.outcome[link] = if world(link) {
                LumpOutcome::World
            } else if head[link] != link {
                plan.on(head[link], head_from_link[link])
            } else {
                let heavy = mass_kg[link] > 0.0;
                plan.of_head(robot, tree, link, heavy)
            };
        }
        plan
    }

    /// Outcome for a link fixed to `link`, whose outcome is known.
    fn on(&self, link: usize, link_from_other: Pose) -> LumpOutcome {
        match self.outcome[link] {
            LumpOutcome::Body => {
                LumpOutcome::Merged { head: link, head_from_link: link_from_other }
            }
            LumpOutcome::Merged { head, head_from_link } => {
                LumpOutcome::Merged { head, head_from_link: head_from_link * link_from_other }
            }
            LumpOutcome::World | LumpOutcome::Lost => LumpOutcome::Lost,
        }
    }

    /// Outcome for a link that would carry a body.
    fn of_head(
        &mut self,
        robot: &UrdfRobot,
        tree: &Tree<'_>,
        link: usize,
        heavy: bool,
    ) -> LumpOutcome {
        let above = tree.parent[link].map(|parent| self.outcome[parent]);
        if above == Some(LumpOutcome::Lost) {
            return LumpOutcome::Lost;
        }
        if heavy {
            return LumpOutcome::Body;
        }
        let joint = tree.joint_above[link].map(|joint| &robot.joints[joint]);
        if let (Some(parent), Some(joint)) = (tree.parent[link], joint)
            && joint.kind == JointType::Fixed
            && let merged @ LumpOutcome::Merged { .. } =
                self.on(parent, joint.parent_from_joint.pose())
        {
            self.unpreserved.push(link);
            return merged;
        }
        self.massless.push(link);
        LumpOutcome::Lost
    }

    /// Links of the body that `head` carries, itself first, each with its frame in the head's. Computed for
    /// all bodies at once, as bodies are small and may be many.
    pub(crate) fn members(&self) -> Vec<Vec<(usize, Pose)>> {
        let mut members = vec![Vec::new(); self.outcome.len()];
        for &link in &self.order {
            match self.outcome[link] {
                LumpOutcome::Body => members[link].push((link, Pose::IDENTITY)),
                LumpOutcome::Merged { head, head_from_link } => {
                    members[head].push((link, head_from_link));
                }
                LumpOutcome::World | LumpOutcome::Lost => {}
            }
        }
        members
    }
}
