//! `<include merge="true">`.

use periplus_diagnostics::{Diagnostic, Diagnostics};

use super::root::Reader;
use crate::draft::{FrameDraft, ModelDraft, Part, WorldDraft};
use crate::frames::resolve_model;
use crate::pose::Reference;

/// Merges the content of an included model into the model around it. A frame `_merged__NAME__model__`
/// replaces the frame of the included model (SDF 1.9, merge include).
pub(crate) fn merge(included: ModelDraft, into: &mut ModelDraft, reader: &mut Reader<'_>) {
    let included = rebased(included, reader);
    into.frames.extend(included.frames);
    into.links.extend(included.links);
    into.joints.extend(included.joints);
    into.models.extend(included.models);
    into.model.plugins.extend(included.model.plugins);
    into.model.extra.extend(included.model.extra);
}

/// Merges into a world (SDF 1.10), which cannot have links.
pub(crate) fn merge_into_world(
    included: ModelDraft,
    into: &mut WorldDraft,
    reader: &mut Reader<'_>,
) {
    if let Some(link) = included.links.first() {
        reader.diagnostics.push(
            Diagnostic::error(
                "misplaced-include",
                "a model with links cannot be merged into a world",
            )
            .at(included.model.origin)
            .related(link.link.origin, "a world cannot contain this link")
            .help("leave out `merge=\"true\"`"),
        );
        into.models.push(included);
        return;
    }
    let mut included = rebased(included, reader);
    if let Some(root) = included.frames[0].relative_to.as_mut().filter(|it| it.name == "__model__")
    {
        root.name = "world".into();
    }
    into.frames.extend(included.frames);
    into.joints.extend(included.joints);
    into.models.extend(included.models);
    into.world.plugins.extend(included.model.plugins);
    into.world.extra.extend(included.model.extra);
}

/// Model whose content is relative to a new frame instead of `__model__`.
fn rebased(mut included: ModelDraft, reader: &mut Reader<'_>) -> ModelDraft {
    let origin = included.model.origin;
    let proxy =
        Reference { name: format!("_merged__{}__model__", included.model.name).into(), origin };
    let mut pose = included.model.parent_from_model;
    if included.placement_frame.is_some() {
        // Pose of the model's frame that puts the placement frame at the pose.
        let mut found = Diagnostics::new();
        let placed = resolve_model(included.clone(), &mut found);
        pose = pose * placed.model_from_placement(reader.diagnostics).inverse();
    }
    let canonical = included.canonical_link.take().or_else(|| {
        included.links.first().map(|it| Reference { name: it.link.name.as_str().into(), origin })
    });
    let to_proxy = |reference: &mut Option<Reference>| {
        if reference.as_ref().is_none_or(|it| it.name == "__model__") {
            *reference = Some(proxy.clone());
        }
    };
    let rename = |reference: &mut Reference| {
        if reference.name == "__model__" {
            reference.name = proxy.name.clone();
        }
    };
    let rename_parts = |parts: &mut Vec<(Part, Reference)>| {
        parts.iter_mut().for_each(|(_, reference)| rename(reference));
    };
    for link in &mut included.links {
        to_proxy(&mut link.relative_to);
        rename_parts(&mut link.parts);
    }
    for frame in &mut included.frames {
        to_proxy(&mut frame.attached_to);
        frame.relative_to.iter_mut().for_each(rename);
    }
    for joint in &mut included.joints {
        rename(&mut joint.parent);
        rename(&mut joint.child);
        joint.relative_to.iter_mut().for_each(rename);
        joint.expressed_in.iter_mut().flatten().for_each(rename);
        rename_parts(&mut joint.parts);
    }
    for model in &mut included.models {
        to_proxy(&mut model.relative_to);
    }
    let frame = FrameDraft {
        frame: periplus_scene::NamedFrame {
            name: proxy.name.to_string(),
            parent_from_frame: pose,
            attached_to: String::new(),
            role: periplus_scene::FrameRole::Declared,
            origin,
        },
        relative_to: included
            .relative_to
            .take()
            .or(Some(Reference { name: "__model__".into(), origin })),
        attached_to: canonical,
    };
    included.frames.insert(0, frame);
    included
}
