//! Construction of vertices and indices from triangle corners.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DMat3, DMat4, DVec3};

use crate::error::MeshError;
use crate::limits::Budget;
use crate::mesh::{MeshMaterial, Submesh};
use crate::notes::Notes;

/// Corner of a triangle: identity and attributes.
pub(crate) struct Corner {
    /// Corners with equal keys in one part are one vertex: indices of position, normal and texture
    /// coordinate in the file's lists.
    pub(crate) key: [u32; 3],
    pub(crate) position: DVec3,
    pub(crate) normal: Option<[f32; 3]>,
    pub(crate) uv: Option<[f32; 2]>,
}

/// Approximate size of one finished vertex and one triangle [bytes].
const VERTEX_BYTES: usize = 44;
const TRIANGLE_BYTES: usize = 12;

/// Size of one vertex and one triangle while a part is read [bytes]: those of the part, those of its first
/// instance, and the entry in the index of equal corners.
const READ_VERTEX_BYTES: usize = 2 * VERTEX_BYTES + 32;
const READ_TRIANGLE_BYTES: usize = 2 * TRIANGLE_BYTES;

/// Part under construction, in its own frame and unit.
#[derive(Default)]
pub(crate) struct Part {
    pub(crate) positions: Vec<DVec3>,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    vertex_of_key: HashMap<[u32; 3], u32>,
}

impl Part {
    pub(crate) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Adds one triangle.
    ///
    /// # Errors
    /// If the budget is exceeded or a position is not finite.
    pub(crate) fn triangle(
        &mut self,
        corners: [&Corner; 3],
        budget: &mut Budget,
    ) -> Result<(), MeshError> {
        budget.triangles(1)?;
        budget.bytes(READ_TRIANGLE_BYTES)?;
        let mut triangle = [0; 3];
        for (index, corner) in triangle.iter_mut().zip(corners) {
            *index = self.vertex(corner, budget)?;
        }
        self.triangles.push(triangle);
        Ok(())
    }

    fn vertex(&mut self, corner: &Corner, budget: &mut Budget) -> Result<u32, MeshError> {
        if let Some(&index) = self.vertex_of_key.get(&corner.key) {
            return Ok(index);
        }
        if !corner.position.is_finite() {
            return Err(not_finite(corner.position));
        }
        budget.bytes(READ_VERTEX_BYTES)?;
        // Cannot overflow: 2^32 vertices exceed any byte budget below 176 GiB.
        let index = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
        self.positions.push(corner.position);
        // Attributes are used only if every vertex has them: see `complete`.
        self.normals.extend(corner.normal.and_then(unit));
        self.uvs.extend(corner.uv.filter(|uv| uv.iter().all(|x| x.is_finite())));
        self.vertex_of_key.insert(corner.key, index);
        Ok(index)
    }

    /// Returns this part in the mesh frame: `mesh_from_part` includes the unit.
    pub(crate) fn placed(
        &self,
        name: String,
        material: Option<Arc<MeshMaterial>>,
        mesh_from_part: DMat4,
        notes: &mut Notes,
    ) -> Result<Submesh, MeshError> {
        let positions_m = self
            .positions
            .iter()
            .map(|&p| {
                let placed = mesh_from_part.transform_point3(p);
                if placed.is_finite() { Ok(placed.to_array()) } else { Err(not_finite(placed)) }
            })
            .collect::<Result<Vec<_>, _>>()?;
        let linear = DMat3::from_mat4(mesh_from_part);
        let mirrored = linear.determinant() < 0.0;
        let cofactor = cofactor(linear, mirrored);
        let normals = complete(&self.normals, positions_m.len(), "normals", notes).map(|normals| {
            let place = |n: &[f32; 3]| {
                let placed = cofactor * DVec3::from_array(n.map(f64::from));
                unit(placed.try_normalize().unwrap_or(DVec3::ZERO).as_vec3().to_array())
                    .unwrap_or(*n)
            };
            normals.iter().map(place).collect()
        });
        let uvs =
            complete(&self.uvs, positions_m.len(), "texture coordinates", notes).map(<[_]>::to_vec);
        let mut triangles = self.triangles.clone();
        if mirrored {
            // A mirroring transform would invert every face (glTF 2.0, 3.7.4).
            triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        Ok(Submesh { name, positions_m, normals, uvs, triangles, material })
    }

    /// Charges the budget for another instance of this part.
    pub(crate) fn charge_copy(&self, budget: &mut Budget) -> Result<(), MeshError> {
        budget.triangles(self.triangles.len())?;
        let vertices = self.positions.len().saturating_mul(VERTEX_BYTES);
        budget.bytes(vertices.saturating_add(self.triangles.len().saturating_mul(TRIANGLE_BYTES)))
    }
}

/// Normals transform by the inverse transpose; the cofactor matrix equals it up to scale and exists for
/// singular transforms too.
fn cofactor(m: DMat3, mirrored: bool) -> DMat3 {
    let (a, b, c) = (m.x_axis, m.y_axis, m.z_axis);
    let cofactor = DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b));
    if mirrored { cofactor * -1.0 } else { cofactor }
}

fn complete<'a, T>(
    values: &'a [T],
    vertices: usize,
    what: &str,
    notes: &mut Notes,
) -> Option<&'a [T]> {
    if !values.is_empty() && values.len() < vertices {
        notes.add(format!("part with {what} on some vertices only, or not finite ones: left out"));
    }
    (!values.is_empty() && values.len() == vertices).then_some(values)
}

fn unit(normal: [f32; 3]) -> Option<[f32; 3]> {
    let normal = DVec3::from_array(normal.map(f64::from)).try_normalize()?;
    Some(normal.as_vec3().to_array())
}

pub(crate) fn not_finite(p: DVec3) -> MeshError {
    MeshError::new(
        format!("vertex position ({}, {}, {}) is not finite", p.x, p.y, p.z),
        "repair the mesh in a modelling program and export it again",
    )
}
