//! Cache of meshes and textures shared by shapes.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_images::{BadImage, Image};
use periplus_scene::MeshShape;

use crate::assets::AssetLoader;
use crate::mesh::{SharedMesh, select_submesh};

/// Maximum absolute value of a coordinate \[m\].
const MAX_COORDINATE_M: f64 = 1e9;

/// Identity of a mesh: path, submesh, centring, scale.
type MeshKey = (String, Option<String>, bool, [u64; 3]);

/// Meshes and textures, each prepared once.
#[derive(Debug, Default)]
pub(crate) struct AssetCache {
    meshes: BTreeMap<MeshKey, Arc<SharedMesh>>,
    /// Keyed by content: several names can refer to one image, and one name to several.
    images: BTreeMap<Arc<[u8]>, Result<Arc<Image>, BadImage>>,
}

impl AssetCache {
    /// # Errors
    /// The problem, as a clause that follows the shape's name.
    pub(crate) fn mesh(
        &mut self,
        mesh: &MeshShape,
        shapes: &dyn AssetLoader,
    ) -> Result<Arc<SharedMesh>, String> {
        if !mesh.scale.is_finite() {
            return Err(format!("has a mesh (`{}`) whose scale is not finite", mesh.uri));
        }
        // Without a path the URI is relative to its own file, so nothing is shared.
        let key = mesh.path.as_ref().map(|path| {
            let scale = mesh.scale.to_array().map(f64::to_bits);
            let path = path.to_string_lossy().into_owned();
            (path, mesh.submesh.clone(), mesh.center_submesh, scale)
        });
        if let Some(source) = key.as_ref().and_then(|key| self.meshes.get(key)) {
            return Ok(Arc::clone(source));
        }
        let Some(file) = shapes.mesh(mesh) else {
            return Err(format!("has a mesh (`{}`) that was not read", mesh.uri));
        };
        let selected = select_submesh(mesh, &file);
        if selected.triangles.is_empty() {
            let part = mesh.submesh.as_deref().unwrap_or_default();
            return Err(format!("has a mesh (`{}`) without a submesh named `{part}`", mesh.uri));
        }
        if !selected.positions_m.iter().flatten().all(|x| x.abs() < MAX_COORDINATE_M) {
            return Err(format!("has a mesh (`{}`) with coordinates beyond 1e9 m", mesh.uri));
        }
        let prepared = Arc::new(SharedMesh::new(selected));
        if let Some(key) = key {
            self.meshes.insert(key, Arc::clone(&prepared));
        }
        Ok(prepared)
    }

    pub(crate) fn image(&mut self, bytes: Arc<[u8]>) -> Result<Arc<Image>, BadImage> {
        self.images
            .entry(bytes)
            .or_insert_with_key(|bytes| Image::decode(bytes).map(Arc::new))
            .clone()
    }
}
