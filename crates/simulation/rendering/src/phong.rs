//! Surface materials.

use std::sync::Arc;

use periplus_images::Image;
use periplus_scene::{Colour, Material};

/// Gazebo's default grey.
const DEFAULT_GREY_RATIO: [f32; 3] = [0.7; 3];
/// Maximum shininess of Phong's model.
const MAX_SHININESS_FACTOR: f64 = 128.0;

/// Phong material, as in Gazebo Classic.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PhongMaterial {
    /// Reflectance of ambient light.
    pub(crate) ambient: [f32; 3],
    /// Diffuse reflectance.
    pub(crate) diffuse: [f32; 3],
    pub(crate) specular: [f32; 3],
    /// Emitted colour.
    pub(crate) emissive: [f32; 3],
    pub(crate) shininess: f32,
    /// 1 is opaque.
    pub(crate) opacity: f32,
    /// True if lighting applies.
    pub(crate) is_lit: bool,
    /// Texture that multiplies the colours.
    pub(crate) texture: Option<Arc<Image>>,
}

impl PhongMaterial {
    /// Returns true if the material has specular highlights.
    pub(crate) fn has_specular(&self) -> bool {
        self.shininess > 0.0 && self.specular != [0.0; 3]
    }
}

impl Default for PhongMaterial {
    fn default() -> Self {
        Self {
            ambient: DEFAULT_GREY_RATIO,
            diffuse: DEFAULT_GREY_RATIO,
            specular: [0.0; 3],
            emissive: [0.0; 3],
            shininess: 0.0,
            opacity: 1.0,
            is_lit: true,
            texture: None,
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "colours need no more than single precision")]
pub(crate) fn rgb(Colour([r, g, b, _]): Colour) -> [f32; 3] {
    [r, g, b].map(|x| if x.is_finite() { x.clamp(0.0, 1.0) as f32 } else { 0.0 })
}

impl PhongMaterial {
    /// Converts a material of a scene, without its texture. A missing ambient or diffuse colour
    /// defaults to the other.
    pub(crate) fn of_material(material: &Material, texture: Option<Arc<Image>>) -> Self {
        let diffuse = material.diffuse.or(material.ambient);
        let ambient = material.ambient.or(material.diffuse);
        // A texture keeps its own colours where the material has none.
        let plain = if texture.is_some() { [1.0; 3] } else { DEFAULT_GREY_RATIO };
        let shininess = material.shininess.unwrap_or(0.0).clamp(0.0, MAX_SHININESS_FACTOR);
        #[expect(clippy::cast_possible_truncation, reason = "within 0 and 128")]
        Self {
            ambient: ambient.map_or(plain, rgb),
            diffuse: diffuse.map_or(plain, rgb),
            specular: material.specular.map_or([0.0; 3], rgb),
            emissive: material.emissive.map_or([0.0; 3], rgb),
            shininess: shininess as f32,
            opacity: diffuse.map_or(1.0, |Colour([.., alpha])| unit(alpha)),
            is_lit: material.lighting.unwrap_or(true),
            texture,
        }
    }

    /// Converts a material of a mesh file.
    pub(crate) fn of_mesh(
        material: &periplus_meshes::MeshMaterial,
        texture: Option<Arc<Image>>,
    ) -> Self {
        let [r, g, b, alpha] = material.diffuse_rgba.map(|x| if x.is_finite() { x } else { 1.0 });
        let colour = [r, g, b].map(|x| x.clamp(0.0, 1.0));
        Self {
            ambient: colour,
            diffuse: colour,
            opacity: alpha.clamp(0.0, 1.0),
            texture,
            ..Self::default()
        }
    }

    /// Returns the material with its opacity scaled by `1 - transparency`.
    pub(crate) fn with_transparency(mut self, transparency: f64) -> Self {
        self.opacity *= 1.0 - unit(transparency);
        self
    }
}

#[expect(clippy::cast_possible_truncation, reason = "within 0 and 1")]
fn unit(x: f64) -> f32 {
    if x.is_finite() { x.clamp(0.0, 1.0) as f32 } else { 0.0 }
}
