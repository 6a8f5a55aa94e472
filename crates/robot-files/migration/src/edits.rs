//! Edits of a file by its elements.

use std::ops::Range;

use periplus_diagnostics::{TextEdit, apply_edits};
use periplus_xml::Element;

use crate::source::SourceText;
use crate::world::written;

/// Indentation of an element below its parent.
const STEP: &str = "  ";

/// Collected edits of a text.
pub(crate) struct Edits<'a> {
    pub(crate) source: SourceText<'a>,
    edits: Vec<TextEdit>,
}

impl<'a> Edits<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self { source: SourceText { text }, edits: Vec::new() }
    }

    fn push(&mut self, range: Range<usize>, text: String) {
        self.edits.push(TextEdit { range, text });
    }

    /// Replaces an element by others.
    pub(crate) fn replace(&mut self, element: &Element, by: &[Element]) {
        let Some(range) = self.source.whole(element) else { return };
        let indentation = self.source.indentation(range.start);
        self.push(range, written(by, indentation));
    }

    /// Replaces an element by a comment.
    pub(crate) fn comment_out(&mut self, element: &Element, comment: &str) {
        let Some(range) = self.source.whole(element) else { return };
        self.push(range, format!("<!-- {} -->", comment.replace("--", "- -")));
    }

    /// Removes an element with its lines.
    pub(crate) fn remove(&mut self, element: &Element) {
        let Some(range) = self.source.whole(element) else { return };
        let range = self.source.lines(range);
        self.push(range, String::new());
    }

    /// Adds text after an element, on a new line.
    pub(crate) fn insert_after(&mut self, element: &Element, elements: &[Element]) {
        let Some(range) = self.source.whole(element) else { return };
        let indentation = self.source.indentation(range.start);
        let text = format!("\n{indentation}{}", written(elements, indentation));
        self.push(range.end..range.end, text);
    }

    /// Adds children at the end of an element.
    pub(crate) fn append(&mut self, element: &Element, children: &[Element]) {
        let Some(start) = self.source.start_tag(element) else { return };
        let indentation = self.source.indentation(start.start);
        let inner = format!("{indentation}{STEP}");
        let text = written(children, &inner);
        match self.source.end_tag(element) {
            Some(end) => {
                // Before the white space of the end tag, which keeps its line.
                let before = self.source.indentation(end.start);
                let at = end.start - before.len();
                if self.source.text[..at].ends_with('\n') {
                    self.push(at..at, format!("{inner}{text}\n"));
                } else {
                    self.push(end.start..end.start, format!("\n{inner}{text}\n{indentation}"));
                }
            }
            None => {
                let name = &element.name;
                let slash = start.end - 2;
                self.push(slash..start.end, format!(">\n{inner}{text}\n{indentation}</{name}>"));
            }
        }
    }

    /// Adds children at the start of an element.
    pub(crate) fn prepend(&mut self, element: &Element, children: &[Element]) {
        let Some(start) = self.source.start_tag(element) else { return };
        if self.source.text[start.clone()].ends_with("/>") {
            return self.append(element, children);
        }
        let inner = format!("{}{STEP}", self.source.indentation(start.start));
        let text = format!("\n{inner}{}", written(children, &inner));
        self.push(start.end..start.end, text);
    }

    /// Sets the value of an attribute.
    pub(crate) fn set_attribute(&mut self, element: &Element, name: &str, value: &str) {
        let Some(span) = element.attribute(name).and_then(|it| it.value_origin.0) else { return };
        self.push(span.start as usize..span.end as usize, value.to_owned());
    }

    /// Renames an element.
    pub(crate) fn rename(&mut self, element: &Element, name: &str) {
        let Some(start) = self.source.start_tag(element) else { return };
        let old = element.name.len();
        let at = start.start + 1;
        self.push(at..at + old, name.to_owned());
        if let Some(end) = self.source.end_tag(element) {
            let at = end.start + 2;
            self.push(at..at + old, name.to_owned());
        }
    }

    /// Sets the text of an element that has text only.
    pub(crate) fn set_text(&mut self, element: &Element, text: &str) {
        let (Some(start), Some(end)) =
            (self.source.start_tag(element), self.source.end_tag(element))
        else {
            return;
        };
        self.push(start.end..end.start, text.to_owned());
    }

    /// New text; `None` if edits overlap.
    pub(crate) fn apply(self) -> Option<String> {
        apply_edits(self.source.text, self.edits)
    }
}
