//! COLLADA 1.4 and 1.5 (`.dae`), geometry of the visual scene.
//!
//! Follows "COLLADA - Digital Asset Schema Release 1.4.1" (Khronos, 2008), except where Gazebo reads files
//! differently: see the crate documentation on the up axis.

mod geometry;
mod material;
mod plan;
mod scene;
mod source;
mod text;
mod transform;
mod tree;

use glam::{DMat4, DVec3};

use self::plan::Planner;
use self::scene::Walk;
use self::tree::{Node, Tree, short};
use crate::error::MeshError;
use crate::limits::Budget;
use crate::mesh::{Mesh, UpAxis};
use crate::notes::Notes;

pub(crate) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Mesh, MeshError> {
    let text = text::decode(bytes)?;
    let tree = Tree::parse(&text, budget)?;
    let root = tree.root()?;
    let mut notes = Notes::default();
    let mesh_from_scene = DMat4::from_scale(DVec3::splat(unit_m(root)?));
    let declared_up = declared_up(root);
    if matches!(declared_up, Some(UpAxis::X | UpAxis::Y)) {
        notes.add("`<up_axis>` other than Z_UP has no effect, as in Gazebo and RViz");
    }

    let mut walk = Walk::new(Planner::new(&tree, &mut notes), budget);
    if let Some(scene) = visual_scene(root)? {
        walk.scene(scene, mesh_from_scene)?;
    } else {
        // A file with geometries only: every geometry once, at its own coordinates.
        for library in root.children_named("library_geometries") {
            for geometry in library.children_named("geometry") {
                walk.lone(geometry, mesh_from_scene)?;
            }
        }
    }
    let submeshes = walk.submeshes;
    Ok(Mesh { submeshes, declared_up, notes: notes.finish() })
}

/// Length of the file's unit \[m\]; the default is one metre.
fn unit_m(root: Node<'_>) -> Result<f64, MeshError> {
    let unit = root.descend(&["asset", "unit"]);
    let Some((unit, text)) = unit.and_then(|unit| Some((unit, unit.attribute("meter")?))) else {
        return Ok(1.0);
    };
    let meter = text.trim().parse().ok().filter(|meter: &f64| meter.is_finite() && *meter > 0.0);
    meter.ok_or_else(|| unit.error(format!("`meter=\"{}\"` is not a length", short(text))))
}

fn declared_up(root: Node<'_>) -> Option<UpAxis> {
    match root.descend(&["asset", "up_axis"])?.text() {
        "X_UP" => Some(UpAxis::X),
        "Y_UP" => Some(UpAxis::Y),
        "Z_UP" => Some(UpAxis::Z),
        _ => None,
    }
}

/// Scene that `<scene>` instantiates, or else the first one.
fn visual_scene(root: Node<'_>) -> Result<Option<Node<'_>>, MeshError> {
    let instance = root.descend(&["scene", "instance_visual_scene"]);
    let Some((instance, url)) = instance.and_then(|i| Some((i, i.attribute("url")?))) else {
        return Ok(root.descend(&["library_visual_scenes", "visual_scene"]));
    };
    match root.tree().find("visual_scene", url) {
        Some(scene) => Ok(Some(scene)),
        None => Err(instance.error(format!("no `<visual_scene>` has the id `{}`", short(url)))),
    }
}
