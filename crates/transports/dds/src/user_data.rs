//! `USER_DATA` of participants and endpoints: `key=value;` pairs.
//!
//! Source: handling of `typehash=` and `enclave=` in `rmw_dds_common` and `rmw_cyclonedds`.

/// Encodes the type hash of an endpoint.
#[must_use]
pub fn type_hash(hash: &str) -> Vec<u8> {
    format!("typehash={hash};").into_bytes()
}

/// Encodes the security enclave of a participant.
#[must_use]
pub fn enclave(enclave: &str) -> Vec<u8> {
    format!("enclave={enclave};").into_bytes()
}

/// Returns the value of a key.
#[must_use]
pub fn value<'a>(user_data: &'a [u8], key: &str) -> Option<&'a str> {
    let text = std::str::from_utf8(user_data).ok()?;
    let mut pairs = text.trim_end_matches('\0').split(';');
    pairs.find_map(|pair| pair.strip_prefix(key)?.strip_prefix('='))
}

/// Returns the type hash, if it is valid.
#[must_use]
pub fn hash_of(user_data: &[u8]) -> Option<String> {
    let hash = value(user_data, "typehash")?;
    let digits = hash.strip_prefix("RIHS01_")?;
    let is_hex = digits.len() == 64 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    is_hex.then(|| hash.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_read() {
        let hash = format!("RIHS01_{}", "0a".repeat(32));
        assert_eq!(hash_of(&type_hash(&hash)), Some(hash.clone()));
        assert_eq!(hash_of(format!("a=b;typehash={hash};c=d;").as_bytes()), Some(hash));
        assert_eq!(value(&enclave("/"), "enclave"), Some("/"));
        for bad in [&b""[..], b"typehash=", b"typehash=RIHS01_12;", b"\xff\xfe", b"typehashes=1;"] {
            assert_eq!(hash_of(bad), None);
        }
    }
}
