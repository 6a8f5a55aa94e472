//! Plugins, word for word.

use periplus_diagnostics::Origin;
use periplus_xml::Element;

/// A plugin as the file gives it. What its parameters mean is known to the crate `plugins`.
#[derive(Clone, Debug, PartialEq)]
pub struct Plugin {
    /// Its name; in Harmonic the class, in Classic free.
    pub name: String,
    /// The library that Gazebo would load.
    pub filename: String,
    /// Its parameters.
    pub content: Vec<Element>,
    /// The whole element, for places in messages.
    pub origin: Origin,
}

impl Plugin {
    /// The text of the first parameter of a name.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<std::borrow::Cow<'_, str>> {
        self.content.iter().find(|element| element.name == name).map(Element::text)
    }
}
