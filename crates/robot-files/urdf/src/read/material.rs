//! Materials.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_xml::Element;

use super::fields::{extra, only_child, required_text, vector};
use crate::robot::{ColourAsWritten, UrdfMaterial, UrdfTexture};

/// Reads a `<material>` of the robot: it must have a name and a colour or texture.
pub(super) fn global(element: &Element, diagnostics: &mut Diagnostics) -> Option<UrdfMaterial> {
    let name = required_text(element, "name", diagnostics)?.value.to_string();
    let material = content(name, element, diagnostics);
    if !material.is_definition() {
        diagnostics.push(
            Diagnostic::error(
                "empty-material",
                format!("the material `{}` has neither colour nor texture", material.name),
            )
            .at(element.origin)
            .help("write <color rgba=\"1 0 0 1\"/> or <texture filename=\"...\"/> in it"),
        );
    }
    Some(material)
}

/// Reads a `<material>` of a visual: a definition or a reference by name.
pub(super) fn of_visual(element: &Element, diagnostics: &mut Diagnostics) -> UrdfMaterial {
    // An empty name with a colour in place is common and harmless.
    let name = match element.attribute("name") {
        Some(name) => name.value.to_string(),
        None => {
            diagnostics.push(
                Diagnostic::error("missing-attribute", "this `material` has no attribute `name`")
                    .at(element.origin)
                    .help("write <material name=\"...\">; the name may be empty"),
            );
            String::new()
        }
    };
    content(name, element, diagnostics)
}

fn content(name: String, element: &Element, diagnostics: &mut Diagnostics) -> UrdfMaterial {
    let colour = only_child(element, "color", diagnostics).and_then(|colour| {
        if colour.attribute("rgba").is_none() {
            required_text(colour, "rgba", diagnostics);
        }
        let rgba: [f64; 4] = vector(colour, "rgba", diagnostics)?;
        if rgba.iter().any(|part| !(0.0..=1.0).contains(part)) {
            diagnostics.push(
                Diagnostic::warning("colour-out-of-range", "colours are numbers from 0 to 1")
                    .at(colour.attribute("rgba").map_or(colour.origin, |rgba| rgba.value_origin))
                    .help("divide by 255 if they were meant for 0 to 255"),
            );
        }
        Some(ColourAsWritten { rgba, extra: extra(colour, &["rgba"], &[], &[], diagnostics) })
    });
    let texture = only_child(element, "texture", diagnostics).and_then(|texture| {
        // `<texture/>` without a name is what liburdfdom itself writes for "none".
        let filename = texture.value("filename").filter(|name| !name.is_empty())?;
        Some(UrdfTexture {
            filename: filename.to_owned(),
            extra: extra(texture, &["filename"], &[], &[], diagnostics),
        })
    });
    UrdfMaterial {
        name,
        colour,
        texture,
        extra: extra(element, &["name"], &["color", "texture"], &[], diagnostics),
        origin: element.origin,
    }
}
