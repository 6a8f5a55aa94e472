//! Uninterpreted attributes and elements.

use periplus_xml::{Attribute, Element};

/// Uninterpreted attributes and children of an element, kept verbatim.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extra {
    /// Attributes.
    pub attributes: Vec<Attribute>,
    /// Children.
    pub elements: Vec<Element>,
}

impl Extra {
    /// Returns true if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.attributes.is_empty() && self.elements.is_empty()
    }
}
