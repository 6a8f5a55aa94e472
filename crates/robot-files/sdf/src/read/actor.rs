//! `<actor>`.

use periplus_diagnostics::Diagnostics;
use periplus_scene::Actor;
use periplus_xml::Element;

use super::joint::read_joint;
use super::link::read_link;
use super::plugin::plugins;
use crate::draft::ActorDraft;
use crate::fields::Fields;

pub(crate) fn read_actor(element: &Element, diagnostics: &mut Diagnostics) -> ActorDraft {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let (world_from_actor, relative_to) = fields.pose();
    let plugins = plugins(&mut fields);
    let mut links = Vec::new();
    for child in fields.children("link") {
        links.push(read_link(child, false, fields.diagnostics));
    }
    let mut joints = Vec::new();
    for child in fields.children("joint") {
        joints.extend(read_joint(child, fields.diagnostics));
    }
    fields.verbatim(&["skin", "animation", "script", "static", "frame"]);
    let actor = Actor {
        name: name.unwrap_or_else(|| "actor".into()),
        world_from_actor,
        links: Vec::new(),
        joints: Vec::new(),
        plugins,
        extra: fields.finish(),
        origin: element.origin,
    };
    ActorDraft { actor, relative_to, links, joints }
}
