//! Sensors with those who publish what they measure.
//!
//! A sensor publishes through its plugins, as each of them would in Gazebo; one without any under
//! the topic that Gazebo's own sensors have. What nobody hears is not measured.

mod camera;
mod cloud;
mod contact;
mod imu;
mod lidar;
mod logical;
mod mount;
mod navsat;
mod order;
mod port;
mod post;
mod scalar;
mod sonar;
mod timer;

use periplus_diagnostics::Diagnostics;
use periplus_plugin_specs::{Site, interpret};
use periplus_scene::{Model, SensorKind};

use crate::{Device, Setting};
use mount::Mount;
use order::{Failed, Made, Order};
use post::Post;
use timer::Timer;

/// The sensors of a model. `sites` are all its plugins.
pub(crate) fn build(
    setting: &Setting<'_>,
    sites: &[Site<'_>],
    diagnostics: &mut Diagnostics,
) -> Vec<Box<dyn Device>> {
    let mut devices = Vec::new();
    each_post(setting, setting.root, "", sites, &mut |post| {
        devices.extend(device(&post, diagnostics));
    });
    devices
}

/// Visits the sensors on links, those of nested models after those of the model itself.
fn each_post(
    setting: &Setting<'_>,
    model: &Model,
    scope: &str,
    sites: &[Site<'_>],
    visit: &mut dyn FnMut(Post<'_>),
) {
    for link in &model.links {
        let scoped = format!("{scope}{}", link.name);
        let Some(id) = setting.world.find_link(setting.model, &scoped) else { continue };
        for sensor in &link.sensors {
            let own = |site: &&Site<'_>| {
                site.context.sensor.is_some_and(|other| std::ptr::eq(other, sensor))
            };
            let own: Vec<Site<'_>> = sites.iter().filter(own).copied().collect();
            visit(Post { setting, model, scoped: &scoped, link, id, sensor, sites: &own });
        }
    }
    for inner in &model.models {
        each_post(setting, inner, &format!("{scope}{}::", inner.name), sites, visit);
    }
}

fn device(post: &Post<'_>, diagnostics: &mut Diagnostics) -> Option<Box<dyn Device>> {
    // What is wrong with a parameter was told when the file was checked.
    let plugins: Vec<_> = post
        .sites
        .iter()
        .filter_map(|site| interpret(site.plugin, &site.context, &mut Diagnostics::new()))
        .collect();
    match &post.sensor.kind {
        SensorKind::Lidar(spec) => lidar::build(post, spec, &plugins, diagnostics),
        _ => order::build(post, diagnostics),
    }
}
