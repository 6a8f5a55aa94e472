//! `<world>` and `<actor>`.

use periplus_geometry::DVec3;
use periplus_scene::{Actor, Gui, Physics, SphericalCoordinates, World};
use periplus_xml::Element;

use super::light::write_light;
use super::link::write_link;
use super::model::{write_frame, write_joint, write_model};
use super::out::{Out, degrees, write_pose};
use super::{Writer, write_plugin};
use crate::version::Version;

pub(super) fn write_world(world: &World, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::named("world", &world.name);
    for physics in &world.physics {
        out.push(write_physics(physics));
    }
    out.vector("gravity", world.gravity_m_s2);
    out.vector("magnetic_field", world.magnetic_field_t);
    if world.wind_m_s != DVec3::ZERO {
        let mut wind = Out::new("wind");
        wind.vector("linear_velocity", world.wind_m_s);
        out.push(wind.finish(&[]));
    }
    let mut scene = Out::new("scene");
    scene.colour("ambient", world.ambient);
    scene.colour("background", world.background);
    scene.text("shadows", world.shadows.to_string());
    scene.flag("grid", world.grid, true);
    out.push(scene.finish(&[]));
    if let Some(coordinates) = &world.spherical_coordinates {
        out.push(write_coordinates(coordinates));
    }
    if let Some(gui) = &world.gui {
        out.push(write_gui(gui));
    }
    for plugin in &world.plugins {
        out.push(write_plugin(plugin));
    }
    for frame in &world.frames {
        out.push(write_frame(frame, "world", writer));
    }
    for light in &world.lights {
        out.push(write_light(light));
    }
    for model in &world.models {
        out.push(write_model(model, writer));
    }
    for joint in &world.joints {
        writer.needs(Version::new(11));
        if let Some(element) = write_joint(joint, writer) {
            out.push(element);
        }
    }
    for actor in &world.actors {
        out.push(write_actor(actor, writer));
    }
    out.finish(&world.extra)
}

fn write_physics(physics: &Physics) -> Element {
    let mut out = Out::named("physics", &physics.name);
    if physics.default {
        out.attribute("default", "true");
    }
    out.attribute("type", &physics.engine);
    out.always("max_step_size", physics.max_step_size_s);
    out.always("real_time_factor", physics.real_time_factor);
    out.always("real_time_update_rate", physics.real_time_update_rate_hz);
    out.count("max_contacts", physics.max_contacts, 20);
    out.finish(&physics.extra)
}

fn write_coordinates(coordinates: &SphericalCoordinates) -> Element {
    let mut out = Out::new("spherical_coordinates");
    out.text("surface_model", &coordinates.surface_model);
    out.text("world_frame_orientation", &coordinates.frame_orientation);
    out.text("latitude_deg", degrees(coordinates.latitude_rad));
    out.text("longitude_deg", degrees(coordinates.longitude_rad));
    out.always("elevation", coordinates.elevation_m);
    out.text("heading_deg", degrees(coordinates.heading_rad));
    out.finish(&coordinates.extra)
}

fn write_gui(gui: &Gui) -> Element {
    let mut out = Out::new("gui");
    if gui.fullscreen {
        out.attribute("fullscreen", "true");
    }
    if gui.world_from_camera.is_some() || !gui.camera_extra.is_empty() {
        let mut camera = Out::named("camera", "user_camera");
        if let Some(pose) = gui.world_from_camera {
            camera.push(write_pose(pose));
        }
        out.push(camera.finish(&gui.camera_extra));
    }
    for plugin in &gui.plugins {
        out.push(write_plugin(plugin));
    }
    out.finish(&gui.extra)
}

pub(super) fn write_actor(actor: &Actor, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::named("actor", &actor.name);
    out.pose(actor.world_from_actor);
    for link in &actor.links {
        out.push(write_link(link, writer));
    }
    for joint in &actor.joints {
        if let Some(element) = write_joint(joint, writer) {
            out.push(element);
        }
    }
    for plugin in &actor.plugins {
        out.push(write_plugin(plugin));
    }
    out.finish(&actor.extra)
}
