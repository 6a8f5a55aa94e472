//! Numbers of an expanded document.

use std::collections::BTreeSet;

use periplus_diagnostics::{Origin, SourceMap, Span};
use periplus_xml::{Document, Element, XmlNode};

use super::sites::Site;

/// Position of a number: an element, its attribute or its text, and the index of the word.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::calibrate) struct Place {
    /// Number of the element, in the order of the document.
    pub(in crate::calibrate) element: usize,
    /// Attribute; none for the text.
    pub(in crate::calibrate) attribute: Option<String>,
    /// Index of the word.
    pub(in crate::calibrate) word: usize,
}

/// Elements of a document in its order, with the numbers of their parents.
pub(in crate::calibrate) struct Elements<'a> {
    pub(in crate::calibrate) all: Vec<(&'a Element, Option<usize>)>,
}

impl<'a> Elements<'a> {
    pub(in crate::calibrate) fn of(document: &'a Document) -> Self {
        let mut elements = Self { all: Vec::new() };
        elements.collect(&document.root, None);
        elements
    }

    fn collect(&mut self, element: &'a Element, parent: Option<usize>) {
        let number = self.all.len();
        self.all.push((element, parent));
        for child in element.elements() {
            self.collect(child, Some(number));
        }
    }

    /// Numbers of the elements with a name.
    pub(in crate::calibrate) fn named<'b>(
        &'b self,
        name: &'b str,
    ) -> impl Iterator<Item = usize> + use<'a, 'b> {
        (0..self.all.len()).filter(move |it| self.all[*it].0.local_name() == name)
    }

    /// Numbers of the elements inside one, with itself.
    pub(in crate::calibrate) fn inside(&self, number: usize) -> Vec<usize> {
        (number..self.all.len()).filter(|it| self.is_inside(*it, number)).collect()
    }

    pub(in crate::calibrate) fn is_inside(&self, number: usize, outer: usize) -> bool {
        let mut at = Some(number);
        while let Some(number) = at {
            if number == outer {
                return true;
            }
            at = self.all[number].1;
        }
        false
    }
}

/// Attributes and texts of a document.
pub(super) struct Leaves<'a> {
    elements: Elements<'a>,
}

impl<'a> Leaves<'a> {
    pub(super) fn of(document: &'a Document) -> Self {
        Self { elements: Elements::of(document) }
    }

    /// Text of the attribute or element, and its source.
    fn text(&self, place: &Place) -> Option<(String, Origin)> {
        let element = self.elements.all.get(place.element)?.0;
        match &place.attribute {
            Some(name) => element.attribute(name).map(|it| (it.value.to_string(), it.value_origin)),
            None => Some((element.text().into_owned(), element.text_origin())),
        }
    }

    pub(super) fn number(&self, place: &Place) -> Option<f64> {
        let (text, _) = self.text(place)?;
        text.split_whitespace().nth(place.word)?.parse().ok()
    }

    /// `FILE:LINE:COLUMN` of a number.
    pub(super) fn location(&self, place: &Place, sources: &SourceMap) -> String {
        let origin = self.text(place).and_then(|it| it.1.0);
        let of_element = self.elements.all.get(place.element).and_then(|it| it.0.origin.0);
        match origin.or(of_element) {
            Some(span) => location(span, sources),
            None => "?".to_owned(),
        }
    }

    /// Number in the text that is the number of the document, if it is not an expression.
    pub(super) fn literal(
        &self,
        place: &Place,
        sources: &SourceMap,
        sites: &[Site],
    ) -> Option<usize> {
        let (value, origin) = self.text(place)?;
        let span = origin.0?;
        if sources.text(span).trim() != value.trim() {
            return None;
        }
        let is_inside = |it: &&usize| {
            let site = &sites[**it];
            sources.file(site.file).name == sources.file(span.file).name
                && site.start >= span.start
                && site.end <= span.end
        };
        // Words that are no numbers have no site.
        let before = value.split_whitespace().take(place.word);
        let nth = before.filter(|it| it.parse::<f64>().is_ok()).count();
        let numbers: Vec<usize> = (0..sites.len()).collect();
        numbers.iter().filter(is_inside).nth(nth).copied()
    }

    /// Numbers that differ in another document of the same structure, with their change; none if the structure or
    /// other words differ.
    pub(super) fn changes(&self, other: &Self) -> Option<Vec<(Place, f64)>> {
        if self.elements.all.len() != other.elements.all.len() {
            return None;
        }
        let mut changes = Vec::new();
        let pairs = self.elements.all.iter().zip(&other.elements.all);
        for (number, ((before, _), (after, _))) in pairs.enumerate() {
            if before.name != after.name || before.attributes.len() != after.attributes.len() {
                return None;
            }
            for (a, b) in before.attributes.iter().zip(&after.attributes) {
                if a.name != b.name {
                    return None;
                }
                compare(number, Some(&a.name), &a.value, &b.value, &mut changes)?;
            }
            let is_text = |it: &XmlNode| matches!(it, XmlNode::Text(_));
            if before.children.iter().any(is_text) {
                compare(number, None, &before.text(), &after.text(), &mut changes)?;
            }
        }
        Some(changes)
    }

    /// True for a number in one of the elements.
    pub(super) fn is_inside(&self, place: &Place, outer: &BTreeSet<usize>) -> bool {
        outer.iter().any(|it| self.elements.is_inside(place.element, *it))
    }
}

/// Adds the numbers that differ; none if other words differ.
fn compare(
    element: usize,
    attribute: Option<&str>,
    before: &str,
    after: &str,
    changes: &mut Vec<(Place, f64)>,
) -> Option<()> {
    if before == after {
        return Some(());
    }
    let (a, b): (Vec<&str>, Vec<&str>) =
        (before.split_whitespace().collect(), after.split_whitespace().collect());
    if a.len() != b.len() {
        return None;
    }
    for (word, (a, b)) in a.into_iter().zip(b).enumerate().filter(|(_, (a, b))| a != b) {
        let change = b.parse::<f64>().ok()? - a.parse::<f64>().ok()?;
        changes.push((Place { element, attribute: attribute.map(str::to_owned), word }, change));
    }
    Some(())
}

/// `FILE:LINE:COLUMN` of a span.
pub(super) fn location(span: Span, sources: &SourceMap) -> String {
    let (name, position) = sources.locate(span);
    format!("{name}:{}:{}", position.line, position.column)
}
