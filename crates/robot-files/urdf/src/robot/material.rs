//! Materials.

use periplus_diagnostics::Origin;

use super::Extra;

/// A material: a definition, or only the name of one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UrdfMaterial {
    /// Its name; may be empty in a visual.
    pub name: String,
    /// Its colour.
    pub colour: Option<ColourAsWritten>,
    /// Its texture.
    pub texture: Option<UrdfTexture>,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// `<color rgba="...">`.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourAsWritten {
    /// Red, green, blue, alpha; 0..1 is expected.
    pub rgba: [f64; 4],
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
}

/// `<texture filename="...">`.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfTexture {
    /// The URI as written.
    pub filename: String,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
}

impl UrdfMaterial {
    /// Returns true if it defines a colour or texture, not only a name.
    #[must_use]
    pub fn is_definition(&self) -> bool {
        self.colour.is_some() || self.texture.is_some()
    }
}
