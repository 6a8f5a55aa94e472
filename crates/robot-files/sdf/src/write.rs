//! Writer: a scene as SDF.
//!
//! Poses are written in the frame of their fixed parent, so reading them back resolves nothing. The version
//! is 1.9, which most current versions of Gazebo read, unless the content needs a newer one.

mod light;
mod link;
mod material;
mod model;
mod out;
mod radar;
mod sensor;
mod shape;
mod surface;
mod world;

use periplus_diagnostics::Diagnostics;
use periplus_scene::Scene;
use periplus_xml::{Document, Element};

use crate::version::Version;
use out::Out;

/// State of the writer.
struct Writer<'a> {
    version: Version,
    /// True if any extension that only Periplus reads is written.
    own_names: bool,
    diagnostics: &'a mut Diagnostics,
}

impl Writer<'_> {
    fn needs(&mut self, version: Version) {
        self.version = self.version.max(version);
    }
}

/// Writes a scene as SDF. Reading the document gives an equal scene, except for content that SDF cannot
/// express: floating and planar joints are left out with a warning, and paths of resolved files are not
/// written.
pub fn write(scene: &Scene, diagnostics: &mut Diagnostics) -> Document {
    let mut writer = Writer { version: Version::new(9), own_names: false, diagnostics };
    let mut content = Vec::new();
    for world in &scene.worlds {
        content.push(world::write_world(world, &mut writer));
    }
    for model in &scene.models {
        content.push(model::write_model(model, &mut writer));
    }
    for light in &scene.lights {
        content.push(light::write_light(light));
    }
    for actor in &scene.actors {
        content.push(world::write_actor(actor, &mut writer));
    }
    let mut root = Out::new("sdf");
    root.attribute("version", writer.version.to_string());
    if writer.own_names {
        root.attribute("xmlns:periplus", "urn:periplus:scene");
    }
    let mut root = root.finish(&[]);
    for element in content {
        root.push(element);
    }
    Document { before: Vec::new(), root, after: Vec::new() }
}

/// Writes one element of a plugin.
fn write_plugin(plugin: &periplus_scene::Plugin) -> Element {
    let mut out = Out::new("plugin");
    out.attribute("name", &plugin.name);
    out.attribute("filename", &plugin.filename);
    let mut element = out.finish(&[]);
    for child in &plugin.content {
        element.push(child.clone());
    }
    element
}
