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

use crate::{Interpreted, Site, interpret, sites};

/// Adds what there is to say about the plugins of a scene, and about sensors that want a plugin.
pub fn lint(scene: &Scene, diagnostics: &mut Diagnostics) {
    let sites = sites(scene);
    unknown::check(&sites, diagnostics);
    let mut understood: Vec<(Site<'_>, Interpreted)> = Vec::new();
    for site in sites {
        if let Some(plugin) = interpret(site.plugin, &site.context, diagnostics) {
            parameters::check(&site, plugin.known, diagnostics);
            ros::check(&site, &plugin, diagnostics);
            references::check(&site, &plugin, diagnostics);
            geometry::check(&site, &plugin, diagnostics);
            understood.push((site, plugin));
        }
    }
    topics::check(&understood, diagnostics);
    ros_version::check(&understood, diagnostics);
    for world in &scene.worlds {
        systems::check(world, &understood, diagnostics);
    }
}
