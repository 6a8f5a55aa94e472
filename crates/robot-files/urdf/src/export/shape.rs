//! Shapes and materials.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::Pose;
use periplus_scene::{
    Collision as SceneCollision, Colour, Material as SceneMaterial, Pbr, Shape,
    Visual as SceneVisual,
};
use periplus_xml::{Element, XmlNode};

use super::lost;
use crate::convert::LUMP;
use crate::robot::{
    ColourAsWritten, Extra, UrdfCollision, UrdfGeometry, UrdfMaterial, UrdfOrigin, UrdfTexture,
    UrdfVisual,
};

/// Origin of a shape, by Gazebo's rule for names of shapes converted from URDF.
pub(super) struct Source {
    /// Name without the suffix added by the rule: that of a link, or the shape's own.
    pub(super) base: String,
    /// True if the name follows the rule.
    pub(super) by_rule: bool,
}

impl Source {
    fn of(head: &str, name: &str, kind: &str, index: usize) -> Self {
        let number = if index > 0 { format!("_{index}") } else { String::new() };
        let ending = format!("_{kind}{number}");
        match name.strip_suffix(&*ending) {
            Some(base) if !base.is_empty() => {
                let prefix = format!("{head}{LUMP}");
                let base = base.strip_prefix(&*prefix).unwrap_or(base);
                Self { base: base.to_owned(), by_rule: true }
            }
            _ => Self { base: name.to_owned(), by_rule: false },
        }
    }

    /// Name that makes the rule produce the shape's present name on a link.
    pub(super) fn name_on(&self, link: &str) -> Option<String> {
        (self.base != link).then(|| self.base.clone())
    }
}

/// Origins of all shapes of a body.
pub(super) fn sources<'a>(
    head: &str,
    names: impl Iterator<Item = &'a str>,
    kind: &str,
) -> Vec<Source> {
    names.enumerate().map(|(index, name)| Source::of(head, name, kind, index)).collect()
}

/// SDF settings of a shape that URDF does not have.
pub(super) type Rest = Vec<Element>;

/// Children of a shape other than pose and geometry.
pub(super) fn rest(written: &Element) -> Rest {
    written
        .elements()
        .filter(|part| !["pose", "geometry"].contains(&&*part.name))
        .cloned()
        .collect()
}

/// Block for all shapes of a link with the settings that they share. Differing settings are lost.
pub(super) fn common(
    kind: &str,
    rests: &[Rest],
    link: &str,
    diagnostics: &mut Diagnostics,
) -> Option<Element> {
    let first = rests.first()?;
    if let Some(other) = rests.iter().find(|rest| *rest != first) {
        let differing =
            other.iter().chain(first).find(|part| !(first.contains(part) && other.contains(part)));
        let what = differing.map_or("settings", |part| &*part.name);
        let origin = differing.map_or(Origin::default(), |part| part.origin);
        diagnostics.push(
            lost(format!(
                "the {kind}s of `{link}` differ in `{what}`, and URDF has one value per link"
            ))
            .at(origin)
            .label(format!("the first {kind} decides"))
            .help("put them on separate links, on fixed joints"),
        );
    }
    if first.is_empty() {
        return None;
    }
    // Common short form.
    if kind == "visual"
        && let [only] = &**first
        && let Some(name) = script_only(only)
    {
        return Some(Element::new("material").with_text(name));
    }
    let mut block = Element::new(kind);
    block.children.extend(first.iter().cloned().map(XmlNode::Element));
    Some(block)
}

/// Name of a material that only refers to one of Gazebo's materials.
fn script_only(material: &Element) -> Option<String> {
    let mut parts = material.elements();
    let script = parts.next().filter(|part| part.name == "script")?;
    let uris: Vec<_> = script.named("uri").map(Element::text).collect();
    (parts.next().is_none() && uris == [crate::convert::BUILTIN_MATERIALS])
        .then(|| script.child("name").map(|name| name.text().into_owned()))?
}

pub(super) fn collision(
    from: &SceneCollision,
    name: Option<String>,
    link_from_collision: Pose,
    diagnostics: &mut Diagnostics,
) -> Option<UrdfCollision> {
    Some(UrdfCollision {
        geometry: geometry(&from.shape, &from.name, from.origin, diagnostics)?,
        name,
        link_from_collision: UrdfOrigin::from_pose(link_from_collision),
        extra: Extra::default(),
        origin: from.origin,
    })
}

pub(super) fn visual(
    from: &SceneVisual,
    look: Option<UrdfMaterial>,
    name: Option<String>,
    link_from_visual: Pose,
    diagnostics: &mut Diagnostics,
) -> Option<UrdfVisual> {
    Some(UrdfVisual {
        geometry: geometry(&from.shape, &from.name, from.origin, diagnostics)?,
        name,
        link_from_visual: UrdfOrigin::from_pose(link_from_visual),
        material: look,
        extra: Extra::default(),
        origin: from.origin,
    })
}

fn geometry(
    shape: &Shape,
    name: &str,
    origin: Origin,
    diagnostics: &mut Diagnostics,
) -> Option<UrdfGeometry> {
    let cannot = |what: &str, help: &str, diagnostics: &mut Diagnostics| {
        diagnostics
            .push(lost(format!("URDF has no {what}, and `{name}` is one")).at(origin).help(help));
    };
    Some(match shape {
        Shape::Empty => {
            diagnostics.push(
                Diagnostic::warning("not-in-urdf", format!("`{name}` has no shape"))
                    .at(origin)
                    .label("left out"),
            );
            return None;
        }
        Shape::Box { size_m } => UrdfGeometry::Box { size_m: size_m.to_array() },
        Shape::Cylinder { radius_m, length_m } => {
            UrdfGeometry::Cylinder { radius_m: *radius_m, length_m: *length_m }
        }
        Shape::Sphere { radius_m } => UrdfGeometry::Sphere { radius_m: *radius_m },
        Shape::Capsule { radius_m, length_m } => {
            diagnostics.push(
                Diagnostic::warning("newer-urdf", format!("`{name}` is a capsule"))
                    .at(origin)
                    .note("capsules are of URDF 1.2; older readers refuse the file"),
            );
            UrdfGeometry::Capsule { radius_m: *radius_m, length_m: *length_m }
        }
        Shape::Mesh(mesh) => {
            if mesh.submesh.is_some() || !mesh.extra.is_empty() {
                cannot("part of a mesh", "save the part as a separate mesh", diagnostics);
            }
            UrdfGeometry::Mesh {
                filename: mesh.uri.clone(),
                scale: mesh.scale.to_array(),
                origin: mesh.origin,
            }
        }
        Shape::Unknown(element) => UrdfGeometry::Unknown(element.clone()),
        other => {
            let (what, help) = match other {
                Shape::Cone { .. } => ("cone", "use a mesh"),
                Shape::Ellipsoid { .. } => ("ellipsoid", "use a sphere mesh with a scale"),
                Shape::Plane { .. } => ("plane", "use a flat box"),
                Shape::Polylines(_) => ("polyline", "use a mesh"),
                Shape::Heightmap(_) => ("heightmap", "keep the terrain in the world"),
                Shape::Image(_) => ("image", "keep the walls in the world"),
                _ => ("such shape", "leave it out"),
            };
            cannot(what, help, diagnostics);
            return None;
        }
    })
}

/// Materials exported so far: in a URDF a name identifies one material.
#[derive(Default)]
pub(super) struct ExportedMaterials {
    known: BTreeMap<String, UrdfMaterial>,
}

impl ExportedMaterials {
    /// Part of a material that URDF can express: one colour and a texture. `written` is the material as
    /// SDF, from which that part is removed.
    pub(super) fn of(
        &mut self,
        look: &SceneMaterial,
        written: Option<&mut Element>,
    ) -> Option<UrdfMaterial> {
        let texture = look.pbr.as_ref().and_then(texture);
        let colour = match (look.ambient == look.diffuse, look.diffuse) {
            (true, Some(diffuse)) => as_written(diffuse),
            _ => None,
        };
        if texture.is_none() && colour.is_none() {
            return None;
        }
        if let Some(written) = written {
            let said = |part: &Element| match &*part.name {
                "ambient" | "diffuse" => colour.is_some(),
                "pbr" => texture.is_some(),
                _ => false,
            };
            written.children.retain(|node| node.as_element().is_none_or(|part| !said(part)));
        }
        let mut material = UrdfMaterial {
            name: look.name.clone().unwrap_or_default(),
            colour: colour.map(|rgba| ColourAsWritten { rgba, extra: Extra::default() }),
            texture: texture.map(|filename| UrdfTexture { filename, extra: Extra::default() }),
            extra: Extra::default(),
            origin: Origin::default(),
        };
        if !material.name.is_empty() {
            let first = self.known.entry(material.name.clone()).or_insert_with(|| material.clone());
            if *first != material {
                material.name.clear();
            }
        }
        Some(material)
    }
}

/// Texture of a material that has no other maps.
fn texture(pbr: &Pbr) -> Option<String> {
    let alone = pbr.element.as_ref().is_none_or(|element| {
        let parts = element.elements().flat_map(Element::elements).count();
        element.elements().count() == 1 && parts == 1
    });
    let numbers = pbr.roughness.is_some() || pbr.metalness.is_some();
    pbr.albedo_map.clone().filter(|_| alone && !numbers)
}

/// Inverse of the brightening by Gazebo, see `convert`. Full brightness may come from any value from 0.8
/// on; 1 is the most common.
fn as_written(Colour([red, green, blue, alpha]): Colour) -> Option<[f64; 4]> {
    let dark = |bright: f64| -> Option<f64> {
        if bright == 1.0 {
            return Some(1.0);
        }
        let guess = bright * 0.8;
        // Rounding may be off by one step.
        [guess, guess.next_up(), guess.next_down()]
            .into_iter()
            .find(|dark| (dark / 0.8).clamp(0.0, 1.0) == bright)
    };
    Some([dark(red)?, dark(green)?, dark(blue)?, alpha])
}
