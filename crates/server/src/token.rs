//! Tokens: what opens a server to others.

/// A new one, that nobody can guess: 128 bits as 32 hexadecimal digits.
///
/// # Errors
/// When the system has no random numbers.
pub fn token() -> Result<String, String> {
    let mut bytes = [0_u8; 16];
    getrandom::fill(&mut bytes).map_err(|error| format!("no random numbers: {error}"))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Whether two are the same, in a time that does not tell where they differ.
pub(crate) fn same(one: &str, other: &str) -> bool {
    let differences = one.bytes().zip(other.bytes()).fold(0, |sum, (a, b)| sum | (a ^ b));
    one.len() == other.len() && differences == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_another() {
        let (one, other) = (token().expect("a token"), token().expect("a token"));
        assert_eq!(one.len(), 32);
        assert!(same(&one, &one.clone()));
        assert!(!same(&one, &other) && !same(&one, "") && !same(&one, &one[..31]));
    }
}
