//! Geometry and materials.

use periplus_diagnostics::Origin;
use periplus_geometry::Pose;
use periplus_xml::{Element, XmlNode};

use super::element::{child_mut, element, leaf, numbers, push_pose};
use crate::robot::{UrdfCollision, UrdfGeometry, UrdfMaterial, UrdfVisual};

/// `<collision>` with the settings from the blocks of its link.
pub(super) fn collision(
    collision: &UrdfCollision,
    name: &str,
    head_from_collision: Pose,
    settings: &[Element],
) -> Element {
    let mut to = element("collision", collision.origin).with_attribute("name", name);
    push_pose(&mut to, head_from_collision, collision.origin);
    to.push(geometry(&collision.geometry, collision.origin));
    to.children.extend(settings.iter().cloned().map(XmlNode::Element));
    to
}

/// `<visual>` with the settings from the blocks of its link. `material` is the definition of its material.
pub(super) fn visual(
    visual: &UrdfVisual,
    look: Option<&UrdfMaterial>,
    name: &str,
    head_from_visual: Pose,
    settings: &[Element],
) -> Element {
    let mut to = element("visual", visual.origin).with_attribute("name", name);
    push_pose(&mut to, head_from_visual, visual.origin);
    to.push(geometry(&visual.geometry, visual.origin));
    to.children.extend(settings.iter().cloned().map(XmlNode::Element));
    if let Some(look) = look {
        colour(look, &mut to);
    }
    to
}

/// Adds the colour of a URDF material, unless a block gives one. Gazebo brightens it because its renderers
/// darken (libsdformat, `CreateVisual`).
fn colour(look: &UrdfMaterial, to: &mut Element) {
    let material = child_mut(to, "material");
    if let Some(colour) = &look.colour
        && material.child("diffuse").is_none()
        && material.child("ambient").is_none()
    {
        let [red, green, blue, alpha] = colour.rgba;
        let bright = |part: f64| (part / 0.8).clamp(0.0, 1.0);
        let rgba = [bright(red), bright(green), bright(blue), alpha.clamp(0.0, 1.0)];
        material.push(numbers("diffuse", &rgba, look.origin));
        material.push(numbers("ambient", &rgba, look.origin));
    }
    // Gazebo drops the texture of a URDF; as an albedo map it can be rendered.
    if let Some(texture) = &look.texture
        && material.child("pbr").is_none()
    {
        let metal = child_mut(child_mut(material, "pbr"), "metal");
        metal.push(leaf("albedo_map", &texture.filename, look.origin));
    }
}

fn geometry(geometry: &UrdfGeometry, origin: Origin) -> Element {
    let one = |name: &str, parts: &[(&str, f64)]| {
        parts.iter().fold(element(name, origin), |shape, (part, value)| {
            shape.with_child(numbers(part, &[*value], origin))
        })
    };
    let shape = match geometry {
        // The reader has reported the error; a wrong size must not become SDF's default of 1 m.
        shape if !has_extent(shape) => element("empty", origin),
        UrdfGeometry::Box { size_m } => {
            element("box", origin).with_child(numbers("size", size_m, origin))
        }
        UrdfGeometry::Cylinder { radius_m, length_m } => {
            one("cylinder", &[("radius", *radius_m), ("length", *length_m)])
        }
        UrdfGeometry::Capsule { radius_m, length_m } => {
            one("capsule", &[("radius", *radius_m), ("length", *length_m)])
        }
        UrdfGeometry::Sphere { radius_m } => one("sphere", &[("radius", *radius_m)]),
        UrdfGeometry::Mesh { filename, scale, origin } => {
            let mesh = element("mesh", *origin).with_child(leaf("uri", filename, *origin));
            if *scale == [1.0; 3] {
                mesh
            } else {
                mesh.with_child(numbers("scale", scale, *origin))
            }
        }
        UrdfGeometry::Unknown(shape) => shape.clone(),
    };
    element("geometry", origin).with_child(shape)
}

fn has_extent(geometry: &UrdfGeometry) -> bool {
    match geometry {
        UrdfGeometry::Box { size_m } => size_m.iter().all(|size| *size > 0.0),
        // A capsule without a cylinder part is a sphere.
        UrdfGeometry::Capsule { radius_m, length_m } => *radius_m > 0.0 && *length_m >= 0.0,
        UrdfGeometry::Cylinder { radius_m, length_m } => *radius_m > 0.0 && *length_m > 0.0,
        UrdfGeometry::Sphere { radius_m } => *radius_m > 0.0,
        UrdfGeometry::Mesh { .. } | UrdfGeometry::Unknown(_) => true,
    }
}
