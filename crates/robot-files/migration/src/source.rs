//! Text of an XML file by its elements.

use std::ops::Range;

use periplus_xml::Element;

/// Text of a file, addressed by the elements that were parsed from it.
#[derive(Clone, Copy)]
pub(crate) struct SourceText<'a> {
    pub(crate) text: &'a str,
}

impl<'a> SourceText<'a> {
    /// Bytes of a start tag, from `<` to `>`.
    pub(crate) fn start_tag(self, element: &Element) -> Option<Range<usize>> {
        let span = element.origin.0?;
        let range = span.start as usize..span.end as usize;
        self.text.get(range.clone()).map(|_| range)
    }

    /// Bytes of a whole element, with its end tag.
    pub(crate) fn whole(self, element: &Element) -> Option<Range<usize>> {
        let start = self.start_tag(element)?;
        if self.text[start.clone()].ends_with("/>") {
            return Some(start);
        }
        Some(start.start..self.end_tag(element)?.end)
    }

    /// Bytes of the end tag; `None` for an element without one.
    pub(crate) fn end_tag(self, element: &Element) -> Option<Range<usize>> {
        let start = self.start_tag(element)?;
        if self.text[start.clone()].ends_with("/>") {
            return None;
        }
        let mut at = start.end;
        let mut depth = 0_usize;
        loop {
            at += self.text[at..].find('<')?;
            let rest = &self.text[at..];
            let length = tag_length(rest)?;
            let tag = &rest[..length];
            if tag.starts_with("</") {
                if depth == 0 {
                    return Some(at..at + length);
                }
                depth -= 1;
            } else if !tag.starts_with("<!") && !tag.starts_with("<?") && !tag.ends_with("/>") {
                depth += 1;
            }
            at += length;
        }
    }

    /// White space between the start of the line and a position; empty if the line has other characters there.
    pub(crate) fn indentation(self, at: usize) -> &'a str {
        let line = self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        let before = &self.text[line..at];
        if before.trim().is_empty() { before } else { "" }
    }

    /// Bytes of an element with the white space before it and its line break, if it has its lines for itself.
    pub(crate) fn lines(self, range: Range<usize>) -> Range<usize> {
        let start = range.start - self.indentation(range.start).len();
        let is_first = start == 0 || self.text[..start].ends_with('\n');
        let rest = &self.text[range.end..];
        match rest.find('\n') {
            Some(end) if is_first && rest[..end].trim().is_empty() => start..range.end + end + 1,
            _ => range,
        }
    }
}

/// Length of the tag, comment, section or instruction at the start of a text.
fn tag_length(text: &str) -> Option<usize> {
    let until = |end: &str| text.find(end).map(|at| at + end.len());
    if let Some(inner) = text.strip_prefix("<!--") {
        return inner.find("-->").map(|at| at + "<!---->".len());
    }
    if text.starts_with("<![CDATA[") {
        return until("]]>");
    }
    if text.starts_with("<?") {
        return until("?>");
    }
    let mut quote = None;
    for (at, character) in text.char_indices() {
        match (quote, character) {
            (None, '"' | '\'') => quote = Some(character),
            (None, '>') => return Some(at + 1),
            (Some(open), _) if open == character => quote = None,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::{Diagnostics, SourceMap};

    use super::SourceText;

    fn whole(text: &str, name: &str) -> String {
        let mut sources = SourceMap::new();
        let file = sources.add("a.xml", text);
        let document = periplus_xml::parse(file, &sources, &mut Diagnostics::new()).unwrap();
        let source = SourceText { text };
        let element = document.root.child(name).unwrap();
        text[source.whole(element).unwrap()].to_owned()
    }

    #[test]
    fn an_element_ends_at_its_own_end_tag() {
        assert_eq!(whole("<a><b x='>'><b/><b>1</b></b></a>", "b"), "<b x='>'><b/><b>1</b></b>");
        assert_eq!(whole("<a><b/><c/></a>", "b"), "<b/>");
        assert_eq!(whole("<a><b><!-- </b> --></b></a>", "b"), "<b><!-- </b> --></b>");
        assert_eq!(whole("<a><b><![CDATA[</b>]]></b></a>", "b"), "<b><![CDATA[</b>]]></b>");
    }

    #[test]
    fn lines_include_indentation_and_break() {
        let text = "<a>\n  <b/>\n</a>";
        let source = SourceText { text };
        assert_eq!(source.lines(6..10), 4..11);
        assert_eq!(SourceText { text: "<a><b/></a>" }.lines(3..7), 3..7);
    }
}
