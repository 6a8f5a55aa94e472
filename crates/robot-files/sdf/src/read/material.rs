//! `<material>`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{Material, MaterialScript, Pbr, builtin_material, builtin_material_names};
use periplus_xml::Element;

use crate::fields::Fields;
use crate::verbatim::keep;

/// Reads a `<material>`. Missing elements stay `None`.
pub fn read_material(element: &Element, diagnostics: &mut Diagnostics) -> Material {
    let mut fields = Fields::new(element, diagnostics);
    let mut material = Material {
        name: fields.attribute("periplus:name").map(|it| it.value.to_string()),
        ambient: fields.colour("ambient"),
        diffuse: fields.colour("diffuse"),
        specular: fields.colour("specular"),
        emissive: fields.colour("emissive"),
        shininess: fields.optional_number("shininess"),
        ..Material::default()
    };
    if let Some(script) = fields.open("script") {
        let (script, rest) = read_script(script);
        material.script = script;
        fields.close("script", rest);
    }
    if element.child("lighting").is_some() {
        material.lighting = Some(fields.boolean("lighting", true));
    }
    material.double_sided = fields.boolean("double_sided", false);
    if let Some(pbr) = fields.child("pbr") {
        material.pbr = Some(read_pbr(pbr, fields.diagnostics));
    }
    fields.verbatim(&["shader", "render_order", "lighting"]);
    material.extra = fields.finish();
    material
}

fn read_script(mut fields: Fields<'_, '_>) -> (Option<MaterialScript>, Vec<Element>) {
    let mut uris = Vec::new();
    for uri in fields.children("uri") {
        let text = uri.text();
        if text.is_empty() || text == "__default__" {
            // Occurs in worlds saved by Gazebo Classic's building editor.
            fields.diagnostics.push(
                Diagnostic::warning("empty-value", "the `<uri>` of this script is empty")
                    .at(uri.origin)
                    .note("Gazebo Classic loads this, newer Gazebo refuses the whole file"),
            );
        } else {
            uris.push(text.into_owned());
        }
    }
    let name = fields.text("name");
    if let Some(name) = &name {
        check_name(name, &mut fields);
    } else {
        let finding = Diagnostic::warning(
            "missing-element",
            "`<script>` lacks the `<name>` of a material; it changes nothing",
        );
        fields.diagnostics.push(finding.at(fields.origin()));
    }
    let rest = fields.finish();
    let script = (name.is_some() || !uris.is_empty())
        .then(|| MaterialScript { uris, name: name.unwrap_or_default() });
    (script, rest)
}

fn check_name(name: &str, fields: &mut Fields<'_, '_>) {
    if name.starts_with("Gazebo/") && builtin_material(name).is_none() {
        let origin = fields.element.child("name").map(Element::text_origin).unwrap_or_default();
        let finding = Diagnostic::hint(
            "unknown-material",
            format!("`{name}` is none of Gazebo's built-in materials that are known here"),
        );
        fields.diagnostics.push(finding.at(origin).did_you_mean(
            origin,
            name,
            builtin_material_names(),
        ));
    }
}

/// Only a few values are read, so the whole element is kept.
fn read_pbr(element: &Element, diagnostics: &mut Diagnostics) -> Pbr {
    let mut pbr = Pbr { element: Some(keep(element)), ..Pbr::default() };
    let Some(metal) = element.child("metal") else { return pbr };
    let mut fields = Fields::new(metal, diagnostics);
    pbr.roughness = fields.optional_number("roughness");
    pbr.metalness = fields.optional_number("metalness");
    pbr.albedo_map = fields.text("albedo_map");
    fields.verbatim(&[
        "roughness_map",
        "metalness_map",
        "environment_map",
        "ambient_occlusion_map",
        "normal_map",
        "emissive_map",
        "light_map",
    ]);
    fields.finish();
    pbr
}
