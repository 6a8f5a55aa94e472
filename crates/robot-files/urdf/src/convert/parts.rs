//! Children of an element under construction, found by name without a search.

use std::collections::BTreeMap;

use periplus_xml::Element;

/// Children in order, most of which occur at most once.
#[derive(Default)]
pub(super) struct Parts {
    /// `None` where a child was replaced by a later one.
    parts: Vec<Option<Element>>,
    places: BTreeMap<String, usize>,
}

impl Parts {
    /// Adds a child that may occur several times.
    pub(super) fn push(&mut self, part: Element) {
        self.parts.push(Some(part));
    }

    /// Appends a child, removes the existing one of the same name and returns it.
    pub(super) fn set(&mut self, part: Element) -> Option<Element> {
        let place = self.places.insert(part.name.to_string(), self.parts.len());
        self.parts.push(Some(part));
        place.and_then(|place| self.parts[place].take())
    }

    /// Mutable child of a name that occurs at most once.
    pub(super) fn get_mut(&mut self, name: &str) -> Option<&mut Element> {
        self.places.get(name).and_then(|&place| self.parts[place].as_mut())
    }

    /// All children.
    pub(super) fn into_elements(self) -> impl Iterator<Item = Element> {
        self.parts.into_iter().flatten()
    }
}
