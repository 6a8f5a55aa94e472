//! What things look like.

use std::sync::Arc;

use periplus_images::Image;
use periplus_scene::{Colour, Material};

/// Gazebo's own grey for what has no material.
const PLAIN: [f32; 3] = [0.7; 3];
/// The highlights of Phong's model end beyond this.
const SHARPEST: f64 = 128.0;

/// How a surface takes light: Phong's model, as in Gazebo Classic.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Look {
    /// Under ambient light.
    pub(crate) ambient: [f32; 3],
    /// Under direct light.
    pub(crate) diffuse: [f32; 3],
    pub(crate) specular: [f32; 3],
    /// Without any.
    pub(crate) emissive: [f32; 3],
    pub(crate) shininess: f32,
    /// 1 hides what is behind.
    pub(crate) opacity: f32,
    /// Whether light matters.
    pub(crate) is_lit: bool,
    /// A picture to multiply colours with.
    pub(crate) texture: Option<Arc<Image>>,
}

impl Look {
    /// Whether it has highlights.
    pub(crate) fn gleams(&self) -> bool {
        self.shininess > 0.0 && self.specular != [0.0; 3]
    }
}

impl Default for Look {
    fn default() -> Self {
        Self {
            ambient: PLAIN,
            diffuse: PLAIN,
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

impl Look {
    /// Of a material in a scene, without its texture. What it leaves out of ambient or diffuse is
    /// taken from the other, as people expect who write one only.
    pub(crate) fn of_material(material: &Material, texture: Option<Arc<Image>>) -> Self {
        let diffuse = material.diffuse.or(material.ambient);
        let ambient = material.ambient.or(material.diffuse);
        // A texture shows its own colours where the material says none.
        let plain = if texture.is_some() { [1.0; 3] } else { PLAIN };
        let shininess = material.shininess.unwrap_or(0.0).clamp(0.0, SHARPEST);
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

    /// Of a material in a mesh file.
    pub(crate) fn of_mesh(
        material: &periplus_meshes::Material,
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

    /// The same, seen through more.
    pub(crate) fn fainter(mut self, transparency: f64) -> Self {
        self.opacity *= 1.0 - unit(transparency);
        self
    }
}

#[expect(clippy::cast_possible_truncation, reason = "within 0 and 1")]
fn unit(x: f64) -> f32 {
    if x.is_finite() { x.clamp(0.0, 1.0) as f32 } else { 0.0 }
}
