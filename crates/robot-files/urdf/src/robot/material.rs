//! Looks.

use periplus_diagnostics::Origin;

use super::Extra;

/// A material: a definition, or only the name of one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Its name; may be empty in a visual.
    pub name: String,
    /// Its colour.
    pub colour: Option<ColourAsWritten>,
    /// Its texture.
    pub texture: Option<Texture>,
    /// What nobody here interprets.
    pub extra: Extra,
    /// Where it was read.
    pub origin: Origin,
}

/// `<color rgba="...">`.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourAsWritten {
    /// Red, green, blue, alpha; 0..1 is expected.
    pub rgba: [f64; 4],
    /// What nobody here interprets.
    pub extra: Extra,
}

/// `<texture filename="...">`.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The URI as written.
    pub filename: String,
    /// What nobody here interprets.
    pub extra: Extra,
}

impl Material {
    /// Whether it says what the material looks like, and not only what it is called.
    #[must_use]
    pub fn is_definition(&self) -> bool {
        self.colour.is_some() || self.texture.is_some()
    }
}
