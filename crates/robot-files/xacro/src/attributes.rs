//! The attributes of xacro's own elements.

use std::rc::Rc;

use periplus_diagnostics::{Diagnostic, Origin};
use periplus_xml::{Element, XmlNode};

use crate::frame::Frame;
use crate::state::{Failed, State};

impl State<'_> {
    /// The value of an attribute as characters.
    #[inline(never)]
    pub(crate) fn attribute(
        &self,
        element: &Element,
        name: &str,
        frame: Frame,
    ) -> Result<Option<Rc<str>>, Failed> {
        let Some(attribute) = element.attribute(name) else { return Ok(None) };
        self.text(&attribute.value, frame.seen(attribute.value_origin), frame.scope).map(Some)
    }

    /// Warns about content in an element whose content is ignored.
    #[inline(never)]
    pub(crate) fn check_childless(&self, element: &Element, frame: Frame) {
        let unread = element.children.iter().find_map(|node| match node {
            XmlNode::Element(child) => Some(child.origin),
            XmlNode::Text(text) if !text.text.trim().is_empty() => Some(text.origin),
            _ => None,
        });
        if let Some(origin) = unread {
            self.report(
                Diagnostic::warning(
                    "unread-content",
                    format!("the content of `{}` is not read", element.name),
                )
                .at(frame.seen(origin))
                .related(frame.seen(element.origin), "the element")
                .help("remove it, or move it outside"),
            );
        }
    }

    #[inline(never)]
    pub(crate) fn require(
        &self,
        element: &Element,
        name: &str,
        frame: Frame,
    ) -> Result<(), Failed> {
        if element.attribute(name).is_some() {
            return Ok(());
        }
        Err(self.fail(
            Diagnostic::error(
                "missing-attribute",
                format!("`{}` needs the attribute `{name}`", element.name),
            )
            .at(frame.seen(element.origin))
            .help(format!("add {name}=\"...\"")),
        ))
    }

    /// Reports missing attributes (an error, and the expansion of the element fails) and unknown ones (a
    /// warning).
    #[inline(never)]
    pub(crate) fn check_attributes(
        &self,
        element: &Element,
        required: &[&str],
        known: &[&str],
        frame: Frame,
    ) -> Result<(), Failed> {
        for name in required {
            self.require(element, name, frame)?;
        }
        for attribute in &element.attributes {
            let name = attribute.name.as_str();
            if known.contains(&name) || name.starts_with("xmlns:") {
                continue;
            }
            let origin = frame.seen(attribute.origin);
            let origin = Origin(origin.0.map(|span| span.part(0, name.len())));
            self.report(
                Diagnostic::warning(
                    "unknown-attribute",
                    format!("`{}` has no attribute `{name}`", element.name),
                )
                .at(origin)
                .label("not read")
                .did_you_mean(origin, name, known.iter().copied()),
            );
        }
        Ok(())
    }
}

/// Source location of the value of an attribute.
pub(crate) fn value_origin(element: &Element, name: &str, frame: Frame) -> Origin {
    let origin = element.attribute(name).map(|attribute| attribute.value_origin);
    frame.seen(origin.unwrap_or(element.origin))
}
