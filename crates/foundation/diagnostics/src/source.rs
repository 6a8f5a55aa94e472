//! Texts, places in them, and the chain of macro calls and includes that led to a place.

use std::sync::Arc;

/// Names one text of a [`SourceMap`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(u32);

/// Names one [`Expansion`] of a [`SourceMap`]; [`ContextId::ROOT`] is text that stands as written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContextId(u32);

impl ContextId {
    /// Text that no macro produced.
    pub const ROOT: Self = Self(0);
}

/// A range of bytes in one text, and how the text came to be used there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The text.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// The macro call or include through which the text is seen.
    pub context: ContextId,
}

impl Span {
    /// The same place, seen through `context`.
    #[must_use]
    pub fn within(self, context: ContextId) -> Self {
        Self { context, ..self }
    }

    /// The part of this span from byte `from` to byte `to`, both counted from its start and held
    /// inside it.
    #[must_use]
    pub fn part(self, from: usize, to: usize) -> Self {
        let at = |offset: usize| {
            let offset = u32::try_from(offset).unwrap_or(u32::MAX);
            self.start.saturating_add(offset).min(self.end)
        };
        Self { start: at(from), end: at(to.max(from)), ..self }
    }
}

/// Where a value came from, if anyone knows. Values that differ only in origin are equal, so that
/// two scenes read from different texts can be compared with `==`.
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

/// A line and a column, both counted from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// A step between the text as written and the place where it is used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expansion {
    /// The body of a macro, used by a call.
    Macro {
        /// The macro's name.
        name: String,
        /// The call; its context leads further out.
        call: Span,
    },
    /// A file brought in by an include.
    Include {
        /// The include element; its context leads further out.
        at: Span,
    },
}

impl Expansion {
    /// The place one step further out.
    #[must_use]
    pub fn site(&self) -> Span {
        match self {
            Self::Macro { call, .. } => *call,
            Self::Include { at } => *at,
        }
    }
}

/// One text and the name under which messages show it.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// A path or another name, as a person should see it.
    pub name: String,
    /// The whole text.
    pub text: Arc<str>,
    line_starts: Vec<u32>,
}

impl SourceFile {
    /// Line and column of a byte; bytes past the end count as the end.
    #[must_use]
    pub fn position(&self, byte: u32) -> Position {
        let line = self.line_starts.partition_point(|&start| start <= byte).max(1);
        let start = self.line_starts[line - 1] as usize;
        let byte = (byte as usize).min(self.text.len());
        let before = self.text.get(start..byte).unwrap_or_default();
        Position { line, column: before.chars().count() + 1 }
    }

    /// Bytes of the lines that hold `start..end`, without the final line break, and the number of
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

/// All texts that took part in a reading.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    files: Vec<SourceFile>,
    expansions: Vec<Expansion>,
}

impl SourceMap {
    /// An empty map.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a text. Texts are at most 4 GiB; readers refuse larger ones before they come here.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<Arc<str>>) -> FileId {
        let text = text.into();
        let mut line_starts = vec![0];
        line_starts.extend(
            memchr_newlines(&text).map(|newline| u32::try_from(newline + 1).unwrap_or(u32::MAX)),
        );
        self.files.push(SourceFile { name: name.into(), text, line_starts });
        FileId(u32::try_from(self.files.len() - 1).unwrap_or(u32::MAX))
    }

    /// The text behind an id of this map.
    ///
    /// # Panics
    /// With an id of another map.
    #[must_use]
    pub fn file(&self, file: FileId) -> &SourceFile {
        &self.files[file.0 as usize]
    }

    /// The span of a whole text.
    #[must_use]
    pub fn whole(&self, file: FileId) -> Span {
        let end = u32::try_from(self.file(file).text.len()).unwrap_or(u32::MAX);
        Span { file, start: 0, end, context: ContextId::ROOT }
    }

    /// Records a macro call or include and names it.
    pub fn expand(&mut self, expansion: Expansion) -> ContextId {
        self.expansions.push(expansion);
        ContextId(u32::try_from(self.expansions.len()).unwrap_or(u32::MAX))
    }

    /// The expansion behind a context; none for [`ContextId::ROOT`].
    #[must_use]
    pub fn expansion(&self, context: ContextId) -> Option<&Expansion> {
        (context.0 as usize).checked_sub(1).and_then(|index| self.expansions.get(index))
    }

    /// The macro calls and includes around a place, innermost first.
    pub fn backtrace(&self, span: Span) -> impl Iterator<Item = &Expansion> {
        let mut context = span.context;
        std::iter::from_fn(move || {
            let expansion = self.expansion(context)?;
            context = expansion.site().context;
            Some(expansion)
        })
    }

    /// Whether a span is of a text of this map, as far as its number tells.
    #[must_use]
    pub fn holds(&self, span: Span) -> bool {
        (span.file.0 as usize) < self.files.len()
    }

    /// The name of a span's text and the position of its first byte.
    #[must_use]
    pub fn locate(&self, span: Span) -> (&str, Position) {
        let file = self.file(span.file);
        (&file.name, file.position(span.start))
    }

    /// The text of a span.
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
