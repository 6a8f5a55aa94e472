//! Export of the current world as SDF.

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_scene::{Model, Scene};
use periplus_xml::write_document;

use super::super::reading::told;
use crate::Simulation;

/// Returns the SDF with models at their current poses, and links at their initial poses in them.
///
/// # Errors
/// The part of the world that SDF cannot represent.
pub(in crate::services) fn text(simulation: &Simulation) -> Result<String, String> {
    let mut world = (*simulation.scene).clone();
    let running = simulation.running.iter();
    world.models = running
        .map(|running| {
            let pose = simulation.motion.model_pose(running.model);
            let parent_from_model = pose.unwrap_or(running.member.world_from_model);
            let name = running.member.name.clone();
            Model { name, parent_from_model, ..running.member.model.clone() }
        })
        .collect();
    let scene = Scene { worlds: vec![world], ..Scene::default() };
    let mut findings = Diagnostics::new();
    let document = periplus_sdf::write(&scene, &mut findings);
    if findings.has_errors() {
        return Err(told(&findings, &SourceMap::new()));
    }
    Ok(write_document(&document))
}
