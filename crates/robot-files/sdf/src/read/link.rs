//! `<link>`, `<inertial>`, `<collision>`, `<visual>`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{Collision, Inertial, Link, Shape, Visual};
use periplus_xml::Element;

use super::light::read_light;
use super::material::read_material;
use super::plugin::plugins;
use super::sensor::read_sensor;
use super::shape::read_geometry;
use super::surface::read_surface;
use crate::draft::{LinkDraft, Part};
use crate::fields::Fields;
use crate::inertia;
use crate::pose::{PosedElement, Reference};

/// Reads a `<link>`. `moves` is false in static models, whose inertia is not checked.
pub(crate) fn read_link(
    element: &Element,
    moves: bool,
    diagnostics: &mut Diagnostics,
) -> LinkDraft {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let mut link = Link::new(name.unwrap_or_else(|| "link".into()));
    link.origin = element.origin;
    let (pose, relative_to) = fields.pose();
    link.model_from_link = pose;
    link.gravity = fields.boolean("gravity", true);
    link.enable_wind = fields.boolean("enable_wind", false);
    link.self_collide = fields.boolean("self_collide", false);
    link.kinematic = fields.boolean("kinematic", false);
    if let Some(mut decay) = fields.open("velocity_decay") {
        link.velocity_decay = [decay.number("linear", 0.0), decay.number("angular", 0.0)];
        let rest = decay.finish();
        fields.close("velocity_decay", rest);
    }
    if let Some(inertial) = fields.child("inertial") {
        link.inertial = read_inertial(inertial, fields.diagnostics);
        if moves {
            inertia::check(&link.inertial, &link.name, inertial, fields.diagnostics);
        }
    }
    let mut parts = Vec::new();
    let mut part = |part, reference: Option<Reference>| {
        parts.extend(reference.map(|reference| (part, reference)));
    };
    for (index, child) in fields.children("collision").into_iter().enumerate() {
        let placed = read_collision(child, fields.diagnostics);
        part(Part::Collision(index), placed.relative_to);
        link.collisions.push(placed.value);
    }
    for (index, child) in fields.children("visual").into_iter().enumerate() {
        let placed = read_visual(child, fields.diagnostics);
        part(Part::Visual(index), placed.relative_to);
        link.visuals.push(placed.value);
    }
    for (index, child) in fields.children("sensor").into_iter().enumerate() {
        let placed = read_sensor(child, fields.diagnostics);
        part(Part::Sensor(index), placed.relative_to);
        for (camera, reference) in placed.cameras_relative_to {
            part(Part::Camera(index, camera), Some(reference));
        }
        link.sensors.push(placed.value);
    }
    for (index, child) in fields.children("light").into_iter().enumerate() {
        let placed = read_light(child, fields.diagnostics);
        part(Part::Light(index), placed.relative_to);
        link.lights.push(placed.value);
    }
    fields.verbatim(&[
        "must_be_base_link",
        "projector",
        "audio_sink",
        "audio_source",
        "battery",
        "particle_emitter",
        "frame",
    ]);
    link.extra = fields.finish();
    LinkDraft { link, relative_to, parts }
}

/// Reads an `<inertial>`; SDF's defaults of 1 kg and 1 kg m².
pub fn read_inertial(element: &Element, diagnostics: &mut Diagnostics) -> Inertial {
    let mut fields = Fields::new(element, diagnostics);
    let mut inertial = Inertial::default();
    if let Some(auto) = fields.attribute("auto") {
        inertial.auto =
            crate::value::boolean_word(&auto.value, auto.value_origin, fields.diagnostics)
                .unwrap_or(false);
    }
    inertial.link_from_inertial = fields.fixed_pose("link");
    inertial.mass_kg = fields.magnitude("mass", 1.0);
    if let Some(mut inertia) = fields.open("inertia") {
        inertial.inertia_kg_m2 = [
            inertia.number("ixx", 1.0),
            inertia.number("ixy", 0.0),
            inertia.number("ixz", 0.0),
            inertia.number("iyy", 1.0),
            inertia.number("iyz", 0.0),
            inertia.number("izz", 1.0),
        ];
        let rest = inertia.finish();
        fields.close("inertia", rest);
    }
    fields.verbatim(&["fluid_added_mass", "density", "auto_inertia_params", "frame"]);
    inertial.extra = fields.finish();
    inertial
}

/// Reads a `<collision>`; SDF's defaults.
pub fn read_collision(element: &Element, diagnostics: &mut Diagnostics) -> PosedElement<Collision> {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let (pose, relative_to) = fields.pose();
    let shape = geometry(&mut fields);
    let mut collision = Collision::new(name.unwrap_or_else(|| "collision".into()), shape);
    collision.origin = element.origin;
    collision.link_from_collision = pose;
    collision.laser_retro = fields.number("laser_retro", 0.0);
    collision.max_contacts = fields.count("max_contacts", 10);
    if let Some(surface) = fields.child("surface") {
        collision.surface = read_surface(surface, fields.diagnostics);
    }
    fields.verbatim(&["density", "auto_inertia_params", "frame"]);
    collision.extra = fields.finish();
    PosedElement { value: collision, relative_to }
}

/// Reads a `<visual>`; SDF's defaults.
pub fn read_visual(element: &Element, diagnostics: &mut Diagnostics) -> PosedElement<Visual> {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let (pose, relative_to) = fields.pose();
    let shape = geometry(&mut fields);
    let mut visual = Visual::new(name.unwrap_or_else(|| "visual".into()), shape);
    visual.origin = element.origin;
    visual.link_from_visual = pose;
    if let Some(material) = fields.child("material") {
        visual.material = Some(read_material(material, fields.diagnostics));
    }
    visual.cast_shadows = fields.boolean("cast_shadows", true);
    visual.transparency = fields.number("transparency", 0.0);
    visual.laser_retro = fields.number("laser_retro", 0.0);
    visual.visibility_flags = fields.count("visibility_flags", u32::MAX);
    visual.plugins = plugins(&mut fields);
    fields.verbatim(&["meta", "frame"]);
    visual.extra = fields.finish();
    if !(0.0..=1.0).contains(&visual.transparency)
        && let Some(child) = element.child("transparency")
    {
        diagnostics.push(
            Diagnostic::warning("out-of-range", "the transparency must be between 0 and 1")
                .at(child.text_origin()),
        );
    }
    PosedElement { value: visual, relative_to }
}

fn geometry(fields: &mut Fields<'_, '_>) -> Shape {
    if let Some(geometry) = fields.child("geometry") {
        return read_geometry(geometry, fields.diagnostics);
    }
    fields.diagnostics.push(
        Diagnostic::warning(
            "missing-element",
            format!("`<{}>` lacks its `<geometry>`", fields.element.name),
        )
        .at(fields.origin())
        .label("this has no shape")
        .help("add `<geometry><box><size>1 1 1</size></box></geometry>`"),
    );
    Shape::Empty
}
