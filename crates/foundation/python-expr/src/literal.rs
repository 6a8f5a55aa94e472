//! Number and string literals.

use std::ops::Range;

use super::error::{ExpressionError, Outcome, fail};
use super::number::too_large;
use super::token::Token;

/// String literal as written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct StringSource {
    /// Range between the quotes.
    pub(super) body: Range<usize>,
    pub(super) is_raw: bool,
    pub(super) is_format: bool,
}

/// Parses the number at `at` and advances.
pub(super) fn number(text: &str, at: &mut usize) -> Outcome<Token> {
    let start = *at;
    let rest = &text[start..];
    let bytes = rest.as_bytes();
    let radix = match bytes.get(1).map(u8::to_ascii_lowercase) {
        Some(b'x') if bytes[0] == b'0' => 16,
        Some(b'o') if bytes[0] == b'0' => 8,
        Some(b'b') if bytes[0] == b'0' => 2,
        _ => 10,
    };
    let mut end = if radix == 10 { 0 } else { 2 };
    let mut is_float = false;
    while let Some(&byte) = bytes.get(end) {
        match byte {
            b'.' if radix == 10 && !is_float => is_float = true,
            b'e' | b'E' if radix == 10 => {
                let signed = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
                if !bytes.get(end + 1 + signed).is_some_and(u8::is_ascii_digit) {
                    break;
                }
                is_float = true;
                end += 1 + signed;
                while bytes.get(end).is_some_and(|byte| byte.is_ascii_digit() || *byte == b'_') {
                    end += 1;
                }
                break;
            }
            b'_' => {}
            _ if (byte as char).is_digit(radix) => {}
            _ => break,
        }
        end += 1;
    }
    let range = start..start + end;
    *at = range.end;
    if let Some(next) = text[range.end..].chars().next()
        && (next.is_alphanumeric() || next == '_')
        && !followed_by_keyword(&text[range.end..])
    {
        let message = if matches!(next, 'j' | 'J') && radix == 10 {
            "complex numbers are not supported".to_owned()
        } else {
            format!("the number `{}` runs into `{next}`", &text[range.clone()])
        };
        return Err(ExpressionError::new(message).at(&(start..range.end + next.len_utf8())));
    }
    let digits = &rest[..end];
    if is_float {
        return match digits_without_underscores(digits).and_then(|digits| digits.parse().ok()) {
            Some(float) => Ok(Token::Float(float)),
            None => Err(ExpressionError::new(format!("`{digits}` is not a number")).at(&range)),
        };
    }
    if radix == 10
        && digits.len() > 1
        && digits.starts_with('0')
        && digits.bytes().any(|byte| matches!(byte, b'1'..=b'9'))
    {
        return Err(ExpressionError::new(format!("the integer `{digits}` starts with a zero"))
            .with_help("drop the leading zeros, or write `0o` for an octal number")
            .at(&range));
    }
    integer(digits, if radix == 10 { 10 } else { 0 })
        .map(Token::Int)
        .map_err(|error| error.at(&range))
}

/// `1if x else 2` and `1or 2` are (deprecated but) valid Python.
fn followed_by_keyword(rest: &str) -> bool {
    ["and", "else", "for", "if", "in", "is", "not", "or"].iter().any(|word| {
        rest.strip_prefix(word).is_some_and(|rest| {
            !rest.starts_with(|next: char| next == '_' || next.is_alphanumeric())
        })
    })
}

/// Single underscores are allowed between digits only.
fn digits_without_underscores(digits: &str) -> Option<String> {
    let bytes = digits.as_bytes();
    let well_placed = (0..bytes.len()).filter(|&index| bytes[index] == b'_').all(|index| {
        index > 0
            && bytes[index - 1].is_ascii_alphanumeric()
            && bytes.get(index + 1).is_some_and(u8::is_ascii_alphanumeric)
    });
    well_placed.then(|| digits.replace('_', ""))
}

/// `int(text, base)`; base 0 uses the prefix.
pub(super) fn integer(text: &str, base: u32) -> Outcome<i128> {
    let not_an_integer = || {
        ExpressionError::new(format!(
            "`{}` is not an integer in base {}",
            text.escape_debug(),
            if base == 0 { 10 } else { base }
        ))
    };
    let trimmed = text.trim();
    let (is_negative, unsigned) = match trimmed.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, trimmed.strip_prefix('+').unwrap_or(trimmed)),
    };
    let prefixed = match unsigned.get(..2).map(str::to_ascii_lowercase).as_deref() {
        Some("0x") => 16,
        Some("0o") => 8,
        Some("0b") => 2,
        _ => 0,
    };
    let has_prefix = prefixed != 0 && (base == 0 || base == prefixed);
    let radix = match base {
        0 if has_prefix => prefixed,
        0 => 10,
        _ => base,
    };
    let digits = if has_prefix {
        unsigned[2..].strip_prefix('_').unwrap_or(&unsigned[2..])
    } else {
        unsigned
    };
    let digits = digits_without_underscores(digits).ok_or_else(not_an_integer)?;
    if digits.is_empty() || !digits.chars().all(|digit| digit.is_digit(radix)) {
        return Err(not_an_integer());
    }
    if base == 0
        && !has_prefix
        && digits.starts_with('0')
        && digits.bytes().any(|byte| byte != b'0')
    {
        return Err(not_an_integer());
    }
    let signed = if is_negative { format!("-{digits}") } else { digits };
    i128::from_str_radix(&signed, radix).map_err(|_| too_large())
}

/// `float(text)`.
pub(super) fn float(text: &str) -> Outcome<f64> {
    let parsed = digits_without_underscores(text.trim()).and_then(|digits| digits.parse().ok());
    match parsed {
        Some(float) => Ok(float),
        None => fail(format!("`{}` is not a number", text.escape_debug())),
    }
}

/// Length of the prefix letters before the quote, if a string literal starts here.
pub(super) fn string_prefix(rest: &str) -> Option<usize> {
    let length = rest.bytes().take_while(|byte| b"rRbBuUfF".contains(byte)).count();
    let quote = rest.as_bytes().get(length)?;
    (length <= 2 && matches!(quote, b'\'' | b'"')).then_some(length)
}

/// Finds the end of the string literal at `at` and advances.
pub(super) fn string(text: &str, at: &mut usize) -> Outcome<StringSource> {
    let start = *at;
    let rest = &text[start..];
    let prefix_length = string_prefix(rest).unwrap_or(0);
    let prefix = rest[..prefix_length].to_ascii_lowercase();
    let opened = start + prefix_length;
    if prefix.contains('b') {
        *at = opened;
        return Err(ExpressionError::new("bytes literals are not supported")
            .with_help("drop the `b` before the quote")
            .at(&(start..opened + 1)));
    }
    if !matches!(prefix.as_str(), "" | "r" | "u" | "f" | "fr" | "rf") {
        return Err(ExpressionError::new(format!("`{prefix}` is not a prefix of a string"))
            .at(&(start..opened)));
    }
    let quote = &text[opened..opened + 1];
    let triple = quote.repeat(3);
    let closing = if text[opened..].starts_with(&triple) { triple.as_str() } else { quote };
    let body_start = opened + closing.len();
    let mut end = body_start;
    loop {
        let rest = &text[end..];
        if rest.starts_with(closing) {
            break;
        }
        match rest.chars().next() {
            Some('\\') => end += 1 + rest[1..].chars().next().map_or(0, char::len_utf8),
            Some('\n') if closing.len() == 1 => {
                return Err(ExpressionError::new("a line break in a string")
                    .with_help("write `\\n`, or triple quotes")
                    .at(&(start..end)));
            }
            Some(next) => end += next.len_utf8(),
            None => {
                return Err(ExpressionError::new("the string is not closed")
                    .with_help(format!("add the closing {closing}"))
                    .at(&(start..end)));
            }
        }
    }
    *at = end + closing.len();
    Ok(StringSource {
        body: body_start..end,
        is_raw: prefix.contains('r'),
        is_format: prefix.contains('f'),
    })
}

/// Decodes the escapes of `text[range]`.
pub(super) fn unescape(text: &str, range: Range<usize>, is_raw: bool) -> Outcome<String> {
    let body = &text[range.clone()];
    if is_raw || !body.contains('\\') {
        return Ok(body.replace("\r\n", "\n"));
    }
    let mut result = String::with_capacity(body.len());
    let mut rest = body;
    while let Some(position) = rest.find('\\') {
        result.push_str(&rest[..position]);
        let start = range.end - rest.len() + position;
        rest = &rest[position + 1..];
        let Some(letter) = rest.chars().next() else { break };
        rest = &rest[letter.len_utf8()..];
        match letter {
            '\n' => {}
            '\\' | '\'' | '"' => result.push(letter),
            'a' => result.push('\u{7}'),
            'b' => result.push('\u{8}'),
            'f' => result.push('\u{c}'),
            'n' => result.push('\n'),
            'r' => result.push('\r'),
            't' => result.push('\t'),
            'v' => result.push('\u{b}'),
            '0'..='7' => {
                let more =
                    rest.bytes().take(2).take_while(|byte| matches!(byte, b'0'..=b'7')).count();
                let digits = format!("{letter}{}", &rest[..more]);
                rest = &rest[more..];
                result.extend(u32::from_str_radix(&digits, 8).ok().and_then(char::from_u32));
            }
            'x' | 'u' | 'U' => {
                let count = match letter {
                    'x' => 2,
                    'u' => 4,
                    _ => 8,
                };
                let digits = rest
                    .get(..count)
                    .filter(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()));
                let decoded = digits
                    .and_then(|digits| u32::from_str_radix(digits, 16).ok())
                    .and_then(char::from_u32);
                let Some(decoded) = decoded else {
                    return Err(ExpressionError::new(format!(
                        "`\\{letter}` needs {count} hexadecimal digits of a character"
                    ))
                    .at(&(start..start + 2)));
                };
                result.push(decoded);
                rest = &rest[count..];
            }
            'N' => {
                return Err(ExpressionError::new("characters by name are not supported")
                    .with_help("write the character itself")
                    .at(&(start..start + 2)));
            }
            // Python keeps a backslash without a valid escape.
            _ => {
                result.push('\\');
                result.push(letter);
            }
        }
    }
    result.push_str(rest);
    Ok(result)
}
