//! `<state>`: poses at the time when Gazebo Classic saved the world. Classic restores them when it loads
//! the world, so the state overrides the poses of models and links. All poses in it are in the world frame.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_xml::Element;

use super::light::read_light;
use super::model::read_model;
use super::root::Reader;
use crate::draft::{LightDraft, ModelDraft, WorldDraft};
use crate::fields::Fields;

pub(crate) fn read_state(element: &Element, draft: &mut WorldDraft, reader: &mut Reader<'_>) {
    let mut fields = Fields::new(element, reader.diagnostics);
    fields.ignore_attributes(&["world_name"]);
    if let Some(world) = element.value("world_name")
        && world != draft.world.name
    {
        fields.diagnostics.push(
            Diagnostic::warning(
                "wrong-world",
                format!("this state belongs to a world `{world}`, not `{}`", draft.world.name),
            )
            .at(element.origin)
            .note("it is left out"),
        );
        return;
    }
    // Clocks of the saved run are not used.
    for clock in ["sim_time", "real_time", "wall_time", "iterations", "time"] {
        fields.child(clock);
    }
    let insertions = fields.child("insertions");
    let deletions = fields.child("deletions");
    let models = fields.children("model");
    let lights = fields.children("light");
    fields.verbatim(&["joint"]);
    fields.finish();

    for child in insertions.into_iter().flat_map(Element::elements) {
        match &*child.name {
            "model" => draft.models.extend(read_model(child, reader)),
            "light" => {
                let placed = read_light(child, reader.diagnostics);
                draft
                    .lights
                    .push(LightDraft { light: placed.value, relative_to: placed.relative_to });
            }
            _ => {}
        }
    }
    let deleted: BTreeSet<String> =
        deletions.into_iter().flat_map(|it| it.named("name")).map(|it| it.text().into()).collect();
    draft.models.retain(|it| !deleted.contains(&it.model.name));
    draft.lights.retain(|it| !deleted.contains(&it.light.name));
    place_models(&models, &mut draft.models, reader.diagnostics);
    place_lights(&lights, draft, reader.diagnostics);
}

fn pose(element: &Element, diagnostics: &mut Diagnostics) -> Option<Pose> {
    element.child("pose").map(|pose| crate::pose::read_pose(pose, diagnostics).0)
}

fn place_models(states: &[&Element], models: &mut [ModelDraft], diagnostics: &mut Diagnostics) {
    let mut by_name: BTreeMap<String, usize> = BTreeMap::new();
    for (index, model) in models.iter().enumerate() {
        by_name.entry(model.model.name.clone()).or_insert(index);
    }
    for state in states {
        let Some(name) = state.attribute("name") else { continue };
        let Some(&index) = by_name.get(&*name.value) else {
            diagnostics.push(
                Diagnostic::warning(
                    "unknown-model",
                    format!("the saved state names a model `{}` that does not exist", name.value),
                )
                .at(name.value_origin)
                .did_you_mean(
                    name.value_origin,
                    &name.value,
                    by_name.keys().take(1000).map(String::as_str),
                ),
            );
            continue;
        };
        place_model(state, &mut models[index], diagnostics);
    }
}

/// Tolerance below which a saved pose equals the pose in the file [m, rad].
const POSE_TOLERANCE: f64 = 1e-5;

fn place_model(state: &Element, draft: &mut ModelDraft, diagnostics: &mut Diagnostics) {
    scale(state, diagnostics);
    let Some(world_from_model) = pose(state, diagnostics) else { return };
    let same = draft.relative_to.is_none()
        && draft.placement_frame.is_none()
        && near(draft.model.parent_from_model, world_from_model);
    if !same {
        draft.model.parent_from_model = world_from_model;
        draft.relative_to = None;
        draft.placement_frame = None;
    }
    let model_from_world = draft.model.parent_from_model.inverse();
    let mut states: BTreeMap<&str, &Element> = BTreeMap::new();
    for link in state.named("link") {
        states.entry(link.value("name").unwrap_or_default()).or_insert(link);
    }
    for link in &mut draft.links {
        let Some(state) = states.get(&*link.link.name) else { continue };
        let Some(world_from_link) = pose(state, diagnostics) else { continue };
        let model_from_link = model_from_world * world_from_link;
        if link.relative_to.is_some() || !near(link.link.model_from_link, model_from_link) {
            link.link.model_from_link = model_from_link;
            link.relative_to = None;
        }
    }
    for inner_state in state.named("model") {
        let name = inner_state.value("name").unwrap_or_default();
        if let Some(inner) = draft.models.iter_mut().find(|it| it.model.name == name) {
            place_nested(inner_state, model_from_world, inner, diagnostics);
        }
    }
}

fn place_nested(
    state: &Element,
    parent_from_world: Pose,
    draft: &mut ModelDraft,
    diagnostics: &mut Diagnostics,
) {
    // Read as a model of the world first, then moved into its parent.
    let world_from_parent = parent_from_world.inverse();
    let before = draft.model.parent_from_model;
    draft.model.parent_from_model = world_from_parent * before;
    place_model(state, draft, diagnostics);
    draft.model.parent_from_model = parent_from_world * draft.model.parent_from_model;
    if near(before, draft.model.parent_from_model) {
        draft.model.parent_from_model = before;
    }
}

fn near(a: Pose, b: Pose) -> bool {
    let (metres, radians) = a.distance_to(b);
    metres < POSE_TOLERANCE && radians < POSE_TOLERANCE
}

fn scale(state: &Element, diagnostics: &mut Diagnostics) {
    if let Some(scale) = state.child("scale")
        && crate::value::numbers(scale, diagnostics).is_some_and(|factors| factors != [1.0; 3])
    {
        diagnostics.push(
            Diagnostic::warning(
                "unsupported",
                "the scale of a model in the saved state is not applied",
            )
            .at(scale.origin),
        );
    }
}

fn place_lights(states: &[&Element], draft: &mut WorldDraft, diagnostics: &mut Diagnostics) {
    let states: BTreeMap<&str, &Element> =
        states.iter().map(|it| (it.value("name").unwrap_or_default(), *it)).collect();
    for light in &mut draft.lights {
        let Some(state) = states.get(&*light.light.name) else { continue };
        let Some(world_from_light) = pose(state, diagnostics) else { continue };
        if light.relative_to.is_some() || !near(light.light.parent_from_light, world_from_light) {
            light.light.parent_from_light = world_from_light;
            light.relative_to = None;
        }
    }
}
