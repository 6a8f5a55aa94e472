//! Reading texts in tests.
#![allow(dead_code, reason = "each test file uses a part")]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, Origin, RenderStyle, SourceMap, render};
use periplus_geometry::Pose;
use periplus_scene::{Model, Scene};
use periplus_sdf::{IncludeResolver, IncludeTarget, SdfContext};

/// Files by URI.
#[derive(Clone, Default)]
pub(crate) struct Files(pub(crate) BTreeMap<String, String>);

impl Files {
    pub(crate) fn with(mut self, uri: &str, text: impl Into<String>) -> Self {
        self.0.insert(uri.into(), text.into());
        self
    }
}

impl IncludeResolver for Files {
    fn open(
        &mut self,
        uri: &str,
        _: Origin,
        sources: &mut SourceMap,
        diagnostics: &mut Diagnostics,
    ) -> IncludeTarget {
        let Some(text) = self.0.get(uri) else {
            return IncludeTarget::Missing { tried: vec![format!("/models/{uri}")], advice: None };
        };
        let file = sources.add(uri, text.as_str());
        match periplus_xml::parse(file, sources, diagnostics) {
            Some(document) => IncludeTarget::Sdf { document: Arc::new(document), key: uri.into() },
            None => IncludeTarget::Broken,
        }
    }
}

pub(crate) fn read_with(text: &str, files: &mut Files) -> (Scene, Diagnostics, SourceMap) {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let file = sources.add("test.sdf", text);
    let scene = match periplus_xml::parse(file, &sources, &mut diagnostics) {
        Some(document) => {
            let mut context = SdfContext {
                sources: &mut sources,
                diagnostics: &mut diagnostics,
                includes: files,
            };
            periplus_sdf::read_document(&document, &mut context)
        }
        None => Scene::default(),
    };
    (scene, diagnostics, sources)
}

/// Reads a valid text.
pub(crate) fn read(text: &str) -> Scene {
    let (scene, diagnostics, sources) = read_with(text, &mut Files::default());
    assert!(diagnostics.is_empty(), "{}", told(&diagnostics, &sources));
    scene
}

pub(crate) fn told(diagnostics: &Diagnostics, sources: &SourceMap) -> String {
    let mut out = String::new();
    for diagnostic in diagnostics.iter() {
        let _ = writeln!(out, "{}", render(diagnostic, sources, RenderStyle::Plain).trim_end());
    }
    out
}

/// Findings about a text.
pub(crate) fn findings(text: &str) -> String {
    let (_, diagnostics, sources) = read_with(text, &mut Files::default());
    told(&diagnostics, &sources)
}

/// A model in SDF of the newest version around some content.
pub(crate) fn model(content: &str) -> String {
    format!("<sdf version=\"1.9\"><model name=\"m\">{content}</model></sdf>")
}

pub(crate) fn show_pose(pose: Pose) -> String {
    let rounded = |value: f64| (value * 1e4).round() / 1e4 + 0.0;
    let [x, y, z] = pose.translation.to_array().map(rounded);
    let yaw = rounded(pose.rpy().yaw.to_degrees());
    format!("({x} {y} {z}) yaw {yaw}")
}

/// The frames of a model, one a line.
pub(crate) fn show_model(model: &Model, out: &mut String) {
    let _ = writeln!(out, "model {} {}", model.name, show_pose(model.parent_from_model));
    for link in &model.links {
        let _ = writeln!(out, "  link {} {}", link.name, show_pose(link.model_from_link));
    }
    for joint in &model.joints {
        let (parent, child) = (&joint.parent, &joint.child);
        let pose = show_pose(joint.child_from_joint);
        let _ = writeln!(out, "  joint {} {parent} -> {child} {pose}", joint.name);
    }
    for frame in &model.frames {
        let pose = show_pose(frame.parent_from_frame);
        let _ = writeln!(out, "  frame {} on {} {pose}", frame.name, frame.attached_to);
    }
    for inner in &model.models {
        let mut text = String::new();
        show_model(inner, &mut text);
        for line in text.lines() {
            let _ = writeln!(out, "  {line}");
        }
    }
}

/// The frames of all models of a scene.
pub(crate) fn show(scene: &Scene) -> String {
    let mut out = String::new();
    for world in &scene.worlds {
        for frame in &world.frames {
            let pose = show_pose(frame.parent_from_frame);
            let _ = writeln!(out, "frame {} on {} {pose}", frame.name, frame.attached_to);
        }
        for model in &world.models {
            show_model(model, &mut out);
        }
        for light in &world.lights {
            let _ = writeln!(out, "light {} {}", light.name, show_pose(light.parent_from_light));
        }
    }
    for model in &scene.models {
        show_model(model, &mut out);
    }
    out
}
