//! Tokenizer.

use std::ops::Range;

use super::error::{ExpressionError, Outcome};
use super::literal;

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    Name,
    Int(i128),
    Float(f64),
    /// String literal, still encoded, see [`literal::StringSource`].
    String(literal::StringSource),
    Sign(&'static str),
    End,
}

#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub(super) token: Token,
    pub(super) range: Range<usize>,
}

/// Longest first. Signs of other languages are included, so that the error can name them.
const SIGNS: &[&str] = &[
    "**=", "//=", "<<=", ">>=", "...", "**", "//", "<<", ">>", "<=", ">=", "==", "!=", "<>", "->",
    ":=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "@=", "&&", "||", "+", "-", "*", "/",
    "%", "&", "|", "^", "~", "<", ">", "(", ")", "[", "]", "{", "}", ",", ":", ".", "=", "!", "@",
    ";",
];

/// Tokens of `text[within]`; the last is [`Token::End`].
pub(super) fn tokenize(text: &str, within: Range<usize>) -> Outcome<Vec<Placed>> {
    let mut tokens = Vec::new();
    let mut brackets = 0_usize;
    let mut at = within.start;
    let text = &text[..within.end];
    while let Some(first) = text[at..].chars().next() {
        let start = at;
        let rest = &text[at..];
        let token = match first {
            ' ' | '\t' | '\u{c}' => {
                at += 1;
                continue;
            }
            // A line break ends a Python expression unless a bracket is open or only blanks follow.
            '\n' | '\r' if brackets > 0 || tokens.is_empty() || is_blank(rest) => {
                at += 1;
                continue;
            }
            '\n' | '\r' => {
                return Err(ExpressionError::new("the expression continues after a line break")
                    .with_help("put it in parentheses to write it over several lines")
                    .at(&(start..start + 1)));
            }
            '#' => {
                at += rest.find('\n').unwrap_or(rest.len());
                continue;
            }
            '\\' if rest[1..].starts_with('\n') || rest[1..].starts_with("\r\n") => {
                at += rest.find('\n').unwrap_or(0) + 1;
                continue;
            }
            '0'..='9' => literal::number(text, &mut at)?,
            '.' if rest[1..].starts_with(|next: char| next.is_ascii_digit()) => {
                literal::number(text, &mut at)?
            }
            _ if literal::string_prefix(rest).is_some() => {
                Token::String(literal::string(text, &mut at)?)
            }
            _ if first == '_' || first.is_alphabetic() => {
                at += rest
                    .find(|next: char| next != '_' && !next.is_alphanumeric())
                    .unwrap_or(rest.len());
                Token::Name
            }
            _ => {
                let Some(sign) = SIGNS.iter().find(|sign| rest.starts_with(**sign)) else {
                    return Err(unexpected(first).at(&(start..start + first.len_utf8())));
                };
                match *sign {
                    "(" | "[" | "{" => brackets += 1,
                    ")" | "]" | "}" => brackets = brackets.saturating_sub(1),
                    _ => {}
                }
                at += sign.len();
                Token::Sign(sign)
            }
        };
        tokens.push(Placed { token, range: start..at });
    }
    tokens.push(Placed { token: Token::End, range: at..at });
    Ok(tokens)
}

/// Returns true if only blanks, line breaks and comments follow.
fn is_blank(rest: &str) -> bool {
    rest.lines().all(|line| line.trim_start().is_empty() || line.trim_start().starts_with('#'))
}

fn unexpected(sign: char) -> ExpressionError {
    let error = ExpressionError::new(format!("unexpected character `{}`", sign.escape_debug()));
    match sign {
        '$' => error.with_help(
            "`$` is not needed inside an expression: write the name of a property without it",
        ),
        '?' => error.with_help("write a choice as `a if condition else b`"),
        '\u{2018}'..='\u{201f}' => error.with_help("use the straight quotes ' or \""),
        '\u{2013}' | '\u{2014}' | '\u{2212}' => error.with_help("use the plain minus sign `-`"),
        '\u{d7}' => error.with_help("use `*` to multiply"),
        _ => error,
    }
}
