//! Files of shapes, each read once.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use periplus_diagnostics::Origin;
use periplus_geometry::DVec3;
use periplus_graph::ParameterFileError;
use periplus_loader::read_mesh;
use periplus_os::Machine;
use periplus_physics::{Heights, Meshes, Triangles};
use periplus_rendering::{AssetLoader, sample_heightmap, select_submesh};
use periplus_resources::{FileReadError, Host};
use periplus_scene::{Heightmap, MeshShape};
use periplus_sim_nodes::ParameterFiles;

/// Reads the files of a scene, for physics and rendering, and parameter files of controllers.
#[derive(Debug, Default)]
pub struct AssetFiles {
    meshes: Mutex<BTreeMap<PathBuf, Option<Arc<periplus_meshes::Mesh>>>>,
}

impl AssetLoader for AssetFiles {
    fn mesh(&self, mesh: &MeshShape) -> Option<Arc<periplus_meshes::Mesh>> {
        let path = mesh.path.as_ref()?;
        let mut meshes = self.meshes.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = meshes.get(path) {
            return known.clone();
        }
        let read = Machine.read(path).ok().and_then(|bytes| read_mesh(path, &bytes, &Machine));
        let read = read.map(Arc::new);
        meshes.insert(path.clone(), read.clone());
        read
    }

    fn image(&self, uri: &str, _: Origin) -> Option<Arc<[u8]>> {
        // The composition has replaced the URIs of images by paths.
        Machine.read(Path::new(uri)).ok().map(Arc::from)
    }

    fn texture(&self, mesh: &MeshShape, name: &str) -> Option<Arc<[u8]>> {
        let path = mesh.path.as_ref()?;
        periplus_loader::read_beside(path, name, &Machine).map(Arc::from)
    }
}

impl Meshes for AssetFiles {
    fn triangles(&self, mesh: &MeshShape) -> Option<Triangles> {
        let selected = select_submesh(mesh, &*AssetLoader::mesh(self, mesh)?);
        let points_m = selected.positions_m.into_iter().map(DVec3::from_array).collect();
        Some(Triangles { points_m, triangles: selected.triangles })
    }

    fn heights(&self, heightmap: &Heightmap) -> Option<Heights> {
        // Problems are reported by rendering.
        let samples = sample_heightmap(heightmap, self).ok()?;
        Some(Heights {
            columns: samples.columns,
            rows: samples.rows,
            heights_m: samples.heights_m,
            size_m: samples.size_m,
        })
    }
}

impl ParameterFiles for AssetFiles {
    fn parameter_text(&self, path: &Path) -> Result<String, ParameterFileError> {
        let unreadable = |error: FileReadError| match Machine.kind(path) {
            None => ParameterFileError::Missing,
            Some(_) => ParameterFileError::Unreadable(error.to_string()),
        };
        let bytes = Machine.read(path).map_err(unreadable)?;
        String::from_utf8(bytes).map_err(|_| ParameterFileError::NotText)
    }
}
