//! Readers for STL, OBJ, COLLADA and glTF meshes.
//!
//! A reader turns bytes into a [`Mesh`] and opens no files. Files next to the mesh file (`.mtl`, `.bin`)
//! are requested through a callback.
//!
//! ```
//! use periplus_meshes::{MeshFormat, read};
//!
//! let text = b"v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";
//! let mesh = read(text, MeshFormat::Obj, &mut |_| None)?;
//! assert_eq!(mesh.triangle_count(), 1);
//! assert_eq!(mesh.bounds().map(|b| b.size_m()), Some([2.0, 1.0, 0.0]));
//! # Ok::<(), periplus_meshes::MeshError>(())
//! ```
//!
//! # Up axis and unit
//!
//! A mesh has the same pose as in Gazebo and RViz:
//!
//! - COLLADA: `<unit meter="...">` scales to metres. `<up_axis>` does **not** rotate the mesh. Gazebo
//!   Classic never read the tag (gazebo-classic issue 1305), gz-common's `ColladaLoader` does not either,
//!   its `AssimpLoader` removes the rotation that assimp adds to the root node
//!   (`UpdatedRootNodeTransform`), and RViz and MoveIt undo it (geometric_shapes pull request 52). Robot
//!   files rely on this: TurtleBot3's world meshes declare `Y_UP` and have their height along z. The
//!   declared axis is kept in [`Mesh::declared_up`], with a note if it is not z.
//! - glTF: coordinates as in the file, in metres, with all node transforms, as in current gz-common. The
//!   format defines +y as up, so an asset that was not exported with z up is rotated by 90 degrees in
//!   Gazebo, and here.
//! - STL and OBJ have neither unit nor axis: coordinates are metres, unchanged.

mod build;
mod collada;
mod error;
mod format;
mod gltf;
mod limits;
mod mesh;
mod notes;
mod obj;
mod pack;
mod stl;
mod triangulate;

pub use crate::error::{MeshError, MeshLocation};
pub use crate::format::MeshFormat;
pub use crate::limits::MeshLimits;
pub use crate::mesh::{Mesh, MeshBounds, MeshMaterial, MeshTexture, Submesh, TextureAlpha, UpAxis};
pub use crate::notes::Note;
pub use crate::pack::{pack_file, sibling_uri};

/// Returns the bytes of a file that a mesh file refers to, relative to it, or `None`.
///
/// The name is as in the mesh file (percent-decoded for glTF). The callback decides whether `../../secret`
/// or an absolute path may be opened.
pub type SideFiles<'a> = dyn FnMut(&str) -> Option<Vec<u8>> + 'a;

/// Reads a mesh with the default [`MeshLimits`].
///
/// # Errors
/// If the bytes are not a mesh of this format, a vertex position is not finite, there is no triangle, or
/// the file exceeds the limits.
pub fn read(
    bytes: &[u8],
    format: MeshFormat,
    side_files: &mut SideFiles<'_>,
) -> Result<Mesh, MeshError> {
    read_within(MeshLimits::default(), bytes, format, side_files)
}

/// Reads a mesh with the given limits.
///
/// # Errors
/// As [`read`].
pub fn read_within(
    limits: MeshLimits,
    bytes: &[u8],
    format: MeshFormat,
    side_files: &mut SideFiles<'_>,
) -> Result<Mesh, MeshError> {
    let mut budget = limits::Budget::new(limits);
    budget.grant(bytes.len());
    let mesh = match format {
        MeshFormat::Stl => stl::read(bytes, &mut budget),
        MeshFormat::Obj => obj::read(bytes, &mut budget, side_files),
        MeshFormat::Collada => collada::read(bytes, &mut budget),
        MeshFormat::Gltf => gltf::read(bytes, &mut budget, side_files),
    }
    .map_err(|error| explain_wrong_format(error, bytes, format))?;
    if mesh.submeshes.is_empty() {
        let why = mesh.notes.first().map_or(String::new(), |note| format!(" ({})", note.message));
        let help = "export the mesh with its faces, or refer to another file";
        return Err(MeshError::new(format!("the file has no triangles{why}"), help));
    }
    Ok(mesh)
}

/// Explains an error of a file whose bytes are in another format: it is misnamed rather than damaged.
fn explain_wrong_format(mut error: MeshError, bytes: &[u8], format: MeshFormat) -> MeshError {
    if let Some(found) = MeshFormat::from_bytes(bytes).filter(|&found| found != format) {
        error.message = format!("{} (it looks like {found:?}, not {format:?})", error.message);
        error.help = "give the file the extension of its format".to_owned();
    }
    error
}
