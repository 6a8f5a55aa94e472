//! `<model>` element and additions to the resulting model.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Diagnostics};
use periplus_scene::{FrameRole, Joint as SceneJoint, Model, Sensor, SensorKind};
use periplus_xml::Element;

use super::element::{element, push_pose, renamed, set};
use super::extension::{SettingTarget, check_place, setting_target};
use super::link::shape_name;
use super::state::ConversionState;
use crate::lump::LumpOutcome;
use crate::robot::{UrdfMaterial, UrdfVisual};

impl ConversionState<'_> {
    /// The `<model>`.
    pub(super) fn model_element(&self, diagnostics: &mut Diagnostics) -> Element {
        self.joint_names.check(self.robot, diagnostics);
        self.check_losses(diagnostics);
        self.check_joint_kinds(diagnostics);
        let mut to = element("model", self.robot.origin).with_attribute("name", self.name());
        let brought = self.brought();
        let with_settings = self.are_settings_few(diagnostics);
        for &link in &self.plan.order {
            match self.plan.outcome[link] {
                LumpOutcome::Body => {
                    if let Some(joint) = self.joint_element(link, diagnostics) {
                        to.push(joint);
                    }
                    to.push(self.link_element(link, with_settings, diagnostics));
                }
                LumpOutcome::Merged { .. } | LumpOutcome::Lost => {
                    self.frames(link, &brought, &mut to);
                }
                LumpOutcome::World => {}
            }
        }
        for setting in self.extensions.settings("") {
            check_place(setting, &[SettingTarget::Robot], diagnostics);
            match &*setting.name {
                "static" => {
                    set(&mut to, renamed(setting, "static"));
                }
                name if setting_target(name).is_some() => {}
                _ => to.push(setting.clone()),
            }
        }
        self.place(&mut to, diagnostics);
        to
    }

    /// Adds the pose at which Gazebo places the robot, if the file gives one.
    fn place(&self, to: &mut Element, diagnostics: &mut Diagnostics) {
        let Some(origin) = &self.robot.origin_in_world else { return };
        if let Some(pose) = to.child("pose") {
            diagnostics.push(
                Diagnostic::warning(
                    "two-poses",
                    "the robot has an `origin` and a `pose` in a <gazebo> block; the origin is used",
                )
                .at(pose.origin)
                .help("keep one of them"),
            );
            to.children.retain(|node| node.as_element().is_none_or(|child| child.name != "pose"));
        }
        push_pose(to, origin.pose(), self.robot.origin);
    }

    /// Adds the frames of a link without a body and of the joint above it: the joint's frame attached to
    /// the parent, the link's to the joint (libsdformat 14, `ReduceFixedJoints`).
    fn frames(&self, link: usize, brought: &BTreeSet<&str>, to: &mut Element) {
        let data = self.link(link);
        let mut on_model = element("frame", data.origin).with_attribute("name", &*data.name);
        if let Some(joint) = self.joint_above(link) {
            let name = self.joint_names.of(&joint.name);
            let parent = match self.parent(link) {
                Some(parent) if !self.on_world(link) => &*parent.name,
                _ => "__model__",
            };
            let mut frame = element("frame", joint.origin)
                .with_attribute("name", name)
                .with_attribute("attached_to", parent);
            push_pose(&mut frame, joint.parent_from_joint.pose(), joint.origin);
            if !brought.contains(name) {
                to.push(frame);
            }
            on_model = on_model.with_attribute("attached_to", name);
        }
        if !brought.contains(&*data.name) {
            to.push(on_model);
        }
    }

    /// Names of the SDF links, joints and frames that the robot defines in <gazebo> blocks. The PR2 does so
    /// for joints that Gazebo does not convert from its URDF.
    fn brought(&self) -> BTreeSet<&str> {
        self.extensions
            .settings("")
            .filter(|part| ["link", "joint", "frame", "model"].contains(&&*part.name))
            .filter_map(|part| part.value("name"))
            .collect()
    }

    /// Definition of a visual's material: by name, or else its own.
    pub(super) fn look<'v>(&'v self, visual: &'v UrdfVisual) -> Option<&'v UrdfMaterial> {
        let own = visual.material.as_ref()?;
        if own.name.is_empty() {
            return Some(own);
        }
        self.materials.get(&*own.name).copied().or_else(|| own.is_definition().then_some(own))
    }

    /// Removes the findings about the SDF that repeat findings about the URDF.
    pub(super) fn without_repetitions(&self, found: Diagnostics) -> Diagnostics {
        let inertials: BTreeSet<_> = self
            .robot
            .links
            .iter()
            .flat_map(|link| [link.inertial.as_ref().and_then(|one| one.origin.0), link.origin.0])
            .flatten()
            .collect();
        let said = |one: &Diagnostic| match one.cause {
            Some(DiagnosticCause::Inertia) => {
                one.span.is_some_and(|span| inertials.contains(&span))
            }
            Some(DiagnosticCause::NoLinks) => {
                !self.plan.massless.is_empty() || self.robot.links.is_empty()
            }
            _ => false,
        };
        let mut rest = Diagnostics::new();
        for one in found.iter().filter(|one| !said(one)) {
            rest.push(one.clone());
        }
        rest
    }

    /// Adds data to a model that SDF cannot express.
    pub(super) fn complete(&self, model: &mut Model) {
        self.mark_frames(model);
        self.name_materials(model);
        self.rename_contacts(model);
        model.joints.extend(self.joints_beyond_sdf());
        self.keep_controllers(model);
        for verbatim in [&self.robot.transmissions, &self.robot.ros2_controls, &self.robot.sensors]
        {
            model.extra.extend(verbatim.iter().cloned());
        }
        model.extra.extend(self.robot.extra.elements.iter().cloned());
    }

    fn mark_frames(&self, model: &mut Model) {
        let mut roles: BTreeMap<&str, FrameRole> = BTreeMap::new();
        for &link in &self.plan.order {
            if matches!(self.plan.outcome[link], LumpOutcome::Merged { .. } | LumpOutcome::Lost) {
                roles.insert(&self.link(link).name, FrameRole::MergedLink);
                if let Some(joint) = self.joint_above(link) {
                    roles.insert(self.joint_names.of(&joint.name), FrameRole::MergedJoint);
                }
            }
        }
        for frame in &mut model.frames {
            if let Some(role) = roles.get(&*frame.name) {
                frame.role = *role;
            }
        }
    }

    fn name_materials(&self, model: &mut Model) {
        let mut places: BTreeMap<&str, usize> = BTreeMap::new();
        for (place, link) in model.links.iter().enumerate() {
            places.insert(&link.name, place);
        }
        let places: Vec<(usize, usize)> = self
            .plan
            .order
            .iter()
            .filter_map(|&link| Some((link, *places.get(&*self.link(link).name)?)))
            .collect();
        for (head, place) in places {
            let members = self.members[head].iter().map(|(link, _)| self.link(*link));
            let visuals = members.flat_map(|link| &link.visuals);
            for (to, visual) in model.links[place].visuals.iter_mut().zip(visuals) {
                let name = visual.material.as_ref().map(|own| &own.name);
                if let (Some(material), Some(name)) = (&mut to.material, name)
                    && !name.is_empty()
                {
                    material.name = Some(name.clone());
                }
            }
        }
    }

    /// Renames the collisions of contact sensors, which are written as if no link were merged.
    fn rename_contacts(&self, model: &mut Model) {
        for link in &mut model.links {
            let watches = |sensor: &Sensor| matches!(sensor.kind, SensorKind::Contact { .. });
            let Some(&head) = self.tree.index.get(&*link.name) else { continue };
            if !link.sensors.iter().any(watches) {
                continue;
            }
            let names: BTreeSet<&str> =
                link.collisions.iter().map(|collision| &*collision.name).collect();
            let merged = self.merged_names(head);
            for sensor in &mut link.sensors {
                let SensorKind::Contact { collisions, .. } = &mut sensor.kind else { continue };
                for wanted in collisions.iter_mut().filter(|wanted| !names.contains(&***wanted)) {
                    if let Some(found) = merged.get(wanted) {
                        wanted.clone_from(found);
                    }
                }
            }
        }
    }

    /// Names of a body's collisions, indexed by the names that they have or would have on their own links.
    fn merged_names(&self, head: usize) -> BTreeMap<String, String> {
        let head_name = &self.link(head).name;
        let mut names = BTreeMap::new();
        let mut index = 0;
        for &(member, _) in &self.members[head] {
            let link = self.link(member);
            for (own_index, collision) in link.collisions.iter().enumerate() {
                let own = collision.name.as_deref();
                let merged = shape_name(head_name, &link.name, own, "collision", index);
                let alone = shape_name(&link.name, &link.name, own, "collision", own_index);
                index += 1;
                for name in [Some(&*alone), own].into_iter().flatten() {
                    names.entry(name.to_owned()).or_insert_with(|| merged.clone());
                }
            }
        }
        names
    }

    /// Calibration and soft limits of joints, for controllers.
    fn keep_controllers(&self, model: &mut Model) {
        let mut written: BTreeMap<&str, Vec<Element>> = BTreeMap::new();
        for joint in &self.robot.joints {
            let kept = crate::write::controller_parts(joint);
            if !kept.is_empty() || !joint.extra.elements.is_empty() {
                let kept = kept.into_iter().chain(joint.extra.elements.iter().cloned());
                written.insert(self.joint_names.of(&joint.name), kept.collect());
            }
        }
        let keep = |joint: &mut SceneJoint| {
            joint.extra.extend(written.get(&*joint.name).cloned().unwrap_or_default());
        };
        model.joints.iter_mut().for_each(keep);
    }
}
