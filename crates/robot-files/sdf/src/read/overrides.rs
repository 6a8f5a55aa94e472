//! Overrides in an `<include>`.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::Pose;
use periplus_xml::Element;

use super::include::Entity;
use super::model::reference;
use super::plugin::plugins;
use crate::fields::Fields;
use crate::pose::Reference;

/// Content of an `<include>`.
pub(crate) struct Overrides {
    pub(crate) uri: String,
    pub(crate) uri_origin: Origin,
    origin: Origin,
    pub(crate) merge: bool,
    name: Option<String>,
    is_static: Option<bool>,
    pose: Option<(Pose, Option<Reference>)>,
    placement_frame: Option<Reference>,
    plugins: Vec<periplus_scene::Plugin>,
    extra: Vec<Element>,
}

pub(crate) fn read_overrides(
    element: &Element,
    diagnostics: &mut Diagnostics,
) -> Option<Overrides> {
    let mut fields = Fields::new(element, diagnostics);
    let uri = fields.text("uri");
    let name = fields.text("name");
    let merge = fields.attribute("merge").is_some_and(|it| {
        crate::value::boolean_word(&it.value, it.value_origin, fields.diagnostics).unwrap_or(false)
    });
    let is_static = element.child("static").is_some().then(|| fields.boolean("static", false));
    let pose = element.child("pose").is_some().then(|| fields.pose());
    let placement_frame = match fields.child("placement_frame") {
        Some(child) => {
            crate::value::leaf(child, &[], fields.diagnostics);
            let name = child.text();
            (!name.is_empty())
                .then(|| Reference { name: name.as_ref().into(), origin: child.text_origin() })
        }
        None => reference(&mut fields, "placement_frame"),
    };
    let plugins = plugins(&mut fields);
    fields.verbatim(&["static", "pose"]);
    let extra = fields.finish();
    if let Some(parameters) = extra.iter().find(|it| it.name == "experimental:params") {
        diagnostics.push(
            Diagnostic::warning(
                "unsupported",
                "changes to an included model by `<experimental:params>` are not made",
            )
            .at(parameters.origin)
            .help("change a copy of the model's file instead"),
        );
    }
    let Some(uri) = uri else {
        diagnostics.push(
            Diagnostic::error("missing-uri", "`<include>` lacks its `<uri>`")
                .at(element.origin)
                .help("write `<include><uri>model://name</uri></include>`"),
        );
        return None;
    };
    if placement_frame.is_some() && pose.is_none() {
        diagnostics.push(
            Diagnostic::error("missing-element", "a `<placement_frame>` needs a `<pose>`")
                .at(element.origin)
                .help("give the pose of the frame: add `<pose>0 0 0 0 0 0</pose>`"),
        );
    }
    let uri_origin = element.child("uri").map(Element::text_origin).unwrap_or_default();
    Some(Overrides {
        uri,
        uri_origin,
        origin: element.origin,
        merge,
        name,
        is_static,
        pose,
        placement_frame,
        plugins,
        extra,
    })
}

impl Overrides {
    pub(crate) fn apply(self, entity: &mut Entity) {
        match entity {
            Entity::Model(draft) => {
                let model = &mut draft.model;
                model.name = self.name.unwrap_or_else(|| std::mem::take(&mut model.name));
                model.is_static = self.is_static.unwrap_or(model.is_static);
                model.included_from = Some(self.uri);
                model.plugins.extend(self.plugins);
                model.extra.extend(self.extra);
                model.origin = self.origin;
                if let Some((pose, relative_to)) = self.pose {
                    model.parent_from_model = pose;
                    draft.relative_to = relative_to;
                    draft.placement_frame = self.placement_frame;
                }
            }
            Entity::Light(draft) => {
                let light = &mut draft.light;
                light.name = self.name.unwrap_or_else(|| std::mem::take(&mut light.name));
                light.origin = self.origin;
                if let Some((pose, relative_to)) = self.pose {
                    light.parent_from_light = pose;
                    draft.relative_to = relative_to;
                }
            }
            Entity::Actor(draft) => {
                let actor = &mut draft.actor;
                actor.name = self.name.unwrap_or_else(|| std::mem::take(&mut actor.name));
                actor.plugins.extend(self.plugins);
                actor.origin = self.origin;
                if let Some((pose, relative_to)) = self.pose {
                    actor.world_from_actor = pose;
                    draft.relative_to = relative_to;
                }
            }
        }
    }
}
