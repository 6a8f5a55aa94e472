//! STL, OBJ, COLLADA and glTF to triangles.
//!
//! Bytes in, [`Mesh`] out: no file is opened here. Files beside the mesh file
//! (`.mtl`, `.bin`) are asked for through a callback.
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
//! # Which way is up, and how long is a unit
//!
//! A mesh lies in the world exactly as Gazebo and RViz place it:
//!
//! - COLLADA: `<unit meter="...">` scales to metres. `<up_axis>` does **not**
//!   turn the mesh. Gazebo Classic never read the tag (gazebo-classic issue
//!   1305), gz-common's `ColladaLoader` does not either, its `AssimpLoader`
//!   drops the turn that assimp puts on the root node
//!   (`UpdatedRootNodeTransform`), and RViz and MoveIt undo it
//!   (geometric_shapes pull request 52). Robot files are written against that:
//!   TurtleBot3's world meshes say `Y_UP` and have their height along z. The
//!   declared axis is kept in [`Mesh::declared_up`], with a note when it is not z.
//! - glTF: coordinates as in the file, metres, with all node transforms, as
//!   current gz-common loads them. The format says +y is up, so an asset that was not
//!   exported with z up lies on its side in Gazebo, and here.
//! - STL and OBJ have neither unit nor axis: taken as metres, as they are.

mod build;
mod collada;
mod error;
mod format;
mod gltf;
mod limits;
mod mesh;
mod notes;
mod obj;
mod stl;
mod triangulate;

pub use crate::error::{MeshError, Place};
pub use crate::format::MeshFormat;
pub use crate::limits::Limits;
pub use crate::mesh::{Bounds, Material, Mesh, Submesh, Texture, UpAxis};
pub use crate::notes::Note;

/// Gives the bytes of a file named in a mesh file, relative to it, or `None`.
///
/// The name is what the mesh file says (percent-decoded for glTF): the callee
/// decides whether `../../secret` or an absolute path may be followed.
pub type SideFiles<'a> = dyn FnMut(&str) -> Option<Vec<u8>> + 'a;

/// Reads a mesh within the default [`Limits`].
///
/// # Errors
/// When the bytes are not a mesh of this format, when a vertex position is not
/// finite, when no triangle is found, or when the file unfolds beyond the limits.
pub fn read(
    bytes: &[u8],
    format: MeshFormat,
    side_files: &mut SideFiles<'_>,
) -> Result<Mesh, MeshError> {
    read_within(Limits::default(), bytes, format, side_files)
}

/// Reads a mesh within the given limits.
///
/// # Errors
/// As [`read`].
pub fn read_within(
    limits: Limits,
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

/// A file whose bytes speak for another format is misnamed rather than damaged.
fn explain_wrong_format(mut error: MeshError, bytes: &[u8], format: MeshFormat) -> MeshError {
    if let Some(found) = MeshFormat::from_bytes(bytes).filter(|&found| found != format) {
        error.message = format!("{} (it looks like {found:?}, not {format:?})", error.message);
        error.help = "give the file the extension of its format".to_owned();
    }
    error
}
