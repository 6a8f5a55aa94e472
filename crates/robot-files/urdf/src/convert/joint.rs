//! Joints that are not merged.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{Axis, DVec3, Joint as SceneJoint, JointKind};
use periplus_xml::Element;

use super::element::{child_mut, element, is_true, leaf, numbers, renamed, set, value};
use super::extension::{SettingTarget, check_place, setting_target};
use super::state::ConversionState;
use crate::lump::{LumpOutcome, WORLD};
use crate::robot::{JointType, UrdfJoint};

impl ConversionState<'_> {
    /// `<joint>` above a body; `None` for types that SDF does not have.
    pub(super) fn joint_element(
        &self,
        head: usize,
        diagnostics: &mut Diagnostics,
    ) -> Option<Element> {
        let joint = self.joint_above(head)?;
        let hinge = self.preserved.hinge.contains(&*joint.name);
        let kind = match joint.kind {
            JointType::Fixed if hinge => "revolute",
            JointType::Floating | JointType::Planar => return None,
            kind => kind.name(),
        };
        let mut to = element("joint", joint.origin)
            .with_attribute("name", self.joint_names.of(&joint.name))
            .with_attribute("type", kind);
        to.push(leaf("parent", self.parent_name(head), joint.parent_origin));
        to.push(leaf("child", &joint.child, joint.child_origin));
        if kind != "fixed" {
            to.push(self.axis(joint));
        }
        for setting in self.extensions.settings(&joint.name) {
            self.joint_setting(joint, setting, &mut to, diagnostics);
        }
        Some(to)
    }

    /// Parent of the joint above a body: the link as the file names it, which may have become a frame.
    fn parent_name(&self, head: usize) -> &str {
        if self.on_world(head) {
            WORLD
        } else {
            self.parent(head).map_or(WORLD, |parent| &parent.name)
        }
    }

    fn axis(&self, joint: &UrdfJoint) -> Element {
        let origin = joint.origin;
        let mut axis = element("axis", origin);
        if joint.kind == JointType::Fixed {
            // `disableFixedJointLumping`: a hinge about z that cannot turn.
            let limit = element("limit", origin)
                .with_child(numbers("lower", &[0.0], origin))
                .with_child(numbers("upper", &[0.0], origin));
            axis.push(numbers("xyz", &[0.0, 0.0, 1.0], origin));
            axis.push(limit);
            return axis;
        }
        // The reader has reported a zero axis.
        let xyz = joint.axis_xyz();
        let xyz = if xyz == [0.0; 3] { crate::robot::DEFAULT_AXIS } else { xyz };
        axis.push(numbers("xyz", &xyz, origin));
        if let Some(limit) = &joint.limit {
            let mut to = element("limit", limit.origin);
            if joint.kind != JointType::Continuous {
                let (lower, upper) = (limit.lower.min(limit.upper), limit.upper.max(limit.lower));
                to.push(numbers("lower", &[lower], limit.origin));
                to.push(numbers("upper", &[upper], limit.origin));
            }
            to.push(numbers("effort", &[limit.effort], limit.origin));
            to.push(numbers("velocity", &[limit.velocity], limit.origin));
            axis.push(to);
        }
        if let Some(dynamics) = &joint.dynamics {
            let to = element("dynamics", origin)
                .with_child(numbers("damping", &[dynamics.damping], origin))
                .with_child(numbers("friction", &[dynamics.friction], origin));
            axis.push(to);
        }
        // The reader has reported a mimic joint without a leader.
        if let Some(mimic) = &joint.mimic
            && self.joint_names.is_joint(&mimic.joint)
        {
            let to = element("mimic", mimic.origin)
                .with_attribute("joint", self.joint_names.of(&mimic.joint))
                .with_child(numbers("multiplier", &[mimic.multiplier], mimic.origin))
                .with_child(numbers("offset", &[mimic.offset], mimic.origin));
            axis.push(to);
        }
        axis
    }

    fn joint_setting(
        &self,
        joint: &UrdfJoint,
        setting: &Element,
        to: &mut Element,
        diagnostics: &mut Diagnostics,
    ) {
        // A link of the same name takes its own settings.
        if self.tree.index.contains_key(&*joint.name)
            && setting_target(&setting.name) != Some(SettingTarget::Joint)
        {
            return;
        }
        check_place(setting, &[SettingTarget::Joint], diagnostics);
        let (text, origin) = value(setting);
        let truth = if is_true(setting) { "true" } else { "false" };
        match &*setting.name {
            "preserveFixedJoint" | "disableFixedJointLumping" => {}
            "springReference" => {
                let dynamics = child_mut(child_mut(to, "axis"), "dynamics");
                set(dynamics, renamed(setting, "spring_reference"));
            }
            "springStiffness" => {
                let dynamics = child_mut(child_mut(to, "axis"), "dynamics");
                set(dynamics, renamed(setting, "spring_stiffness"));
            }
            "stopCfm" => {
                set(child_mut(ode(to), "limit"), renamed(setting, "cfm"));
            }
            "stopErp" => {
                set(child_mut(ode(to), "limit"), renamed(setting, "erp"));
            }
            "fudgeFactor" => {
                set(ode(to), leaf("fudge_factor", &text, origin));
            }
            "provideFeedback" => {
                set(child_mut(to, "physics"), leaf("provide_feedback", truth, origin));
                set(ode(to), leaf("provide_feedback", truth, origin));
            }
            "cfmDamping" | "implicitSpringDamper" => {
                set(ode(to), leaf("implicit_spring_damper", truth, origin));
                set(ode(to), leaf("cfm_damping", truth, origin));
            }
            name if setting_target(name).is_some() => {}
            _ => to.push(setting.clone()),
        }
    }

    /// Joints that only URDF has, for the scene.
    pub(super) fn joints_beyond_sdf(&self) -> impl Iterator<Item = SceneJoint> + '_ {
        self.plan
            .order
            .iter()
            .filter(|&&link| self.plan.outcome[link] == LumpOutcome::Body)
            .filter_map(|&head| {
                let joint = self.joint_above(head)?;
                let kind = match joint.kind {
                    JointType::Floating => JointKind::Floating,
                    JointType::Planar => JointKind::Planar,
                    _ => return None,
                };
                let name = self.joint_names.of(&joint.name);
                let mut scene = SceneJoint::new(name, kind, self.parent_name(head), &*joint.child);
                scene.origin = joint.origin;
                if kind == JointKind::Planar {
                    scene.axis = Some(Axis {
                        direction_in_joint: DVec3::from_array(joint.axis_xyz())
                            .try_normalize()
                            .unwrap_or(DVec3::X),
                        ..Axis::default()
                    });
                }
                Some(scene)
            })
    }

    /// Warns about joints that Gazebo does not have.
    pub(super) fn check_joint_kinds(&self, diagnostics: &mut Diagnostics) {
        for joint in self.joints_beyond_sdf() {
            let name = &joint.name;
            diagnostics.push(
                Diagnostic::warning(
                    "not-in-gazebo",
                    format!("Gazebo has no joint of the kind of `{name}`, and refuses the robot"),
                )
                .at(joint.origin)
                .help("for a robot that moves freely leave the joint out; its root is free"),
            );
        }
    }
}

/// Settings of a joint for the physics engine ODE.
fn ode(joint: &mut Element) -> &mut Element {
    child_mut(child_mut(joint, "physics"), "ode")
}
