//! Output of an expansion.

use periplus_diagnostics::Origin;
use periplus_xml::{Attribute, Element, SmolStr, XmlNode};

/// Element that receives expanded nodes. `xacro:attribute` and inherited namespaces add to its attributes.
pub(crate) struct Output<'e> {
    pub(crate) parent: &'e mut Element,
    /// Number of children whose comments no following directive removes.
    settled: usize,
}

impl<'e> Output<'e> {
    pub(crate) fn new(parent: &'e mut Element) -> Self {
        Self { parent, settled: 0 }
    }

    pub(crate) fn push(&mut self, node: XmlNode) {
        self.parent.children.push(node);
    }

    #[inline(never)]
    pub(crate) fn set_attribute(&mut self, name: &str, value: &str, origin: Origin) {
        let value = SmolStr::new(value);
        match self.parent.attributes.iter_mut().find(|attribute| attribute.name == name) {
            Some(attribute) => attribute.value = value,
            None => self.parent.attributes.push(Attribute {
                name: name.into(),
                value,
                origin,
                value_origin: origin,
            }),
        }
    }

    /// Keeps the comments written so far.
    pub(crate) fn settle(&mut self) {
        self.settled = self.parent.children.len();
    }

    /// Removes the comments directly before a directive: they describe the directive.
    #[inline(never)]
    pub(crate) fn drop_comments(&mut self) {
        let children = &mut self.parent.children;
        let blank = |node: &XmlNode| {
            matches!(node, XmlNode::Text(text)
                if text.text.trim().is_empty() && text.text.matches('\n').count() <= 1)
        };
        let mut before = children.len();
        loop {
            if before > self.settled && blank(&children[before - 1]) {
                before -= 1;
            }
            if before <= self.settled || !matches!(children[before - 1], XmlNode::Comment(_)) {
                return;
            }
            before -= 1;
            children.remove(before);
        }
    }
}
