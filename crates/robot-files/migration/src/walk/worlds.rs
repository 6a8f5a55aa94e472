//! Worlds.

use std::collections::BTreeMap;

use periplus_geometry::{Pose, Rpy};
use periplus_xml::Element;

use super::{Walker, words};
use crate::entry::MigrationOutcome;
use crate::old_plugin::{OldPlugin, Surroundings};
use crate::replacement::leaf;
use crate::world::{builtin_element, builtin_include, missing_systems};
use crate::{population, template};

/// Elements of a world without effect in gz-sim, and the reason.
const NO_EFFECT: [(&str, &str); 3] = [
    ("road", "gz-sim draws no roads: use a textured plane or mesh"),
    ("audio", "gz-sim has no audio in worlds"),
    ("joint", "gz-sim has no joints of a world: put the models into one model"),
];

impl<'a> Walker<'a> {
    pub(super) fn world(&mut self, element: &'a Element, around: Surroundings<'a>) {
        let around = Surroundings { world: Some(element), ..around };
        let before = self.entries.len();
        for child in element.elements() {
            match child.name.as_str() {
                "state" => self.state(child, element),
                "population" => self.population(child),
                "gui" => self.gui(child),
                "physics" => self.physics(child),
                "scene" => self.scene(child),
                name => {
                    if let Some((_, reason)) = NO_EFFECT.iter().find(|(known, _)| *known == name) {
                        let remarks = vec![(*reason).to_owned()];
                        self.entry(
                            child,
                            format!("<{name}>"),
                            "",
                            MigrationOutcome::NoEffect,
                            remarks,
                        );
                    }
                    self.element(child, around);
                }
            }
        }
        let systems = missing_systems(element);
        // A recent world without any sign of Gazebo Classic gets the default systems of gz-sim.
        let is_classic = self.entries.len() > before || self.is_old_version;
        if systems.is_empty() || !is_classic {
            return;
        }
        let new = systems.iter().map(words).collect::<Vec<_>>().join(", ");
        self.edits.prepend(element, &systems);
        let old = format!("world {}", element.value("name").unwrap_or_default());
        let remark =
            "gz-sim loads only the systems that a world names once it names one".to_owned();
        self.entry(element, old, new, MigrationOutcome::Converted, vec![remark]);
    }

    pub(super) fn include(&mut self, element: &'a Element, around: Surroundings<'a>) {
        let Some(uri) = element.child("uri").map(|uri| uri.text().into_owned()) else {
            return self.children(element, around);
        };
        if let Some(model) = builtin_include(&uri).filter(|_| around.world.is_some()) {
            let new = builtin_element(model, element);
            let remark = "the model is written into the world, since current Gazebo has no folder \
                          with it and would download it"
                .to_owned();
            let shown = format!("<{}> {model}", new.name);
            self.edits.replace(element, &[new]);
            self.entry(
                element,
                format!("include {uri}"),
                shown,
                MigrationOutcome::Converted,
                vec![remark],
            );
            return;
        }
        let folder = self.context.path.parent().unwrap_or(self.context.path);
        if uri.starts_with("model://") && self.context.resolver.resolve(&uri, folder).is_err() {
            let name = uri.trim_start_matches("model://");
            let remark = format!(
                "the model is in no folder here, and Harmonic does not download from Gazebo \
                 Classic's database: put it on GZ_SIM_RESOURCE_PATH, or include it from Fuel: \
                 https://app.gazebosim.org/search;q={name}"
            );
            let old = format!("include {uri}");
            self.entry(element, old.clone(), old, MigrationOutcome::NoCounterpart, vec![remark]);
        }
        self.children(element, around);
    }

    fn gui(&mut self, element: &'a Element) {
        let mut remarks = Vec::new();
        if element.child("plugin").is_some() && element.named("plugin").all(is_current) {
            return;
        }
        if element.child("camera").is_some() {
            remarks.push(
                "the pose of the user's camera is set in the GUI's configuration (`camera_pose` of \
                 MinimalScene)"
                    .to_owned(),
            );
        }
        if element.named("plugin").any(|plugin| !is_current(plugin)) {
            remarks.push("plugins of Gazebo Classic's GUI are not loaded".to_owned());
        }
        if remarks.is_empty() {
            return;
        }
        // With Classic's plugins gz-sim would open without its own.
        self.edits.remove(element);
        self.entry(element, "<gui>", "", MigrationOutcome::NoEffect, remarks);
    }

    fn physics(&mut self, element: &'a Element) {
        let mut remarks = Vec::new();
        let engine = element.value("type").unwrap_or("ode");
        if ["ode", "bullet", "simbody"].iter().any(|name| element.child(name).is_some()) {
            remarks.push(format!(
                "solver settings of {engine} have no effect on DART, which gz-sim uses by default"
            ));
        }
        let number =
            |name: &str| element.child(name).and_then(|child| child.text().parse::<f64>().ok());
        if let (Some(rate_hz), Some(step_s)) =
            (number("real_time_update_rate"), number("max_step_size"))
        {
            let factor = rate_hz * step_s;
            if (factor - 1.0).abs() > 1e-6 && rate_hz > 0.0 {
                remarks.push(format!(
                    "<real_time_update_rate> has no effect; it gave a real-time factor of at most \
                     {factor}: write <real_time_factor>"
                ));
            }
        }
        if !remarks.is_empty() {
            let old = format!("physics {engine}");
            self.entry(element, old.clone(), old, MigrationOutcome::NoEffect, remarks);
        }
    }

    fn scene(&mut self, element: &'a Element) {
        if element.child("fog").is_some() {
            let remarks = vec!["gz-sim has no fog".to_owned()];
            self.entry(element, "<fog>", "", MigrationOutcome::NoEffect, remarks);
        }
    }

    /// `<population>`: its models, one by one.
    fn population(&mut self, element: &'a Element) {
        let name = format!("population {}", element.value("name").unwrap_or_default());
        let models = population::models(element);
        if models.is_empty() {
            let remarks = vec!["gz-sim has no populations, and this one has no model".to_owned()];
            return self.entry(element, name, "", MigrationOutcome::NoCounterpart, remarks);
        }
        let new = format!("{} models", models.len());
        self.edits.replace(element, &models);
        let remark = "gz-sim has no populations: the models are written one by one, at the poses that Periplus gives them"
            .to_owned();
        self.entry(element, name, new, MigrationOutcome::Converted, vec![remark]);
    }

    /// `<state>`: the saved poses replace those of the models.
    fn state(&mut self, state: &'a Element, world: &'a Element) {
        let mut remarks =
            vec!["gz-sim ignores saved states: the poses are written into the models".to_owned()];
        let is_own = state.value("world_name").is_none_or(|name| Some(name) == world.value("name"));
        if is_own {
            let mut poses = BTreeMap::new();
            for saved in state.elements() {
                if let (Some(name), Some(pose)) = (saved.value("name"), saved.child("pose")) {
                    poses.insert((saved.name.as_str(), name), pose.text().into_owned());
                }
            }
            let (mut count, mut moved) = (0, 0);
            for entity in world
                .elements()
                .filter(|it| matches!(it.name.as_str(), "model" | "light" | "include"))
            {
                let named = entity.child("name").map(|name| name.text().into_owned());
                let name = entity.value("name").map(str::to_owned).or(named);
                let Some(name) = name.or_else(|| included(entity)) else { continue };
                let kind = if entity.name == "light" { "light" } else { "model" };
                let Some(pose) = poses.get(&(kind, name.as_str())) else { continue };
                // Built-in models are replaced as a whole.
                if entity.child("uri").is_some_and(|uri| builtin_include(&uri.text()).is_some()) {
                    continue;
                }
                count += 1;
                match entity.child("pose") {
                    Some(present) if present.text() == *pose => {}
                    Some(present) => self.edits.replace(present, &[leaf("pose", pose)]),
                    None => self.edits.prepend(entity, &[leaf("pose", pose)]),
                }
                let saved =
                    state.elements().find(|saved| saved.value("name") == Some(name.as_str()));
                if let Some(saved) = saved.filter(|_| entity.name == "model") {
                    moved += self.saved_links(saved, entity);
                }
            }
            remarks.push(format!("{count} poses of models and {moved} of links"));
            if let Some(insertions) = state.child("insertions") {
                let inserted: Vec<Element> = insertions.elements().cloned().collect();
                if !inserted.is_empty() {
                    self.edits.insert_after(state, &inserted);
                    remarks.push(
                        "models that were inserted before saving are models of the world now"
                            .to_owned(),
                    );
                }
            }
        }
        self.edits.remove(state);
        self.entry(state, "<state>", "poses of the models", MigrationOutcome::Converted, remarks);
    }

    /// Links that were moved in their model before it was saved; returns how many.
    fn saved_links(&mut self, saved: &'a Element, model: &'a Element) -> usize {
        let Some(world_from_model) = pose_of(saved) else { return 0 };
        let mut count = 0;
        for link in model.named("link") {
            let name = link.value("name");
            let Some(state) = saved.named("link").find(|state| state.value("name") == name) else {
                continue;
            };
            let (Some(world_from_link), Some(written)) = (pose_of(state), pose_of(link)) else {
                continue;
            };
            if state.child("pose").is_none() {
                continue;
            }
            let model_from_link = world_from_model.inverse() * world_from_link;
            let (metres, radians) = written.distance_to(model_from_link);
            if metres < SAVED_POSE_TOLERANCE && radians < SAVED_POSE_TOLERANCE {
                continue;
            }
            count += 1;
            let pose = leaf("pose", pose_text(model_from_link));
            match link.child("pose") {
                Some(present) => self.edits.replace(present, &[pose]),
                None => self.edits.prepend(link, &[pose]),
            }
        }
        count
    }
}

/// Tolerance within which a saved pose of a link is that of the file \[m, rad\].
const SAVED_POSE_TOLERANCE: f64 = 1e-5;

/// Pose of an element in its parent, as six numbers; `None` for other forms.
fn pose_of(element: &Element) -> Option<Pose> {
    let Some(pose) = element.child("pose") else { return Some(Pose::IDENTITY) };
    if pose.value("relative_to").is_some_and(|frame| !frame.is_empty()) {
        return None;
    }
    let text = pose.text();
    let numbers: Vec<f64> = text.split_whitespace().map_while(|word| word.parse().ok()).collect();
    let [x, y, z, roll, pitch, yaw] = *numbers.first_chunk::<6>()?;
    Some(Pose::from_xyz_rpy([x, y, z], Rpy { roll, pitch, yaw }))
}

/// Six numbers of a pose.
fn pose_text(pose: Pose) -> String {
    let (position, rpy) = (pose.translation, pose.rpy());
    [position.x, position.y, position.z, rpy.roll, rpy.pitch, rpy.yaw]
        .map(template::shown)
        .join(" ")
}

/// True for a plugin of current Gazebo.
fn is_current(plugin: &Element) -> bool {
    let old = OldPlugin::read(plugin, Surroundings::default(), None);
    !crate::plugin::is_classic(&old)
}

/// Name that an include gives its model by default: that of the folder, in nearly all models.
fn included(include: &Element) -> Option<String> {
    let uri = include.child("uri")?.text().into_owned();
    uri.trim_end_matches('/').rsplit('/').next().map(str::to_owned)
}
