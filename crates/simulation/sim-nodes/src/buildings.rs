//! Doors and lifts of buildings, as Open-RMF simulates them: `register_component` names the joints of a model, and
//! requests on topics move them.
//!
//! Source of names, parameters and behaviour: `rmf_building_sim_gz_plugins` of `rmf_simulation` 2.4 (`register_component`,
//! `door`, `lift`), and the worlds that `rmf_building_map_tools` writes.

mod cabin;
mod device;
mod door;
mod lift;
mod motion;
mod read;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::Graph;
use periplus_scene::{Model, World};

pub use read::BuildingFloor;

pub(crate) use motion::MotionLimits;

use self::device::Building;
use crate::Device;

/// Builds the device that moves all doors and lifts of the models of a world; none where there are none.
pub(crate) fn build(
    graph: &Graph,
    world: &World,
    models: &[&Model],
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Device>> {
    let plan = read::read(world, models, diagnostics);
    if plan.doors.is_empty() && plan.lifts.is_empty() {
        return None;
    }
    match Building::new(graph, plan) {
        Ok(building) => Some(Box::new(building)),
        Err(error) => {
            let message = format!("doors and lifts cannot be moved: {error}");
            diagnostics.push(Diagnostic::error("plugin-refused", message));
            None
        }
    }
}

/// Floors that the lifts of the models of a world serve, each once, the lowest first.
#[must_use]
pub fn floors_of(world: &World, models: &[&Model]) -> Vec<BuildingFloor> {
    let plan = read::read(world, models, &mut Diagnostics::new());
    let mut floors: Vec<BuildingFloor> =
        plan.lifts.into_iter().flat_map(|lift| lift.stops).map(|stop| stop.floor).collect();
    floors.sort_by(|a, b| a.elevation_m.total_cmp(&b.elevation_m).then(a.name.cmp(&b.name)));
    floors.dedup_by(|a, b| a.name == b.name);
    floors
}
