//! `<surface>`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_scene::{ContactProperties, Friction, SurfaceProperties};
use periplus_xml::Element;

use crate::fields::Fields;

/// Reads a `<surface>`; SDF's defaults.
pub fn read_surface(element: &Element, diagnostics: &mut Diagnostics) -> SurfaceProperties {
    let mut fields = Fields::new(element, diagnostics);
    let mut surface = SurfaceProperties::default();
    if let Some(mut bounce) = fields.open("bounce") {
        surface.contact.restitution = bounce.number("restitution_coefficient", 0.0);
        surface.contact.bounce_threshold_m_s = bounce.limit("threshold", 100_000.0);
        let rest = bounce.finish();
        fields.close("bounce", rest);
    }
    if let Some(mut friction) = fields.open("friction") {
        if let Some(mut ode) = friction.open("ode") {
            surface.friction = read_friction(&mut ode);
            let rest = ode.finish();
            friction.close("ode", rest);
        }
        friction.verbatim(&["torsional", "bullet"]);
        let rest = friction.finish();
        fields.close("friction", rest);
    }
    if let Some(mut contact) = fields.open("contact") {
        read_contact(&mut contact, &mut surface.contact);
        let rest = contact.finish();
        fields.close("contact", rest);
    }
    fields.verbatim(&["soft_contact"]);
    surface.extra = fields.finish();
    surface
}

fn read_friction(ode: &mut Fields<'_, '_>) -> Friction {
    // SDF 1.0 to 1.3 have -1 for a coefficient left to the engine; ODE then used infinity.
    let mut coefficient = |name| {
        let value = ode.limit(name, 1.0);
        if value < 0.0 { f64::INFINITY } else { value }
    };
    Friction {
        mu: coefficient("mu"),
        mu2: coefficient("mu2"),
        fdir1_expressed_in: expressed_in(ode.element),
        fdir1: ode.vector("fdir1", DVec3::ZERO),
        slip1: ode.number("slip1", 0.0),
        slip2: ode.number("slip2", 0.0),
    }
}

/// Frame of `<fdir1>`; Gazebo reads it under its own and under the older name.
fn expressed_in(ode: &Element) -> Option<String> {
    let fdir1 = ode.child("fdir1")?;
    let named = ["gz:expressed_in", "ignition:expressed_in"];
    let frame = named.iter().find_map(|name| fdir1.attribute(name))?;
    Some(frame.value.to_string()).filter(|frame| !frame.is_empty())
}

fn read_contact(fields: &mut Fields<'_, '_>, contact: &mut ContactProperties) {
    contact.collide_without_contact = fields.boolean("collide_without_contact", false);
    contact.collide_bitmask = fields.count("collide_bitmask", 0xffff);
    if let Some(mut ode) = fields.open("ode") {
        contact.kp = ode.limit("kp", 1e12);
        contact.kd = ode.limit("kd", 1.0);
        contact.max_vel_m_s = ode.limit("max_vel", 0.01);
        contact.min_depth_m = ode.number("min_depth", 0.0);
        ode.verbatim(&["soft_cfm", "soft_erp"]);
        let rest = ode.finish();
        fields.close("ode", rest);
    }
    fields.verbatim(&[
        "collide_without_contact_bitmask",
        "category_bitmask",
        "poissons_ratio",
        "elastic_modulus",
        "bullet",
    ]);
}
