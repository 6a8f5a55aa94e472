//! glTF 2.0, as JSON or binary container.
//!
//! Follows the "glTF 2.0 Specification" (Khronos, ISO/IEC 12113:2022). The JSON is parsed by the `gltf`
//! crate; its wrappers and validation are not used, because they index by numbers from the file and refuse
//! files without `min`/`max`, which all other readers accept. Skins and morph targets keep their base
//! shape.

mod accessor;
mod buffers;
mod container;
mod material;
mod primitive;
mod scene;

use ::gltf::json::Root;

use self::buffers::Buffers;
use self::scene::Walk;
use crate::SideFiles;
use crate::error::{MeshError, MeshLocation};
use crate::limits::Budget;
use crate::mesh::Mesh;
use crate::notes::Notes;

/// Extensions that do not change the shape, or that accessors support.
const KNOWN_EXTENSIONS: [&str; 16] = [
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_materials_unlit",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_texture_basisu",
    "EXT_texture_webp",
    "MSFT_texture_dds",
];

/// Maximum memory of one parsed JSON object [bytes].
const OBJECT_BYTES: usize = 512;

pub(crate) fn read(
    bytes: &[u8],
    budget: &mut Budget,
    side_files: &mut SideFiles<'_>,
) -> Result<Mesh, MeshError> {
    let container::Parts { json, binary } = container::split(bytes)?;
    // An object of two characters, `{}`, may become a node of hundreds of bytes.
    budget.bytes(json.iter().filter(|&&b| b == b'{').count().saturating_mul(OBJECT_BYTES))?;
    let root = Root::from_slice(json).map_err(|error| not_gltf(&error))?;
    if !root.asset.version.starts_with("2.") {
        let version: String = root.asset.version.chars().take(20).collect();
        return Err(MeshError::new(
            format!("glTF version `{version}` is not supported"),
            "convert the file to glTF 2.0",
        ));
    }
    let unknown = root.extensions_required.iter().find(|e| !KNOWN_EXTENSIONS.contains(&e.as_str()));
    if let Some(extension) = unknown {
        let extension: String = extension.chars().take(60).collect();
        return Err(MeshError::new(
            format!("the file requires the glTF extension `{extension}`, which is not supported"),
            "export it without compression and without that extension",
        ));
    }
    let mut notes = Notes::default();
    let buffers = Buffers::new(&root, binary, side_files);
    let mut walk = Walk::new(&root, buffers, budget, &mut notes);
    walk.default_scene()?;
    let submeshes = walk.submeshes;
    Ok(Mesh { submeshes, declared_up: None, notes: notes.finish() })
}

fn not_gltf(error: &::gltf::json::Error) -> MeshError {
    MeshError::new(format!("not glTF: {error}"), "export the file again as glTF 2.0")
        .at(MeshLocation::Line(error.line()))
}
