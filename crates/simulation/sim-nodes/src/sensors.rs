//! Sensors and their publishers.
//!
//! A sensor publishes through its plugins, as in Gazebo; without plugins, on the topics of Gazebo's
//! own sensors. Sensors without subscribers are not simulated.

mod build_context;
mod camera;
mod cloud;
mod contact;
mod environment;
mod imu;
mod lidar;
mod logical;
mod mount;
mod navsat;
mod port;
mod radar;
mod sensor_context;
mod sonar;
mod timer;

use periplus_diagnostics::Diagnostics;
use periplus_plugin_specs::{PluginSite, interpret};
use periplus_scene::{Model, SensorKind};

use crate::{Device, DeviceContext};
use build_context::{DeviceResult, SensorBuildContext, SensorBuildError};
pub(crate) use imu::diagonal;
use mount::Mount;
use sensor_context::SensorContext;
use timer::Timer;

/// Builds the sensors of a model. `sites` are all its plugins.
pub(crate) fn build(
    setting: &DeviceContext<'_>,
    sites: &[PluginSite<'_>],
    diagnostics: &mut Diagnostics,
) -> Vec<Box<dyn Device>> {
    let mut devices = Vec::new();
    for_each_sensor(setting, setting.root, "", sites, &mut |sensor_context| {
        devices.extend(device(&sensor_context, diagnostics));
    });
    devices
}

/// Visits the sensors on links, nested models after the model itself.
fn for_each_sensor(
    setting: &DeviceContext<'_>,
    model: &Model,
    scope: &str,
    sites: &[PluginSite<'_>],
    visit: &mut dyn FnMut(SensorContext<'_>),
) {
    for link in &model.links {
        let scoped = format!("{scope}{}", link.name);
        let Some(id) = setting.world.find_link(setting.model, &scoped) else { continue };
        for sensor in &link.sensors {
            let own = |site: &&PluginSite<'_>| {
                site.context.sensor.is_some_and(|other| std::ptr::eq(other, sensor))
            };
            let own: Vec<PluginSite<'_>> = sites.iter().filter(own).copied().collect();
            visit(SensorContext { setting, model, scoped: &scoped, link, id, sensor, sites: &own });
        }
    }
    for inner in &model.models {
        for_each_sensor(setting, inner, &format!("{scope}{}::", inner.name), sites, visit);
    }
}

fn device(
    sensor_context: &SensorContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Device>> {
    // Problems of parameters were reported when the file was checked.
    let plugins: Vec<_> = sensor_context
        .sites
        .iter()
        .filter_map(|site| interpret(site.plugin, &site.context, &mut Diagnostics::new()))
        .collect();
    match &sensor_context.sensor.kind {
        SensorKind::Lidar(spec) => lidar::build(sensor_context, spec, &plugins, diagnostics),
        _ => build_context::build(sensor_context, diagnostics),
    }
}
