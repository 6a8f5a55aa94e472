//! Transform elements of a `<node>`.

use glam::{DMat4, DVec3};

use super::tree::Node;
use crate::error::MeshError;
use crate::notes::Notes;

/// The node's transform elements multiplied in document order (COLLADA 1.4.1,
/// 5-65): the last one acts on the geometry first.
pub(super) fn parent_from_node(node: Node<'_>, notes: &mut Notes) -> Result<DMat4, MeshError> {
    let mut parent_from_node = DMat4::IDENTITY;
    for element in node.children() {
        let step = match element.tag() {
            "matrix" => matrix(element)?,
            "translate" => DMat4::from_translation(DVec3::from_array(exactly(element)?)),
            "scale" => DMat4::from_scale(DVec3::from_array(exactly(element)?)),
            "rotate" => {
                let [x, y, z, angle_deg] = exactly(element)?;
                let axis = DVec3::new(x, y, z).try_normalize();
                // Without an axis there is no rotation.
                axis.map_or(DMat4::IDENTITY, |axis| {
                    DMat4::from_axis_angle(axis, f64::to_radians(angle_deg))
                })
            }
            "lookat" => lookat(element)?,
            "skew" => {
                notes.add("`<skew>` left out: bake transforms before export");
                continue;
            }
            _ => continue,
        };
        parent_from_node *= step;
    }
    if !parent_from_node.is_finite() {
        return Err(node.error("its transform is not finite"));
    }
    Ok(parent_from_node)
}

/// Sixteen numbers, row-major.
pub(super) fn matrix(element: Node<'_>) -> Result<DMat4, MeshError> {
    Ok(DMat4::from_cols_array(&exactly(element)?).transpose())
}

/// Eye, target and up direction: the node is at the eye and looks along its -z.
fn lookat(element: Node<'_>) -> Result<DMat4, MeshError> {
    let [ex, ey, ez, ix, iy, iz, ux, uy, uz] = exactly(element)?;
    let eye = DVec3::new(ex, ey, ez);
    let back = (eye - DVec3::new(ix, iy, iz)).try_normalize();
    let right = back.and_then(|back| DVec3::new(ux, uy, uz).cross(back).try_normalize());
    let (Some(back), Some(right)) = (back, right) else {
        return Err(element.error("eye, target and up direction do not make a frame"));
    };
    let up = back.cross(right);
    Ok(DMat4::from_cols(right.extend(0.0), up.extend(0.0), back.extend(0.0), eye.extend(1.0)))
}

fn exactly<const N: usize>(element: Node<'_>) -> Result<[f64; N], MeshError> {
    let numbers = element.numbers()?;
    let len = numbers.len();
    numbers.try_into().map_err(|_| element.error(format!("needs {N} numbers, has {len}")))
}
