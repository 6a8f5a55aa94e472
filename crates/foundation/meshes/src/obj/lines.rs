//! Lines of OBJ and MTL files: keyword, arguments, line number.

use std::borrow::Cow;

use crate::error::{MeshError, MeshLocation};

/// Logical line: a backslash at the end continues it.
pub(super) struct Line<'a> {
    number: usize,
    text: Cow<'a, str>,
}

impl Line<'_> {
    pub(super) fn place(&self) -> MeshLocation {
        MeshLocation::Line(self.number)
    }

    pub(super) fn keyword(&self) -> &str {
        self.text.split_whitespace().next().unwrap_or("")
    }

    /// Text after the keyword, without surrounding blanks.
    pub(super) fn rest(&self) -> &str {
        self.text.trim_start().split_once(char::is_whitespace).map_or("", |(_, rest)| rest.trim())
    }

    /// First `N` numbers after the keyword; `at_least` are required.
    pub(super) fn numbers<const N: usize>(&self, at_least: usize) -> Result<[f64; N], MeshError> {
        let mut numbers = [0.0; N];
        let mut words = self.rest().split_whitespace();
        for (i, number) in numbers.iter_mut().enumerate() {
            match words.next().map(str::parse) {
                Some(Ok(value)) => *number = value,
                None if i >= at_least => {}
                _ => {
                    return Err(MeshError::new(
                        format!("`{}` needs {at_least} numbers", self.keyword()),
                        "the file is cut short or damaged: export it again",
                    )
                    .at(self.place()));
                }
            }
        }
        Ok(numbers)
    }
}

/// Lines of a file, without comments. Bytes that are not UTF-8 (names in old encodings) become replacement
/// characters.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = Line<'_>> {
    let mut raw = bytes.split(|&b| b == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (i, first) = raw.next()?;
        let mut text = String::from_utf8_lossy(first);
        while let Some(end) = continued(&text) {
            let Some((_, next)) = raw.next() else { break };
            let joined = text.to_mut();
            joined.truncate(end);
            joined.push(' ');
            joined.push_str(&String::from_utf8_lossy(next));
        }
        let text = match comment(&text) {
            Some(at) => Cow::Owned(text[..at].to_owned()),
            None => text,
        };
        Some(Line { number: i + 1, text })
    })
}

/// End of the text proper if a backslash continues it on the next line.
fn continued(text: &str) -> Option<usize> {
    text.trim_end_matches(['\r']).strip_suffix('\\').map(str::len)
}

/// Start of a comment. A `#` inside a word belongs to a name (`usemtl metal#2`).
fn comment(text: &str) -> Option<usize> {
    let begins_word =
        |&(at, _): &(usize, &str)| text[..at].chars().next_back().is_none_or(char::is_whitespace);
    text.match_indices('#').find(begins_word).map(|(at, _)| at)
}
