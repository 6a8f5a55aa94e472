//! `<material>`.

use periplus_scene::Material;
use periplus_xml::Element;

use super::Writer;
use super::out::Out;

pub(super) fn write_material(material: &Material, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::new("material");
    if let Some(name) = &material.name {
        writer.own_names = true;
        out.attribute("periplus:name", name);
    }
    if let Some(script) = &material.script {
        let mut element = Out::new("script");
        for uri in &script.uris {
            element.text("uri", uri);
        }
        if !script.name.is_empty() {
            element.text("name", &script.name);
        }
        out.push(element.finish(&[]));
    }
    if let Some(lighting) = material.lighting {
        out.text("lighting", lighting.to_string());
    }
    let colours = [
        ("ambient", material.ambient),
        ("diffuse", material.diffuse),
        ("specular", material.specular),
        ("emissive", material.emissive),
    ];
    for (name, colour) in colours {
        if let Some(colour) = colour {
            out.colour(name, colour);
        }
    }
    if let Some(shininess) = material.shininess {
        out.always("shininess", shininess);
    }
    out.flag("double_sided", material.double_sided, false);
    if let Some(pbr) = &material.pbr {
        out.push(write_pbr(pbr));
    }
    out.finish(&material.extra)
}

/// The whole element if there is one, as it has more content than the numbers.
fn write_pbr(pbr: &periplus_scene::Pbr) -> Element {
    if let Some(element) = &pbr.element {
        return element.clone();
    }
    let mut metal = Out::new("metal");
    metal.optional("albedo_map", &pbr.albedo_map);
    for (name, value) in [("roughness", pbr.roughness), ("metalness", pbr.metalness)] {
        if let Some(value) = value {
            metal.always(name, value);
        }
    }
    Element::new("pbr").with_child(metal.finish(&[]))
}
