//! `<material>` by way of `<effect>` to a diffuse colour and an image file.

use super::tree::Node;
use crate::mesh::{Material, Texture};

/// The material a `<material>` element stands for.
///
/// `<transparency>` is left aside: exporters disagree on whether 0 or 1 means
/// opaque, and Gazebo's reader takes only the diffuse alpha into the colour too.
pub(super) fn read(material: Node<'_>) -> Material {
    let name = material.attribute("name").or(material.attribute("id")).unwrap_or("").to_owned();
    let mut result = Material { name, diffuse_rgba: [1.0; 4], texture: None };
    let effect = material
        .child("instance_effect")
        .and_then(|instance| material.tree().find("effect", instance.attribute("url")?));
    let profile = effect.and_then(|effect| effect.child("profile_COMMON"));
    let Some(profile) = profile else { return result };
    let shading = profile.child("technique").and_then(|technique| {
        let is_model =
            |node: &Node<'_>| matches!(node.tag(), "phong" | "blinn" | "lambert" | "constant");
        technique.children().find(is_model)
    });
    // A `<constant>` surface shines by itself and has no diffuse part.
    let diffuse = shading.and_then(|shading| {
        let tag = if shading.tag() == "constant" { "emission" } else { "diffuse" };
        shading.child(tag)
    });
    if let Some(diffuse) = diffuse {
        if let Some(color) = diffuse.child("color").and_then(color) {
            result.diffuse_rgba = color;
        }
        let texture = diffuse.child("texture").and_then(|node| node.attribute("texture"));
        result.texture = texture.and_then(|name| image_file(profile, name)).map(Texture::File);
    }
    result
}

fn color(node: Node<'_>) -> Option<[f32; 4]> {
    let numbers = node.numbers().ok()?;
    if numbers.len() < 3 || numbers.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let channel = |i: usize| numbers.get(i).map_or(1.0, |&x| (x as f32).clamp(0.0, 1.0));
    Some([channel(0), channel(1), channel(2), channel(3)])
}

/// A texture names a sampler, that a surface, that an image; some writers name
/// the image at once. COLLADA 1.5 has the sampler name the image.
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
