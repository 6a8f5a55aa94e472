//! What several shapes share: meshes, textures.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_images::{BadImage, Image};
use periplus_scene::Mesh;

use crate::mesh::{Prepared, select};
use crate::shapes::Shapes;

/// Corners beyond this are no place \[m\].
const FARTHEST_M: f64 = 1e9;

/// What makes two meshes the same.
type Key = (String, Option<String>, bool, [u64; 3]);

/// Meshes and textures, each made once.
#[derive(Debug, Default)]
pub(crate) struct Store {
    meshes: BTreeMap<Key, Arc<Prepared>>,
    /// By what the file holds: many names may lead to one picture, and one name to several.
    images: BTreeMap<Arc<[u8]>, Result<Arc<Image>, BadImage>>,
}

impl Store {
    /// # Errors
    /// What is wrong with it, to be read after the shape's name.
    pub(crate) fn mesh(
        &mut self,
        mesh: &Mesh,
        shapes: &dyn Shapes,
    ) -> Result<Arc<Prepared>, String> {
        if !mesh.scale.is_finite() {
            return Err(format!("has a mesh (`{}`) whose scale is not finite", mesh.uri));
        }
        // Without a path the URI counts from its own file, so nothing is shared.
        let key = mesh.path.as_ref().map(|path| {
            let scale = mesh.scale.to_array().map(f64::to_bits);
            let path = path.to_string_lossy().into_owned();
            (path, mesh.submesh.clone(), mesh.center_submesh, scale)
        });
        if let Some(found) = key.as_ref().and_then(|key| self.meshes.get(key)) {
            return Ok(Arc::clone(found));
        }
        let Some(file) = shapes.mesh(mesh) else {
            return Err(format!("has a mesh (`{}`) that was not read", mesh.uri));
        };
        let selected = select(mesh, &file);
        if selected.triangles.is_empty() {
            let part = mesh.submesh.as_deref().unwrap_or_default();
            return Err(format!("has a mesh (`{}`) without a part named `{part}`", mesh.uri));
        }
        if !selected.positions_m.iter().flatten().all(|x| x.abs() < FARTHEST_M) {
            return Err(format!("has a mesh (`{}`) that reaches beyond any world", mesh.uri));
        }
        let prepared = Arc::new(Prepared::new(selected));
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
