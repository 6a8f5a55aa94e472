//! Plugins, word for word.

use periplus_diagnostics::Origin;
use periplus_xml::Element;
use serde::Serialize;

/// A plugin as the file gives it. What its parameters mean is known to the crate `plugin-specs`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plugin {
    /// Its name; in Harmonic the class, in Classic free.
    pub name: String,
    /// The library that Gazebo would load.
    pub filename: String,
    /// Its parameters.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub content: Vec<Element>,
    /// The whole element, for places in messages.
    #[serde(skip)]
    pub origin: Origin,
}

impl Plugin {
    /// The text of the first parameter of a name.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<std::borrow::Cow<'_, str>> {
        self.content.iter().find(|element| element.name == name).map(Element::text)
    }
}
