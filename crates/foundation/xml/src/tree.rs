//! The tree: elements, attributes, text, comments.

use std::borrow::Cow;

use periplus_diagnostics::{ContextId, Origin, Span};
use smol_str::SmolStr;

/// A whole file: what stands before the root, the root, what stands after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Comments and processing instructions before the root.
    pub before: Vec<Node>,
    /// The root element.
    pub root: Element,
    /// Comments and processing instructions after the root.
    pub after: Vec<Node>,
}

/// A part of an element's content.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// A child element.
    Element(Element),
    /// Characters, entities resolved; CDATA too.
    Text(Text),
    /// A comment without its `<!--` and `-->`.
    Comment(Text),
    /// A processing instruction without its `<?` and `?>`.
    Instruction(Text),
}

/// Characters and where they stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The characters.
    pub text: SmolStr,
    /// Where they stand.
    pub origin: Origin,
}

/// `name="value"`.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// The name as written, with its prefix.
    pub name: SmolStr,
    /// The value, entities resolved, line breaks and tabs made spaces.
    pub value: SmolStr,
    /// Where name and value stand.
    pub origin: Origin,
    /// Where the value stands, without its quotes.
    pub value_origin: Origin,
}

/// `<name attribute="value">children</name>`. Elements that differ only in origin are equal.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// The name as written, with its prefix.
    pub name: SmolStr,
    /// The attributes, in order of writing.
    pub attributes: Vec<Attribute>,
    /// The content, in order.
    pub children: Vec<Node>,
    /// Where the start tag stands, from `<` to `>`.
    pub origin: Origin,
}

impl Element {
    /// An empty element that no file holds.
    #[must_use]
    pub fn new(name: impl Into<SmolStr>) -> Self {
        Self {
            name: name.into(),
            attributes: Vec::new(),
            children: Vec::new(),
            origin: Origin::default(),
        }
    }

    /// Adds an attribute.
    #[must_use]
    pub fn with_attribute(mut self, name: &str, value: impl Into<SmolStr>) -> Self {
        self.attributes.push(Attribute {
            name: name.into(),
            value: value.into(),
            origin: Origin::default(),
            value_origin: Origin::default(),
        });
        self
    }

    /// Adds a child element.
    #[must_use]
    pub fn with_child(mut self, child: Self) -> Self {
        self.children.push(Node::Element(child));
        self
    }

    /// Adds text.
    #[must_use]
    pub fn with_text(mut self, text: impl Into<SmolStr>) -> Self {
        self.push_text(text);
        self
    }

    /// Adds a child element.
    pub fn push(&mut self, child: Self) {
        self.children.push(Node::Element(child));
    }

    /// Adds text.
    pub fn push_text(&mut self, text: impl Into<SmolStr>) {
        self.children.push(Node::Text(Text { text: text.into(), origin: Origin::default() }));
    }

    /// The name without its prefix.
    #[must_use]
    pub fn local_name(&self) -> &str {
        self.name.rsplit_once(':').map_or(&*self.name, |(_, local)| local)
    }

    /// The prefix of the name.
    #[must_use]
    pub fn prefix(&self) -> Option<&str> {
        self.name.rsplit_once(':').map(|(prefix, _)| prefix)
    }

    /// An attribute by name.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|attribute| attribute.name == name)
    }

    /// The value of an attribute.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|attribute| &*attribute.value)
    }

    /// The child elements.
    pub fn elements(&self) -> impl Iterator<Item = &Self> {
        self.children.iter().filter_map(Node::as_element)
    }

    /// The child elements of one name.
    pub fn named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> {
        self.elements().filter(move |element| element.name == name)
    }

    /// The first child element of one name.
    #[must_use]
    pub fn child<'a>(&'a self, name: &'a str) -> Option<&'a Self> {
        self.named(name).next()
    }

    /// All characters directly in this element, white space around them removed.
    #[must_use]
    pub fn text(&self) -> Cow<'_, str> {
        let mut parts = self.children.iter().filter_map(|node| match node {
            Node::Text(text) => Some(&text.text),
            _ => None,
        });
        match (parts.next(), parts.next()) {
            (None, _) => Cow::Borrowed(""),
            (Some(only), None) => Cow::Borrowed(only.trim()),
            (Some(first), Some(second)) => {
                let mut whole = format!("{first}{second}");
                whole.extend(parts.map(SmolStr::as_str));
                Cow::Owned(whole.trim().to_owned())
            }
        }
    }

    /// Where the characters of [`Self::text`] stand: the first run of text that is not white
    /// space, trimmed; or else the start tag.
    #[must_use]
    pub fn text_origin(&self) -> Origin {
        let run = self.children.iter().find_map(|node| match node {
            Node::Text(text) if !text.text.trim().is_empty() => Some(text),
            _ => None,
        });
        let Some(run) = run else { return self.origin };
        let Some(span) = run.origin.0 else { return self.origin };
        let leading = run.text.len() - run.text.trim_start().len();
        let length = run.text.trim().len();
        // With entities or CDATA in it the text is shorter than its source; then point to it all.
        let plain = run.text.len() == (span.end - span.start) as usize;
        Origin(Some(if plain { span.part(leading, leading + length) } else { span }))
    }

    /// Makes every place in this element be seen through a macro call or an include.
    pub fn see_through(&mut self, context: ContextId) {
        let seen = |origin: &mut Origin| {
            if let Some(span) = &mut origin.0 {
                span.context = context;
            }
        };
        seen(&mut self.origin);
        for attribute in &mut self.attributes {
            seen(&mut attribute.origin);
            seen(&mut attribute.value_origin);
        }
        for child in &mut self.children {
            match child {
                Node::Element(element) => element.see_through(context),
                Node::Text(text) | Node::Comment(text) | Node::Instruction(text) => {
                    seen(&mut text.origin);
                }
            }
        }
    }

    /// Where the name in the start tag stands.
    #[must_use]
    pub fn name_origin(&self) -> Origin {
        Origin(self.origin.0.map(|span: Span| span.part(1, 1 + self.name.len())))
    }
}

impl Node {
    /// The element, if it is one.
    #[must_use]
    pub fn as_element(&self) -> Option<&Element> {
        match self {
            Self::Element(element) => Some(element),
            _ => None,
        }
    }
}
