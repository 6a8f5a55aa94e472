//! Decoding of bytes.

use std::borrow::Cow;

/// Decodes a file: UTF-8 with or without a byte order mark, UTF-16 with one, and ISO-8859-1 if declared.
///
/// # Errors
/// What is wrong with the bytes, and what to do.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, String> {
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

fn utf8(bytes: &[u8]) -> Result<Cow<'_, str>, String> {
    std::str::from_utf8(bytes).map(Cow::Borrowed).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        format!(
            "line {line} holds bytes that are not UTF-8; save the file as UTF-8, or name its \
             encoding in the first line: <?xml version=\"1.0\" encoding=\"iso-8859-1\"?>"
        )
    })
}

fn utf16(bytes: &[u8], read: fn([u8; 2]) -> u16) -> Result<Cow<'static, str>, String> {
    let (units, odd) = bytes.as_chunks::<2>();
    let units = units.iter().map(|&unit| read(unit));
    let text: Result<String, _> = char::decode_utf16(units).collect();
    match text {
        Ok(text) if odd.is_empty() => Ok(text.into()),
        _ => {
            Err("the byte order mark is that of UTF-16, but the bytes are not; save it as UTF-8"
                .into())
        }
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
        assert!(decode(b"<a>\n\xE9</a>").unwrap_err().starts_with("line 2 holds"));
    }
}
