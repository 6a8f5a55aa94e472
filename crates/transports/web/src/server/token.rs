//! Access tokens of the server.

use std::fmt;

use sha2::{Digest as _, Sha256};

/// Minimum length of a token for access from other machines \[characters\], so that it cannot be
/// guessed.
pub const MIN_TOKEN_CHARACTERS: usize = 16;

/// Reason for which no token was generated: the system has no random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TokenError(getrandom::Error);

impl fmt::Display for TokenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the system has no random numbers: {}", self.0)
    }
}

impl std::error::Error for TokenError {}

/// Generates a random token: 128 bits as 32 hexadecimal digits.
///
/// # Errors
/// When the system has no random numbers.
pub fn token() -> Result<String, TokenError> {
    let mut bytes = [0_u8; 16];
    getrandom::fill(&mut bytes).map_err(TokenError)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Compares two tokens in constant time by their hashes, so that the time reveals neither a
/// difference nor the length.
pub(crate) fn same(one: &[u8], other: &[u8]) -> bool {
    let (one, other) = (Sha256::digest(one), Sha256::digest(other));
    one.iter().zip(&other).fold(0, |sum, (a, b)| sum | (a ^ b)) == 0
}

/// Percent-encodes a token for a URL: all but letters, digits and `-._~` (RFC 3986, section 2.1).
pub(crate) fn encoded(token: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~".contains(&byte);
    let written = token.bytes().map(|byte| {
        if is_plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") }
    });
    written.collect()
}

/// Decodes percent-encoded text. A `%` without two digits is kept.
pub(crate) fn decoded(text: &str) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, after @ ..] = rest {
        let digit = |place: usize| after.get(place).and_then(|byte| char::from(*byte).to_digit(16));
        let byte =
            digit(0).zip(digit(1)).and_then(|(high, low)| u8::try_from(16 * high + low).ok());
        match byte.filter(|_| *first == b'%') {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_another() {
        let (one, other) = (token().expect("a token"), token().expect("a token"));
        assert_eq!(one.len(), 32);
        let (one, other) = (one.as_bytes(), other.as_bytes());
        assert!(same(one, one));
        assert!(!same(one, other) && !same(one, b"") && !same(one, &one[..31]));
    }

    #[test]
    fn odd_characters_survive_an_address() {
        for token in ["plain-._~", "a b+c/ü%&=#?", "%", "%zz", "%4", "日本"] {
            let address = encoded(token);
            assert!(address.is_ascii() && !address.contains(['&', '#', ' ', '+', '?', '=']));
            assert_eq!(decoded(&address), token.as_bytes(), "{address}");
        }
        assert_eq!(decoded("%zz%4%"), b"%zz%4%");
    }
}
