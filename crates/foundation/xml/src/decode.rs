//! Decoding of bytes.

use std::borrow::Cow;
use std::fmt;

/// Error of a file that is not in its encoding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EncodingError {
    /// Not UTF-8, in this line, from 1.
    NotUtf8 {
        /// Line, from 1.
        line: usize,
    },
    /// Not UTF-16 after its byte order mark.
    NotUtf16,
}

impl fmt::Display for EncodingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotUtf8 { line } => write!(
                f,
                "line {line} holds bytes that are not UTF-8; save the file as UTF-8, or name its \
                 encoding in the first line: <?xml version=\"1.0\" encoding=\"iso-8859-1\"?>"
            ),
            Self::NotUtf16 => write!(
                f,
                "the byte order mark is that of UTF-16, but the bytes are not; save it as UTF-8"
            ),
        }
    }
}

impl std::error::Error for EncodingError {}

/// Decodes a file: UTF-8 with or without a byte order mark, UTF-16 with one, and ISO-8859-1 if declared.
///
/// # Errors
/// If the bytes are not in their encoding.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, EncodingError> {
    match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => utf8(rest),
        [0xFF, 0xFE, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xFE, 0xFF, rest @ ..] => utf16(rest, u16::from_be_bytes),
        _ => match declared_encoding(bytes).as_deref() {
            Some("iso-8859-1" | "latin-1" | "latin1" | "windows-1252") => {
                Ok(bytes.iter().map(|&byte| char::from(byte)).collect::<String>().into())
            }
            _ => utf8(bytes),
        },
    }
}

fn utf8(bytes: &[u8]) -> Result<Cow<'_, str>, EncodingError> {
    std::str::from_utf8(bytes).map(Cow::Borrowed).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        EncodingError::NotUtf8 { line }
    })
}

fn utf16(bytes: &[u8], read: fn([u8; 2]) -> u16) -> Result<Cow<'static, str>, EncodingError> {
    let (units, odd) = bytes.as_chunks::<2>();
    let units = units.iter().map(|&unit| read(unit));
    let text: Result<String, _> = char::decode_utf16(units).collect();
    match text {
        Ok(text) if odd.is_empty() => Ok(text.into()),
        _ => Err(EncodingError::NotUtf16),
    }
}

fn declared_encoding(bytes: &[u8]) -> Option<String> {
    let head = &bytes[..bytes.len().min(200)];
    let head: String = head.iter().map(|&byte| char::from(byte)).collect();
    let declaration = head.strip_prefix("<?xml")?.split("?>").next()?;
    let value = declaration.split("encoding").nth(1)?.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|quote| matches!(quote, '"' | '\''))?;
    Some(value[1..].split(quote).next()?.to_lowercase())
}

#[cfg(test)]
mod tests {
    use super::decode;

    #[test]
    fn encodings_of_real_files() {
        assert_eq!(decode("\u{feff}<a/>".as_bytes()).unwrap(), "<a/>");
        assert_eq!(decode(b"\xFF\xFE<\0a\0/\0>\0").unwrap(), "<a/>");
        let latin = b"<?xml version='1.0' encoding='ISO-8859-1'?><a>\xE9</a>";
        assert!(decode(latin).unwrap().ends_with("<a>é</a>"));
        assert!(decode(b"<a>\n\xE9</a>").unwrap_err().to_string().starts_with("line 2 holds"));
    }
}
