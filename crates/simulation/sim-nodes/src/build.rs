//! Devices of a model.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, GraphError};
use periplus_plugin_specs::{interpret, model_sites, world_sites};
use periplus_scene::{Model, World};

use crate::states::{JointStatePublisher, RobotFrames, triggered};
use crate::{Device, DeviceContext, buildings, drives, sensors};

/// Builds the devices of a model: first drives, then sensors, then publishers of joint states and
/// frames. Problems are reported, and valid devices are built. `description` is the URDF of the
/// model; with it the robot has a `robot_state_publisher`.
#[must_use]
pub fn devices(
    setting: &DeviceContext<'_>,
    description: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Vec<Box<dyn Device>> {
    let sites = model_sites(setting.scene, setting.root);
    let others = joint_state_publishers(setting);
    let mut devices: Vec<Box<dyn Device>> = Vec::new();
    let mut has_controllers = false;
    for site in &sites {
        // Problems of parameters were reported when the file was checked.
        let plugin = interpret(site.plugin, &site.context, &mut Diagnostics::new());
        has_controllers |= plugin.as_ref().is_some_and(|plugin| is_controlled(plugin.known.id));
        let driven = plugin.and_then(|plugin| drives::build(setting, site, &plugin, diagnostics));
        devices.extend(driven);
    }
    devices.extend(sensors::build(setting, &sites, diagnostics));
    let publishes_joint_states = joint_state_publishers(setting) > others;
    // A spawner may start a broadcaster later.
    let may_publish_later = has_controllers && !setting.starts_controllers;
    if setting.publishes_joint_states && !publishes_joint_states && !may_publish_later {
        match JointStatePublisher::fallback(setting) {
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

/// Builds the devices of a world, besides those of its models: what connects models, such as lifts with their doors, is
/// one device.
#[must_use]
pub fn world_devices(
    graph: &Graph,
    world: &World,
    models: &[&Model],
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
    devices.extend(buildings::build(graph, world, models, diagnostics));
    devices
}

/// Returns the number of publishers of topics named `joint_states`.
fn joint_state_publishers(setting: &DeviceContext<'_>) -> usize {
    let topics = setting.graph.topics();
    let named = topics.iter().filter(|topic| topic.name.ends_with("/joint_states"));
    named.map(|topic| topic.publishers.len()).sum()
}

fn refused(setting: &DeviceContext<'_>, error: &GraphError) -> Diagnostic {
    let message =
        format!("the joint states of `{}` are not published: {error}", setting.model_name);
    Diagnostic::error("states-refused", message).at(setting.root.origin)
}

/// Returns true for a plugin whose controllers can publish joint states.
fn is_controlled(id: &str) -> bool {
    id.contains("ros2_control") || id == "gazebo_ros_control"
}
