//! Frame tree of a robot.

use std::collections::BTreeMap;

use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_scene::{Joint, JointKind, Mimic, Model, tf_tree};
use periplus_urdf::{JointType, UrdfRobot};

/// A frame with its parent.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Edge {
    pub(crate) parent: String,
    pub(crate) child: String,
    /// Pose of the child in the parent with the joint at zero.
    pub(crate) parent_from_child: Pose,
}

/// A frame moved by a joint.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MovingEdge {
    pub(crate) edge: Edge,
    child_from_joint: Pose,
    axis_in_joint: DVec3,
    slides: bool,
}

/// Frames of a robot as in `robot_state_publisher`: fixed ones, and those moved by one coordinate,
/// by the name of their joint. Joints with several coordinates have no transforms.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FrameTree {
    pub(crate) fixed: Vec<Edge>,
    pub(crate) moving: BTreeMap<String, MovingEdge>,
    /// Mimic joints by name.
    pub(crate) mimics: BTreeMap<String, Mimic>,
}

impl FrameTree {
    pub(crate) fn of(model: &Model) -> Self {
        let mut tree = Self::default();
        for edge in tf_tree(model) {
            let plain = Edge {
                parent: edge.parent,
                child: edge.child,
                parent_from_child: edge.parent_from_child,
            };
            let Some(name) = edge.joint else {
                tree.fixed.push(plain);
                continue;
            };
            let Some((owner, joint)) = joint_of(model, &name) else { continue };
            let slides = match joint.kind {
                JointKind::Revolute | JointKind::Continuous => false,
                JointKind::Prismatic => true,
                _ => continue,
            };
            let Some(axis) = &joint.axis else { continue };
            let axis_in_joint = axis.direction_in_joint.normalize_or(DVec3::X);
            if let Some(mimic) = &axis.mimic {
                tree.mimics.insert(name.clone(), mimic.clone());
            }
            let child_from_joint = joint_in_link(owner, joint, &plain.child);
            let moving = MovingEdge { edge: plain, child_from_joint, axis_in_joint, slides };
            tree.moving.insert(name, moving);
        }
        tree
    }

    /// Returns the frames of a URDF as `kdl_parser` does: every joint counts regardless of inertia,
    /// floating joints have no transform, and planar ones are fixed.
    pub(crate) fn of_robot(robot: &UrdfRobot) -> Self {
        let mut tree = Self::default();
        for joint in &robot.joints {
            let edge = Edge {
                parent: joint.parent.clone(),
                child: joint.child.clone(),
                parent_from_child: joint.parent_from_joint.pose(),
            };
            let slides = match joint.kind {
                JointType::Floating => continue,
                JointType::Fixed | JointType::Planar => {
                    tree.fixed.push(edge);
                    continue;
                }
                JointType::Revolute | JointType::Continuous => false,
                JointType::Prismatic => true,
            };
            let axis = joint.axis.as_ref().map_or(DVec3::X, |(axis, _)| DVec3::from_array(*axis));
            if let Some(mimic) = &joint.mimic {
                let follow = Mimic {
                    joint: mimic.joint.clone(),
                    axis: "axis".into(),
                    multiplier: mimic.multiplier,
                    offset: mimic.offset,
                    reference: 0.0,
                };
                tree.mimics.insert(joint.name.clone(), follow);
            }
            let moving = MovingEdge {
                edge,
                child_from_joint: Pose::IDENTITY,
                axis_in_joint: axis.normalize_or(DVec3::X),
                slides,
            };
            tree.moving.insert(joint.name.clone(), moving);
        }
        // Sorted by joint name, as in the original.
        let name = |edge: &Edge| {
            let joint = robot.joints.iter().find(|joint| joint.child == edge.child);
            joint.map(|joint| joint.name.clone())
        };
        tree.fixed.sort_by_key(name);
        tree
    }

    /// Adds the positions of mimic joints with known leaders.
    pub(crate) fn complete(&self, positions: &mut BTreeMap<String, f64>) {
        for (name, mimic) in &self.mimics {
            if let Some(leader) = positions.get(&mimic.joint)
                && !positions.contains_key(name)
            {
                let position = mimic.multiplier * (leader - mimic.reference) + mimic.offset;
                positions.insert(name.clone(), position);
            }
        }
    }
}

impl MovingEdge {
    /// Returns the pose of the child in the parent, with the joint at a position [rad or m].
    pub(crate) fn parent_from_child(&self, position: f64) -> Pose {
        let motion = if self.slides {
            let DVec3 { x, y, z } = self.axis_in_joint * position;
            Pose::from_xyz(x, y, z)
        } else {
            let (sine, cosine) = libm::sincos(position / 2.0);
            let DVec3 { x, y, z } = self.axis_in_joint * sine;
            Pose { translation: DVec3::ZERO, rotation: DQuat::from_xyzw(x, y, z, cosine) }
        };
        let child_from_joint = self.child_from_joint;
        self.edge.parent_from_child * child_from_joint * motion * child_from_joint.inverse()
    }
}

/// Returns a joint by its scoped name, and the model that contains it.
fn joint_of<'m>(model: &'m Model, scoped: &str) -> Option<(&'m Model, &'m Joint)> {
    if let Some(joint) = model.joint(scoped) {
        return Some((model, joint));
    }
    let (first, rest) = scoped.split_once("::")?;
    joint_of(model.models.iter().find(|inner| inner.name == first)?, rest)
}

/// Returns the joint's frame in its child link. The pose in the file is relative to the joint's
/// child, which can be a frame on that link.
fn joint_in_link(owner: &Model, joint: &Joint, link: &str) -> Pose {
    let link = link.rsplit("::").next().unwrap_or(link);
    let frame = owner.frames.iter().find(|frame| frame.name == joint.child);
    match (frame, owner.link(link)) {
        (Some(frame), Some(link)) => {
            link.model_from_link.inverse() * frame.parent_from_frame * joint.child_from_joint
        }
        _ => joint.child_from_joint,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use periplus_scene::{Axis, Link};

    use super::*;

    fn arm(kind: JointKind) -> Model {
        let mut model = Model::new("arm");
        let hand = Link { model_from_link: Pose::from_xyz(0.0, 0.0, 1.0), ..Link::new("hand") };
        model.links = vec![Link::new("base"), hand];
        let mut joint = Joint::new("elbow", kind, "base", "hand");
        // The axis is half a metre to the left of the hand.
        joint.child_from_joint = Pose::from_xyz(0.0, 0.5, 0.0);
        joint.axis = Some(Axis::default());
        model.joints = vec![joint];
        model
    }

    #[test]
    fn a_quarter_turn_about_an_axis_beside_the_link() {
        let tree = FrameTree::of(&arm(JointKind::Revolute));
        assert!(tree.fixed.is_empty());
        let hand = tree.moving["elbow"].parent_from_child(FRAC_PI_2);
        // Half a metre to the right of the axis turns to half a metre ahead of it.
        assert!(hand.translation.distance(DVec3::new(0.5, 0.5, 1.0)) < 1e-12, "{hand:?}");
        assert!((hand.rpy().yaw - FRAC_PI_2).abs() < 1e-12);
        assert_eq!(tree.moving["elbow"].parent_from_child(0.0), Pose::from_xyz(0.0, 0.0, 1.0));
    }

    #[test]
    fn a_slide_of_20_cm() {
        let tree = FrameTree::of(&arm(JointKind::Prismatic));
        let hand = tree.moving["elbow"].parent_from_child(0.2);
        assert!(hand.translation.distance(DVec3::new(0.0, 0.0, 1.2)) < 1e-12);
    }

    #[test]
    fn a_ball_has_no_transform() {
        let tree = FrameTree::of(&arm(JointKind::Ball));
        assert!(tree.moving.is_empty() && tree.fixed.is_empty());
    }
}
