//! `<link>` and its content.

use periplus_scene::{Collision, Inertial, Link, Visual};
use periplus_xml::Element;

use super::light::write_light;
use super::material::write_material;
use super::out::Out;
use super::sensor::write_sensor;
use super::shape::write_geometry;
use super::surface::write_surface;
use super::{Writer, write_plugin};
use crate::version::Version;

pub(super) fn write_link(link: &Link, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::named("link", &link.name);
    out.pose(link.model_from_link);
    out.flag("gravity", link.gravity, true);
    out.flag("enable_wind", link.enable_wind, false);
    out.flag("self_collide", link.self_collide, false);
    out.flag("kinematic", link.kinematic, false);
    let mut decay = Out::new("velocity_decay");
    decay.number("linear", link.velocity_decay[0], 0.0);
    decay.number("angular", link.velocity_decay[1], 0.0);
    out.push_filled(decay.finish(&[]));
    if link.inertial != Inertial::default() {
        out.push(write_inertial(&link.inertial, writer));
    }
    for collision in &link.collisions {
        out.push(write_collision(collision, writer));
    }
    for visual in &link.visuals {
        out.push(write_visual(visual, writer));
    }
    for sensor in &link.sensors {
        out.push(write_sensor(sensor));
    }
    for light in &link.lights {
        out.push(write_light(light));
    }
    out.finish(&link.extra)
}

fn write_inertial(inertial: &Inertial, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::new("inertial");
    if inertial.auto {
        writer.needs(Version::new(11));
        out.attribute("auto", "true");
    }
    out.pose(inertial.link_from_inertial);
    out.always("mass", inertial.mass_kg);
    let mut inertia = Out::new("inertia");
    let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
    for (name, value) in names.iter().zip(inertial.inertia_kg_m2) {
        inertia.always(name, value);
    }
    out.push(inertia.finish(&[]));
    out.finish(&inertial.extra)
}

fn write_collision(collision: &Collision, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::named("collision", &collision.name);
    out.pose(collision.link_from_collision);
    out.push(write_geometry(&collision.shape, writer));
    out.number("laser_retro", collision.laser_retro, 0.0);
    out.count("max_contacts", collision.max_contacts, 10);
    out.push_filled(write_surface(&collision.surface));
    out.finish(&collision.extra)
}

fn write_visual(visual: &Visual, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::named("visual", &visual.name);
    out.pose(visual.link_from_visual);
    out.push(write_geometry(&visual.shape, writer));
    if let Some(material) = &visual.material {
        out.push(write_material(material, writer));
    }
    out.flag("cast_shadows", visual.cast_shadows, true);
    out.number("transparency", visual.transparency, 0.0);
    out.number("laser_retro", visual.laser_retro, 0.0);
    out.count("visibility_flags", visual.visibility_flags, u32::MAX);
    for plugin in &visual.plugins {
        out.push(write_plugin(plugin));
    }
    out.finish(&visual.extra)
}
