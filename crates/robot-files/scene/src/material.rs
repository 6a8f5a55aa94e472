//! Materials.

mod builtin;

use periplus_xml::Element;
use serde::Serialize;

pub use builtin::{builtin_material, builtin_material_names};

/// Red, green, blue, alpha in 0..1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Colour(pub [f64; 4]);

impl Colour {
    /// Black and opaque.
    pub const BLACK: Self = Self([0.0, 0.0, 0.0, 1.0]);
    /// White and opaque.
    pub const WHITE: Self = Self([1.0; 4]);
}

/// Material. Missing values are `None`, because their defaults depend on the other values.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Material {
    /// The name of a URDF material.
    pub name: Option<String>,
    /// Colour under ambient light.
    pub ambient: Option<Colour>,
    /// Colour under direct light.
    pub diffuse: Option<Colour>,
    /// Colour of highlights.
    pub specular: Option<Colour>,
    /// Emitted colour.
    pub emissive: Option<Colour>,
    /// Sharpness of highlights.
    pub shininess: Option<f64>,
    /// An OGRE material by name; the built-in ones of Classic are known.
    pub script: Option<MaterialScript>,
    /// Physically based textures and values.
    pub pbr: Option<Pbr>,
    /// True if the material is lit.
    pub lighting: Option<bool>,
    /// True if both sides are rendered.
    pub double_sided: bool,
    /// Shaders and other elements.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
}

/// An OGRE material script.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MaterialScript {
    /// Files and folders to search.
    pub uris: Vec<String>,
    /// The material's name: `Gazebo/Grey`.
    pub name: String,
}

/// Physically based material.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Pbr {
    /// 0 mirror-like to 1 matt.
    pub roughness: Option<f64>,
    /// 0 to 1.
    pub metalness: Option<f64>,
    /// Texture of the colour.
    pub albedo_map: Option<String>,
    /// The whole element, for values that are not listed here.
    #[serde(serialize_with = "crate::json::optional_element")]
    pub element: Option<Element>,
}
