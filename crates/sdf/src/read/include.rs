//! `<include>`.

use std::sync::Arc;

use periplus_base::Pose;
use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap};
use periplus_scene::Model;
use periplus_xml::{Document, Element};

use super::actor::read_actor;
use super::light::read_light;
use super::model::{read_model, reference};
use super::plugin::plugins;
use super::root::{DEEPEST_MODELS, Reader, open_root};
use crate::builtin;
use crate::draft::{ActorDraft, FrameDraft, LightDraft, ModelDraft, Part, WorldDraft};
use crate::fields::Fields;
use crate::frames::resolve_model;
use crate::pose::Reference;

/// Who opens the files that an `<include>` names. This crate knows no files.
pub trait Includes {
    /// Opens what `uri`, as written at `from`, names: a model's folder or an SDF or URDF file.
    fn open(
        &mut self,
        uri: &str,
        from: Origin,
        sources: &mut SourceMap,
        diagnostics: &mut Diagnostics,
    ) -> Opened;
}

/// What an include named.
#[derive(Clone, Debug)]
pub enum Opened {
    /// An SDF document.
    Sdf {
        /// The document.
        document: Arc<Document>,
        /// The same for the same file, however it was named: its path.
        key: String,
    },
    /// A model of another format, whose frames are resolved.
    Model {
        /// The model.
        model: Box<Model>,
        /// The same for the same file, however it was named: its path.
        key: String,
    },
    /// Nothing was found.
    Missing {
        /// Every place where it could have been.
        tried: Vec<String>,
    },
    /// It was found, but it cannot be read, and the diagnostics say why.
    Broken,
}

/// Nothing can be included, but for the built-in models.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoIncludes;

impl Includes for NoIncludes {
    fn open(&mut self, _: &str, _: Origin, _: &mut SourceMap, _: &mut Diagnostics) -> Opened {
        Opened::Missing { tried: Vec::new() }
    }
}

/// Includes in all that are followed for one file. Large worlds hold a few thousand.
pub(crate) const MOST_INCLUDES: usize = 20_000;

/// Elements in all that includes may bring in.
pub(crate) const MOST_PARTS: usize = 1_000_000;

/// What a file held.
#[derive(Clone, Debug)]
pub(crate) enum Entity {
    Model(Box<ModelDraft>),
    Light(Box<LightDraft>),
    Actor(Box<ActorDraft>),
}

#[derive(Clone, Debug)]
pub(crate) struct Loaded {
    entity: Entity,
    parts: usize,
    /// How many models of it are in each other.
    depth: usize,
}

/// Reads what an `<include>` names, with what the include overrides; and whether it is merged.
pub(crate) fn read_include(element: &Element, reader: &mut Reader<'_>) -> Option<(Entity, bool)> {
    let overrides = read_overrides(element, reader.diagnostics)?;
    if reader.includes_left == 0 {
        // It was told when the last one was used up.
        return None;
    }
    reader.includes_left -= 1;
    if reader.includes_left == 0 {
        too_many("includes", MOST_INCLUDES, element.origin, reader);
    }
    let loaded = load(&overrides.uri, overrides.uri_origin, reader)?;
    if loaded.parts > reader.parts_left {
        if reader.parts_left > 0 {
            too_many("elements in included files", MOST_PARTS, element.origin, reader);
        }
        reader.parts_left = 0;
        return None;
    }
    if reader.depth + loaded.depth > DEEPEST_MODELS {
        too_deep(element.origin, reader);
        return None;
    }
    reader.parts_left -= loaded.parts;
    let mut entity = loaded.entity;
    let merge = overrides.merge;
    if merge && !matches!(entity, Entity::Model(_)) {
        let told = Diagnostic::error("misplaced-include", "only models can be merged");
        reader.diagnostics.push(told.at(element.origin));
    }
    overrides.apply(&mut entity);
    Some((entity, merge))
}

fn too_many(what: &str, most: usize, origin: Origin, reader: &mut Reader<'_>) {
    let mut told = Diagnostic::error(
        "too-many-includes",
        format!("this file brings in more than {most} {what}; the rest is left out"),
    )
    .at(origin);
    for (_, site) in &reader.chain {
        told = told.related(*site, "included here");
    }
    reader.diagnostics.push(told);
}

fn too_deep(origin: Origin, reader: &mut Reader<'_>) {
    reader.diagnostics.push(
        Diagnostic::error(
            "too-deep",
            format!("more than {DEEPEST_MODELS} models are in each other; this one is left out"),
        )
        .at(origin),
    );
}

/// What stands in an `<include>`.
struct Overrides {
    uri: String,
    uri_origin: Origin,
    origin: Origin,
    merge: bool,
    name: Option<String>,
    is_static: Option<bool>,
    pose: Option<(Pose, Option<Reference>)>,
    placement_frame: Option<Reference>,
    plugins: Vec<periplus_scene::Plugin>,
    extra: Vec<Element>,
}

fn read_overrides(element: &Element, diagnostics: &mut Diagnostics) -> Option<Overrides> {
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
                .help("say where the frame is to be: add `<pose>0 0 0 0 0 0</pose>`"),
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
    fn apply(self, entity: &mut Entity) {
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

fn load(uri: &str, from: Origin, reader: &mut Reader<'_>) -> Option<Loaded> {
    match reader.includes.open(uri, from, reader.sources, reader.diagnostics) {
        Opened::Sdf { document, key } => load_document(&document.root, key, from, reader),
        Opened::Model { model, .. } => Some(Loaded::of_model(ModelDraft::from_model(*model))),
        Opened::Missing { tried } => {
            if let Some(document) = builtin::find(uri, reader.sources) {
                return load_document(&document.root, format!("built-in {uri}"), from, reader);
            }
            tell_missing(uri, from, tried, reader);
            None
        }
        Opened::Broken => None,
    }
}

fn tell_missing(uri: &str, from: Origin, tried: Vec<String>, reader: &mut Reader<'_>) {
    let mut told = Diagnostic::error("missing-include", format!("`{uri}` is not found")).at(from);
    // The places need to be listed only once.
    if reader.missing.insert(uri.to_owned()) {
        for place in tried {
            told = told.note(format!("looked at {place}"));
        }
    }
    for (_, site) in reader.chain.iter().rev() {
        told = told.related(*site, "included here");
    }
    reader.diagnostics.push(told);
}

fn load_document(
    root: &Element,
    key: String,
    from: Origin,
    reader: &mut Reader<'_>,
) -> Option<Loaded> {
    if reader.chain.iter().any(|(open, _)| *open == key) {
        tell_cycle(&key, from, reader);
        return None;
    }
    if let Some(loaded) = reader.loaded.get(&key) {
        return loaded.clone();
    }
    if reader.chain.len() + 1 >= DEEPEST_MODELS {
        too_deep(from, reader);
        return None;
    }
    reader.chain.push((key.clone(), from));
    let parts_left = reader.parts_left;
    let version = reader.version;
    // Findings in the file are told once, with the first include that led to it.
    let mut findings = Diagnostics::new();
    let loaded = {
        let mut inner = Reader {
            sources: reader.sources,
            diagnostics: &mut findings,
            includes: reader.includes,
            version,
            chain: std::mem::take(&mut reader.chain),
            loaded: std::mem::take(&mut reader.loaded),
            missing: std::mem::take(&mut reader.missing),
            includes_left: reader.includes_left,
            parts_left: reader.parts_left,
            // What is loaded may be used at other depths too: that is checked there.
            depth: 0,
        };
        let loaded = read_root(root, from, &mut inner);
        reader.chain = inner.chain;
        reader.loaded = inner.loaded;
        reader.missing = inner.missing;
        reader.includes_left = inner.includes_left;
        reader.parts_left = inner.parts_left;
        loaded
    };
    reader.chain.pop();
    reader.diagnostics.append(findings);
    // What it includes itself comes along at every use.
    let nested = parts_left - reader.parts_left;
    let loaded = loaded.map(|it| Loaded { parts: nested + elements_in(root), ..it });
    reader.loaded.insert(key, loaded.clone());
    loaded
}

fn tell_cycle(key: &str, from: Origin, reader: &mut Reader<'_>) {
    let start = reader.chain.iter().position(|(open, _)| open == key).unwrap_or(0);
    let names = reader.chain[start..].iter().map(|(open, _)| open.as_str()).chain([key]);
    let chain = names.collect::<Vec<_>>().join(" -> ");
    let mut told =
        Diagnostic::error("include-cycle", "this file includes itself").at(from).note(chain);
    for (_, site) in reader.chain[start..].iter().rev() {
        told = told.related(*site, "included here");
    }
    reader.diagnostics.push(told);
}

fn read_root(root: &Element, from: Origin, reader: &mut Reader<'_>) -> Option<Loaded> {
    let (version, root) = open_root(root, reader.diagnostics)?;
    reader.version = version;
    let mut candidates =
        root.elements().filter(|it| ["model", "light", "actor"].contains(&&*it.name));
    let Some(first) = candidates.next() else {
        let mut told =
            Diagnostic::error("empty-file", "the included file holds no model, light or actor")
                .at(from)
                .related(root.origin, "here");
        if root.child("world").is_some() {
            told = told.note("it holds a world, and worlds cannot be included");
        }
        reader.diagnostics.push(told);
        return None;
    };
    if let Some(second) = candidates.next() {
        reader.diagnostics.push(
            Diagnostic::warning(
                "more-than-one-model",
                "an included file should hold one model; this one is left out",
            )
            .at(second.origin)
            .related(first.origin, "this one counts"),
        );
    }
    match &*first.name {
        "model" => Some(Loaded::of_model(read_model(first, reader)?)),
        "light" => {
            let placed = read_light(first, reader.diagnostics);
            let draft = LightDraft { light: placed.value, relative_to: placed.relative_to };
            Some(Loaded { entity: Entity::Light(Box::new(draft)), parts: 1, depth: 0 })
        }
        _ => {
            let draft = read_actor(first, reader.diagnostics);
            Some(Loaded { entity: Entity::Actor(Box::new(draft)), parts: 1, depth: 0 })
        }
    }
}

impl Loaded {
    fn of_model(draft: ModelDraft) -> Self {
        let (parts, depth) = measure(&draft);
        Self { entity: Entity::Model(Box::new(draft)), parts, depth }
    }
}

fn elements_in(element: &Element) -> usize {
    1 + element.elements().map(elements_in).sum::<usize>()
}

/// About how many elements a model was made of, and how many models are in each other.
fn measure(draft: &ModelDraft) -> (usize, usize) {
    let kept = |elements: &[Element]| elements.iter().map(elements_in).sum::<usize>();
    let plugins = |plugins: &[periplus_scene::Plugin]| {
        plugins.iter().map(|it| 1 + kept(&it.content)).sum::<usize>()
    };
    let on_link = |link: &periplus_scene::Link| {
        let sensors = link.sensors.iter().map(|it| 1 + kept(&it.extra) + plugins(&it.plugins));
        link.collisions.len() + link.visuals.len() + kept(&link.extra) + sensors.sum::<usize>()
    };
    let on_links = draft.links.iter().map(|it| on_link(&it.link)).sum::<usize>()
        + plugins(&draft.model.plugins)
        + kept(&draft.model.extra);
    let own = 1 + draft.links.len() + on_links + draft.joints.len() + draft.frames.len();
    let nested = draft.models.iter().map(measure);
    let (parts, depth) = nested.fold((own, 0), |(parts, depth), (more, deep)| {
        (parts.saturating_add(more), depth.max(deep))
    });
    (parts, depth + 1)
}

/// Puts the content of an included model into the model around it. A frame
/// `_merged__NAME__model__` stands for the frame of the model that is gone (SDF 1.9, merge
/// include).
pub(crate) fn merge(included: ModelDraft, into: &mut ModelDraft, reader: &mut Reader<'_>) {
    let included = rebased(included, reader);
    into.frames.extend(included.frames);
    into.links.extend(included.links);
    into.joints.extend(included.joints);
    into.models.extend(included.models);
    into.model.plugins.extend(included.model.plugins);
    into.model.extra.extend(included.model.extra);
}

/// The same for a world (SDF 1.10), where there can be no links.
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
            .related(link.link.origin, "a world has no place for this link")
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

/// The model with everything in it relative to a frame of its own instead of `__model__`.
fn rebased(mut included: ModelDraft, reader: &mut Reader<'_>) -> ModelDraft {
    let origin = included.model.origin;
    let proxy =
        Reference { name: format!("_merged__{}__model__", included.model.name).into(), origin };
    let mut pose = included.model.parent_from_model;
    if included.placement_frame.is_some() {
        // Where the model's frame must lie for the placement frame to lie at the pose.
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
        frame: periplus_scene::Frame {
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
