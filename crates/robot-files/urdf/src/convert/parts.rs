//! Children of an element under construction, found by name without a search.

use std::collections::BTreeMap;

use periplus_xml::Element;

/// Children in order, of which most stand once.
#[derive(Default)]
pub(super) struct Parts {
    /// None where a child was replaced by a later one.
    parts: Vec<Option<Element>>,
    places: BTreeMap<String, usize>,
}

impl Parts {
    /// Adds a child that may stand several times.
    pub(super) fn push(&mut self, part: Element) {
        self.parts.push(Some(part));
    }

    /// Puts a child at the end, in the place of the one of its name, which it gives back.
    pub(super) fn set(&mut self, part: Element) -> Option<Element> {
        let place = self.places.insert(part.name.to_string(), self.parts.len());
        self.parts.push(Some(part));
        place.and_then(|place| self.parts[place].take())
    }

    /// The child of a name that stands once, for a change.
    pub(super) fn get_mut(&mut self, name: &str) -> Option<&mut Element> {
        self.places.get(name).and_then(|&place| self.parts[place].as_mut())
    }

    /// All children.
    pub(super) fn into_elements(self) -> impl Iterator<Item = Element> {
        self.parts.into_iter().flatten()
    }
}
