//! Settings in `<gazebo>` blocks that apply to each shape of a link, merged once per link.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_xml::Element;

use super::element::{child_mut, element, leaf, renamed, set, value};
use super::parts::Parts;
use crate::robot::GazeboBlock;

/// Location of the materials named `Gazebo/...` in Gazebo Classic.
pub(crate) const BUILTIN_MATERIALS: &str = "file://media/materials/scripts/gazebo.material";

/// Maximum number of elements that settings may add to the shapes of a robot. Robots with a hundred shapes
/// have about a thousand.
const MAX_COPIED_ELEMENTS: usize = 200_000;

/// Children added to each shape of a link.
#[derive(Default)]
pub(super) struct ShapeSettings {
    /// Children of a `<collision>`.
    pub(super) collision: Vec<Element>,
    /// Children of a `<visual>`.
    pub(super) visual: Vec<Element>,
    /// Numbers of elements in them, descendants included.
    sizes: [usize; 2],
}

impl ShapeSettings {
    /// Merges the blocks of one link; the last occurrence of a setting wins.
    pub(super) fn new(blocks: &[&GazeboBlock]) -> Self {
        let size = |parts: &[Element]| parts.iter().map(elements).sum::<usize>();
        let (collision, visual) = (collision(blocks), visual(blocks));
        let sizes = [size(&collision), size(&visual)];
        Self { collision, visual, sizes }
    }

    /// Number of elements that these numbers of shapes receive.
    pub(super) fn copied_elements(&self, collisions: usize, visuals: usize) -> usize {
        let [collision, visual] = self.sizes;
        collision.saturating_mul(collisions).saturating_add(visual.saturating_mul(visuals))
    }
}

/// Reports an error and returns false if too many elements would be copied.
pub(super) fn are_few(copied: usize, robot: Origin, diagnostics: &mut Diagnostics) -> bool {
    if copied <= MAX_COPIED_ELEMENTS {
        return true;
    }
    diagnostics.push(
        Diagnostic::error(
            "too-many-settings",
            format!(
                "<gazebo> blocks bring {copied} elements into the shapes of the robot, each of \
                 their settings into each shape of a link; more than {MAX_COPIED_ELEMENTS} are not read"
            ),
        )
        .at(robot)
        .help("give each link fewer shapes, or fewer settings in <collision> and <visual>"),
    );
    false
}

fn elements(of: &Element) -> usize {
    1 + of.elements().map(elements).sum::<usize>()
}

fn collision(blocks: &[&GazeboBlock]) -> Vec<Element> {
    let mut parts = Parts::default();
    // Settings inside <surface> since it was last replaced: the last of each, with its position.
    let mut surface: BTreeMap<(&str, &str), (usize, Element)> = BTreeMap::new();
    let mut met = 0;
    for block in blocks {
        for content in block.content.iter().filter(|setting| setting.name == "collision") {
            for part in content.elements() {
                if part.name == "surface" {
                    surface.clear();
                }
                set_or_push(&mut parts, part);
            }
        }
        for setting in &block.content {
            let Some((group, name)) = place_in_collision(&setting.name) else { continue };
            let leaf = renamed(setting, name);
            if group.is_empty() {
                parts.set(leaf);
                continue;
            }
            if parts.get_mut("surface").is_none() {
                parts.set(element("surface", setting.origin));
            }
            met += 1;
            surface.insert((group, name), (met, leaf));
        }
    }
    let mut surface: Vec<_> = surface.into_iter().collect();
    surface.sort_by_key(|(_, (met, _))| *met);
    if let Some(to) = parts.get_mut("surface") {
        for ((group, _), (_, leaf)) in surface {
            set(child_mut(child_mut(to, group), "ode"), leaf);
        }
    }
    parts.into_elements().collect()
}

/// Group inside `<surface>` and name of a setting from before `<collision>` was allowed in a block; without
/// a group it belongs in the `<collision>` itself.
fn place_in_collision(setting: &str) -> Option<(&'static str, &'static str)> {
    Some(match setting {
        "mu" | "mu1" => ("friction", "mu"),
        "mu2" => ("friction", "mu2"),
        "fdir1" => ("friction", "fdir1"),
        "kp" => ("contact", "kp"),
        "kd" => ("contact", "kd"),
        "maxVel" => ("contact", "max_vel"),
        "minDepth" => ("contact", "min_depth"),
        "laserRetro" => ("", "laser_retro"),
        "maxContacts" => ("", "max_contacts"),
        _ => return None,
    })
}

fn visual(blocks: &[&GazeboBlock]) -> Vec<Element> {
    let mut parts = Parts::default();
    // Script named last since <material> was last replaced.
    let mut script = None;
    for block in blocks {
        for content in block.content.iter().filter(|setting| setting.name == "visual") {
            for part in content.elements() {
                if part.name == "material" {
                    script = None;
                }
                set_or_push(&mut parts, part);
            }
        }
        for setting in block.content.iter().filter(|setting| setting.name == "material") {
            let (text, origin) = value(setting);
            if text.is_empty() {
                // SDF in place of a name is ignored by Gazebo and has been reported.
                if setting.elements().next().is_some() {
                    script = None;
                    parts.set(setting.clone());
                }
                continue;
            }
            if parts.get_mut("material").is_none() {
                parts.set(element("material", setting.origin));
            }
            script = Some((text, origin));
        }
    }
    if let (Some(material), Some((name, origin))) = (parts.get_mut("material"), script) {
        let script = child_mut(material, "script");
        set(script, leaf("name", &name, origin));
        set(script, leaf("uri", BUILTIN_MATERIALS, origin));
    }
    parts.into_elements().collect()
}

/// Most children of a shape occur at most once; plugins may repeat. As in Gazebo, children set by the URDF
/// (pose, geometry) cannot be overridden; the SDF reader reports it.
fn set_or_push(parts: &mut Parts, part: &Element) {
    match &*part.name {
        "plugin" | "pose" | "geometry" => parts.push(part.clone()),
        _ => {
            parts.set(part.clone());
        }
    }
}
