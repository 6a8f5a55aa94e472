//! Plugins of a scene with the elements that they are attached to.

use periplus_scene::{Link, Model, Plugin, Scene, Sensor, World};

use crate::Family;
use crate::recognise::{Sign, ros_sign};

/// Type of the element that a plugin is attached to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PluginParent {
    /// A world.
    World,
    /// The GUI.
    Gui,
    /// A model.
    Model,
    /// A sensor.
    Sensor,
    /// A visual.
    Visual,
    /// An actor.
    Actor,
}

/// Elements around a plugin.
#[derive(Clone, Copy, Debug)]
pub struct PluginContext<'a> {
    /// Type of the element that it is attached to.
    pub place: PluginParent,
    /// World that contains it.
    pub world: Option<&'a World>,
    /// Outermost model that contains it.
    pub root: Option<&'a Model>,
    /// Innermost model that contains it.
    pub model: Option<&'a Model>,
    /// Link that contains it.
    pub link: Option<&'a Link>,
    /// Sensor that contains it.
    pub sensor: Option<&'a Sensor>,
    /// ROS version of the plugins of the file that determine it, for the others.
    pub ros: Option<Family>,
}

/// Plugin with its context.
#[derive(Clone, Copy, Debug)]
pub struct PluginSite<'a> {
    /// The plugin.
    pub plugin: &'a Plugin,
    /// Context of the plugin.
    pub context: PluginContext<'a>,
}

impl PluginContext<'_> {
    /// Context without any known element.
    pub const NOWHERE: PluginContext<'static> = PluginContext {
        place: PluginParent::Model,
        world: None,
        root: None,
        model: None,
        link: None,
        sensor: None,
        ros: None,
    };
}

/// All plugins of a scene, in order.
#[must_use]
pub fn sites(scene: &Scene) -> Vec<PluginSite<'_>> {
    let mut sites = Vec::new();
    for world in &scene.worlds {
        let context = PluginContext {
            place: PluginParent::World,
            world: Some(world),
            ..PluginContext::NOWHERE
        };
        add(&world.plugins, context, &mut sites);
        if let Some(gui) = &world.gui {
            add(&gui.plugins, PluginContext { place: PluginParent::Gui, ..context }, &mut sites);
        }
        for model in &world.models {
            add_model(model, PluginContext { root: Some(model), ..context }, &mut sites);
        }
        for actor in &world.actors {
            let context = PluginContext { place: PluginParent::Actor, ..context };
            add(&actor.plugins, context, &mut sites);
            for link in &actor.links {
                add_link(link, context, &mut sites);
            }
        }
        for joint in &world.joints {
            for sensor in &joint.sensors {
                add_sensor(sensor, context, &mut sites);
            }
        }
    }
    for model in &scene.models {
        add_model(model, PluginContext { root: Some(model), ..PluginContext::NOWHERE }, &mut sites);
    }
    for actor in &scene.actors {
        add(
            &actor.plugins,
            PluginContext { place: PluginParent::Actor, ..PluginContext::NOWHERE },
            &mut sites,
        );
    }
    settle_ros_version(&mut sites);
    sites
}

/// Plugins of a model in a world, in order.
#[must_use]
pub fn model_sites<'a>(world: &'a World, model: &'a Model) -> Vec<PluginSite<'a>> {
    let mut sites = Vec::new();
    let context = PluginContext { world: Some(world), root: Some(model), ..PluginContext::NOWHERE };
    add_model(model, context, &mut sites);
    settle_ros_version(&mut sites);
    sites
}

/// Plugins of a world itself, in order.
#[must_use]
pub fn world_sites(world: &World) -> Vec<PluginSite<'_>> {
    let mut sites = Vec::new();
    let context =
        PluginContext { place: PluginParent::World, world: Some(world), ..PluginContext::NOWHERE };
    add(&world.plugins, context, &mut sites);
    settle_ros_version(&mut sites);
    sites
}

fn add<'a>(plugins: &'a [Plugin], context: PluginContext<'a>, sites: &mut Vec<PluginSite<'a>>) {
    sites.extend(plugins.iter().map(|plugin| PluginSite { plugin, context }));
}

fn add_model<'a>(model: &'a Model, context: PluginContext<'a>, sites: &mut Vec<PluginSite<'a>>) {
    let context = PluginContext { place: PluginParent::Model, model: Some(model), ..context };
    add(&model.plugins, context, sites);
    for link in &model.links {
        add_link(link, context, sites);
    }
    for joint in &model.joints {
        for sensor in &joint.sensors {
            add_sensor(sensor, context, sites);
        }
    }
    for nested in &model.models {
        add_model(nested, context, sites);
    }
}

fn add_link<'a>(link: &'a Link, context: PluginContext<'a>, sites: &mut Vec<PluginSite<'a>>) {
    let context = PluginContext { link: Some(link), ..context };
    for sensor in &link.sensors {
        add_sensor(sensor, context, sites);
    }
    for visual in &link.visuals {
        add(&visual.plugins, PluginContext { place: PluginParent::Visual, ..context }, sites);
    }
}

fn add_sensor<'a>(sensor: &'a Sensor, context: PluginContext<'a>, sites: &mut Vec<PluginSite<'a>>) {
    let context = PluginContext { place: PluginParent::Sensor, sensor: Some(sensor), ..context };
    add(&sensor.plugins, context, sites);
}

/// A file has plugins of one ROS version: those that determine it apply to the others.
fn settle_ros_version(sites: &mut [PluginSite<'_>]) {
    let signs: Vec<Sign> = sites.iter().map(|site| ros_sign(site.plugin)).collect();
    let count = |sign: Sign| signs.iter().filter(|other| **other == sign).count();
    let (ros1, ros2) = (count(Sign::Ros1), count(Sign::Ros2));
    let ros = if ros1 > ros2 || ros2 == 0 && count(Sign::PerhapsRos1) > 0 {
        Some(Family::ClassicRos1)
    } else if ros2 > 0 {
        Some(Family::ClassicRos2)
    } else {
        None
    };
    for site in sites {
        site.context.ros = ros;
    }
}
