//! `<light>`.

use periplus_scene::{Light, LightKind};
use periplus_xml::Element;

use super::out::Out;

pub(super) fn write_light(light: &Light) -> Element {
    let mut out = Out::named("light", &light.name);
    let kind = match light.kind {
        LightKind::Point => "point",
        LightKind::Directional => "directional",
        LightKind::Spot(_) => "spot",
    };
    out.attribute("type", kind);
    out.pose(light.parent_from_light);
    out.flag("light_on", light.is_on, true);
    out.flag("visualize", light.visualize, true);
    out.flag("cast_shadows", light.cast_shadows, false);
    out.number("intensity", light.intensity, 1.0);
    out.colour("diffuse", light.diffuse);
    out.colour("specular", light.specular);
    let mut attenuation = Out::new("attenuation");
    attenuation.always("range", light.attenuation.range_m);
    attenuation.always("constant", light.attenuation.constant);
    attenuation.always("linear", light.attenuation.linear);
    attenuation.always("quadratic", light.attenuation.quadratic);
    out.push(attenuation.finish(&[]));
    out.vector("direction", light.direction_in_light);
    if let LightKind::Spot(spot) = light.kind {
        let mut element = Out::new("spot");
        element.always("inner_angle", spot.inner_angle_rad);
        element.always("outer_angle", spot.outer_angle_rad);
        element.always("falloff", spot.falloff);
        out.push(element.finish(&[]));
    }
    out.finish(&light.extra)
}
