//! Joints.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_scene::{Axis, FrameRole, Joint as SceneJoint, JointKind, Model, NamedFrame, TfEdge};
use periplus_xml::Element;

use super::{Export, lost, push_block};
use crate::lump::WORLD;
use crate::robot::{
    Dynamics, Extra, JointCalibration, JointType, Limit, SafetyController, UrdfJoint, UrdfMimic,
    UrdfOrigin, UrdfRobot,
};

/// Value for an unlimited joint, which URDF cannot express; the same number as in libsdformat.
const UNLIMITED: f64 = 1e16;

/// Names of the joints above all links and frames: their own, those of merged joints, or new ones.
pub(super) fn names<'a>(model: &'a Model, tree: &'a [TfEdge]) -> BTreeMap<&'a str, String> {
    let mut names: BTreeMap<&str, String> =
        model.joints.iter().map(|joint| (&*joint.child, joint.name.clone())).collect();
    let mut taken: BTreeSet<String> = names.values().cloned().collect();
    let frames: BTreeMap<&str, &NamedFrame> =
        model.frames.iter().map(|frame| (&*frame.name, frame)).collect();
    for edge in tree {
        if names.contains_key(&*edge.child) {
            continue;
        }
        let above = frames
            .get(&*edge.child)
            .and_then(|frame| frames.get(&*frame.attached_to))
            .filter(|above| above.role == FrameRole::MergedJoint);
        let mut name = match above {
            Some(above) => above.name.clone(),
            None => format!("{}_joint", edge.child),
        };
        while !taken.insert(name.clone()) {
            name.push('_');
        }
        names.insert(&edge.child, name);
    }
    names
}

impl Export<'_> {
    /// One joint for each edge of the tree.
    pub(super) fn joints(&self, robot: &mut UrdfRobot, diagnostics: &mut Diagnostics) {
        let by_child: BTreeMap<&str, &SceneJoint> =
            self.model.joints.iter().map(|joint| (&*joint.child, joint)).collect();
        let written: BTreeMap<&str, &Element> = self
            .written
            .named("joint")
            .filter_map(|joint| Some((joint.value("name")?, joint)))
            .collect();
        let poses = self.poses();
        let pose = |name: &str| poses.get(name).copied().unwrap_or_default();
        for edge in self.tree {
            let parent_from_joint =
                UrdfOrigin::from_pose(pose(&edge.parent).inverse() * pose(&edge.child));
            let base = UrdfJoint {
                parent: edge.parent.clone(),
                child: edge.child.clone(),
                parent_from_joint,
                ..UrdfJoint::default()
            };
            let joint = match by_child.get(&*edge.child) {
                Some(joint) => {
                    let element = written.get(&*joint.name);
                    self.settings_of_joint(joint, element.copied(), robot);
                    of_scene(base, joint, diagnostics)
                }
                None => {
                    let name = self.joint_above.get(&*edge.child).cloned().unwrap_or_default();
                    UrdfJoint { name, ..base }
                }
            };
            robot.joints.push(joint);
        }
    }

    /// Poses of all nodes in the model; the world is at the model's origin.
    fn poses(&self) -> BTreeMap<&str, Pose> {
        let links = self.model.links.iter().map(|link| (&*link.name, link.model_from_link));
        let frames = self.model.frames.iter().map(|frame| (&*frame.name, frame.parent_from_frame));
        links.chain(frames).collect()
    }

    /// Adds the SDF settings of a joint that URDF does not have.
    fn settings_of_joint(
        &self,
        joint: &SceneJoint,
        written: Option<&Element>,
        robot: &mut UrdfRobot,
    ) {
        let mut content = Vec::new();
        if joint.kind == JointKind::Fixed && joint.parent != WORLD {
            content.push(Element::new("preserveFixedJoint").with_text("true"));
        }
        if let Some(axis) = &joint.axis {
            let mut setting = |name: &str, value: f64| {
                if value != 0.0 {
                    let text = periplus_geometry::format_number(value);
                    content.push(Element::new(name).with_text(text));
                }
            };
            setting("springStiffness", axis.spring_stiffness);
            setting("springReference", axis.spring_reference);
        }
        let parts = written.into_iter().flat_map(Element::elements);
        content.extend(parts.filter(|part| !KNOWN.contains(&&*part.name)).cloned());
        push_block(robot, Some(&joint.name), content);
    }
}

/// Children of an SDF joint that a URDF joint has too.
const KNOWN: [&str; 9] = [
    "pose",
    "parent",
    "child",
    "axis",
    "axis2",
    "calibration",
    "safety_controller",
    "screw_thread_pitch",
    "thread_pitch",
];

fn of_scene(base: UrdfJoint, joint: &SceneJoint, diagnostics: &mut Diagnostics) -> UrdfJoint {
    let axis = joint.axis.as_ref();
    let free = |axis: &Axis| axis.lower == f64::NEG_INFINITY && axis.upper == f64::INFINITY;
    let kind = match joint.kind {
        JointKind::Revolute if axis.is_none_or(free) => JointType::Continuous,
        JointKind::Revolute => JointType::Revolute,
        JointKind::Continuous => JointType::Continuous,
        JointKind::Prismatic => JointType::Prismatic,
        JointKind::Floating => JointType::Floating,
        JointKind::Planar => JointType::Planar,
        _ => JointType::Fixed,
    };
    let part = |name: &str| joint.extra.iter().find(|part| part.name == name);
    let number = |element: &Element, name: &str| {
        element.value(name).and_then(periplus_geometry::parse_number)
    };
    let mut to = UrdfJoint {
        name: joint.name.clone(),
        kind,
        calibration: part("calibration").map(|element| JointCalibration {
            rising: number(element, "rising"),
            falling: number(element, "falling"),
            extra: Extra::default(),
        }),
        safety_controller: part("safety_controller").map(|element| SafetyController {
            soft_lower_limit: number(element, "soft_lower_limit").unwrap_or(0.0),
            soft_upper_limit: number(element, "soft_upper_limit").unwrap_or(0.0),
            k_position: number(element, "k_position").unwrap_or(0.0),
            k_velocity: number(element, "k_velocity").unwrap_or(0.0),
            extra: Extra::default(),
        }),
        origin: joint.origin,
        ..base
    };
    let Some(axis) = axis.filter(|_| kind.has_axis()) else { return to };
    to.axis = Some((axis.direction_in_joint.to_array(), Extra::default()));
    to.limit = limit(kind, axis);
    if axis.damping != 0.0 || axis.friction != 0.0 {
        to.dynamics = Some(Dynamics {
            damping: axis.damping,
            friction: axis.friction,
            extra: Extra::default(),
        });
    }
    if let Some(mimic) = &axis.mimic {
        if mimic.axis == "axis2" {
            let what = format!("`{}` mimics a second axis, which URDF does not have", joint.name);
            diagnostics.push(lost(what).at(joint.origin));
        } else {
            to.mimic = Some(UrdfMimic {
                joint: mimic.joint.clone(),
                multiplier: mimic.multiplier,
                // m (x - r) + o = m x + (o - m r)
                offset: mimic.offset - mimic.multiplier * mimic.reference,
                extra: Extra::default(),
                origin: joint.origin,
            });
        }
    }
    for extra in &axis.extra {
        diagnostics.push(
            Diagnostic::warning(
                "not-in-urdf",
                format!("URDF has no `{}` for the axis of `{}`", extra.name, joint.name),
            )
            .at(extra.origin)
            .label("left out"),
        );
    }
    to
}

/// Limits as URDF requires them: complete and finite; `None` if nothing is limited and the type needs none.
fn limit(kind: JointType, axis: &Axis) -> Option<Limit> {
    let free = axis.effort == f64::INFINITY && axis.velocity == f64::INFINITY;
    let bounded = matches!(kind, JointType::Revolute | JointType::Prismatic);
    (bounded || !free).then(|| Limit {
        lower: if bounded { axis.lower.max(-UNLIMITED) } else { 0.0 },
        upper: if bounded { axis.upper.min(UNLIMITED) } else { 0.0 },
        effort: axis.effort.min(UNLIMITED),
        velocity: axis.velocity.min(UNLIMITED),
        ..Limit::default()
    })
}
