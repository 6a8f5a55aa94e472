//! Which plugin a `<plugin>` means.

use periplus_scene::Plugin;

use crate::library::library_id;
use crate::{Context, Family, Known, known};

/// The plugin that a `<plugin>` means, if we know it.
///
/// The library decides. ROS 1 and ROS 2 share library names such as `libgazebo_ros_diff_drive.so`;
/// there a `<ros>` element means ROS 2, then parameters that only one of the two reads, then the
/// other plugins of the file, and without any sign ROS 2.
#[must_use]
pub fn recognise(plugin: &Plugin, context: &Context<'_>) -> Option<&'static Known> {
    let id = library_id(&plugin.filename);
    let candidates: Vec<&'static Known> = known().filter(|known| known.id == id).collect();
    match candidates[..] {
        [] => None,
        [only] => Some(only),
        _ => {
            let family = family_by_parameters(plugin, &candidates).unwrap_or(if context.ros1 {
                Family::ClassicRos1
            } else {
                Family::ClassicRos2
            });
            candidates.iter().copied().find(|known| known.family == family).or(Some(candidates[0]))
        }
    }
}

/// The family of a plugin as far as it tells by itself.
pub(crate) fn certain_family(plugin: &Plugin) -> Option<Family> {
    let id = library_id(&plugin.filename);
    let candidates: Vec<&'static Known> = known().filter(|known| known.id == id).collect();
    match candidates[..] {
        [] => None,
        [only] => Some(only.family),
        _ => family_by_parameters(plugin, &candidates),
    }
}

fn family_by_parameters(plugin: &Plugin, candidates: &[&'static Known]) -> Option<Family> {
    if plugin.content.iter().any(|element| element.name == "ros") {
        return Some(Family::ClassicRos2);
    }
    let reads = |family: Family, name: &str| {
        candidates.iter().any(|known| known.family == family && known.table.find(name).is_some())
    };
    let mut ros1_only = false;
    let mut ros2_only = false;
    for element in &plugin.content {
        let name = element.name.as_str();
        match (reads(Family::ClassicRos1, name), reads(Family::ClassicRos2, name)) {
            (true, false) => ros1_only = true,
            (false, true) => ros2_only = true,
            _ => {}
        }
    }
    // With both, ROS 2: old parameters are often carried along, new ones never carried back.
    match (ros1_only, ros2_only) {
        (_, true) => Some(Family::ClassicRos2),
        (true, false) => Some(Family::ClassicRos1),
        (false, false) => None,
    }
}
