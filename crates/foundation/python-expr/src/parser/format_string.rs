//! f-strings: `f'{side}_wheel{count:02d}'`.

use std::ops::Range;

use super::super::ast::Piece;
use super::super::error::{ExpressionError, Outcome};
use super::super::literal::{StringSource, string, string_prefix, unescape};
use super::Parser;

impl Parser<'_> {
    pub(super) fn format_pieces(&self, source: &StringSource) -> Outcome<Vec<Piece>> {
        let mut at = source.body.start;
        let pieces = self.pieces(&mut at, source.body.end, source.is_raw, false)?;
        Ok(pieces)
    }

    /// Pieces from `at` to `end`, or in a format specification to the closing brace of its field.
    fn pieces(
        &self,
        at: &mut usize,
        end: usize,
        is_raw: bool,
        in_specification: bool,
    ) -> Outcome<Vec<Piece>> {
        let mut pieces = Vec::new();
        let mut text = String::new();
        let mut start = *at;
        while *at < end {
            let rest = &self.text[*at..end];
            let brace = match rest.as_bytes()[0] {
                b'\\' if !is_raw => {
                    // Escape; `\N{...}` is refused when the piece is decoded.
                    *at += 1 + rest[1..].chars().next().map_or(0, char::len_utf8);
                    continue;
                }
                brace @ (b'{' | b'}') => brace,
                _ => {
                    *at += rest.chars().next().map_or(1, char::len_utf8);
                    continue;
                }
            };
            text.push_str(&unescape(self.text, start..*at, is_raw)?);
            if !in_specification && rest.as_bytes().get(1) == Some(&brace) {
                text.push(brace as char);
                *at += 2;
            } else if brace == b'{' {
                if !text.is_empty() {
                    pieces.push(Piece::Text(std::mem::take(&mut text).into()));
                }
                *at += 1;
                self.field(at, end, is_raw, in_specification, &mut pieces)?;
            } else if in_specification {
                start = *at;
                break;
            } else {
                return Err(ExpressionError::new("a single `}` in an f-string")
                    .with_help("double it: `}}`")
                    .at(&(*at..*at + 1)));
            }
            start = *at;
        }
        text.push_str(&unescape(self.text, start..*at, is_raw)?);
        if !text.is_empty() {
            pieces.push(Piece::Text(text.into()));
        }
        Ok(pieces)
    }

    /// Field after `{` up to and including `}`.
    fn field(
        &self,
        at: &mut usize,
        end: usize,
        is_raw: bool,
        in_specification: bool,
        pieces: &mut Vec<Piece>,
    ) -> Outcome<()> {
        let opened = *at - 1;
        let unclosed = || {
            ExpressionError::new("a `{` in an f-string is not closed")
                .with_help("close it with `}`, or double it: `{{`")
                .at(&(opened..end))
        };
        let expression = self.field_expression(*at, end).ok_or_else(unclosed)?;
        *at = expression.end;
        if self.text[expression.clone()].trim().is_empty() {
            return Err(ExpressionError::new("an f-string field is empty").at(&(opened..*at + 1)));
        }
        let mut parser = Parser::new(self.text, expression.clone(), self.nesting)?;
        let value = parser.nested(|parser| parser.tuple_or_expression())?;
        parser.expect_end()?;
        let mut conversion = None;
        let byte = |at: usize| self.text.as_bytes()[..end].get(at).copied();
        let is_debug = byte(*at) == Some(b'=');
        if is_debug {
            *at += 1;
            while byte(*at).is_some_and(|byte| byte.is_ascii_whitespace()) {
                *at += 1;
            }
            pieces.push(Piece::Text(self.text[expression.start..*at].into()));
        }
        if byte(*at) == Some(b'!') {
            conversion =
                byte(*at + 1).map(char::from).filter(|letter| matches!(letter, 'r' | 's' | 'a'));
            if conversion.is_none() {
                return Err(ExpressionError::new("behind `!` one of `r`, `s` and `a` is needed")
                    .at(&(*at..*at + 1)));
            }
            *at += 2;
        }
        let mut format = Vec::new();
        if byte(*at) == Some(b':') {
            if in_specification {
                return Err(
                    ExpressionError::new("f-string fields nest too deeply").at(&(opened..*at))
                );
            }
            *at += 1;
            format = self.pieces(at, end, is_raw, true)?;
        } else if is_debug && conversion.is_none() {
            conversion = Some('r');
        }
        if byte(*at) != Some(b'}') {
            return Err(unclosed());
        }
        *at += 1;
        pieces.push(Piece::Field { value, conversion, format });
        Ok(())
    }

    /// Expression of a field: up to `}`, `:`, `=` or `!` outside brackets and strings.
    fn field_expression(&self, start: usize, end: usize) -> Option<Range<usize>> {
        let text = &self.text[..end];
        let mut at = start;
        let mut brackets = 0_usize;
        while let Some(letter) = text[at..].chars().next() {
            let rest = &text[at..];
            match letter {
                '(' | '[' | '{' => brackets += 1,
                ')' | ']' => brackets = brackets.saturating_sub(1),
                '}' if brackets > 0 => brackets -= 1,
                '}' | ':' if brackets == 0 => return Some(start..at),
                '!' if brackets == 0 && !rest.starts_with("!=") => return Some(start..at),
                '=' | '<' | '>' | '!' if rest[1..].starts_with('=') => at += 1,
                '=' if brackets == 0 => return Some(start..at),
                '\'' | '"' => {
                    debug_assert!(string_prefix(rest).is_some());
                    string(text, &mut at).ok()?;
                    continue;
                }
                _ => {}
            }
            at += letter.len_utf8();
        }
        None
    }
}
