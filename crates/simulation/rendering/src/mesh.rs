//! Meshes of files, made ready.

use std::sync::Arc;

use periplus_geometry::DVec3;
use periplus_meshes::{Material, Submesh};
use periplus_raycast::{MeshError, TriangleMesh};
use periplus_scene::Mesh;

/// The parts of a mesh file that a scene asks for, as one list of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selected {
    /// Corners, scaled and centred \[m\].
    pub positions_m: Vec<[f64; 3]>,
    /// Three corners each.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals in the file, one for each corner (zero where a part has none).
    pub(crate) normals: Vec<[f32; 3]>,
    /// Texture coordinates, one for each corner (zero where a part has none).
    pub(crate) uvs: Vec<[f32; 2]>,
    /// The parts in order: first triangle, material.
    pub(crate) parts: Vec<(u32, Option<Arc<Material>>)>,
}

/// Takes the submesh that a scene asks for, moves its centre where it wants it, and scales. A name
/// that no part has selects nothing.
#[must_use]
pub fn select(mesh: &Mesh, file: &periplus_meshes::Mesh) -> Selected {
    let chosen: Vec<&Submesh> = file
        .submeshes
        .iter()
        .filter(|part| mesh.submesh.as_ref().is_none_or(|name| part.name == *name))
        .collect();
    // Gazebo centres what it draws of a file, and that is one submesh.
    let centre =
        if mesh.submesh.is_some() && mesh.center_submesh { middle(&chosen) } else { DVec3::ZERO };
    let mut all = Selected::default();
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
            // Normals of a stretched surface shrink where it grows.
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

/// A mesh as things share it.
#[derive(Debug)]
pub(crate) struct Prepared {
    pub(crate) selected: Selected,
    /// Made when first something that moves has this mesh.
    pub(crate) tree: std::sync::OnceLock<Result<Arc<TriangleMesh>, MeshError>>,
}

impl Prepared {
    pub(crate) fn new(selected: Selected) -> Self {
        Self { selected, tree: std::sync::OnceLock::new() }
    }

    pub(crate) fn tree(&self, threads: usize) -> Result<Arc<TriangleMesh>, MeshError> {
        let Selected { positions_m, triangles, .. } = &self.selected;
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
        let mesh = Mesh {
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
        let selected = select(&mesh, &file);
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
