//! `<surface>`.

use periplus_geometry::DVec3;
use periplus_scene::{ContactProperties, Friction, SurfaceProperties};
use periplus_xml::Element;

use super::out::Out;

pub(super) fn write_surface(surface: &SurfaceProperties) -> Element {
    let mut out = Out::new("surface");
    let contact = &surface.contact;
    let defaults = ContactProperties::default();
    let mut bounce = Out::new("bounce");
    bounce.number("restitution_coefficient", contact.restitution, defaults.restitution);
    bounce.number("threshold", contact.bounce_threshold_m_s, defaults.bounce_threshold_m_s);
    out.push_filled(bounce.finish(&[]));
    out.push_filled(write_friction(&surface.friction));
    out.push_filled(write_contact(contact, &defaults));
    out.finish(&surface.extra)
}

fn write_friction(friction: &Friction) -> Element {
    let mut ode = Out::new("ode");
    ode.number("mu", friction.mu, 1.0);
    ode.number("mu2", friction.mu2, 1.0);
    if friction.fdir1 != DVec3::ZERO {
        ode.vector_in("fdir1", friction.fdir1, friction.fdir1_expressed_in.as_deref());
    }
    ode.number("slip1", friction.slip1, 0.0);
    ode.number("slip2", friction.slip2, 0.0);
    let mut out = Out::new("friction");
    out.push_filled(ode.finish(&[]));
    out.finish(&[])
}

fn write_contact(contact: &ContactProperties, defaults: &ContactProperties) -> Element {
    let mut out = Out::new("contact");
    out.flag("collide_without_contact", contact.collide_without_contact, false);
    out.count("collide_bitmask", contact.collide_bitmask, defaults.collide_bitmask);
    let mut ode = Out::new("ode");
    ode.number("kp", contact.kp, defaults.kp);
    ode.number("kd", contact.kd, defaults.kd);
    ode.number("max_vel", contact.max_vel_m_s, defaults.max_vel_m_s);
    ode.number("min_depth", contact.min_depth_m, defaults.min_depth_m);
    out.push_filled(ode.finish(&[]));
    out.finish(&[])
}
