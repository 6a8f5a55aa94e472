//! Wavefront MTL: diffuse and emissive colour, opacity and diffuse texture.

use std::collections::HashMap;
use std::sync::Arc;

use super::lines::lines;
use crate::mesh::{MeshMaterial, MeshTexture, TextureAlpha};
use crate::notes::Notes;

/// Reads all materials of a file into `materials`; a damaged line only loses its property, with a note.
pub(super) fn read(
    bytes: &[u8],
    file: &str,
    materials: &mut HashMap<String, Arc<MeshMaterial>>,
    notes: &mut Notes,
) {
    let mut current: Option<MeshMaterial> = None;
    for line in lines(bytes) {
        let keyword = line.keyword().to_ascii_lowercase();
        if keyword == "newmtl" {
            keep(current.take(), materials);
            let name = line.rest().to_owned();
            current = Some(MeshMaterial { name, ..MeshMaterial::default() });
            continue;
        }
        let Some(material) = &mut current else { continue };
        let number = || line.numbers::<1>(1).ok().map(|[x]| x as f32).filter(|x| x.is_finite());
        match keyword.as_str() {
            "kd" => match line.numbers::<3>(3) {
                Ok(rgb) if rgb.iter().all(|x| x.is_finite()) => {
                    for (to, from) in material.diffuse_rgba.iter_mut().zip(rgb) {
                        *to = (from as f32).clamp(0.0, 1.0);
                    }
                }
                _ => notes.add(format!("`{file}`: `Kd` that is not three numbers left out")),
            },
            "ke" => match line.numbers::<3>(3) {
                Ok(rgb) if rgb.iter().all(|x| x.is_finite()) => {
                    material.emissive_rgb = rgb.map(|x| (x as f32).clamp(0.0, 1.0));
                }
                _ => notes.add(format!("`{file}`: `Ke` that is not three numbers left out")),
            },
            "map_d" => material.texture_alpha = TextureAlpha::Blended,
            "d" => material.diffuse_rgba[3] = number().unwrap_or(1.0).clamp(0.0, 1.0),
            "tr" => material.diffuse_rgba[3] = 1.0 - number().unwrap_or(0.0).clamp(0.0, 1.0),
            "map_kd" => {
                material.texture =
                    texture_file(line.rest()).map(|file| MeshTexture::File(file.to_owned()));
            }
            _ => {}
        }
    }
    keep(current, materials);
}

/// The first definition of a name wins, as in tobj and assimp.
fn keep(material: Option<MeshMaterial>, materials: &mut HashMap<String, Arc<MeshMaterial>>) {
    if let Some(material) = material {
        materials.entry(material.name.clone()).or_insert_with(|| Arc::new(material));
    }
}

/// File name after options such as `-s 1 1 1` or `-clamp on`; it may contain spaces.
fn texture_file(mut text: &str) -> Option<&str> {
    while let Some(option) = text.strip_prefix('-') {
        let (name, mut rest) = option.split_once(char::is_whitespace)?;
        let arguments = match name {
            "o" | "s" | "t" => 3,
            "mm" => 2,
            _ => 1,
        };
        for i in 0..arguments {
            rest = rest.trim_start();
            let (word, after) = rest.split_once(char::is_whitespace)?;
            // `-o`, `-s` and `-t` may have fewer than three numbers.
            if i > 0 && word.parse::<f64>().is_err() {
                break;
            }
            rest = after;
        }
        text = rest.trim_start();
    }
    (!text.is_empty()).then_some(text)
}
