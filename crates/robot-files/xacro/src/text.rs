//! Splits text into plain pieces, `${expressions}` and `$(extensions)`.

use std::ops::Range;

/// A piece of a text, by its byte range.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Piece {
    /// Literal characters.
    Plain(Range<usize>),
    /// Content of `${...}`.
    Expression(Range<usize>),
    /// Content of `$(...)`.
    Extension(Range<usize>),
    /// `${` or `$(` without its closing bracket.
    Unclosed(Range<usize>),
}

/// Splits a text. `$${` and `$$(` are escapes of a literal dollar sign with its bracket.
pub(crate) fn pieces(text: &str) -> Vec<Piece> {
    let bytes = text.as_bytes();
    let mut pieces = Vec::new();
    let mut paired = Paired { is_hopeless: false };
    let mut plain_from = 0;
    let mut at = 0;
    while let Some(dollar) = text[at..].find('$').map(|offset| at + offset) {
        let run = bytes[dollar..].iter().take_while(|&&byte| byte == b'$').count();
        let bracket = dollar + run;
        let Some(open @ (b'{' | b'(')) = bytes.get(bracket).copied() else {
            at = bracket;
            continue;
        };
        if run > 1 {
            // One dollar sign of the run is the escape; the rest, and the bracket, stay.
            pieces.push(Piece::Plain(plain_from..dollar));
            pieces.push(Piece::Plain(dollar + 1..bracket + 1));
            (plain_from, at) = (bracket + 1, bracket + 1);
            continue;
        }
        if plain_from < dollar {
            pieces.push(Piece::Plain(plain_from..dollar));
        }
        let inner = bracket + 1;
        let end = match open {
            b'{' => closing_brace(text, inner, &mut paired),
            _ => closing_paren(text, inner, &mut paired),
        };
        let Some(end) = end else {
            pieces.push(Piece::Unclosed(dollar..text.len()));
            return pieces;
        };
        pieces.push(match open {
            b'{' => Piece::Expression(inner..end),
            _ => Piece::Extension(inner..end),
        });
        (plain_from, at) = (end + 1, end + 1);
    }
    if plain_from < text.len() {
        pieces.push(Piece::Plain(plain_from..text.len()));
    }
    pieces.retain(|piece| !matches!(piece, Piece::Plain(range) if range.is_empty()));
    pieces
}

/// Position of the brace that closes an expression. The reference stops at the first `}`; here braces of
/// dicts and in strings are skipped, so `${{'a': 1}['a']}` works.
fn closing_brace(text: &str, from: usize, paired: &mut Paired) -> Option<usize> {
    paired.end(text, from, b'{', b'}').or_else(|| text[from..].find('}').map(|end| from + end))
}

/// Position of the parenthesis that closes an extension: for `$(eval ...)` the matching one, for other
/// commands the first.
fn closing_paren(text: &str, from: usize, paired: &mut Paired) -> Option<usize> {
    if text[from..].starts_with("eval ")
        && let Some(end) = paired.end(text, from, b'(', b')')
    {
        return Some(end);
    }
    // An expression inside, as in `$(find ${pkg(1)})`, may contain parentheses.
    let mut at = from;
    loop {
        let offset = text[at..].find(['$', ')'])?;
        let stop = at + offset;
        if text.as_bytes()[stop] == b')' {
            return Some(stop);
        }
        at = if text[stop..].starts_with("${") {
            closing_brace(text, stop + 2, paired)? + 1
        } else {
            stop + 1
        };
    }
}

/// Search for closing brackets. Remembers that a bracket was not found up to the end of the text, so that a
/// hostile text with a million opening brackets does not take quadratic time.
struct Paired {
    is_hopeless: bool,
}

impl Paired {
    fn end(&mut self, text: &str, from: usize, open: u8, close: u8) -> Option<usize> {
        if self.is_hopeless {
            return None;
        }
        let end = balanced(text, from, open, close);
        self.is_hopeless = end.is_none();
        end
    }
}

fn balanced(text: &str, from: usize, open: u8, close: u8) -> Option<usize> {
    let mut depth = 0_usize;
    let mut quote = None;
    let mut escaped = false;
    for (offset, byte) in text.bytes().enumerate().skip(from) {
        if let Some(mark) = quote {
            match byte {
                _ if escaped => escaped = false,
                b'\\' => escaped = true,
                _ if byte == mark => quote = None,
                _ => {}
            }
        } else if byte == b'\'' || byte == b'"' {
            quote = Some(byte);
        } else if byte == open {
            depth += 1;
        } else if byte == close {
            if depth == 0 {
                return Some(offset);
            }
            depth -= 1;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use proptest::prelude::*;

    use super::*;

    fn check(text: &str, expected: Expect) {
        let shown: Vec<String> = pieces(text)
            .into_iter()
            .map(|piece| match piece {
                Piece::Plain(range) => format!("plain <{}>", &text[range]),
                Piece::Expression(range) => format!("expression <{}>", &text[range]),
                Piece::Extension(range) => format!("extension <{}>", &text[range]),
                Piece::Unclosed(range) => format!("unclosed <{}>", &text[range]),
            })
            .collect();
        expected.assert_eq(&shown.join("\n"));
    }

    #[test]
    fn expressions_and_extensions() {
        check(
            "a${b}$(c d)e",
            expect![[r#"
            plain <a>
            expression <b>
            extension <c d>
            plain <e>"#]],
        );
    }

    #[test]
    fn escapes() {
        check(
            "$${a} $$$(b) $5 $",
            expect![[r#"
            plain <${>
            plain <a} >
            plain <$$(>
            plain <b) $5 $>"#]],
        );
    }

    #[test]
    fn braces_in_dicts_and_strings() {
        check("${{'}': 1}['}']}", expect!["expression <{'}': 1}['}']>"]);
    }

    #[test]
    fn parentheses_in_eval_and_in_expressions() {
        check(
            "$(eval arg('x') + 1)|$(find ${f(1)})/x",
            expect![[r#"
            extension <eval arg('x') + 1>
            plain <|>
            extension <find ${f(1)}>
            plain </x>"#]],
        );
    }

    #[test]
    fn what_nothing_closes() {
        check(
            "a ${b",
            expect![[r#"
            plain <a >
            unclosed <${b>"#]],
        );
    }

    proptest! {
        #[test]
        fn any_text_is_cut(text in "[${}()'a\\\\é]{0,30}") {
            let _ = pieces(&text);
        }
    }
}
