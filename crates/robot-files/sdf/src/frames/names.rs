//! Names that must be unique.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};

use crate::draft::{LinkDraft, ModelDraft, WorldDraft};

/// Names of one scope and their owners.
#[derive(Default)]
struct Names {
    taken: BTreeMap<String, (&'static str, Origin)>,
    /// Last number appended to a duplicate name.
    numbers: BTreeMap<String, u32>,
}

impl Names {
    /// Registers a name; a duplicate is reported and changed.
    fn take(
        &mut self,
        kind: &'static str,
        name: &mut String,
        origin: Origin,
        lenient: bool,
        diagnostics: &mut Diagnostics,
    ) {
        let Some((first_kind, first)) = self.taken.get(name) else {
            check_name(kind, name, origin, diagnostics);
            self.taken.insert(name.clone(), (kind, origin));
            return;
        };
        if lenient && *first_kind != kind {
            // As libsdformat does for old files.
            let fresh = format!("{name}_{kind}");
            if !self.taken.contains_key(&fresh) {
                diagnostics.push(
                    Diagnostic::warning(
                        "duplicate-name",
                        format!("this {kind} has the name of a {first_kind}, `{name}`"),
                    )
                    .at(origin)
                    .related(*first, format!("the {first_kind}"))
                    .note(format!("it is called `{fresh}` here and in Gazebo"))
                    .help("since SDF 1.7 names must differ; rename one of them"),
                );
                self.taken.insert(fresh.clone(), (kind, origin));
                *name = fresh;
                return;
            }
        }
        let number = self.numbers.entry(name.clone()).or_default();
        let fresh = loop {
            *number += 1;
            let fresh = format!("{name}_{number}");
            if !self.taken.contains_key(&fresh) {
                break fresh;
            }
        };
        diagnostics.push(
            Diagnostic::error("duplicate-name", format!("the name `{name}` is already used"))
                .at(origin)
                .related(*first, format!("by this {first_kind}"))
                .note(format!("this {kind} is called `{fresh}` instead")),
        );
        self.taken.insert(fresh.clone(), (kind, origin));
        *name = fresh;
    }
}

fn check_name(kind: &str, name: &str, origin: Origin, diagnostics: &mut Diagnostics) {
    let reserved = name == "world" && kind != "visual" && kind != "collision"
        || name.len() >= 4 && name.starts_with("__") && name.ends_with("__");
    if reserved {
        diagnostics.push(
            Diagnostic::error("reserved-name", format!("a {kind} cannot be called `{name}`"))
                .at(origin)
                .note("`world` and names that start and end with `__` are SDF's own"),
        );
    }
}

pub(super) fn make_unique(draft: &mut ModelDraft, diagnostics: &mut Diagnostics) {
    let mut names = Names::default();
    let lenient = draft.lenient_names;
    for link in &mut draft.links {
        parts(link, diagnostics);
        let link = &mut link.link;
        names.take("link", &mut link.name, link.origin, lenient, diagnostics);
    }
    for model in &mut draft.models {
        let model = &mut model.model;
        names.take("model", &mut model.name, model.origin, lenient, diagnostics);
    }
    for frame in &mut draft.frames {
        let frame = &mut frame.frame;
        names.take("frame", &mut frame.name, frame.origin, lenient, diagnostics);
    }
    for joint in &mut draft.joints {
        let joint = &mut joint.joint;
        names.take("joint", &mut joint.name, joint.origin, lenient, diagnostics);
    }
}

fn parts(link: &mut LinkDraft, diagnostics: &mut Diagnostics) {
    let link = &mut link.link;
    let mut names = Names::default();
    for it in &mut link.collisions {
        names.take("collision", &mut it.name, it.origin, false, diagnostics);
    }
    names = Names::default();
    for it in &mut link.visuals {
        names.take("visual", &mut it.name, it.origin, false, diagnostics);
    }
    names = Names::default();
    for it in &mut link.sensors {
        names.take("sensor", &mut it.name, it.origin, false, diagnostics);
    }
    names = Names::default();
    for it in &mut link.lights {
        names.take("light", &mut it.name, it.origin, false, diagnostics);
    }
}

pub(super) fn make_unique_in_world(draft: &mut WorldDraft, diagnostics: &mut Diagnostics) {
    let mut names = Names::default();
    for model in &mut draft.models {
        let model = &mut model.model;
        names.take("model", &mut model.name, model.origin, false, diagnostics);
    }
    for actor in &mut draft.actors {
        let actor = &mut actor.actor;
        names.take("actor", &mut actor.name, actor.origin, true, diagnostics);
    }
    for frame in &mut draft.frames {
        // Libsdformat renames frames of a world in files of every version (`World::Load`).
        let frame = &mut frame.frame;
        names.take("frame", &mut frame.name, frame.origin, true, diagnostics);
    }
    for joint in &mut draft.joints {
        let joint = &mut joint.joint;
        names.take("joint", &mut joint.name, joint.origin, false, diagnostics);
    }
    names = Names::default();
    for light in &mut draft.lights {
        let light = &mut light.light;
        names.take("light", &mut light.name, light.origin, false, diagnostics);
    }
}
