//! Access to meshes and images of files.

use std::sync::Arc;

use periplus_diagnostics::Origin;
use periplus_scene::MeshShape;

/// Provides the content of files to code that must not read files. [`crate::RenderScene`] reports
/// missing content with the position in the source and continues.
pub trait AssetLoader {
    /// Returns the whole mesh file, without submesh, centring or scale; `None` if it could not be
    /// read.
    fn mesh(&self, mesh: &MeshShape) -> Option<Arc<periplus_meshes::Mesh>>;

    /// Returns the bytes of an image (PNG or JPEG) of a scene: a heightmap, an albedo map.
    fn image(&self, uri: &str, origin: Origin) -> Option<Arc<[u8]>>;

    /// Returns the bytes of an image of a mesh file, relative to that file.
    fn texture(&self, mesh: &MeshShape, name: &str) -> Option<Arc<[u8]>>;
}

/// A loader without files.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoAssets;

impl AssetLoader for NoAssets {
    fn mesh(&self, _: &MeshShape) -> Option<Arc<periplus_meshes::Mesh>> {
        None
    }

    fn image(&self, _: &str, _: Origin) -> Option<Arc<[u8]>> {
        None
    }

    fn texture(&self, _: &MeshShape, _: &str) -> Option<Arc<[u8]>> {
        None
    }
}
