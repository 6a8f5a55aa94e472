//! Identification of plugins.

use periplus_scene::Plugin;

use crate::library::library_id;
use crate::{Family, PluginContext, PluginSpec, known};

/// Returns the specification of a `<plugin>`, if known.
///
/// The library decides. ROS 1 and ROS 2 share library names such as `libgazebo_ros_diff_drive.so`. For
/// these the ROS version is determined by, in this order: a `<ros>` element or a parameter that only ROS 2
/// reads; the other plugins of the file; parameters that only ROS 1 reads; default ROS 2.
#[must_use]
pub fn recognise(plugin: &Plugin, context: &PluginContext<'_>) -> Option<&'static PluginSpec> {
    let candidates = candidates(plugin);
    let [_, _, ..] = candidates[..] else { return candidates.first().copied() };
    let family = match (ros_sign(plugin), context.ros) {
        (Sign::Ros2, _) => Family::ClassicRos2,
        (_, Some(family)) => family,
        (Sign::Ros1 | Sign::PerhapsRos1, None) => Family::ClassicRos1,
        (Sign::None, None) => Family::ClassicRos2,
    };
    candidates.iter().copied().find(|known| known.family == family).or(candidates.first().copied())
}

/// Evidence for the ROS version in a plugin itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sign {
    /// None, or not a ROS plugin.
    None,
    /// Library of ROS 1 only.
    Ros1,
    /// Parameters of ROS 1 in a library of both. They are often left in ROS 2 files.
    PerhapsRos1,
    /// Library or element of ROS 2 only.
    Ros2,
}

pub(crate) fn ros_sign(plugin: &Plugin) -> Sign {
    let candidates = candidates(plugin);
    if let [only] = candidates[..] {
        return match only.family {
            Family::ClassicRos1 => Sign::Ros1,
            Family::ClassicRos2 => Sign::Ros2,
            Family::Classic | Family::Gz => Sign::None,
        };
    }
    let reads = |family: Family, name: &str| {
        candidates.iter().any(|known| known.family == family && known.table.find(name).is_some())
    };
    let mut sign = Sign::None;
    for element in &plugin.content {
        let name = element.name.as_str();
        match (reads(Family::ClassicRos1, name), reads(Family::ClassicRos2, name)) {
            (false, true) => return Sign::Ros2,
            (true, false) => sign = Sign::PerhapsRos1,
            _ => {}
        }
    }
    sign
}

fn candidates(plugin: &Plugin) -> Vec<&'static PluginSpec> {
    let id = library_id(&plugin.filename);
    known().filter(|known| known.id == id).collect()
}
