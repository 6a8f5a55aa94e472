//! What would silently not work, and what contradicts itself.
//!
//! Loading never stops for any of it. What Gazebo would pass over in silence is a warning; names
//! and values that cannot be right are errors; what works but is worth knowing is a hint.

mod geometry;
mod parameters;
mod references;
mod ros;
mod ros_version;
mod systems;
mod topics;
mod unknown;

use periplus_diagnostics::Diagnostics;
use periplus_scene::Scene;

use crate::{Interpreted, Role, Site, interpret, sites};

/// Drives whose wheels are measured; each looks for its joints and links by name.
const MOST_DRIVES: usize = 1_000;

/// Adds what there is to say about the plugins of a scene, and about sensors that want a plugin.
pub fn lint(scene: &Scene, diagnostics: &mut Diagnostics) {
    let sites = sites(scene);
    unknown::check(&sites, diagnostics);
    let mut understood: Vec<(Site<'_>, Interpreted)> = Vec::new();
    let mut names = references::Cache::default();
    let mut drives = 0;
    for site in sites {
        if let Some(plugin) = interpret(site.plugin, &site.context, diagnostics) {
            parameters::check(&site, plugin.known, diagnostics);
            ros::check(&site, &plugin, diagnostics);
            references::check(&site, &plugin, &mut names, diagnostics);
            if plugin.known.role == Role::Drive && drives < MOST_DRIVES {
                drives += 1;
                geometry::check(&site, &plugin, diagnostics);
            }
            understood.push((site, plugin));
        }
    }
    topics::check(&understood, diagnostics);
    ros_version::check(&understood, diagnostics);
    for world in &scene.worlds {
        systems::check(world, &understood, diagnostics);
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::lint;
    use crate::fixture::scene;
    use periplus_diagnostics::Diagnostics;

    /// With quadratic searches this takes minutes.
    #[test]
    fn a_slip_in_every_line_costs_little() {
        let mut text = String::from("<model name='m'>");
        for index in 0..5_000 {
            let _ = write!(
                text,
                "<link name='l{index}'/><joint name='j{index}'><child>l{index}</child></joint>
                 <plugin name='p{index}' filename='libgazebo_ros_diff_drive.so'>
                   <ros/><left_joint>j{index}x</left_joint><right_joint>j{index}</right_joint>
                 </plugin><plugin name='u{index}' filename='libunknown{index}.so'/>"
            );
        }
        text.push_str("</model>");
        let mut diagnostics = Diagnostics::new();
        lint(&scene(&text), &mut diagnostics);
        assert_eq!(diagnostics.errors(), 5_000);
    }
}
