//! Mesh files as the triangles of a viewer.
//!
//! A browser draws the numbers of this form without a parser for any mesh format, so that a file is read by
//! one program only. `docs/live.md` describes the bytes.

mod bytes;

use std::collections::HashMap;
use std::sync::Arc;

use self::bytes::PackedBytes;
use crate::error::MeshError;
use crate::mesh::{Mesh, MeshMaterial, MeshTexture, Submesh, TextureAlpha};
use crate::{MeshFormat, SideFiles, read};

/// First bytes of the form, and its version.
const MAGIC: &[u8; 4] = b"PMSH";
const VERSION: u32 = 1;

/// Maximum size of the form \[bytes\]: a client may have twice as much waiting before it is disconnected
/// (`docs/live.md`, "Slow clients"). Ten million triangles of a closed surface fit.
const MAX_PACKED_BYTES: usize = 192 << 20;

/// Flags of the file.
const LINEAR_COLOURS: u32 = 1;

/// Flags of a material.
const DOUBLE_SIDED: u32 = 1;
const BLENDED: u32 = 2;
const CUTOUT: u32 = 4;

/// Flags of a part.
const HAS_NORMALS: u32 = 1;
const HAS_UVS: u32 = 2;
const LONG_INDICES: u32 = 4;

/// Kind of a texture.
const TEXTURE_URI: u32 = 0;
const TEXTURE_IMAGE: u32 = 1;

/// Reads a mesh file and returns its triangles in the form of a viewer.
///
/// The extension in `uri` selects the format as in [`MeshFormat::from_path_and_bytes`]; a fragment such as
/// `#submesh=wheel` has no effect. Textures in separate files become URIs beside `uri`.
///
/// # Errors
/// As [`read`]; also if a coordinate exceeds single precision, or the result 192 MiB.
pub fn pack_file(
    uri: &str,
    bytes: &[u8],
    side_files: &mut SideFiles<'_>,
) -> Result<Vec<u8>, MeshError> {
    let format = MeshFormat::from_path_and_bytes(without_query(uri), bytes)?;
    pack(&read(bytes, format, side_files)?, format, uri)
}

fn pack(mesh: &Mesh, format: MeshFormat, uri: &str) -> Result<Vec<u8>, MeshError> {
    let catalog = Catalog::of(mesh);
    let mut out = PackedBytes::new(MAX_PACKED_BYTES);
    out.raw(MAGIC)?;
    out.u32(VERSION)?;
    // Base colours of glTF are linear; those of all other formats are meant for the screen.
    out.u32(if format == MeshFormat::Gltf { LINEAR_COLOURS } else { 0 })?;
    out.count(catalog.textures.len())?;
    out.count(catalog.materials.len())?;
    out.count(mesh.submeshes.len())?;
    for texture in &catalog.textures {
        match texture {
            MeshTexture::File(name) => {
                out.u32(TEXTURE_URI)?;
                out.block(sibling_uri(uri, name).as_bytes())?;
            }
            MeshTexture::Embedded { bytes, .. } => {
                out.u32(TEXTURE_IMAGE)?;
                out.block(bytes)?;
            }
        }
    }
    for material in &catalog.materials {
        write_material(material, &catalog, &mut out)?;
    }
    for part in &mesh.submeshes {
        write_part(part, &catalog, &mut out)?;
    }
    Ok(out.finish())
}

/// Materials and textures of a mesh, each once.
#[derive(Default)]
struct Catalog<'m> {
    materials: Vec<&'m Arc<MeshMaterial>>,
    number_of_material: HashMap<*const MeshMaterial, usize>,
    textures: Vec<&'m MeshTexture>,
    number_of_texture: HashMap<(&'m str, &'m [u8]), usize>,
}

impl<'m> Catalog<'m> {
    fn of(mesh: &'m Mesh) -> Self {
        let mut catalog = Catalog::default();
        for material in mesh.submeshes.iter().filter_map(|part| part.material.as_ref()) {
            if catalog.number_of_material.contains_key(&Arc::as_ptr(material)) {
                continue;
            }
            catalog.materials.push(material);
            catalog.number_of_material.insert(Arc::as_ptr(material), catalog.materials.len());
            if let Some(texture) = &material.texture {
                let Catalog { textures, number_of_texture, .. } = &mut catalog;
                number_of_texture.entry(key(texture)).or_insert_with(|| {
                    textures.push(texture);
                    textures.len()
                });
            }
        }
        catalog
    }

    /// Number of a material, from 1; 0 for none.
    fn material(&self, part: &Submesh) -> usize {
        let number =
            part.material.as_ref().and_then(|m| self.number_of_material.get(&Arc::as_ptr(m)));
        number.copied().unwrap_or(0)
    }

    /// Number of a texture, from 1; 0 for none.
    fn texture(&self, material: &MeshMaterial) -> usize {
        let number = material.texture.as_ref().and_then(|t| self.number_of_texture.get(&key(t)));
        number.copied().unwrap_or(0)
    }
}

/// Identity of a texture: its file, or its bytes.
fn key(texture: &MeshTexture) -> (&str, &[u8]) {
    match texture {
        MeshTexture::File(name) => (name, &[]),
        MeshTexture::Embedded { bytes, .. } => ("", bytes),
    }
}

fn write_material(
    material: &MeshMaterial,
    catalog: &Catalog<'_>,
    out: &mut PackedBytes,
) -> Result<(), MeshError> {
    let (alpha_flags, cutoff) = match material.texture_alpha {
        TextureAlpha::Ignored => (0, 0.0),
        TextureAlpha::Cutout(cutoff) => (CUTOUT, cutoff),
        TextureAlpha::Blended => (BLENDED, 0.0),
    };
    material.diffuse_rgba.into_iter().try_for_each(|channel| out.f32(channel))?;
    material.emissive_rgb.into_iter().try_for_each(|channel| out.f32(channel))?;
    out.f32(cutoff)?;
    out.u32(alpha_flags | if material.is_double_sided { DOUBLE_SIDED } else { 0 })?;
    out.count(catalog.texture(material))
}

fn write_part(
    part: &Submesh,
    catalog: &Catalog<'_>,
    out: &mut PackedBytes,
) -> Result<(), MeshError> {
    let has_long_indices = part.positions_m.len() > 1 << 16;
    let flag = |is_set: bool, flag: u32| if is_set { flag } else { 0 };
    out.block(part.name.as_bytes())?;
    out.count(catalog.material(part))?;
    out.u32(
        flag(part.normals.is_some(), HAS_NORMALS)
            | flag(part.uvs.is_some(), HAS_UVS)
            | flag(has_long_indices, LONG_INDICES),
    )?;
    out.count(part.positions_m.len())?;
    out.count(part.triangles.len())?;
    for &x in part.positions_m.iter().flatten() {
        #[expect(clippy::cast_possible_truncation, reason = "checked")]
        let short = x as f32;
        if !short.is_finite() {
            return Err(MeshError::new(
                format!("the coordinate {x:e} m is too large to be drawn"),
                "move the mesh to its origin, or check its unit",
            ));
        }
        out.f32(short)?;
    }
    for &x in part.normals.iter().flatten().flatten() {
        // One part in 32767 is finer than any screen shows.
        #[expect(clippy::cast_possible_truncation, reason = "within -32767 to 32767")]
        let rounded = (x.clamp(-1.0, 1.0) * 32767.0).round() as i16;
        out.raw(&rounded.to_le_bytes())?;
    }
    out.align()?;
    part.uvs.iter().flatten().flatten().try_for_each(|&x| out.f32(x))?;
    for &index in part.triangles.iter().flatten() {
        let bytes = index.to_le_bytes();
        out.raw(if has_long_indices { &bytes } else { &bytes[..2] })?;
    }
    out.align()
}

fn without_query(uri: &str) -> &str {
    uri.split(['?', '#']).next().unwrap_or(uri)
}

/// URI of a file that a mesh names: relative to the mesh, unless it is a URI or an absolute path itself.
#[must_use]
pub fn sibling_uri(mesh_uri: &str, name: &str) -> String {
    if name.contains("://") {
        return name.to_owned();
    }
    // Exporters on Windows write backslashes, and paths of a machine that is not here: the file name remains.
    let mut name = name.replace('\\', "/");
    if name.as_bytes().get(1) == Some(&b':') {
        name = name.rsplit('/').next().unwrap_or_default().to_owned();
    }
    if name.starts_with('/') {
        return format!("file://{name}");
    }
    let mesh = without_query(mesh_uri);
    let folder = mesh.rfind('/').map_or("", |end| &mesh[..=end]);
    format!("{folder}{}", name.trim_start_matches("./"))
}
