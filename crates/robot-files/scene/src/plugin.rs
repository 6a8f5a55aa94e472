//! Plugins, kept verbatim.

use periplus_diagnostics::Origin;
use periplus_xml::Element;
use serde::Serialize;

/// Plugin as written. The crate `plugin-specs` interprets its parameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plugin {
    /// Its name; in current Gazebo the class, in Gazebo Classic arbitrary.
    pub name: String,
    /// Library that Gazebo would load.
    pub filename: String,
    /// Its parameters.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub content: Vec<Element>,
    /// Source location of the whole element.
    #[serde(skip)]
    pub origin: Origin,
}

impl Plugin {
    /// Text of the first parameter of a name.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<std::borrow::Cow<'_, str>> {
        self.content.iter().find(|element| element.name == name).map(Element::text)
    }
}
