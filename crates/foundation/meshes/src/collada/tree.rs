//! XML tree of a COLLADA file: flat, so that any nesting depth is possible, and without namespaces, which
//! COLLADA files do not need.

use std::borrow::Cow;
use std::collections::BTreeMap;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::error::{MeshError, MeshLocation};
use crate::limits::Budget;

/// Memory of an element and an attribute without their text [bytes]: much more than the four characters of
/// a small one in the file, so it is counted.
const ELEMENT_BYTES: usize = 128;
const ATTRIBUTE_BYTES: usize = 80;

struct Element<'x> {
    tag: String,
    attributes: Vec<(String, String)>,
    text: Cow<'x, str>,
    offset: usize,
    first_child: Option<u32>,
    last_child: Option<u32>,
    next_sibling: Option<u32>,
}

/// Parsed file.
pub(super) struct Tree<'x> {
    xml: &'x str,
    elements: Vec<Element<'x>>,
    by_id: BTreeMap<(String, String), u32>,
}

/// Element of a [`Tree`].
#[derive(Clone, Copy)]
pub(super) struct Node<'t> {
    tree: &'t Tree<'t>,
    index: u32,
}

impl<'x> Tree<'x> {
    pub(super) fn parse(xml: &'x str, budget: &mut Budget) -> Result<Tree<'x>, MeshError> {
        let mut tree = Tree { xml, elements: Vec::new(), by_id: BTreeMap::new() };
        let mut reader = Reader::from_str(xml);
        let mut open: Vec<u32> = Vec::new();
        loop {
            let offset = usize::try_from(reader.buffer_position()).unwrap_or(xml.len());
            match reader.read_event() {
                Ok(Event::Start(start)) => open.push(tree.push(&start, offset, &open, budget)?),
                Ok(Event::Empty(start)) => drop(tree.push(&start, offset, &open, budget)?),
                Ok(Event::End(_)) => drop(open.pop()),
                Ok(Event::Text(text)) => tree.append_text(&open, text.into_inner()),
                Ok(Event::CData(text)) => tree.append_text(&open, text.into_inner()),
                Ok(Event::GeneralRef(name)) => tree.append_text(&open, Cow::Owned(entity(&name))),
                Ok(Event::Eof) => break,
                Ok(Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::DocType(_)) => {}
                Err(error) => {
                    let at = usize::try_from(reader.error_position()).unwrap_or(offset);
                    return Err(tree.error_at(at, format!("not well-formed XML: {error}")));
                }
            }
        }
        if let Some(&index) = open.last() {
            let element = &tree.elements[index as usize];
            let message = format!("`<{}>` is never closed", element.tag);
            return Err(tree.error_at(element.offset, message));
        }
        Ok(tree)
    }

    fn push(
        &mut self,
        start: &BytesStart<'x>,
        offset: usize,
        open: &[u32],
        budget: &mut Budget,
    ) -> Result<u32, MeshError> {
        budget.bytes(ELEMENT_BYTES)?;
        let Ok(index) = u32::try_from(self.elements.len()) else {
            return Err(self.error_at(offset, "more than 4 billion elements".to_owned()));
        };
        let tag = start.local_name().as_ref().to_owned();
        let mut attributes = Vec::new();
        // Checks for duplicates would take quadratic time; the first one wins instead.
        for attribute in start.attributes().with_checks(false) {
            let attribute = attribute
                .map_err(|error| self.error_at(offset, format!("bad attribute: {error}")))?;
            let value = attribute
                .normalized_value(quick_xml::XmlVersion::Implicit1_0)
                .map_or_else(|_| attribute.value.clone().into_owned(), Cow::into_owned);
            let name = attribute.key.local_name().as_ref().to_owned();
            budget.bytes(ATTRIBUTE_BYTES)?;
            if name == "id" {
                self.by_id.entry((tag.clone(), value.clone())).or_insert(index);
            }
            attributes.push((name, value));
        }
        if let Some(&parent) = open.last() {
            let previous = self.elements[parent as usize].last_child.replace(index);
            match previous {
                Some(sibling) => self.elements[sibling as usize].next_sibling = Some(index),
                None => self.elements[parent as usize].first_child = Some(index),
            }
        }
        self.elements.push(Element {
            tag,
            attributes,
            text: Cow::Borrowed(""),
            offset,
            first_child: None,
            last_child: None,
            next_sibling: None,
        });
        Ok(index)
    }

    fn append_text(&mut self, open: &[u32], more: Cow<'x, str>) {
        let Some(&index) = open.last() else { return };
        let text = &mut self.elements[index as usize].text;
        if text.trim().is_empty() {
            *text = more;
        } else {
            text.to_mut().push_str(&more);
        }
    }

    fn error_at(&self, offset: usize, message: String) -> MeshError {
        let before = &self.xml.as_bytes()[..offset.min(self.xml.len())];
        let line = before.iter().filter(|&&b| b == b'\n').count() + 1;
        MeshError::new(message, "export the COLLADA file again, or repair it by hand")
            .at(MeshLocation::Line(line))
    }

    /// `<COLLADA>` element.
    pub(super) fn root(&self) -> Result<Node<'_>, MeshError> {
        match self.elements.first() {
            Some(element) if element.tag == "COLLADA" => Ok(Node { tree: self, index: 0 }),
            Some(element) => Err(self.error_at(
                element.offset,
                format!("the root element is `<{}>`, not `<COLLADA>`", element.tag),
            )),
            None => Err(self.error_at(0, "the file has no XML element".to_owned())),
        }
    }

    /// First element of this tag with the id in a local URL (`#id`).
    pub(super) fn find(&self, tag: &str, url: &str) -> Option<Node<'_>> {
        let id = url.strip_prefix('#').unwrap_or(url);
        let index = *self.by_id.get(&(tag.to_owned(), id.to_owned()))?;
        Some(Node { tree: self, index })
    }
}

/// Numbers and references need only the predefined entities; an unknown one is kept as written and fails
/// where it is used.
fn entity(name: &quick_xml::events::BytesRef<'_>) -> String {
    let resolved = match name.resolve_char_ref() {
        Ok(Some(c)) => Some(c.to_string()),
        _ => quick_xml::escape::resolve_predefined_entity(&name.xml10_content()).map(str::to_owned),
    };
    resolved.unwrap_or_else(|| format!("&{};", name.xml10_content()))
}

impl<'t> Node<'t> {
    fn element(self) -> &'t Element<'t> {
        &self.tree.elements[self.index as usize]
    }

    /// Unique id of the element.
    pub(super) fn id(self) -> u32 {
        self.index
    }

    pub(super) fn tree(self) -> &'t Tree<'t> {
        self.tree
    }

    pub(super) fn tag(self) -> &'t str {
        &self.element().tag
    }

    pub(super) fn attribute(self, name: &str) -> Option<&'t str> {
        let found = self.element().attributes.iter().find(|(key, _)| key == name);
        found.map(|(_, value)| value.as_str())
    }

    pub(super) fn text(self) -> &'t str {
        self.element().text.trim()
    }

    pub(super) fn children(self) -> impl Iterator<Item = Node<'t>> {
        let node = move |index: u32| Node { tree: self.tree, index };
        std::iter::successors(self.element().first_child.map(node), move |child| {
            child.element().next_sibling.map(node)
        })
    }

    pub(super) fn children_named(self, tag: &str) -> impl Iterator<Item = Node<'t>> {
        self.children().filter(move |child| child.tag() == tag)
    }

    pub(super) fn child(self, tag: &str) -> Option<Node<'t>> {
        self.children_named(tag).next()
    }

    /// Element at the end of a path of child tags.
    pub(super) fn descend(self, path: &[&str]) -> Option<Node<'t>> {
        path.iter().try_fold(self, |node, tag| node.child(tag))
    }

    /// Error about this element.
    pub(super) fn error(self, message: impl Into<String>) -> MeshError {
        let message = format!("`<{}>`: {}", self.tag(), message.into());
        self.tree.error_at(self.element().offset, message)
    }

    /// Attribute with a count, or its default if absent.
    pub(super) fn count(self, name: &str, default: usize) -> Result<usize, MeshError> {
        self.attribute(name).map_or(Ok(default), |text| {
            text.trim()
                .parse()
                .map_err(|_| self.error(format!("`{name}=\"{}\"` is not a count", short(text))))
        })
    }

    /// All numbers in the text.
    pub(super) fn numbers(self) -> Result<Vec<f64>, MeshError> {
        let words = self.text().split_ascii_whitespace();
        words.map(|word| number(word).ok_or_else(|| self.not_a_number(word))).collect()
    }

    /// All indices in the text.
    pub(super) fn indices(self) -> Result<Vec<u32>, MeshError> {
        let words = self.text().split_ascii_whitespace();
        words.map(|word| word.parse().map_err(|_| self.not_a_number(word))).collect()
    }

    fn not_a_number(self, word: &str) -> MeshError {
        self.error(format!("`{}` is not a valid number here", short(word)))
    }
}

fn number(word: &str) -> Option<f64> {
    // Old Microsoft runtimes print infinities and not-a-number as 1.#INF, -1.#IND.
    word.parse()
        .ok()
        .or_else(|| word.contains("#IN").then_some(f64::NAN))
        .or_else(|| word.contains("#QNAN").then_some(f64::NAN))
}

/// Start of a piece of the file, for a message.
pub(super) fn short(text: &str) -> String {
    text.chars().take(40).collect()
}
