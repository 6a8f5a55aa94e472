//! Tokens of the script language.

use std::ops::Range;

use super::{MAX_SCRIPT_TOKEN_COUNT, ScriptError};

#[derive(Clone, Debug, PartialEq)]
pub(super) enum TokenKind {
    Int(i64),
    Real(f64),
    Text(String),
    Bool(bool),
    Name(String),
    /// Operator or separator.
    Mark(&'static str),
    End,
}

#[derive(Clone, Debug)]
pub(super) struct Token {
    pub(super) kind: TokenKind,
    pub(super) range: Range<usize>,
}

/// All operators, longer ones before their prefixes.
const MARKS: [&str; 27] = [
    "&&", "||", "==", "!=", "<=", ">=", ":=", "+=", "-=", "*=", "/=", "..", "+", "-", "*", "/",
    "&", "|", "^", "~", "!", "<", ">", "=", "?", ":", "(",
];

pub(super) fn tokenize(source: &str) -> Result<Vec<Token>, ScriptError> {
    let bytes = source.as_bytes();
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        if bytes[at].is_ascii_whitespace() {
            at += 1;
            continue;
        }
        let (kind, end) = token(source, at)?;
        tokens.push(Token { kind, range: at..end });
        at = end;
        if tokens.len() > MAX_SCRIPT_TOKEN_COUNT {
            let message = format!("the script has more than {MAX_SCRIPT_TOKEN_COUNT} tokens");
            return Err(ScriptError::new(message, at..source.len()));
        }
    }
    tokens.push(Token { kind: TokenKind::End, range: source.len()..source.len() });
    Ok(tokens)
}

fn token(source: &str, start: usize) -> Result<(TokenKind, usize), ScriptError> {
    let rest = &source[start..];
    let first = rest.as_bytes()[0];
    if first == b'\'' {
        let Some(length) = rest[1..].find('\'') else {
            let message = "a text begins here and is never closed with `'`";
            return Err(ScriptError::new(message, start..source.len()));
        };
        return Ok((TokenKind::Text(rest[1..=length].to_owned()), start + length + 2));
    }
    if first.is_ascii_digit() {
        return number(rest, start);
    }
    if first.is_ascii_alphabetic() || first == b'_' || first == b'@' {
        let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        let length = 1 + rest.bytes().skip(1).take_while(is_part).count();
        let kind = match &rest[..length] {
            "true" => TokenKind::Bool(true),
            "false" => TokenKind::Bool(false),
            name => TokenKind::Name(name.to_owned()),
        };
        return Ok((kind, start + length));
    }
    for mark in MARKS.into_iter().chain([")", ";"]) {
        if rest.starts_with(mark) {
            return Ok((TokenKind::Mark(mark), start + mark.len()));
        }
    }
    let length = rest.chars().next().map_or(1, char::len_utf8);
    let message = format!("unexpected character `{}`", &rest[..length]);
    Err(ScriptError::new(message, start..start + length))
}

fn number(rest: &str, start: usize) -> Result<(TokenKind, usize), ScriptError> {
    let bytes = rest.as_bytes();
    let digits =
        |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let wrong = |length: usize| {
        let message = format!("`{}` is not a number", &rest[..length]);
        ScriptError::new(message, start..start + length)
    };
    if rest.starts_with("0x") || rest.starts_with("0X") {
        let length = 2 + bytes[2..].iter().take_while(|byte| byte.is_ascii_hexdigit()).count();
        let value = i64::from_str_radix(&rest[2..length], 16).map_err(|_| wrong(length))?;
        return Ok((TokenKind::Int(value), start + length));
    }
    let mut length = digits(0);
    let mut is_real = false;
    // `1..2` joins two numbers.
    if bytes.get(length) == Some(&b'.') && bytes.get(length + 1) != Some(&b'.') {
        is_real = true;
        length += 1 + digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            is_real = true;
            length += 1 + sign + exponent;
        }
    }
    if bytes.get(length).is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_') {
        return Err(wrong(length + 1));
    }
    let text = &rest[..length];
    let kind = if is_real {
        TokenKind::Real(text.parse().map_err(|_| wrong(length))?)
    } else {
        TokenKind::Int(text.parse().map_err(|_| wrong(length))?)
    };
    Ok((kind, start + length))
}
