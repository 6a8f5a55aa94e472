//! Source texts, spans in them, and the macro calls and includes that produced a text.

use std::sync::Arc;

/// Index of a text in a [`SourceMap`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(u32);

/// Index of an [`Expansion`] in a [`SourceMap`]; [`ContextId::ROOT`] is text that was not expanded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContextId(u32);

impl ContextId {
    /// Text that no macro or include produced.
    pub const ROOT: Self = Self(0);
}

/// Range of bytes in one text, with the context in which the text was expanded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// Text that contains the span.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// Macro call or include that produced the text.
    pub context: ContextId,
}

impl Span {
    /// Returns the same span in another context.
    #[must_use]
    pub fn within(self, context: ContextId) -> Self {
        Self { context, ..self }
    }

    /// Returns the part from byte `from` to byte `to`, both counted from the start of this span and clamped
    /// to it.
    #[must_use]
    pub fn part(self, from: usize, to: usize) -> Self {
        let at = |offset: usize| {
            let offset = u32::try_from(offset).unwrap_or(u32::MAX);
            self.start.saturating_add(offset).min(self.end)
        };
        Self { start: at(from), end: at(to.max(from)), ..self }
    }
}

/// Source location of a value, if known. Values that differ only in origin are equal, so two scenes read
/// from different texts can be compared with `==`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Origin(pub Option<Span>);

impl PartialEq for Origin {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Origin {}

impl From<Span> for Origin {
    fn from(span: Span) -> Self {
        Self(Some(span))
    }
}

/// Line and column, both counted from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// Step between the text as written and its use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expansion {
    /// Body of a macro, used by a call.
    Macro {
        /// Name of the macro.
        name: String,
        /// Location of the call; its context is the next outer step.
        call: Span,
    },
    /// File that was included.
    Include {
        /// Location of the include element; its context is the next outer step.
        at: Span,
    },
}

impl Expansion {
    /// Location of the next outer step.
    #[must_use]
    pub fn site(&self) -> Span {
        match self {
            Self::Macro { call, .. } => *call,
            Self::Include { at } => *at,
        }
    }
}

/// Text with its display name.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// Path or other name, as shown to users.
    pub name: String,
    /// The whole text.
    pub text: Arc<str>,
    line_starts: Vec<u32>,
}

impl SourceFile {
    /// Line and column of a byte; bytes after the end are treated as the end.
    #[must_use]
    pub fn position(&self, byte: u32) -> Position {
        let line = self.line_starts.partition_point(|&start| start <= byte).max(1);
        let start = self.line_starts[line - 1] as usize;
        let byte = (byte as usize).min(self.text.len());
        let before = self.text.get(start..byte).unwrap_or_default();
        Position { line, column: before.chars().count() + 1 }
    }

    /// Byte range of the lines that contain `start..end`, without the final line break, and the number of
    /// the first of them.
    pub(crate) fn lines_around(&self, start: u32, end: u32) -> (std::ops::Range<usize>, usize) {
        let line_of = |byte: u32| self.line_starts.partition_point(|&s| s <= byte).max(1) - 1;
        let first = line_of(start);
        let last = line_of(end.max(start));
        let from = self.line_starts[first] as usize;
        let to = self.line_starts.get(last + 1).map_or(self.text.len(), |&next| next as usize);
        let to = from + self.text[from..to].trim_end_matches(['\n', '\r']).len();
        (from..to, first + 1)
    }
}

/// All source texts of a reader.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    files: Vec<SourceFile>,
    expansions: Vec<Expansion>,
}

impl SourceMap {
    /// Returns an empty map.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a text. Texts are at most 4 GiB; readers refuse larger ones before.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<Arc<str>>) -> FileId {
        let text = text.into();
        let mut line_starts = vec![0];
        line_starts.extend(
            memchr_newlines(&text).map(|newline| u32::try_from(newline + 1).unwrap_or(u32::MAX)),
        );
        self.files.push(SourceFile { name: name.into(), text, line_starts });
        FileId(u32::try_from(self.files.len() - 1).unwrap_or(u32::MAX))
    }

    /// Text of an id of this map.
    ///
    /// # Panics
    /// With an id of another map.
    #[must_use]
    pub fn file(&self, file: FileId) -> &SourceFile {
        &self.files[file.0 as usize]
    }

    /// Span of a whole text.
    #[must_use]
    pub fn whole(&self, file: FileId) -> Span {
        let end = u32::try_from(self.file(file).text.len()).unwrap_or(u32::MAX);
        Span { file, start: 0, end, context: ContextId::ROOT }
    }

    /// All texts, in the order in which they were added.
    pub fn files(&self) -> impl Iterator<Item = FileId> + use<> {
        (0..u32::try_from(self.files.len()).unwrap_or(u32::MAX)).map(FileId)
    }

    /// Adds a macro call or include and returns its id.
    pub fn expand(&mut self, expansion: Expansion) -> ContextId {
        self.expansions.push(expansion);
        ContextId(u32::try_from(self.expansions.len()).unwrap_or(u32::MAX))
    }

    /// Expansion of a context; `None` for [`ContextId::ROOT`].
    #[must_use]
    pub fn expansion(&self, context: ContextId) -> Option<&Expansion> {
        (context.0 as usize).checked_sub(1).and_then(|index| self.expansions.get(index))
    }

    /// Macro calls and includes around a span, innermost first.
    pub fn backtrace(&self, span: Span) -> impl Iterator<Item = &Expansion> {
        let mut context = span.context;
        std::iter::from_fn(move || {
            let expansion = self.expansion(context)?;
            context = expansion.site().context;
            Some(expansion)
        })
    }

    /// Returns true if a span may belong to a text of this map, judged by its index.
    #[must_use]
    pub fn holds(&self, span: Span) -> bool {
        (span.file.0 as usize) < self.files.len()
    }

    /// Name of a span's text and position of its first byte.
    #[must_use]
    pub fn locate(&self, span: Span) -> (&str, Position) {
        let file = self.file(span.file);
        (&file.name, file.position(span.start))
    }

    /// Text of a span.
    #[must_use]
    pub fn text(&self, span: Span) -> &str {
        let text = &self.file(span.file).text;
        text.get(span.start as usize..(span.end as usize).min(text.len())).unwrap_or_default()
    }
}

fn memchr_newlines(text: &str) -> impl Iterator<Item = usize> + '_ {
    text.bytes().enumerate().filter_map(|(index, byte)| (byte == b'\n').then_some(index))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_from_one() {
        let mut sources = SourceMap::new();
        let file = sources.add("a.xml", "ab\nčd\n");
        let at = |byte| {
            let Position { line, column } = sources.file(file).position(byte);
            (line, column)
        };
        assert_eq!(at(0), (1, 1));
        assert_eq!(at(2), (1, 3));
        assert_eq!(at(3), (2, 1));
        assert_eq!(at(5), (2, 2));
        assert_eq!(at(99), (3, 1));
    }

    #[test]
    fn backtrace_leads_outwards() {
        let mut sources = SourceMap::new();
        let file = sources.add("a.xml", "0123456789");
        let outer_call = sources.whole(file).part(0, 1);
        let outer = sources.expand(Expansion::Macro { name: "outer".into(), call: outer_call });
        let inner_call = sources.whole(file).part(2, 3).within(outer);
        let inner = sources.expand(Expansion::Macro { name: "inner".into(), call: inner_call });
        let starts: Vec<u32> = sources
            .backtrace(sources.whole(file).within(inner))
            .map(|expansion| expansion.site().start)
            .collect();
        assert_eq!(starts, [2, 0]);
    }
}
