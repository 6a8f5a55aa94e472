//! From a model to its devices.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, GraphError};
use periplus_plugin_specs::{interpret, model_sites, world_sites};
use periplus_scene::World;

use crate::states::{JointStatePublisher, RobotFrames, triggered};
use crate::{Device, Setting, drives, sensors};

/// The devices of a model: first what drives it, then what measures, then who tells of its joints
/// and frames. What cannot be is told, and the rest is there. `description` is the URDF that it
/// came from; with it the robot has a `robot_state_publisher`.
#[must_use]
pub fn devices(
    setting: &Setting<'_>,
    description: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Vec<Box<dyn Device>> {
    let sites = model_sites(setting.scene, setting.root);
    let others = joint_state_publishers(setting);
    let mut devices: Vec<Box<dyn Device>> = Vec::new();
    for site in &sites {
        // What is wrong with a parameter was told when the file was checked.
        let plugin = interpret(site.plugin, &site.context, &mut Diagnostics::new());
        let driven = plugin.and_then(|plugin| drives::build(setting, site, &plugin, diagnostics));
        devices.extend(driven);
    }
    devices.extend(sensors::build(setting, &sites, diagnostics));
    let tells_joints = joint_state_publishers(setting) > others;
    if setting.tells_joints && !tells_joints {
        match JointStatePublisher::usual(setting) {
            Ok(Some(publisher)) => devices.push(Box::new(publisher)),
            Ok(None) => {}
            Err(error) => diagnostics.push(refused(setting, &error)),
        }
    }
    if let Some(description) = description {
        match RobotFrames::new(setting, description) {
            Ok(frames) => devices.push(Box::new(frames)),
            Err(error) => diagnostics.push(refused(setting, &error)),
        }
    }
    devices
}

/// The devices of a world itself, beside those of its models.
#[must_use]
pub fn world_devices(
    graph: &Graph,
    world: &World,
    diagnostics: &mut Diagnostics,
) -> Vec<Box<dyn Device>> {
    let mut devices: Vec<Box<dyn Device>> = Vec::new();
    for site in world_sites(world) {
        let plugin = interpret(site.plugin, &site.context, &mut Diagnostics::new());
        if plugin.is_some_and(|plugin| plugin.known.id == "gz-sim-triggered-publisher-system")
            && let Some(device) = triggered(graph, site.plugin, diagnostics)
        {
            devices.push(Box::new(device));
        }
    }
    devices
}

/// How many publish on a topic called `joint_states`.
fn joint_state_publishers(setting: &Setting<'_>) -> usize {
    let topics = setting.graph.topics();
    let named = topics.iter().filter(|topic| topic.name.ends_with("/joint_states"));
    named.map(|topic| topic.publishers.len()).sum()
}

fn refused(setting: &Setting<'_>, error: &GraphError) -> Diagnostic {
    let message = format!("the joints of `{}` are not told: {error}", setting.model_name);
    Diagnostic::error("states-refused", message).at(setting.root.origin)
}
