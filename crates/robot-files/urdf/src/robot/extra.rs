//! What nobody interprets.

use periplus_xml::{Attribute, Element};

/// Attributes and children of an element that nobody here interprets, word for word.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extra {
    /// Attributes.
    pub attributes: Vec<Attribute>,
    /// Children.
    pub elements: Vec<Element>,
}

impl Extra {
    /// Whether there is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.attributes.is_empty() && self.elements.is_empty()
    }
}
