//! Links that carry a body.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_xml::{Element, XmlNode};

use super::element::{child_mut, element, is_true, leaf, numbers, push_pose, renamed};
use super::extension::{SettingTarget, check_place, setting_target};
use super::parts::Parts;
use super::shape;
use super::state::ConversionState;
use crate::lump::combine;
use crate::robot::UrdfLink;

/// Children of a `<link>` that occur at most once.
const SINGLE: [&str; 6] =
    ["gravity", "enable_wind", "self_collide", "kinematic", "velocity_decay", "must_be_base_link"];

/// Separator between the name of a body's link and that of a shape merged into it.
pub(crate) const LUMP: &str = "_fixed_joint_lump__";

/// The name of the shape at `index` of a body (libsdformat, `CreateCollisions`).
pub(super) fn shape_name(
    head: &str,
    link: &str,
    own: Option<&str>,
    kind: &str,
    index: usize,
) -> String {
    let base = own.filter(|own| !own.is_empty()).unwrap_or(link);
    let number = if index > 0 { format!("_{index}") } else { String::new() };
    // Libsdformat omits the prefix if the name starts with that of the body's link, merged or not. Other
    // programs rely on these names.
    let prefix = if base.starts_with(head) { String::new() } else { format!("{head}{LUMP}") };
    format!("{prefix}{base}_{kind}{number}")
}

impl ConversionState<'_> {
    /// `<link>` of the body of `head`, with or without the settings for its shapes.
    pub(super) fn link_element(
        &self,
        head: usize,
        with_settings: bool,
        diagnostics: &mut Diagnostics,
    ) -> Element {
        let link = self.link(head);
        let mut to = element("link", link.origin).with_attribute("name", &*link.name);
        push_pose(&mut to, self.plan.model_from_link[head], link.origin);
        to.children.extend(self.inertial_element(head).map(XmlNode::Element));
        self.shapes(head, with_settings, &mut to);
        self.link_settings(head, &mut to, diagnostics);
        to
    }

    fn inertial_element(&self, head: usize) -> Option<Element> {
        let others = self.members[head].iter().skip(1).filter_map(|&(link, head_from_link)| {
            self.link(link).inertial.as_ref().map(|inertial| (head_from_link, inertial))
        });
        let own = self.link(head).inertial.as_ref();
        let sum = combine(own, others)?;
        let origin = own.map_or(self.link(head).origin, |inertial| inertial.origin);
        let mut to = element("inertial", origin);
        push_pose(&mut to, sum.link_from_inertial, origin);
        to.push(numbers("mass", &[sum.mass_kg], origin));
        let mut inertia = element("inertia", origin);
        let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
        for (name, value) in names.iter().zip(sum.inertia_kg_m2) {
            inertia.push(numbers(name, &[value], origin));
        }
        to.push(inertia);
        Some(to)
    }

    fn shapes(&self, head: usize, with_settings: bool, to: &mut Element) {
        let settings = |link: &UrdfLink| self.shape_settings(link).filter(|_| with_settings);
        let head_name = &self.link(head).name;
        let mut index = 0;
        for &(member, head_from_link) in &self.members[head] {
            let link = self.link(member);
            let settings = settings(link).map_or(&[][..], |settings| &settings.collision);
            for collision in &link.collisions {
                let own = collision.name.as_deref();
                let name = shape_name(head_name, &link.name, own, "collision", index);
                let pose = head_from_link * collision.link_from_collision.pose();
                to.push(shape::collision(collision, &name, pose, settings));
                index += 1;
            }
        }
        index = 0;
        for &(member, head_from_link) in &self.members[head] {
            let link = self.link(member);
            let settings = settings(link).map_or(&[][..], |settings| &settings.visual);
            for visual in &link.visuals {
                let own = visual.name.as_deref();
                let name = shape_name(head_name, &link.name, own, "visual", index);
                let pose = head_from_link * visual.link_from_visual.pose();
                let look = self.look(visual);
                to.push(shape::visual(visual, look, &name, pose, settings));
                index += 1;
            }
        }
    }

    /// Merges the settings of the blocks of all links of a body.
    fn link_settings(&self, head: usize, to: &mut Element, diagnostics: &mut Diagnostics) {
        // Link that made each setting that occurs at most once.
        let mut set_by: BTreeMap<String, usize> = BTreeMap::new();
        let mut parts = Parts::default();
        for &(member, _) in &self.members[head] {
            let name = &self.link(member).name;
            let merged = member != head;
            // A joint of the same name takes its own.
            let here: &[SettingTarget] = if self.joint_names.is_joint(name) {
                &[SettingTarget::Shapes, SettingTarget::Link, SettingTarget::Joint]
            } else {
                &[SettingTarget::Shapes, SettingTarget::Link]
            };
            for setting in self.extensions.settings(name) {
                check_place(setting, here, diagnostics);
                let Some(mut part) = link_part(setting) else { continue };
                if merged && ["sensor", "light", "projector"].contains(&&*part.name) {
                    stay_on(&mut part, name);
                }
                if !SINGLE.contains(&&*part.name) {
                    parts.push(part);
                    continue;
                }
                let key = part.name.to_string();
                let new = periplus_xml::canonical(&part);
                let old = parts.set(part);
                if let Some(earlier) = set_by.insert(key, member)
                    && earlier != member
                    && let Some(old) = old
                    && periplus_xml::canonical(&old) != new
                {
                    diagnostics.push(self.overruled(setting, &old, earlier, member, head));
                }
            }
        }
        to.children.extend(parts.into_elements().map(XmlNode::Element));
    }

    fn overruled(
        &self,
        setting: &Element,
        old: &Element,
        earlier: usize,
        later: usize,
        head: usize,
    ) -> Diagnostic {
        let name = |link: usize| &self.link(link).name;
        Diagnostic::warning(
            "lumped-setting",
            format!(
                "`{}` of `{}` overrides that of `{}`: both belong to the body `{}`",
                setting.name,
                name(later),
                name(earlier),
                name(head)
            ),
        )
        .at(setting.origin)
        .related(old.origin, "this has no effect")
        .note("fixed joints merge links, in Gazebo too, and the last setting wins")
        .help("set it once, or keep the joint with <preserveFixedJoint>true</preserveFixedJoint>")
    }
}

/// Setting of a link as a child of `<link>`; `None` for settings of shapes, joints and robots.
fn link_part(setting: &Element) -> Option<Element> {
    match &*setting.name {
        "turnGravityOff" => {
            let (text, origin) = super::element::value(setting);
            // Any value other than a clear no turns gravity off.
            let no = ["false", "no"].iter().any(|no| text.eq_ignore_ascii_case(no)) || text == "0";
            Some(leaf("gravity", if no { "true" } else { "false" }, origin))
        }
        "selfCollide" => {
            let (_, origin) = super::element::value(setting);
            Some(leaf("self_collide", if is_true(setting) { "true" } else { "false" }, origin))
        }
        "dampingFactor" => {
            let mut decay = element("velocity_decay", setting.origin);
            decay.push(renamed(setting, "linear"));
            decay.push(renamed(setting, "angular"));
            Some(decay)
        }
        name if setting_target(name).is_some() => None,
        _ => Some(setting.clone()),
    }
}

/// Makes a pose that was written for a merged link relative to that link's frame.
fn stay_on(part: &mut Element, link: &str) {
    let pose = child_mut(part, "pose");
    if pose.value("relative_to").is_none_or(str::is_empty) {
        pose.attributes.retain(|attribute| attribute.name != "relative_to");
        *pose = std::mem::replace(pose, Element::new("pose")).with_attribute("relative_to", link);
    }
}
