//! Where shapes from files come from.

use std::sync::Arc;

use periplus_diagnostics::Origin;
use periplus_scene::Mesh;

/// Gives what files hold; whoever may read files does so. What is missing is told by
/// [`crate::Surroundings`], with its place, and the rest goes on.
pub trait Shapes {
    /// The whole mesh file, without submesh, centring or scale; none if it could not be read.
    fn mesh(&self, mesh: &Mesh) -> Option<Arc<periplus_meshes::Mesh>>;

    /// The bytes of an image (PNG or JPEG) that a scene names: a heightmap, an albedo map.
    fn image(&self, uri: &str, origin: Origin) -> Option<Arc<[u8]>>;

    /// The bytes of an image that a mesh file names, relative to that file.
    fn texture(&self, mesh: &Mesh, name: &str) -> Option<Arc<[u8]>>;
}

/// No files at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoShapes;

impl Shapes for NoShapes {
    fn mesh(&self, _: &Mesh) -> Option<Arc<periplus_meshes::Mesh>> {
        None
    }

    fn image(&self, _: &str, _: Origin) -> Option<Arc<[u8]>> {
        None
    }

    fn texture(&self, _: &Mesh, _: &str) -> Option<Arc<[u8]>> {
        None
    }
}
