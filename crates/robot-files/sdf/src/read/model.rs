//! `<model>` and `<frame>`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{FrameRole, Model, NamedFrame};
use periplus_xml::Element;

use super::include::{Entity, read_include};
use super::joint::read_joint;
use super::link::read_link;
use super::merge::merge;
use super::plugin::plugins;
use super::root::{MAX_NESTED_MODELS, Reader};
use crate::draft::{FrameDraft, ModelDraft};
use crate::fields::Fields;
use crate::pose::Reference;
use crate::version::Version;

/// Reads a `<model>` and its content, includes too; `None` if models are nested too deep.
pub(crate) fn read_model(element: &Element, reader: &mut Reader<'_>) -> Option<ModelDraft> {
    if reader.depth >= MAX_NESTED_MODELS {
        reader.diagnostics.push(
            Diagnostic::error(
                "too-deep",
                format!("more than {MAX_NESTED_MODELS} models are nested; this one is left out"),
            )
            .at(element.origin),
        );
        return None;
    }
    let mut draft = read_own(element, reader);
    reader.depth += 1;
    // Links of merged models count at the position of their include: the first link of all is canonical.
    let mut links_before = 0;
    for child in element.elements() {
        match &*child.name {
            "link" => links_before += 1,
            "model" => draft.models.extend(read_model(child, reader)),
            "include" => match read_include(child, reader) {
                Some((Entity::Model(included), true)) => {
                    let links = draft.links.len();
                    merge(*included, &mut draft, reader);
                    let merged = draft.links.len() - links;
                    draft.links[links_before..].rotate_right(merged);
                    links_before += merged;
                }
                Some((Entity::Model(included), false)) => draft.models.push(*included),
                Some(_) => reader.diagnostics.push(
                    Diagnostic::error("misplaced-include", "a model can include only models")
                        .at(child.origin),
                ),
                None => {}
            },
            _ => {}
        }
    }
    reader.depth -= 1;
    Some(draft)
}

/// Reads the model without nested models.
fn read_own(element: &Element, reader: &mut Reader<'_>) -> ModelDraft {
    let lenient_names = reader.version < Version::new(7);
    let mut fields = Fields::new(element, reader.diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let mut model = Model::new(name.unwrap_or_else(|| "model".into()));
    model.origin = element.origin;
    let canonical_link = reference(&mut fields, "canonical_link");
    let placement_frame = reference(&mut fields, "placement_frame");
    // Extension written by this crate's writer.
    model.included_from = fields.attribute("periplus:included_from").map(|it| it.value.to_string());
    let (pose, relative_to) = fields.pose();
    model.parent_from_model = pose;
    model.is_static = fields.boolean("static", false);
    model.self_collide = fields.boolean("self_collide", false);
    model.allow_auto_disable = fields.boolean("allow_auto_disable", true);
    model.enable_wind = fields.boolean("enable_wind", false);
    model.plugins = plugins(&mut fields);
    let mut links = Vec::new();
    for child in fields.children("link") {
        links.push(read_link(child, !model.is_static, fields.diagnostics));
    }
    let mut joints = Vec::new();
    for child in fields.children("joint") {
        joints.extend(read_joint(child, fields.diagnostics));
    }
    let mut frames = Vec::new();
    for child in fields.children("frame") {
        frames.push(read_frame(child, fields.diagnostics));
    }
    // The caller reads these in their order.
    fields.children("model");
    fields.children("include");
    fields.verbatim(&["gripper"]);
    model.extra = fields.finish();
    ModelDraft {
        model,
        relative_to,
        placement_frame,
        canonical_link,
        links,
        joints,
        frames,
        models: Vec::new(),
        lenient_names,
    }
}

pub(crate) fn read_frame(element: &Element, diagnostics: &mut Diagnostics) -> FrameDraft {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let attached_to = reference(&mut fields, "attached_to");
    let role = match fields.attribute("periplus:role").map(|it| &*it.value) {
        Some("merged_link") => FrameRole::MergedLink,
        Some("merged_joint") => FrameRole::MergedJoint,
        _ => FrameRole::Declared,
    };
    let (pose, relative_to) = fields.pose();
    fields.finish();
    let frame = NamedFrame {
        name: name.unwrap_or_else(|| "frame".into()),
        parent_from_frame: pose,
        attached_to: String::new(),
        role,
        origin: element.origin,
    };
    FrameDraft { frame, relative_to, attached_to }
}

/// Attribute that refers to a frame.
pub(crate) fn reference(fields: &mut Fields<'_, '_>, name: &'static str) -> Option<Reference> {
    let attribute = fields.attribute(name)?;
    let trimmed = attribute.value.trim();
    (!trimmed.is_empty())
        .then(|| Reference { name: trimmed.into(), origin: attribute.value_origin })
}
