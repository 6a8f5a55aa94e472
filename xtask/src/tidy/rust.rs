//! Lexer for Rust: tokens with their byte ranges, comments included.
//!
//! A full parser would drop ordinary comments and would not look into macros, where most messages
//! are. Tokens with matched brackets are enough for every check.

use std::ops::Range;

/// Kind of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Ident,
    Lifetime,
    Number,
    Char,
    /// String literal of text; the ranges of tokens of this kind are without quotes and prefix.
    Text {
        is_raw: bool,
    },
    /// String literal of bytes or for C; range without quotes and prefix.
    Bytes,
    Punct(u8),
    /// `///` or `//!`; range without the marker.
    LineDoc {
        is_inner: bool,
    },
    /// `/** */` or `/*! */`; range without the markers.
    BlockDoc,
    /// `//`; range without the marker.
    LineComment,
    /// `/* */`; range without the markers.
    BlockComment,
}

impl Kind {
    /// True for comments and doc comments.
    pub(crate) fn is_comment(self) -> bool {
        matches!(
            self,
            Self::LineDoc { .. } | Self::BlockDoc | Self::LineComment | Self::BlockComment
        )
    }
}

/// Token of Rust source.
#[derive(Clone, Debug)]
pub(crate) struct Token {
    pub(crate) kind: Kind,
    /// Bytes in the source.
    pub(crate) range: Range<usize>,
}

/// Tokens of a source text.
///
/// Source that Rust would refuse gives tokens too: an unclosed literal or comment ends with the text.
pub(crate) fn tokens(source: &str) -> Vec<Token> {
    Lexer { source, at: 0 }.collect()
}

/// Index of the closing bracket for each opening one, `tokens.len()` where it is missing.
///
/// Entries of other tokens are their own index.
pub(crate) fn closers(tokens: &[Token]) -> Vec<usize> {
    let mut closers: Vec<usize> = (0..tokens.len()).collect();
    let mut open: Vec<usize> = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match token.kind {
            Kind::Punct(b'(' | b'[' | b'{') => {
                closers[at] = tokens.len();
                open.push(at);
            }
            Kind::Punct(b')' | b']' | b'}') => {
                if let Some(opening) = open.pop() {
                    closers[opening] = at;
                }
            }
            _ => {}
        }
    }
    closers
}

struct Lexer<'a> {
    source: &'a str,
    at: usize,
}

impl Iterator for Lexer<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        let bytes = self.source.as_bytes();
        while bytes.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
        let first = *bytes.get(self.at)?;
        let rest = &bytes[self.at..];
        Some(match first {
            b'/' if rest.starts_with(b"//") => self.line_comment(),
            b'/' if rest.starts_with(b"/*") => self.block_comment(),
            b'"' => self.quoted(0, Kind::Text { is_raw: false }),
            b'b' if rest.starts_with(b"b\"") => self.quoted(1, Kind::Bytes),
            b'c' if rest.starts_with(b"c\"") => self.quoted(1, Kind::Bytes),
            b'b' if rest.starts_with(b"b'") => self.char_or_lifetime(1),
            b'r' | b'b' | b'c' if raw_prefix(rest).is_some() => self.raw(),
            b'\'' => self.char_or_lifetime(0),
            b'0'..=b'9' => self.number(),
            _ if is_ident(first) => self.run(Kind::Ident, is_ident),
            _ => self.token(Kind::Punct(first), 1, 0, 0),
        })
    }
}

fn is_ident(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80
}

/// Length of `r`, `br` or `cr` and number of `#` where a raw string starts.
fn raw_prefix(rest: &[u8]) -> Option<(usize, usize)> {
    let letters = if rest.first() == Some(&b'r') { 1 } else { 2 };
    if rest.get(letters - 1) != Some(&b'r') {
        return None;
    }
    let hashes = rest[letters..].iter().take_while(|&&byte| byte == b'#').count();
    (rest.get(letters + hashes) == Some(&b'"')).then_some((letters, hashes))
}

impl Lexer<'_> {
    /// Token of `len` bytes whose range leaves out `front` bytes and `back` bytes.
    fn token(&mut self, kind: Kind, len: usize, front: usize, back: usize) -> Token {
        let end = (self.at + len).min(self.source.len());
        let start = (self.at + front).min(end);
        let range = start..end.saturating_sub(back).max(start);
        self.at = end;
        Token { kind, range }
    }

    fn run(&mut self, kind: Kind, belongs: impl Fn(u8) -> bool) -> Token {
        let rest = &self.source.as_bytes()[self.at..];
        let len = rest.iter().take_while(|&&byte| belongs(byte)).count();
        self.token(kind, len, 0, 0)
    }

    fn line_comment(&mut self) -> Token {
        let rest = &self.source[self.at..];
        let len = rest.find('\n').unwrap_or(rest.len());
        if rest.starts_with("//!") {
            self.token(Kind::LineDoc { is_inner: true }, len, 3, 0)
        } else if rest.starts_with("///") && !rest.starts_with("////") {
            self.token(Kind::LineDoc { is_inner: false }, len, 3, 0)
        } else {
            self.token(Kind::LineComment, len, 2, 0)
        }
    }

    fn block_comment(&mut self) -> Token {
        let rest = &self.source.as_bytes()[self.at..];
        let (mut depth, mut len) = (0, 0);
        while len < rest.len() {
            if rest[len..].starts_with(b"/*") {
                depth += 1;
                len += 2;
            } else if rest[len..].starts_with(b"*/") {
                depth -= 1;
                len += 2;
                if depth == 0 {
                    break;
                }
            } else {
                len += 1;
            }
        }
        let back = if depth == 0 { 2 } else { 0 };
        let is_doc =
            len > 4 && matches!(rest.get(2), Some(b'*' | b'!')) && rest.get(3) != Some(&b'*');
        let (kind, front) = if is_doc { (Kind::BlockDoc, 3) } else { (Kind::BlockComment, 2) };
        self.token(kind, len, front, back)
    }

    fn quoted(&mut self, prefix: usize, kind: Kind) -> Token {
        let rest = &self.source.as_bytes()[self.at..];
        let mut len = prefix + 1;
        while len < rest.len() && rest[len] != b'"' {
            len += if rest[len] == b'\\' { 2 } else { 1 };
        }
        let back = usize::from(len < rest.len());
        self.token(kind, len + 1, prefix + 1, back)
    }

    fn raw(&mut self) -> Token {
        let rest = &self.source[self.at..];
        let (letters, hashes) = raw_prefix(rest.as_bytes()).unwrap_or((1, 0));
        let front = letters + hashes + 1;
        let end = format!("\"{}", "#".repeat(hashes));
        let kind = if letters == 1 { Kind::Text { is_raw: true } } else { Kind::Bytes };
        match rest[front..].find(&end) {
            Some(len) => self.token(kind, front + len + end.len(), front, end.len()),
            None => self.token(kind, rest.len(), front, 0),
        }
    }

    fn char_or_lifetime(&mut self, prefix: usize) -> Token {
        let rest = &self.source[self.at + prefix..];
        let mut chars = rest.char_indices().skip(1);
        let (first, second) = (chars.next(), chars.next());
        match (first, second) {
            (Some((_, '\\')), _) => {
                // The escaped character itself may be a quote.
                let end = rest.get(3..).and_then(|tail| tail.find('\''));
                let len = end.map_or(rest.len(), |len| len + 4);
                self.token(Kind::Char, prefix + len, 0, 0)
            }
            (Some(_), Some((end, '\''))) => self.token(Kind::Char, prefix + end + 1, 0, 0),
            _ => {
                let name = rest.as_bytes().iter().skip(1).take_while(|&&byte| is_ident(byte));
                let len = prefix + 1 + name.count();
                self.token(Kind::Lifetime, len, 0, 0)
            }
        }
    }

    fn number(&mut self) -> Token {
        let rest = &self.source.as_bytes()[self.at..];
        let mut len = 1;
        while len < rest.len() {
            let is_fraction = rest[len] == b'.'
                && rest.get(len + 1).is_some_and(u8::is_ascii_digit)
                && !rest[..len].contains(&b'.');
            let is_exponent = matches!(rest[len], b'+' | b'-')
                && matches!(rest[len - 1], b'e' | b'E')
                && !rest.starts_with(b"0x");
            if !(is_ident(rest[len]) || is_fraction || is_exponent) {
                break;
            }
            len += 1;
        }
        self.token(Kind::Number, len, 0, 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(source: &str, expected: &[(Kind, &str)]) {
        let tokens = tokens(source);
        let found: Vec<_> =
            tokens.iter().map(|token| (token.kind, &source[token.range.clone()])).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn strings_and_comments() {
        let text = |is_raw| Kind::Text { is_raw };
        check(
            "\"a \\\" // b\" // c\n/* d /* e */ */ r#\"f\"g\"# b\"h\"",
            &[
                (text(false), "a \\\" // b"),
                (Kind::LineComment, " c"),
                (Kind::BlockComment, " d /* e */ "),
                (text(true), "f\"g"),
                (Kind::Bytes, "h"),
            ],
        );
    }

    #[test]
    fn doc_comments() {
        check(
            "/// A\n//! B\n//// C\n/** D */ /***/",
            &[
                (Kind::LineDoc { is_inner: false }, " A"),
                (Kind::LineDoc { is_inner: true }, " B"),
                (Kind::LineComment, "// C"),
                (Kind::BlockDoc, " D "),
                (Kind::BlockComment, "*"),
            ],
        );
    }

    #[test]
    fn quotes_and_lifetimes() {
        check(
            "'a' '\\'' '\\u{e9}' 'é' &'a b'\\n' 1.5e-3 0..2",
            &[
                (Kind::Char, "'a'"),
                (Kind::Char, "'\\''"),
                (Kind::Char, "'\\u{e9}'"),
                (Kind::Char, "'é'"),
                (Kind::Punct(b'&'), "&"),
                (Kind::Lifetime, "'a"),
                (Kind::Char, "b'\\n'"),
                (Kind::Number, "1.5e-3"),
                (Kind::Number, "0"),
                (Kind::Punct(b'.'), "."),
                (Kind::Punct(b'.'), "."),
                (Kind::Number, "2"),
            ],
        );
    }

    #[test]
    fn unclosed_ends_with_the_text() {
        for source in ["\"a", "\"a\\", "/* a", "r#\"a\"", "'", "b'", "'\\", "/**", "\"\\é"] {
            assert!(!tokens(source).is_empty(), "{source}");
        }
    }

    #[test]
    fn brackets_are_matched() {
        let tokens = tokens("a(b[c]{)");
        assert_eq!(closers(&tokens), [0, 8, 2, 5, 4, 5, 7, 7]);
    }
}
