//! Materials: base and emissive colour, texture, sides.

use std::sync::Arc;

use ::gltf::json::image::MimeType;
use ::gltf::json::mesh::Primitive;
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, Root, image, material};

use super::buffers::{Buffers, data_uri, percent_decode};
use crate::error::MeshError;
use crate::limits::Budget;
use crate::mesh::{MeshMaterial, MeshTexture, TextureAlpha};
use crate::notes::Notes;

/// Texture coordinate set of the primitive's base colour texture.
pub(super) fn uv_set(root: &Root, primitive: &Primitive) -> u32 {
    let material = primitive.material.and_then(|index| root.materials.get(index.value()));
    let texture = material.and_then(|m| m.pbr_metallic_roughness.base_color_texture.as_ref());
    texture.map_or(0, |texture| texture.tex_coord)
}

/// Reads a material; an unreadable image only loses the texture, with a note.
pub(super) fn read(
    root: &Root,
    index: Index<material::Material>,
    buffers: &mut Buffers<'_>,
    budget: &mut Budget,
    notes: &mut Notes,
) -> Result<Option<Arc<MeshMaterial>>, MeshError> {
    let Some(json) = root.materials.get(index.value()) else {
        notes.add(format!("material {} does not exist", index.value()));
        return Ok(None);
    };
    let pbr = &json.pbr_metallic_roughness;
    let mut diffuse_rgba =
        pbr.base_color_factor.0.map(|x| if x.is_finite() { x.clamp(0.0, 1.0) } else { 1.0 });
    let emissive_rgb =
        json.emissive_factor.0.map(|x| if x.is_finite() { x.clamp(0.0, 1.0) } else { 0.0 });
    let texture_alpha = match json.alpha_mode {
        Checked::Valid(material::AlphaMode::Blend) => TextureAlpha::Blended,
        Checked::Valid(material::AlphaMode::Mask) => {
            let cutoff = json.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0);
            TextureAlpha::Cutout(if cutoff.is_finite() { cutoff.clamp(0.0, 1.0) } else { 0.5 })
        }
        _ => TextureAlpha::Ignored,
    };
    if texture_alpha == TextureAlpha::Ignored {
        // Section 3.9.4: the alpha of an opaque material has no effect.
        diffuse_rgba[3] = 1.0;
    }
    let image = pbr.base_color_texture.as_ref().and_then(|info| {
        let texture = root.textures.get(info.index.value())?;
        root.images.get(texture.source.value())
    });
    if pbr.base_color_texture.is_some() && image.is_none() {
        notes.add("base colour texture without a plain image left out");
    }
    let texture = image.and_then(|image| read_image(image, buffers, budget, notes));
    let name = json.name.clone().unwrap_or_default();
    let is_double_sided = json.double_sided;
    let material =
        MeshMaterial { name, diffuse_rgba, emissive_rgb, texture, texture_alpha, is_double_sided };
    budget.bytes(material.size_bytes())?;
    Ok(Some(Arc::new(material)))
}

fn read_image(
    image: &image::Image,
    buffers: &mut Buffers<'_>,
    budget: &mut Budget,
    notes: &mut Notes,
) -> Option<MeshTexture> {
    let media_type = image.mime_type.as_ref().map_or(String::new(), |MimeType(mime)| mime.clone());
    let embedded = match (&image.uri, image.buffer_view) {
        (Some(uri), _) if uri.starts_with("data:") => data_uri(uri).map(|data| {
            MeshTexture::Embedded { media_type: data.media_type, bytes: data.bytes.into() }
        }),
        (Some(uri), _) => Ok(MeshTexture::File(percent_decode(uri))),
        (None, Some(view)) => buffers
            .view(view, budget)
            .map(|view| MeshTexture::Embedded { media_type, bytes: view.bytes().into() }),
        (None, None) => return None,
    };
    embedded.map_err(|error| notes.add(format!("texture left out: {error}"))).ok()
}
