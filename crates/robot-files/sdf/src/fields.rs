//! Access to the parts of an element. Tracks which of them were read: the rest is kept verbatim and, if its
//! name is unknown, reported.

use periplus_diagnostics::{Diagnostic, Diagnostics, MAX_FINDINGS, Origin, Severity};
use periplus_geometry::DVec3;
use periplus_scene::Colour;
use periplus_xml::{Attribute, Element, XmlNode};

use crate::value::{self, leaf};
use crate::verbatim::keep;

/// Element that is being read. Each access marks what it returns as read; [`Self::finish`] handles the
/// rest.
pub(crate) struct Fields<'a, 'd> {
    pub(crate) element: &'a Element,
    pub(crate) diagnostics: &'d mut Diagnostics,
    used: Vec<bool>,
    used_attributes: Vec<bool>,
    known: Vec<&'static str>,
    known_attributes: Vec<&'static str>,
    kept: Vec<Element>,
}

impl<'a, 'd> Fields<'a, 'd> {
    pub(crate) fn new(element: &'a Element, diagnostics: &'d mut Diagnostics) -> Self {
        Self {
            element,
            diagnostics,
            used: vec![false; element.children.len()],
            used_attributes: vec![false; element.attributes.len()],
            // Typical number of kinds of children.
            known: Vec::with_capacity(16),
            known_attributes: Vec::new(),
            kept: Vec::new(),
        }
    }

    /// All children of a name.
    pub(crate) fn children(&mut self, name: &'static str) -> Vec<&'a Element> {
        self.known.push(name);
        let mut found = Vec::new();
        for (node, used) in self.element.children.iter().zip(&mut self.used) {
            if let XmlNode::Element(child) = node
                && child.name == name
            {
                *used = true;
                found.push(child);
            }
        }
        found
    }

    /// Child of a name. Further ones are dropped with a warning, because SDF readers use the first.
    pub(crate) fn child(&mut self, name: &'static str) -> Option<&'a Element> {
        self.known.push(name);
        let mut first: Option<&'a Element> = None;
        for (node, used) in self.element.children.iter().zip(&mut self.used) {
            let XmlNode::Element(child) = node else { continue };
            if child.name != name {
                continue;
            }
            *used = true;
            match first {
                None => first = Some(child),
                Some(first) => self.diagnostics.push(
                    Diagnostic::warning(
                        "repeated-element",
                        format!("`<{name}>` may occur only once; this one is left out"),
                    )
                    .at(child.origin)
                    .related(first.origin, "the first one is used"),
                ),
            }
        }
        first
    }

    /// Child of a name, opened for reading; see [`Self::close`].
    pub(crate) fn open(&mut self, name: &'static str) -> Option<Fields<'a, '_>> {
        let child = self.child(name)?;
        Some(Fields::new(child, self.diagnostics))
    }

    /// Keeps the unread rest of a child opened by [`Self::open`], under the child's name.
    pub(crate) fn close(&mut self, name: &'static str, rest: Vec<Element>) {
        if !rest.is_empty() {
            let mut wrapper = Element::new(name);
            wrapper.children.extend(rest.into_iter().map(XmlNode::Element));
            self.kept.push(wrapper);
        }
    }

    pub(crate) fn attribute(&mut self, name: &'static str) -> Option<&'a Attribute> {
        self.known_attributes.push(name);
        let index = self.element.attributes.iter().position(|it| it.name == name)?;
        self.used_attributes[index] = true;
        Some(&self.element.attributes[index])
    }

    /// Attribute that must exist and not be empty; otherwise an error.
    pub(crate) fn required_attribute(&mut self, name: &'static str) -> Option<&'a Attribute> {
        match self.attribute(name) {
            Some(attribute) if !attribute.value.is_empty() => Some(attribute),
            found => {
                let element = &self.element.name;
                let (message, origin) = match found {
                    Some(empty) => {
                        (format!("the attribute `{name}` of `<{element}>` is empty"), empty.origin)
                    }
                    None => {
                        (format!("`<{element}>` lacks the attribute `{name}`"), self.element.origin)
                    }
                };
                self.diagnostics.push(
                    Diagnostic::error("missing-attribute", message)
                        .at(origin)
                        .help(format!("write `<{element} {name}=\"...\">`")),
                );
                None
            }
        }
    }

    /// Children that are known and kept verbatim.
    pub(crate) fn verbatim(&mut self, names: &[&'static str]) {
        self.known.extend(names);
    }

    /// Attributes without a meaning for this reader.
    pub(crate) fn ignore_attributes(&mut self, names: &[&'static str]) {
        for &name in names {
            let _ = self.attribute(name);
        }
    }

    /// Returns every child that was not read, and reports those with unknown names.
    pub(crate) fn finish(mut self) -> Vec<Element> {
        let mut rest = std::mem::take(&mut self.kept);
        let verbatim_from = rest.len();
        for (node, used) in self.element.children.iter().zip(&self.used) {
            match node {
                XmlNode::Element(child) if !used => rest.push(keep(child)),
                XmlNode::Text(text) if !text.text.trim().is_empty() => self.diagnostics.push(
                    Diagnostic::warning(
                        "stray-text",
                        format!("text directly in `<{}>` has no meaning", self.element.name),
                    )
                    .at(text.origin),
                ),
                _ => {}
            }
        }
        for child in &rest[verbatim_from..] {
            if child.prefix().is_none() && !self.known.contains(&&*child.name) {
                let parent = &self.element.name;
                let message = format!("`<{}>` is not known inside `<{parent}>`", child.name);
                let place = child.name_origin();
                let finding = Diagnostic::warning("unknown-element", message)
                    .at(place)
                    .note("it is kept, but not used");
                // The search for similar names takes time, and further findings are only counted.
                let suggest = self.diagnostics.count(Severity::Warning) < MAX_FINDINGS;
                let known = self.known.iter().copied().filter(|_| suggest);
                self.diagnostics.push(finding.did_you_mean(place, &child.name, known));
            }
        }
        self.settle_attributes();
        rest
    }

    fn settle_attributes(&mut self) {
        for (attribute, used) in self.element.attributes.iter().zip(&self.used_attributes) {
            let foreign = attribute.name.contains(':') || attribute.name == "xmlns";
            if !used && !foreign {
                unknown_attribute(
                    self.element,
                    attribute,
                    &self.known_attributes,
                    self.diagnostics,
                );
            }
        }
    }

    /// Value of a leaf child, read by `read`; `default` if it is missing.
    fn leaf<T>(
        &mut self,
        name: &'static str,
        default: T,
        read: impl FnOnce(&Element, &mut Diagnostics) -> Option<T>,
    ) -> T {
        let Some(child) = self.child(name) else { return default };
        leaf(child, &[], self.diagnostics);
        if child.text().is_empty() {
            value::empty(child, self.diagnostics);
            return default;
        }
        read(child, self.diagnostics).unwrap_or(default)
    }

    /// A finite number.
    pub(crate) fn number(&mut self, name: &'static str, default: f64) -> f64 {
        self.leaf(name, default, value::number)
    }

    /// Finite number, optional.
    pub(crate) fn optional_number(&mut self, name: &'static str) -> Option<f64> {
        self.leaf(name, None, |child, d| Some(value::number(child, d)))
    }

    /// Finite number, at least zero.
    pub(crate) fn magnitude(&mut self, name: &'static str, default: f64) -> f64 {
        self.leaf(name, default, |child, d| {
            let number = value::number(child, d)?;
            value::not_negative(number, child, d).then_some(number)
        })
    }

    /// Finite rate. Gazebo treats values up to zero as unlimited, which is 0 here.
    pub(crate) fn rate(&mut self, name: &'static str, default: f64) -> f64 {
        let rate = self.number(name, default);
        if rate < 0.0
            && let Some(child) = self.element.child(name)
        {
            self.diagnostics.push(
                Diagnostic::hint(
                    "negative-rate",
                    format!("`<{name}>` is below 0, which is read as 0: no limit"),
                )
                .at(child.text_origin())
                .help(format!("write `<{name}>0</{name}>`")),
            );
        }
        rate.max(0.0)
    }

    /// A number that may be infinite.
    pub(crate) fn limit(&mut self, name: &'static str, default: f64) -> f64 {
        self.leaf(name, default, value::number_or_infinite)
    }

    /// Required length above zero.
    pub(crate) fn length(&mut self, name: &'static str, default: f64) -> f64 {
        self.require(name, &periplus_geometry::format_number(default));
        self.leaf(name, default, |child, d| {
            let number = value::number(child, d)?;
            value::positive(number, child, d).then_some(number)
        })
    }

    pub(crate) fn boolean(&mut self, name: &'static str, default: bool) -> bool {
        self.leaf(name, default, value::boolean)
    }

    /// Integer, at least zero.
    pub(crate) fn count(&mut self, name: &'static str, default: u32) -> u32 {
        self.leaf(name, default, value::count)
    }

    pub(crate) fn integer(&mut self, name: &'static str, default: i64) -> i64 {
        self.leaf(name, default, value::integer)
    }

    pub(crate) fn vector(&mut self, name: &'static str, default: DVec3) -> DVec3 {
        self.leaf(name, default, |child, d| value::numbers(child, d).map(DVec3::from_array))
    }

    pub(crate) fn pair(&mut self, name: &'static str, default: [f64; 2]) -> [f64; 2] {
        self.leaf(name, default, value::numbers)
    }

    pub(crate) fn colour(&mut self, name: &'static str) -> Option<Colour> {
        self.leaf(name, None, |child, d| Some(value::colour(child, d)))
    }

    /// Text; `None` if it is missing or empty.
    pub(crate) fn text(&mut self, name: &'static str) -> Option<String> {
        let child = self.child(name)?;
        leaf(child, &[], self.diagnostics);
        // Placeholder that libsdformat writes for missing text.
        let text = child.text();
        (!text.is_empty() && text != "__default__").then(|| text.into_owned())
    }

    /// Warns about a missing child that SDF requires; the default is used.
    pub(crate) fn require(&mut self, name: &'static str, default: &str) {
        if self.element.child(name).is_none() {
            let parent = &self.element.name;
            self.diagnostics.push(
                Diagnostic::warning(
                    "missing-element",
                    format!("`<{parent}>` lacks `<{name}>`; {default} is assumed"),
                )
                .at(self.element.origin)
                .help(format!("add `<{name}>{default}</{name}>`")),
            );
        }
    }

    pub(crate) fn origin(&self) -> Origin {
        self.element.origin
    }
}

pub(crate) fn unknown_attribute(
    element: &Element,
    attribute: &Attribute,
    known: &[&'static str],
    diagnostics: &mut Diagnostics,
) {
    let message = format!("`<{}>` has no attribute `{}`", element.name, attribute.name);
    let name_origin = Origin(attribute.origin.0.map(|span| span.part(0, attribute.name.len())));
    diagnostics.push(
        Diagnostic::warning("unknown-attribute", message)
            .at(attribute.origin)
            .note("it is left out")
            .did_you_mean(name_origin, &attribute.name, known.iter().copied()),
    );
}
