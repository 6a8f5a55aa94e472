//! Diffuse colour and image file of a `<material>`, through its `<effect>`.

use super::tree::Node;
use crate::mesh::{MeshMaterial, MeshTexture, TextureAlpha};

/// Reads the material of a `<material>` element.
///
/// `<transparency>` is ignored: exporters disagree about whether 0 or 1 is opaque, and Gazebo's reader uses
/// only the diffuse alpha too.
pub(super) fn read(material: Node<'_>) -> MeshMaterial {
    let name = material.attribute("name").or(material.attribute("id")).unwrap_or("").to_owned();
    let mut result = MeshMaterial { name, ..MeshMaterial::default() };
    let effect = material
        .child("instance_effect")
        .and_then(|instance| material.tree().find("effect", instance.attribute("url")?));
    let profile = effect.and_then(|effect| effect.child("profile_COMMON"));
    let Some(profile) = profile else { return result };
    result.is_double_sided =
        [effect, Some(profile), profile.child("technique")].into_iter().flatten().any(double_sided);
    let shading = profile.child("technique").and_then(|technique| {
        let is_model =
            |node: &Node<'_>| matches!(node.tag(), "phong" | "blinn" | "lambert" | "constant");
        technique.children().find(is_model)
    });
    // A `<constant>` surface is emissive and has no diffuse part.
    let diffuse = shading.and_then(|shading| {
        let tag = if shading.tag() == "constant" { "emission" } else { "diffuse" };
        shading.child(tag)
    });
    if let Some(diffuse) = diffuse {
        if let Some(color) = diffuse.child("color").and_then(color) {
            result.diffuse_rgba = color;
        }
        let texture = diffuse.child("texture").and_then(|node| node.attribute("texture"));
        result.texture = texture.and_then(|name| image_file(profile, name)).map(MeshTexture::File);
    }
    let Some(shading) = shading else { return result };
    // The only colour of a `<constant>` surface was read as its diffuse one.
    let emission = shading.child("emission").filter(|_| shading.tag() != "constant");
    if let Some([r, g, b, _]) = emission.and_then(|node| node.child("color")).and_then(color) {
        result.emissive_rgb = [r, g, b];
    }
    if shading.descend(&["transparent", "texture"]).is_some() {
        result.texture_alpha = TextureAlpha::Blended;
    }
    result
}

/// True if an `<extra>` of this element has `<double_sided>1`, which Google Earth defined and many programs
/// write.
fn double_sided(element: Node<'_>) -> bool {
    let is_one = |node: Node<'_>| matches!(node.text(), "1" | "true");
    element
        .children_named("extra")
        .flat_map(|extra| extra.children_named("technique"))
        .filter_map(|technique| technique.child("double_sided"))
        .any(is_one)
}

fn color(node: Node<'_>) -> Option<[f32; 4]> {
    let numbers = node.numbers().ok()?;
    if numbers.len() < 3 || numbers.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let channel = |i: usize| numbers.get(i).map_or(1.0, |&x| (x as f32).clamp(0.0, 1.0));
    Some([channel(0), channel(1), channel(2), channel(3)])
}

/// A texture refers to a sampler, the sampler to a surface, the surface to an image; some writers refer to
/// the image directly. In COLLADA 1.5 the sampler refers to the image.
fn image_file(profile: Node<'_>, name: &str) -> Option<String> {
    let param = |sid: &str| {
        profile.children_named("newparam").find(|node| node.attribute("sid") == Some(sid))
    };
    let mut image = name;
    if let Some(sampler) = param(name).and_then(|node| node.child("sampler2D")) {
        if let Some(instance) = sampler.child("instance_image") {
            image = instance.attribute("url")?;
        } else {
            image = sampler.child("source")?.text();
            if let Some(from) = param(image).and_then(|n| n.descend(&["surface", "init_from"])) {
                image = from.text();
            }
        }
    }
    let from = profile.tree().find("image", image)?.child("init_from")?;
    let file = from.child("ref").unwrap_or(from).text();
    (!file.is_empty()).then(|| file.to_owned())
}
