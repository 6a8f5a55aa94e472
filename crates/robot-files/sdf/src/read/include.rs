//! `<include>`.

use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap};
use periplus_scene::Model;
use periplus_xml::{Document, Element};

use super::actor::read_actor;
use super::light::read_light;
use super::model::read_model;
use super::overrides::read_overrides;
use super::root::{MAX_NESTED_MODELS, Reader, open_root};
use crate::builtin;
use crate::draft::{ActorDraft, LightDraft, ModelDraft};

/// Access to the files that an `<include>` names. This crate reads no files.
pub trait IncludeResolver {
    /// Opens the target of `uri`, as written at `from`: a model's folder or an SDF or URDF file.
    fn open(
        &mut self,
        uri: &str,
        from: Origin,
        sources: &mut SourceMap,
        diagnostics: &mut Diagnostics,
    ) -> IncludeTarget;
}

/// Target of an include.
#[derive(Clone, Debug)]
pub enum IncludeTarget {
    /// An SDF document.
    Sdf {
        /// The document.
        document: Arc<Document>,
        /// Path of the file; equal for the same file, however it was named.
        key: String,
    },
    /// Model of another format, with resolved frames.
    Model {
        /// The model.
        model: Box<Model>,
        /// Path of the file; equal for the same file, however it was named.
        key: String,
    },
    /// No such model or file.
    Missing {
        /// Locations that were searched.
        tried: Vec<String>,
        /// Advice about the search paths.
        advice: Option<String>,
    },
    /// The file exists but cannot be read; the diagnostics give the reason.
    Broken,
}

/// Resolves no include except the built-in models.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoIncludes;

impl IncludeResolver for NoIncludes {
    fn open(
        &mut self,
        _: &str,
        _: Origin,
        _: &mut SourceMap,
        _: &mut Diagnostics,
    ) -> IncludeTarget {
        IncludeTarget::Missing { tried: Vec::new(), advice: None }
    }
}

/// Maximum number of includes that are followed for one file. Large worlds have a few thousand.
pub(crate) const MAX_INCLUDES: usize = 20_000;

/// Maximum number of elements that includes may add.
pub(crate) const MAX_INCLUDED_ELEMENTS: usize = 1_000_000;

/// Content of a file.
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
    /// Nesting depth of its models.
    depth: usize,
}

/// Reads the target of an `<include>` with the overrides of the include. The flag is true if it is to be
/// merged.
pub(crate) fn read_include(element: &Element, reader: &mut Reader<'_>) -> Option<(Entity, bool)> {
    let overrides = read_overrides(element, reader.diagnostics)?;
    if reader.includes_left == 0 {
        // It was reported when the last one was used.
        return None;
    }
    reader.includes_left -= 1;
    if reader.includes_left == 0 {
        too_many("includes", MAX_INCLUDES, element.origin, reader);
    }
    let loaded = load(&overrides.uri, overrides.uri_origin, reader)?;
    if loaded.parts > reader.parts_left {
        if reader.parts_left > 0 {
            too_many("elements in included files", MAX_INCLUDED_ELEMENTS, element.origin, reader);
        }
        reader.parts_left = 0;
        return None;
    }
    if reader.depth + loaded.depth > MAX_NESTED_MODELS {
        too_deep(element.origin, reader);
        return None;
    }
    reader.parts_left -= loaded.parts;
    let mut entity = loaded.entity;
    let merge = overrides.merge;
    if merge && !matches!(entity, Entity::Model(_)) {
        let finding = Diagnostic::error("misplaced-include", "only models can be merged");
        reader.diagnostics.push(finding.at(element.origin));
    }
    overrides.apply(&mut entity);
    Some((entity, merge))
}

fn too_many(what: &str, most: usize, origin: Origin, reader: &mut Reader<'_>) {
    let mut finding = Diagnostic::error(
        "too-many-includes",
        format!("this file brings in more than {most} {what}; the rest is left out"),
    )
    .at(origin);
    for (_, site) in &reader.chain {
        finding = finding.related(*site, "included here");
    }
    reader.diagnostics.push(finding);
}

fn too_deep(origin: Origin, reader: &mut Reader<'_>) {
    reader.diagnostics.push(
        Diagnostic::error(
            "too-deep",
            format!("more than {MAX_NESTED_MODELS} models are nested; this one is left out"),
        )
        .at(origin),
    );
}

fn load(uri: &str, from: Origin, reader: &mut Reader<'_>) -> Option<Loaded> {
    match reader.includes.open(uri, from, reader.sources, reader.diagnostics) {
        IncludeTarget::Sdf { document, key } => load_document(&document.root, key, from, reader),
        IncludeTarget::Model { model, .. } => {
            Some(Loaded::of_model(ModelDraft::from_model(*model)))
        }
        IncludeTarget::Missing { tried, advice } => {
            if let Some(document) = builtin::find(uri, reader.sources) {
                return load_document(&document.root, format!("built-in {uri}"), from, reader);
            }
            report_missing(uri, from, (tried, advice), reader);
            None
        }
        IncludeTarget::Broken => None,
    }
}

fn report_missing(
    uri: &str,
    from: Origin,
    (tried, advice): (Vec<String>, Option<String>),
    reader: &mut Reader<'_>,
) {
    let is_new = !reader.missing.contains_key(uri);
    reader.missing.entry(uri.to_owned()).or_insert(from);
    if is_on_fuel(uri) {
        // All of them are reported together: see `report_missing_from_fuel`.
        return;
    }
    let mut finding =
        Diagnostic::error("missing-include", format!("`{uri}` is not found")).at(from);
    // The locations are listed only once.
    if is_new {
        for place in tried {
            finding = finding.note(format!("looked at {place}"));
        }
        finding = advice.into_iter().fold(finding, Diagnostic::help);
    }
    for (_, site) in reader.chain.iter().rev() {
        finding = finding.related(*site, "included here");
    }
    reader.diagnostics.push(finding);
}

/// Returns true if an address is one of Gazebo's model server.
fn is_on_fuel(uri: &str) -> bool {
    let Some((_, rest)) = uri.split_once("://") else { return false };
    let host = rest.split('/').next().unwrap_or_default().to_ascii_lowercase();
    [
        "fuel.gazebosim.org",
        "app.gazebosim.org",
        "fuel.ignitionrobotics.org",
        "app.ignitionrobotics.org",
    ]
    .contains(&host.as_str())
}

/// Maximum number of Fuel models listed in a message.
const MAX_LISTED_MODELS: usize = 12;

/// Reports one finding for all models that are not in the Fuel cache: no download is made.
pub(crate) fn report_missing_from_fuel(reader: &mut Reader<'_>) {
    let missing: Vec<(&String, &Origin)> =
        reader.missing.iter().filter(|(uri, _)| is_on_fuel(uri)).collect();
    let Some((_, first)) = missing.first() else { return };
    let count = missing.len();
    let (what, are) = if count == 1 { ("model", "is") } else { ("models", "are") };
    let mut finding = Diagnostic::error(
        "missing-from-fuel",
        format!("{count} {what} of Fuel {are} not on this machine and left out"),
    )
    .at(**first);
    for (_, site) in missing.iter().skip(1).take(MAX_LISTED_MODELS - 1) {
        finding = finding.related(**site, "and this one");
    }
    let mut commands = String::from("with Gazebo's tools, once for each:");
    for (uri, _) in missing.iter().take(MAX_LISTED_MODELS) {
        commands.push_str(&format!("\n  gz fuel download -u \"{}\"", uri.trim()));
    }
    if count > MAX_LISTED_MODELS {
        commands.push_str(&format!("\n  and {} more", count - MAX_LISTED_MODELS));
    }
    let finding = finding
        .note("Gazebo downloads such models; Periplus uses no network and looks into ~/.gz/fuel")
        .help(commands)
        .help(
            "without these tools open each address in a browser, download the model, unpack it to \
             MODELS/NAME, write model://NAME in the world, and give --resource-path MODELS",
        );
    reader.diagnostics.push(finding);
}

fn load_document(
    root: &Element,
    key: String,
    from: Origin,
    reader: &mut Reader<'_>,
) -> Option<Loaded> {
    if reader.chain.iter().any(|(open, _)| *open == key) {
        report_cycle(&key, from, reader);
        return None;
    }
    if let Some(loaded) = reader.loaded.get(&key) {
        return loaded.clone();
    }
    if reader.chain.len() + 1 >= MAX_NESTED_MODELS {
        too_deep(from, reader);
        return None;
    }
    reader.chain.push((key.clone(), from));
    let parts_left = reader.parts_left;
    let version = reader.version;
    // Findings in the file are reported once, at the first include of it.
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
            // Loaded content may be used at other depths too, where the depth is checked.
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
    // Its own includes count at every use.
    let nested = parts_left - reader.parts_left;
    let loaded = loaded.map(|it| Loaded { parts: nested + elements_in(root), ..it });
    reader.loaded.insert(key, loaded.clone());
    loaded
}

fn report_cycle(key: &str, from: Origin, reader: &mut Reader<'_>) {
    let start = reader.chain.iter().position(|(open, _)| open == key).unwrap_or(0);
    let names = reader.chain[start..].iter().map(|(open, _)| open.as_str()).chain([key]);
    let chain = names.collect::<Vec<_>>().join(" -> ");
    let mut finding =
        Diagnostic::error("include-cycle", "this file includes itself").at(from).note(chain);
    for (_, site) in reader.chain[start..].iter().rev() {
        finding = finding.related(*site, "included here");
    }
    reader.diagnostics.push(finding);
}

fn read_root(root: &Element, from: Origin, reader: &mut Reader<'_>) -> Option<Loaded> {
    let (version, root) = open_root(root, reader.diagnostics)?;
    reader.version = version;
    let mut candidates =
        root.elements().filter(|it| ["model", "light", "actor"].contains(&&*it.name));
    let Some(first) = candidates.next() else {
        let mut finding =
            Diagnostic::error("empty-file", "the included file holds no model, light or actor")
                .at(from)
                .related(root.origin, "here");
        if root.child("world").is_some() {
            finding = finding.note("it holds a world, and worlds cannot be included");
        }
        reader.diagnostics.push(finding);
        return None;
    };
    if let Some(second) = candidates.next() {
        reader.diagnostics.push(
            Diagnostic::warning(
                "more-than-one-model",
                "an included file should hold one model; this one is left out",
            )
            .at(second.origin)
            .related(first.origin, "this one is used"),
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

/// Approximate number of elements of a model, and nesting depth of its models.
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
