//! `<sdf>`.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap};
use periplus_scene::Scene;
use periplus_xml::{Document, Element};

use super::actor::read_actor;
use super::include::{Entity, IncludeResolver, Loaded, read_include, report_missing_from_fuel};
use super::light::read_light;
use super::model::read_model;
use super::world::read_world;
use crate::draft::LightDraft;
use crate::frames::{resolve_actor, resolve_light, resolve_model, resolve_world};
use crate::upgrade::upgrade;
use crate::version::Version;

/// Inputs and outputs of a reader that are shared by all files.
pub struct SdfContext<'a> {
    /// Receives the texts of built-in models.
    pub sources: &'a mut SourceMap,
    /// Receives the findings.
    pub diagnostics: &'a mut Diagnostics,
    /// Resolves `<include>` elements.
    pub includes: &'a mut dyn IncludeResolver,
}

/// State of a reader.
pub(crate) struct Reader<'a> {
    pub(crate) sources: &'a mut SourceMap,
    pub(crate) diagnostics: &'a mut Diagnostics,
    pub(crate) includes: &'a mut dyn IncludeResolver,
    /// Version of the current file.
    pub(crate) version: Version,
    /// Includes that led to the current file: what each opened, and its source location.
    pub(crate) chain: Vec<(String, Origin)>,
    /// Content of included files, which are often included many times.
    pub(crate) loaded: BTreeMap<String, Option<Loaded>>,
    /// Missing targets that were reported, with the source location of their first include.
    pub(crate) missing: BTreeMap<String, Origin>,
    pub(crate) includes_left: usize,
    pub(crate) parts_left: usize,
    /// Number of models around the current element.
    pub(crate) depth: usize,
}

/// Maximum nesting depth of models and includes. The readers are recursive.
pub(crate) const MAX_NESTED_MODELS: usize = 40;

/// Reads a whole SDF document of any version. The scene holds all content that could be read; the
/// diagnostics report the rest.
pub fn read_document(document: &Document, context: &mut SdfContext<'_>) -> Scene {
    let mut reader = Reader {
        sources: context.sources,
        diagnostics: context.diagnostics,
        includes: context.includes,
        version: Version::NEWEST,
        chain: Vec::new(),
        loaded: BTreeMap::new(),
        missing: BTreeMap::new(),
        includes_left: super::include::MAX_INCLUDES,
        parts_left: super::include::MAX_INCLUDED_ELEMENTS,
        depth: 0,
    };
    let Some((version, root)) = open_root(&document.root, reader.diagnostics) else {
        return Scene::default();
    };
    reader.version = version;
    let mut scene = Scene::default();
    for child in root.elements() {
        match &*child.name {
            "world" => {
                let draft = read_world(child, &mut reader);
                scene.worlds.push(resolve_world(draft, reader.diagnostics));
            }
            "model" => {
                if let Some(draft) = read_model(child, &mut reader) {
                    let placed = resolve_model(draft, reader.diagnostics);
                    scene.models.push(placed.stand_alone(reader.diagnostics));
                }
            }
            "light" => {
                let placed = read_light(child, reader.diagnostics);
                let draft = LightDraft { light: placed.value, relative_to: placed.relative_to };
                scene.lights.push(resolve_light(draft, reader.diagnostics));
            }
            "actor" => {
                let draft = read_actor(child, reader.diagnostics);
                scene.actors.push(resolve_actor(draft, reader.diagnostics));
            }
            "include" => match read_include(child, &mut reader) {
                Some((Entity::Model(draft), _)) => {
                    let placed = resolve_model(*draft, reader.diagnostics);
                    scene.models.push(placed.stand_alone(reader.diagnostics));
                }
                Some((Entity::Light(draft), _)) => {
                    scene.lights.push(resolve_light(*draft, reader.diagnostics));
                }
                Some((Entity::Actor(draft), _)) => {
                    scene.actors.push(resolve_actor(*draft, reader.diagnostics));
                }
                None => {}
            },
            _ => unknown_in_root(child, reader.diagnostics),
        }
    }
    report_missing_from_fuel(&mut reader);
    if scene == Scene::default() && !reader.diagnostics.has_errors() {
        reader.diagnostics.push(
            Diagnostic::error("empty-file", "this file holds no world, model, light or actor")
                .at(document.root.origin),
        );
    }
    scene
}

fn unknown_in_root(child: &Element, diagnostics: &mut Diagnostics) {
    if child.prefix().is_some() {
        return;
    }
    diagnostics.push(
        Diagnostic::warning(
            "unknown-element",
            format!("`<{}>` is not known at the top of a file; it is left out", child.name),
        )
        .at(child.name_origin())
        .did_you_mean(
            child.name_origin(),
            &child.name,
            ["world", "model", "light", "actor"],
        ),
    );
}

/// Version of a document and its root, in the spelling of the newest version.
pub(crate) fn open_root<'a>(
    root: &'a Element,
    diagnostics: &mut Diagnostics,
) -> Option<(Version, std::borrow::Cow<'a, Element>)> {
    if root.name != "sdf" && root.name != "gazebo" {
        let mut finding = Diagnostic::error(
            "not-sdf",
            format!("an SDF file starts with `<sdf>`, this one with `<{}>`", root.name),
        )
        .at(root.origin);
        if root.name == "robot" {
            finding = finding.help("this is a robot description: read it as URDF, or as xacro");
        } else if ["world", "model", "light", "actor"].contains(&&*root.name) {
            finding = finding.help("wrap it in `<sdf version=\"1.9\">...</sdf>`");
        }
        diagnostics.push(finding);
        return None;
    }
    let version = read_version(root, diagnostics);
    Some((version, upgrade(root, version)))
}

fn read_version(root: &Element, diagnostics: &mut Diagnostics) -> Version {
    let Some(attribute) = root.attribute("version") else {
        diagnostics.push(
            Diagnostic::error("missing-attribute", format!("`<{}>` lacks its version", root.name))
                .at(root.origin)
                .note(format!("{} is assumed", Version::NEWEST))
                .help("write `<sdf version=\"1.9\">`"),
        );
        return Version::NEWEST;
    };
    match Version::parse(&attribute.value) {
        Some(version) if version.major == 1 => {
            if version > Version::NEWEST {
                diagnostics.push(
                    Diagnostic::warning(
                        "newer-version",
                        format!(
                            "SDF {version} is newer than {}, the newest that is known here",
                            Version::NEWEST
                        ),
                    )
                    .at(attribute.value_origin),
                );
            }
            version
        }
        _ => {
            diagnostics.push(
                Diagnostic::error(
                    "unknown-version",
                    format!(
                        "`{}` is not a version of SDF",
                        crate::value::shortened(&attribute.value)
                    ),
                )
                .at(attribute.value_origin)
                .note(format!("known are 1.0 to {0}; {0} is assumed", Version::NEWEST)),
            );
            Version::NEWEST
        }
    }
}
