//! XML tree: elements, attributes, text, comments.

use std::borrow::Cow;

use periplus_diagnostics::{ContextId, Origin, Span};
use smol_str::SmolStr;

/// Document: content before the root, the root, content after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Comments and processing instructions before the root.
    pub before: Vec<XmlNode>,
    /// The root element.
    pub root: Element,
    /// Comments and processing instructions after the root.
    pub after: Vec<XmlNode>,
}

/// Part of an element's content.
#[derive(Clone, Debug, PartialEq)]
pub enum XmlNode {
    /// A child element.
    Element(Element),
    /// Characters, entities resolved; CDATA too.
    Text(Text),
    /// A comment without its `<!--` and `-->`.
    Comment(Text),
    /// A processing instruction without its `<?` and `?>`.
    Instruction(Text),
}

/// Characters with their source location.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The characters.
    pub text: SmolStr,
    /// Source location.
    pub origin: Origin,
}

/// `name="value"`.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// The name as written, with its prefix.
    pub name: SmolStr,
    /// Value with entities resolved, line breaks and tabs replaced by spaces.
    pub value: SmolStr,
    /// Source location of name and value.
    pub origin: Origin,
    /// Source location of the value, without its quotes.
    pub value_origin: Origin,
}

/// `<name attribute="value">children</name>`. Elements that differ only in origin are equal.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// The name as written, with its prefix.
    pub name: SmolStr,
    /// Attributes, in file order.
    pub attributes: Vec<Attribute>,
    /// The content, in order.
    pub children: Vec<XmlNode>,
    /// Source location of the start tag, from `<` to `>`.
    pub origin: Origin,
}

impl Element {
    /// Returns an empty element without a source location.
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
        self.children.push(XmlNode::Element(child));
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
        self.children.push(XmlNode::Element(child));
    }

    /// Adds text.
    pub fn push_text(&mut self, text: impl Into<SmolStr>) {
        self.children.push(XmlNode::Text(Text { text: text.into(), origin: Origin::default() }));
    }

    /// Name without its prefix.
    #[must_use]
    pub fn local_name(&self) -> &str {
        self.name.rsplit_once(':').map_or(&*self.name, |(_, local)| local)
    }

    /// Prefix of the name.
    #[must_use]
    pub fn prefix(&self) -> Option<&str> {
        self.name.rsplit_once(':').map(|(prefix, _)| prefix)
    }

    /// Attribute by name.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|attribute| attribute.name == name)
    }

    /// Value of an attribute.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|attribute| &*attribute.value)
    }

    /// Child elements.
    pub fn elements(&self) -> impl Iterator<Item = &Self> {
        self.children.iter().filter_map(XmlNode::as_element)
    }

    /// Child elements of one name.
    pub fn named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> {
        self.elements().filter(move |element| element.name == name)
    }

    /// First child element of one name.
    #[must_use]
    pub fn child<'a>(&'a self, name: &'a str) -> Option<&'a Self> {
        self.named(name).next()
    }

    /// All characters directly in this element, without surrounding white space.
    #[must_use]
    pub fn text(&self) -> Cow<'_, str> {
        let mut parts = self.children.iter().filter_map(|node| match node {
            XmlNode::Text(text) => Some(&text.text),
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

    /// Source location of the characters of [`Self::text`]: the first run of text that is not white space,
    /// trimmed; or else the start tag.
    #[must_use]
    pub fn text_origin(&self) -> Origin {
        let run = self.children.iter().find_map(|node| match node {
            XmlNode::Text(text) if !text.text.trim().is_empty() => Some(text),
            _ => None,
        });
        let Some(run) = run else { return self.origin };
        let Some(span) = run.origin.0 else { return self.origin };
        let leading = run.text.len() - run.text.trim_start().len();
        let length = run.text.trim().len();
        // With entities or CDATA the text is shorter than its source; then the whole source is returned.
        let plain = run.text.len() == (span.end - span.start) as usize;
        Origin(Some(if plain { span.part(leading, leading + length) } else { span }))
    }

    /// Sets the context of all locations in this element to a macro call or an include.
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
                XmlNode::Element(element) => element.see_through(context),
                XmlNode::Text(text) | XmlNode::Comment(text) | XmlNode::Instruction(text) => {
                    seen(&mut text.origin);
                }
            }
        }
    }

    /// Source location of the name in the start tag.
    #[must_use]
    pub fn name_origin(&self) -> Origin {
        Origin(self.origin.0.map(|span: Span| span.part(1, 1 + self.name.len())))
    }
}

impl XmlNode {
    /// Returns the element, if it is one.
    #[must_use]
    pub fn as_element(&self) -> Option<&Element> {
        match self {
            Self::Element(element) => Some(element),
            _ => None,
        }
    }
}
