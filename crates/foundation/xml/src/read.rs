//! Parser: text to tree.

use std::borrow::Cow;
use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, Origin, SourceMap, Span};
use quick_xml::events::attributes::AttrError;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, errors::Error};
use smol_str::SmolStr;

use crate::entities::{Entities, Unresolved};
use crate::tree::{Attribute, Document, Element, Text, XmlNode};

/// Maximum nesting depth. Real robot files stay below 30; the readers above are recursive.
pub const MAX_DEPTH: usize = 200;

/// Maximum number of attributes of one element that are compared pairwise; beyond it an index finds
/// repetitions, so that a hostile tag does not take quadratic time.
const FEW_ATTRIBUTES: usize = 16;

/// Parses one text of `sources`. Tolerated faults are warnings; text that is not XML at all gives an error
/// and no document.
pub fn parse(file: FileId, sources: &SourceMap, diagnostics: &mut Diagnostics) -> Option<Document> {
    let text = sources.file(file).text.clone();
    let mut builder = Builder {
        text: &text,
        whole: sources.whole(file),
        diagnostics,
        entities: Entities::default(),
        open: Vec::new(),
        run: None,
        document: Parts::default(),
    };
    builder.run()
}

#[derive(Default)]
struct Parts {
    before: Vec<XmlNode>,
    root: Option<Element>,
    after: Vec<XmlNode>,
}

/// Pieces of one run of text: the first, and all further ones.
struct Run {
    first: SmolStr,
    rest: String,
    span: Span,
}

struct Builder<'a> {
    text: &'a str,
    whole: Span,
    diagnostics: &'a mut Diagnostics,
    entities: Entities,
    open: Vec<Element>,
    /// Text of the innermost open element that is not a node yet: text around entities and CDATA sections
    /// arrives in pieces, and one run is one node.
    run: Option<Run>,
    document: Parts,
}

impl Builder<'_> {
    fn run(&mut self) -> Option<Document> {
        // The reader leaves byte order marks out, and does not count them in its positions.
        let text = self.text.trim_start_matches('\u{feff}');
        let marks = self.text.len() - text.len();
        let offset = |position: u64| offset(position) + marks;
        let mut reader = Reader::from_str(text);
        let config = reader.config_mut();
        // End names are checked here, where both locations are known.
        config.check_end_names = false;
        config.allow_unmatched_ends = true;
        config.allow_dangling_amp = true;
        loop {
            let from = offset(reader.buffer_position());
            let event = match reader.read_event() {
                Ok(event) => event,
                Err(error) => {
                    self.syntax_error(&error, offset(reader.error_position()));
                    return None;
                }
            };
            let span = self.span(from, offset(reader.buffer_position()));
            match event {
                Event::Start(tag) => self.start(&tag, span)?,
                Event::Empty(tag) => {
                    self.start(&tag, span)?;
                    self.close();
                }
                Event::End(tag) => self.end(tag.name().as_ref(), span)?,
                Event::Text(content) => self.characters(&content.xml10_content(), span)?,
                Event::CData(content) => self.characters(&content.xml10_content(), span)?,
                Event::GeneralRef(reference) => {
                    let name = reference.into_inner();
                    let resolved = self.entity(&name, span)?;
                    self.characters(&resolved, span)?;
                }
                Event::Comment(content) => {
                    let node = XmlNode::Comment(plain(&content.xml10_content(), span));
                    self.node(node);
                }
                Event::PI(content) => {
                    let node = XmlNode::Instruction(plain(&content.into_inner(), span));
                    self.node(node);
                }
                Event::DocType(content) => self.entities.declare(&content.into_inner()),
                Event::Decl(_) => {}
                Event::Eof => return self.finish(),
            }
        }
    }

    fn start(&mut self, tag: &BytesStart<'_>, span: Span) -> Option<()> {
        if self.open.len() >= MAX_DEPTH {
            self.error(
                Diagnostic::error(
                    "too-deep",
                    format!("elements are nested deeper than {MAX_DEPTH} levels"),
                )
                .at(span)
                .help("flatten the file; no robot or world needs this"),
            );
            return None;
        }
        self.end_run();
        let mut attributes: Vec<Attribute> = Vec::new();
        let mut places: BTreeMap<SmolStr, usize> = BTreeMap::new();
        let mut iterator = tag.attributes();
        iterator.with_checks(false);
        for attribute in iterator {
            let attribute = match attribute {
                Ok(attribute) => attribute,
                Err(error) => {
                    self.attribute_error(&error, span);
                    return None;
                }
            };
            let name = attribute.key.into_inner();
            // Both are slices of the text, so their addresses give their offsets.
            let start = name.as_ptr() as usize - self.text.as_ptr() as usize;
            let (value_start, raw) = match &attribute.value {
                Cow::Borrowed(raw) => (raw.as_ptr() as usize - self.text.as_ptr() as usize, *raw),
                Cow::Owned(raw) => (start, raw.as_str()),
            };
            let value_span = self.span(value_start, value_start + raw.len());
            let value = self.attribute_value(raw, value_span)?;
            let full = self.span(start, (value_start + raw.len() + 1).min(self.text.len()));
            let earlier = if attributes.len() < FEW_ATTRIBUTES {
                attributes.iter().find(|earlier| earlier.name == name)
            } else {
                for (place, known) in attributes.iter().enumerate().skip(places.len()) {
                    places.insert(known.name.clone(), place);
                }
                places.get(name).map(|&place| &attributes[place])
            };
            if let Some(earlier) = earlier {
                let diagnostic = Diagnostic::error(
                    "malformed-xml",
                    format!("the attribute `{name}` is given twice"),
                )
                .at(full)
                .related(earlier.origin, "first given here")
                .help("keep one of them; the first is used");
                self.error(diagnostic);
                continue;
            }
            attributes.push(Attribute {
                name: SmolStr::new(name),
                value,
                origin: full.into(),
                value_origin: value_span.into(),
            });
        }
        self.open.push(Element {
            name: SmolStr::new(tag.name().into_inner()),
            attributes,
            children: Vec::new(),
            origin: span.into(),
        });
        Some(())
    }

    fn attribute_error(&mut self, error: &AttrError, span: Span) {
        let text = &self.text[span.start as usize..span.end as usize];
        // The end of a tag joined with the end of a comment.
        if let Some(before) = text.strip_suffix("/-->").or_else(|| text.strip_suffix("-->")) {
            let place = span.part(before.len(), text.len());
            self.error(
                Diagnostic::error("malformed-xml", "a tag does not end in `-->`, a comment does")
                    .at(place)
                    .replace(place, "/>", "end the tag with `/>`, or put `<!--` before it"),
            );
            return;
        }
        self.error(
            Diagnostic::error(
                "malformed-xml",
                format!("this tag's attributes are not well-formed: {error}"),
            )
            .at(span)
            .help("write attributes as name=\"value\", separated by spaces"),
        );
    }

    fn end(&mut self, name: &str, span: Span) -> Option<()> {
        match self.open.last() {
            Some(open) if open.name == name.trim_end() => {
                self.close();
                Some(())
            }
            Some(open) => {
                let expected = format!("</{}>", open.name);
                let diagnostic = Diagnostic::error(
                    "malformed-xml",
                    format!("`</{name}>` closes an element that is not open here"),
                )
                .at(span)
                .label(format!("`{expected}` was expected"))
                .related(open.origin, "this element is still open")
                .help(format!("write `{expected}` before it, or remove it"));
                self.error(diagnostic);
                None
            }
            None => {
                self.error(
                    Diagnostic::error(
                        "malformed-xml",
                        format!("`</{name}>` closes an element that was never opened"),
                    )
                    .at(span)
                    .help("remove it"),
                );
                None
            }
        }
    }

    /// Creates a node from the collected text.
    fn end_run(&mut self) {
        if let Some(Run { first, rest, span }) = self.run.take()
            && let Some(parent) = self.open.last_mut()
        {
            let text = if rest.is_empty() { first } else { format!("{first}{rest}").into() };
            parent.children.push(XmlNode::Text(Text { text, origin: span.into() }));
        }
    }

    fn close(&mut self) {
        self.end_run();
        if let Some(element) = self.open.pop() {
            self.node(XmlNode::Element(element));
        }
    }

    fn node(&mut self, node: XmlNode) {
        self.end_run();
        match (self.open.last_mut(), node) {
            (Some(parent), node) => parent.children.push(node),
            (None, XmlNode::Element(element)) => match &self.document.root {
                None => self.document.root = Some(element),
                Some(root) => {
                    let diagnostic = Diagnostic::warning(
                        "second-root",
                        format!("`{}` is after the end of the file's root element", element.name),
                    )
                    .at(element.origin)
                    .label("not read")
                    .related(root.origin, "the root element")
                    .help("a file has one root element; move it inside, or to a separate file");
                    self.error(diagnostic);
                }
            },
            (None, node) if self.document.root.is_none() => self.document.before.push(node),
            (None, node) => self.document.after.push(node),
        }
    }

    fn characters(&mut self, characters: &str, span: Span) -> Option<()> {
        if self.open.is_empty() {
            if characters.trim().is_empty() || characters == "\u{feff}" {
                return Some(());
            }
            let outside = Diagnostic::new(
                // TinyXML-2 stops reading before a root, and ignores content after one.
                if self.document.root.is_some() {
                    periplus_diagnostics::Severity::Warning
                } else {
                    periplus_diagnostics::Severity::Error
                },
                "text-outside",
                "text is outside the root element",
            )
            .at(span)
            .label("not read");
            self.error(outside);
            return self.document.root.is_some().then_some(());
        }
        match &mut self.run {
            Some(run) => {
                run.rest.push_str(characters);
                run.span.end = span.end;
            }
            None => {
                let first = SmolStr::new(characters);
                self.run = Some(Run { first, rest: String::new(), span });
            }
        }
        Some(())
    }

    /// Line breaks and tabs become spaces (XML 1.0, section 3.3.3); entities are resolved.
    fn attribute_value(&mut self, raw: &str, span: Span) -> Option<SmolStr> {
        if !raw.contains(['&', '\n', '\t', '\r']) {
            return Some(SmolStr::new(raw));
        }
        let mut value = String::with_capacity(raw.len());
        let mut rest = raw;
        let space =
            |character| if matches!(character, '\n' | '\t' | '\r') { ' ' } else { character };
        while let Some(start) = rest.find('&') {
            value.extend(rest[..start].chars().map(space));
            let at = raw.len() - rest.len() + start;
            rest = &rest[start..];
            let end = rest[1..].find([';', '&', ' ']).map(|index| index + 1);
            let Some(length) = end.filter(|&end| rest[end..].starts_with(';')) else {
                value.push('&');
                rest = &rest[1..];
                continue;
            };
            let place = span.part(at, at + length + 1);
            value.push_str(&self.entity(&rest[1..length], place)?);
            rest = &rest[length + 1..];
        }
        value.extend(rest.chars().map(space));
        Some(value.into())
    }

    fn entity(&mut self, name: &str, span: Span) -> Option<String> {
        let unresolved = match self.entities.resolve(name) {
            Ok(text) => return Some(text),
            Err(unresolved) => unresolved,
        };
        let (diagnostic, go_on) = match unresolved {
            Unresolved::Unknown => (
                Diagnostic::warning("unknown-entity", format!("`&{name};` is not an entity"))
                    .label("kept as written")
                    .help("write `&amp;` for an ampersand"),
                true,
            ),
            Unresolved::External => (
                Diagnostic::error(
                    "external-entity",
                    format!("`&{name};` refers to another file, which is not read"),
                )
                .help("use <include> or <xacro:include>"),
                false,
            ),
            Unresolved::Bomb => (
                Diagnostic::error(
                    "entity-bomb",
                    format!("`&{name};` expands to too much text, or to itself"),
                )
                .help("entities may bring in at most 1 MiB, 16 levels deep"),
                false,
            ),
            Unresolved::Markup => (
                Diagnostic::error(
                    "entity-with-markup",
                    format!("`&{name};` holds elements, which are not read from entities"),
                )
                .help("use a xacro macro, or write the elements out"),
                false,
            ),
        };
        self.error(diagnostic.at(span));
        go_on.then(|| format!("&{name};"))
    }

    fn finish(&mut self) -> Option<Document> {
        if let Some(open) = self.open.last() {
            let diagnostic = Diagnostic::error(
                "malformed-xml",
                format!("the file ends, but `{}` is still open", open.name),
            )
            .at(open.origin)
            .help(format!("write `</{}>` where it ends", open.name));
            self.error(diagnostic);
            return None;
        }
        let parts = std::mem::take(&mut self.document);
        let Some(root) = parts.root else {
            self.error(
                Diagnostic::error("no-element", "the file holds no XML element")
                    .at(self.whole.part(0, 1))
                    .help("check that this is the right file"),
            );
            return None;
        };
        Some(Document { before: parts.before, root, after: parts.after })
    }

    fn syntax_error(&mut self, error: &Error, at: usize) {
        // The parser reports the end of the text for an unterminated construct; its start, which is
        // reported too, is the better location.
        let start = at.min(self.text.len());
        let mut end = (start + 1).min(self.text.len());
        while !self.text.is_char_boundary(end) {
            end += 1;
        }
        let span = self.span(start, end);
        let help = match error {
            Error::Syntax(quick_xml::errors::SyntaxError::UnclosedComment) => {
                "close the comment with `-->`"
            }
            _ => "look for a missing `>` or quote before this position",
        };
        self.error(
            Diagnostic::error("malformed-xml", format!("this is not well-formed XML: {error}"))
                .at(span)
                .help(help),
        );
    }

    fn error(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    fn span(&self, start: usize, end: usize) -> Span {
        self.whole.part(start, end)
    }
}

fn plain(text: &str, span: Span) -> Text {
    Text { text: SmolStr::new(text), origin: Origin(Some(span)) }
}

fn offset(position: u64) -> usize {
    usize::try_from(position).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests;
