//! `<world>`.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::DVec3;
use periplus_scene::{Gui, SphericalCoordinates, World};
use periplus_xml::Element;

use super::actor::read_actor;
use super::include::{Entity, read_include};
use super::joint::read_joint;
use super::light::read_light;
use super::merge::merge_into_world;
use super::model::{read_frame, read_model};
use super::physics::read_physics;
use super::plugin::plugins;
use super::population::read_population;
use super::root::Reader;
use super::state::read_state;
use crate::draft::{LightDraft, WorldDraft};
use crate::fields::Fields;
use crate::value::boolean_word;

/// Reads a `<world>` and its content.
pub(crate) fn read_world(element: &Element, reader: &mut Reader<'_>) -> WorldDraft {
    let mut draft = read_own(element, reader);
    for child in element.elements() {
        match &*child.name {
            "model" => draft.models.extend(read_model(child, reader)),
            "population" => read_population(child, &mut draft, reader),
            "include" => match read_include(child, reader) {
                Some((Entity::Model(model), true)) => merge_into_world(*model, &mut draft, reader),
                Some((Entity::Model(model), false)) => draft.models.push(*model),
                Some((Entity::Light(light), _)) => draft.lights.push(*light),
                Some((Entity::Actor(actor), _)) => draft.actors.push(*actor),
                None => {}
            },
            _ => {}
        }
    }
    for child in element.named("state") {
        read_state(child, &mut draft, reader);
    }
    draft
}

/// Reads the world without its models.
fn read_own(element: &Element, reader: &mut Reader<'_>) -> WorldDraft {
    let mut fields = Fields::new(element, reader.diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let mut world =
        World { origin: element.origin, ..World::empty(name.unwrap_or_else(|| "world".into())) };
    world.gravity_m_s2 = fields.vector("gravity", world.gravity_m_s2);
    world.magnetic_field_t = fields.vector("magnetic_field", world.magnetic_field_t);
    if let Some(mut wind) = fields.open("wind") {
        world.wind_m_s = wind.vector("linear_velocity", DVec3::ZERO);
        let rest = wind.finish();
        fields.close("wind", rest);
    }
    read_scene(&mut fields, &mut world);
    for child in fields.children("physics") {
        world.physics.push(read_physics(child, fields.diagnostics));
    }
    // The default physics, or else the first, becomes the first of the list.
    if let Some(index) = world.physics.iter().position(|physics| physics.default) {
        world.physics[..=index].rotate_right(1);
    }
    if world.physics.is_empty() {
        world.physics.push(periplus_scene::Physics::default());
    }
    world.spherical_coordinates = spherical_coordinates(&mut fields);
    world.gui = gui(&mut fields);
    world.plugins = plugins(&mut fields);
    let mut draft = WorldDraft {
        frames: Vec::new(),
        models: Vec::new(),
        joints: Vec::new(),
        lights: Vec::new(),
        actors: Vec::new(),
        world,
    };
    for child in fields.children("frame") {
        draft.frames.push(read_frame(child, fields.diagnostics));
    }
    for child in fields.children("joint") {
        draft.joints.extend(read_joint(child, fields.diagnostics));
    }
    for child in fields.children("light") {
        let placed = read_light(child, fields.diagnostics);
        draft.lights.push(LightDraft { light: placed.value, relative_to: placed.relative_to });
    }
    for child in fields.children("actor") {
        draft.actors.push(read_actor(child, fields.diagnostics));
    }
    for read_by_the_caller in ["model", "include", "population", "state"] {
        fields.children(read_by_the_caller);
    }
    fields.verbatim(&["audio", "atmosphere", "road"]);
    draft.world.extra = fields.finish();
    draft
}

fn read_scene(fields: &mut Fields<'_, '_>, world: &mut World) {
    let Some(mut scene) = fields.open("scene") else { return };
    world.ambient = scene.colour("ambient").unwrap_or(world.ambient);
    world.background = scene.colour("background").unwrap_or(world.background);
    world.shadows = scene.boolean("shadows", true);
    world.grid = scene.boolean("grid", true);
    scene.verbatim(&["sky", "fog", "origin_visual"]);
    let rest = scene.finish();
    fields.close("scene", rest);
}

fn spherical_coordinates(fields: &mut Fields<'_, '_>) -> Option<SphericalCoordinates> {
    let mut child = fields.open("spherical_coordinates")?;
    let surface_model = child.text("surface_model").unwrap_or_else(|| "EARTH_WGS84".into());
    if !["EARTH_WGS84", "MOON_SCS", "CUSTOM_SURFACE"].contains(&surface_model.as_str()) {
        let place = child.element.child("surface_model").map(Element::text_origin);
        child.diagnostics.push(
            Diagnostic::error(
                "unknown-type",
                format!("`{surface_model}` is not a surface that is known here"),
            )
            .at(place.unwrap_or_default())
            .help("write `EARTH_WGS84`, `MOON_SCS` or `CUSTOM_SURFACE`"),
        );
    }
    let coordinates = SphericalCoordinates {
        surface_model,
        frame_orientation: child.text("world_frame_orientation").unwrap_or_else(|| "ENU".into()),
        latitude_rad: child.number("latitude_deg", 0.0).to_radians(),
        longitude_rad: child.number("longitude_deg", 0.0).to_radians(),
        elevation_m: child.number("elevation", 0.0),
        heading_rad: child.number("heading_deg", 0.0).to_radians(),
        extra: {
            child.verbatim(&["surface_axis_equatorial", "surface_axis_polar"]);
            child.finish()
        },
    };
    Some(coordinates)
}

fn gui(fields: &mut Fields<'_, '_>) -> Option<Gui> {
    let mut child = fields.open("gui")?;
    let fullscreen = child.attribute("fullscreen").is_some_and(|it| {
        boolean_word(&it.value, it.value_origin, child.diagnostics).unwrap_or(false)
    });
    let mut gui = Gui {
        fullscreen,
        world_from_camera: None,
        camera_extra: Vec::new(),
        plugins: plugins(&mut child),
        extra: Vec::new(),
    };
    if let Some(mut camera) = child.open("camera") {
        camera.ignore_attributes(&["name"]);
        if camera.element.child("pose").is_some() {
            gui.world_from_camera = Some(camera.fixed_pose("world"));
        }
        camera.verbatim(&["view_controller", "projection_type", "track_visual", "frame"]);
        gui.camera_extra = camera.finish();
    }
    gui.extra = child.finish();
    Some(gui)
}
