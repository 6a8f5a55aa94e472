//! Meshes from files, prepared for rendering.

use std::sync::Arc;

use periplus_geometry::DVec3;
use periplus_meshes::{MeshMaterial, Submesh};
use periplus_raycast::{TriangleMesh, TriangleMeshError};
use periplus_scene::MeshShape;

/// The submeshes of a file that a scene selects, as one list of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SelectedMesh {
    /// Corners, scaled and centred \[m\].
    pub positions_m: Vec<[f64; 3]>,
    /// Three corner indices each.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals from the file, one per corner (zero where a submesh has none).
    pub(crate) normals: Vec<[f32; 3]>,
    /// Texture coordinates, one per corner (zero where a submesh has none).
    pub(crate) uvs: Vec<[f32; 2]>,
    /// Submeshes in order: first triangle, material.
    pub(crate) parts: Vec<(u32, Option<Arc<MeshMaterial>>)>,
}

/// Selects the submesh of a scene's mesh, centres and scales it. An unknown name selects nothing.
#[must_use]
pub fn select_submesh(mesh: &MeshShape, file: &periplus_meshes::Mesh) -> SelectedMesh {
    let chosen: Vec<&Submesh> = file
        .submeshes
        .iter()
        .filter(|part| mesh.submesh.as_ref().is_none_or(|name| part.name == *name))
        .collect();
    // Gazebo centres one submesh, which is all that it draws of the file.
    let centre =
        if mesh.submesh.is_some() && mesh.center_submesh { middle(&chosen) } else { DVec3::ZERO };
    let mut all = SelectedMesh::default();
    let has_normals = chosen.iter().any(|part| part.normals.is_some());
    let has_uvs = chosen.iter().any(|part| part.uvs.is_some());
    for part in chosen {
        #[expect(clippy::cast_possible_truncation, reason = "meshes have fewer than 2³² corners")]
        let (corner, triangle) = (all.positions_m.len() as u32, all.triangles.len() as u32);
        all.parts.push((triangle, part.material.clone()));
        let placed = |p: &[f64; 3]| ((DVec3::from_array(*p) - centre) * mesh.scale).to_array();
        all.positions_m.extend(part.positions_m.iter().map(placed));
        all.triangles.extend(part.triangles.iter().map(|t| t.map(|index| index + corner)));
        if has_normals {
            // Normals scale with the inverse of the surface's scale.
            let turned = |n: &[f32; 3]| {
                let n = DVec3::from_array(n.map(f64::from)) / mesh.scale;
                let n = if n.is_finite() { n.normalize_or_zero() } else { DVec3::ZERO };
                #[expect(clippy::cast_possible_truncation, reason = "single precision will do")]
                n.to_array().map(|x| x as f32)
            };
            all.normals.extend(part.normals.iter().flatten().map(turned));
            all.normals.resize(all.positions_m.len(), [0.0; 3]);
        }
        if has_uvs {
            all.uvs.extend(part.uvs.iter().flatten());
            all.uvs.resize(all.positions_m.len(), [0.0; 2]);
        }
    }
    all
}

fn middle(parts: &[&Submesh]) -> DVec3 {
    let all = || parts.iter().flat_map(|part| &part.positions_m).map(|p| DVec3::from_array(*p));
    let low = all().fold(DVec3::INFINITY, DVec3::min);
    let high = all().fold(DVec3::NEG_INFINITY, DVec3::max);
    if low.is_finite() && high.is_finite() { (low + high) / 2.0 } else { DVec3::ZERO }
}

/// A mesh that shapes share.
#[derive(Debug)]
pub(crate) struct SharedMesh {
    pub(crate) selected: SelectedMesh,
    /// Built when the first movable shape uses this mesh.
    pub(crate) tree: std::sync::OnceLock<Result<Arc<TriangleMesh>, TriangleMeshError>>,
}

impl SharedMesh {
    pub(crate) fn new(selected: SelectedMesh) -> Self {
        Self { selected, tree: std::sync::OnceLock::new() }
    }

    pub(crate) fn tree(&self, threads: usize) -> Result<Arc<TriangleMesh>, TriangleMeshError> {
        let SelectedMesh { positions_m, triangles, .. } = &self.selected;
        self.tree
            .get_or_init(|| TriangleMesh::new(positions_m, triangles, threads).map(Arc::new))
            .clone()
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Origin;

    use super::*;

    fn part(name: &str, x: f64) -> Submesh {
        Submesh {
            name: name.into(),
            positions_m: vec![[x, 0.0, 0.0], [x + 2.0, 0.0, 0.0], [x, 4.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            ..Submesh::default()
        }
    }

    fn check(submesh: Option<&str>, center_submesh: bool) -> Vec<[f64; 3]> {
        let mesh = MeshShape {
            uri: "two.dae".into(),
            path: None,
            submesh: submesh.map(str::to_owned),
            center_submesh,
            scale: DVec3::new(1.0, 0.5, 1.0),
            extra: Vec::new(),
            origin: Origin::default(),
        };
        let file = periplus_meshes::Mesh {
            submeshes: vec![part("near", 0.0), part("far", 10.0)],
            ..periplus_meshes::Mesh::default()
        };
        let selected = select_submesh(&mesh, &file);
        assert_eq!(selected.triangles.len(), selected.parts.len());
        selected.positions_m
    }

    #[test]
    fn parts_are_chosen_centred_and_scaled() {
        assert_eq!(check(None, true).len(), 6);
        assert_eq!(
            check(Some("far"), false),
            [[10.0, 0.0, 0.0], [12.0, 0.0, 0.0], [10.0, 2.0, 0.0]]
        );
        assert_eq!(
            check(Some("far"), true),
            [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]]
        );
        assert!(check(Some("gone"), true).is_empty());
    }
}
