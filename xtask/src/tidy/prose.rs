//! Prose of the tree: passages of text, each split into words with their positions.

use std::ops::Range;

/// Kind of text that a passage is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Source {
    /// Doc comment.
    Doc,
    /// Doc comment that clap prints as help.
    Help,
    /// Ordinary comment.
    Comment,
    /// String literal outside tests.
    Message,
    /// Page in Markdown.
    Page,
    /// Visible text, string or comment of the viewer.
    Viewer,
    /// Description of a package.
    Manifest,
}

/// Text with the positions of its parts in a file.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    pub(crate) source: Source,
    pub(crate) text: String,
    /// Offsets in `text` and in the file, ascending; text between two entries runs along with the file.
    pieces: Vec<(usize, usize)>,
}

impl Passage {
    pub(crate) fn new(source: Source) -> Self {
        Self { source, text: String::new(), pieces: Vec::new() }
    }

    /// Appends a part of a file as it is.
    pub(crate) fn push(&mut self, file: &str, range: Range<usize>) {
        self.pieces.push((self.text.len(), range.start));
        self.text.push_str(&file[range]);
    }

    /// Appends text in place of what the file has at an offset.
    pub(crate) fn push_text(&mut self, text: &str, offset: usize) {
        self.pieces.push((self.text.len(), offset));
        self.text.push_str(text);
    }

    /// Offset in the file of an offset in the text.
    pub(crate) fn offset_in_file(&self, at: usize) -> usize {
        let next = self.pieces.partition_point(|&(start, _)| start <= at);
        let (start, offset) = self.pieces.get(next.wrapping_sub(1)).copied().unwrap_or_default();
        offset + (at - start.min(at))
    }
}

/// Kind of a part of a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Word,
    /// Code, placeholder or address.
    Code,
    /// End of a sentence, a paragraph, a table cell or a list item.
    Stop,
    /// Any other character that is not a space.
    Mark(char),
}

/// Part of a sentence.
#[derive(Clone, Debug)]
pub(crate) struct Atom {
    pub(crate) part: Part,
    /// Bytes in the passage's text.
    pub(crate) range: Range<usize>,
}

/// Sentences of a passage as words, marks and stops. Code and placeholders are one atom each.
pub(crate) fn atoms(passage: &Passage) -> Vec<Atom> {
    let mut reader = Reader {
        text: &passage.text,
        has_placeholders: passage.source == Source::Message,
        at: 0,
        in_heading: false,
        atoms: Vec::new(),
    };
    reader.read();
    reader.atoms
}

struct Reader<'a> {
    text: &'a str,
    has_placeholders: bool,
    at: usize,
    /// True up to the end of a line that is a heading.
    in_heading: bool,
    atoms: Vec<Atom>,
}

impl Reader<'_> {
    fn read(&mut self) {
        self.line_start();
        while let Some(next) = self.rest().chars().next() {
            if next == '\n' {
                if std::mem::take(&mut self.in_heading) {
                    self.push(Part::Stop, 0);
                }
                self.at += 1;
                self.line_start();
            } else if next.is_whitespace() {
                self.at += next.len_utf8();
            } else {
                self.atom(next);
            }
        }
    }

    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn push(&mut self, part: Part, len: usize) {
        self.atoms.push(Atom { part, range: self.at..self.at + len });
        self.at += len;
    }

    fn line(&self) -> &str {
        self.rest().lines().next().unwrap_or_default()
    }

    /// Skips code blocks; marks the starts of paragraphs, list items, headings and tables.
    fn line_start(&mut self) {
        let line = self.line();
        let trimmed = line.trim_start();
        let indent = line.len() - trimmed.len();
        if trimmed.starts_with("```") || trimmed.starts_with("~~~") {
            let fence = &trimmed[..3];
            let mut end = self.at + line.len();
            for inner in self.text[end..].split_inclusive('\n').skip(1) {
                end += inner.len();
                if inner.trim_start().starts_with(fence) {
                    break;
                }
            }
            // The line break of the opening line was skipped with the first piece.
            let first = usize::from(self.text[self.at + line.len()..].starts_with('\n'));
            let len = (end + first).min(self.text.len()) - self.at;
            self.push(Part::Stop, len);
            return;
        }
        let numbered = trimmed.trim_start_matches(|c: char| c.is_ascii_digit());
        let marker = if trimmed.is_empty() {
            0
        } else if trimmed.starts_with("- ") || trimmed.starts_with("* ") {
            2
        } else if trimmed.starts_with('#') {
            trimmed.len() - trimmed.trim_start_matches('#').len()
        } else if numbered.len() < trimmed.len() && numbered.starts_with(". ") {
            trimmed.len() - numbered.len() + 2
        } else if trimmed.starts_with(['|', '>']) {
            1
        } else {
            return;
        };
        self.in_heading = trimmed.starts_with('#');
        self.push(Part::Stop, indent + marker);
    }

    fn atom(&mut self, next: char) {
        let rest = self.rest();
        let whole = |len: usize| len.min(rest.len());
        if next == '`' {
            let fence = rest.len() - rest.trim_start_matches('`').len();
            match rest[fence..].find(&rest[..fence]) {
                Some(len) => self.push(Part::Code, whole(len + 2 * fence)),
                None => self.push(Part::Mark('`'), fence),
            }
        } else if self.has_placeholders && next == '{' {
            let len = rest.find('}').map_or(1, |len| len + 1);
            self.push(Part::Code, len);
        } else if rest.starts_with("](") {
            let len = rest.find(')').map_or(2, |len| len + 1);
            self.push(Part::Mark(']'), len);
        } else if next.is_alphanumeric() || next == '_' {
            self.word();
        } else if matches!(next, '.' | '!' | '?' | '|') {
            self.push(Part::Stop, next.len_utf8());
        } else if next == '*' {
            self.at += 1;
        } else {
            self.push(Part::Mark(next), next.len_utf8());
        }
    }

    /// Word, or code where it has characters that words have not: `map_from_base`, `a::b`, `x.yaml`.
    fn word(&mut self) {
        let rest = self.rest();
        let bytes = rest.as_bytes();
        let is_letter = |at: usize| rest[at..].chars().next().is_some_and(char::is_alphanumeric);
        let (mut len, mut is_code) = (0, false);
        while let Some(next) = rest[len..].chars().next() {
            let after = len + next.len_utf8();
            let joins = match next {
                '_' => true,
                '\'' | '’' | '-' => after < rest.len() && is_letter(after),
                '.' | '/' | ':' => {
                    let dense = bytes.get(after).is_some_and(|&byte| byte == b':' || byte == b'/');
                    after < rest.len() && (is_letter(after) || dense)
                }
                _ => next.is_alphanumeric(),
            };
            if !joins {
                break;
            }
            is_code |= matches!(next, '_' | '.' | '/' | ':') || next.is_ascii_digit();
            len = after;
        }
        let is_call = rest[len..].starts_with("()");
        let part = if is_code || is_call { Part::Code } else { Part::Word };
        self.push(part, len.max(1) + if is_call { 2 } else { 0 });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(source: Source, text: &str, expected: &str) {
        let mut passage = Passage::new(source);
        passage.push(text, 0..text.len());
        let shown: Vec<String> = atoms(&passage)
            .iter()
            .map(|atom| match atom.part {
                Part::Word => text[atom.range.clone()].to_owned(),
                Part::Code => "CODE".to_owned(),
                Part::Stop => "STOP".to_owned(),
                Part::Mark(mark) => mark.to_string(),
            })
            .collect();
        assert_eq!(shown.join(" "), expected, "{text}");
    }

    #[test]
    fn words_marks_and_stops() {
        check(
            Source::Doc,
            "The robot's map, re-read: `a b` (x). So",
            "The robot's map , re-read : CODE ( x ) STOP So",
        );
        check(
            Source::Doc,
            "See [who](http://who.is), map_from_base, a::b, a/b and f().",
            "See [ who ] , CODE , CODE , CODE and CODE STOP",
        );
    }

    #[test]
    fn paragraphs_lists_and_tables_stop() {
        check(
            Source::Page,
            "# Who\nSo\non\n\n- it\n2. is\n| a | b |",
            "STOP Who STOP So on STOP STOP it STOP is STOP a STOP b STOP",
        );
    }

    #[test]
    fn blocks_of_code_are_left_out() {
        check(Source::Page, "a\n```sh\nwho\n```\nb", "a STOP b");
        check(Source::Page, "```\nwho", "STOP");
    }

    #[test]
    fn placeholders_of_messages() {
        check(Source::Message, "no {place} in {0}", "no CODE in CODE");
        check(Source::Doc, "a {b}", "a { b }");
    }

    #[test]
    fn positions_in_the_file() {
        let file = "/// one\n/// two";
        let mut passage = Passage::new(Source::Doc);
        passage.push(file, 3..7);
        passage.push_text("\n", 7);
        passage.push(file, 11..15);
        assert_eq!(passage.text, " one\n two");
        assert_eq!(passage.offset_in_file(1), 4);
        assert_eq!(passage.offset_in_file(6), 12);
    }
}
