//! `<light>`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;
use periplus_scene::{Attenuation, Colour, Light, LightKind, Spot};
use periplus_xml::Element;

use crate::fields::Fields;
use crate::pose::PosedElement;

const KINDS: [&str; 3] = ["point", "directional", "spot"];

/// Reads a `<light>`; SDF's defaults.
pub fn read_light(element: &Element, diagnostics: &mut Diagnostics) -> PosedElement<Light> {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let (parent_from_light, relative_to) = fields.pose();
    let type_name = fields.attribute("type").map_or("point", |it| &*it.value);
    let spot = fields.open("spot").map(|mut spot| {
        let read = Spot {
            inner_angle_rad: spot.magnitude("inner_angle", 0.0),
            outer_angle_rad: spot.magnitude("outer_angle", 0.0),
            falloff: spot.magnitude("falloff", 0.0),
        };
        (read, spot.finish())
    });
    let mut spot_rest = Vec::new();
    let spot = spot.map(|(spot, rest)| {
        spot_rest = rest;
        spot
    });
    fields.close("spot", spot_rest);
    let kind = match type_name {
        "directional" => LightKind::Directional,
        "spot" => LightKind::Spot(spot.unwrap_or(Spot {
            inner_angle_rad: 0.0,
            outer_angle_rad: 0.0,
            falloff: 0.0,
        })),
        "point" => LightKind::Point,
        other => {
            let origin = element.attribute("type").map(|it| it.value_origin).unwrap_or_default();
            fields.diagnostics.push(
                Diagnostic::error("unknown-type", format!("`{other}` is not a kind of light"))
                    .at(origin)
                    .note("a light is `point`, `directional` or `spot`; a point light is assumed")
                    .did_you_mean(origin, other, KINDS),
            );
            LightKind::Point
        }
    };
    let mut attenuation = Attenuation { range_m: 10.0, constant: 1.0, linear: 1.0, quadratic: 0.0 };
    if let Some(mut child) = fields.open("attenuation") {
        attenuation = Attenuation {
            range_m: child.limit("range", 10.0),
            constant: child.number("constant", 1.0),
            linear: child.number("linear", 1.0),
            quadratic: child.number("quadratic", 0.0),
        };
        let rest = child.finish();
        fields.close("attenuation", rest);
    }
    let light = Light {
        name: name.unwrap_or_else(|| "light".into()),
        parent_from_light,
        kind,
        direction_in_light: fields.vector("direction", DVec3::NEG_Z),
        is_on: fields.boolean("light_on", true),
        visualize: fields.boolean("visualize", true),
        cast_shadows: fields.boolean("cast_shadows", false),
        intensity: fields.number("intensity", 1.0),
        diffuse: fields.colour("diffuse").unwrap_or(Colour::WHITE),
        specular: fields.colour("specular").unwrap_or(Colour([0.1, 0.1, 0.1, 1.0])),
        attenuation,
        origin: element.origin,
        extra: {
            fields.verbatim(&["frame"]);
            fields.finish()
        },
    };
    PosedElement { value: light, relative_to }
}
