//! Paths of Windows without their verbatim prefix.

/// Returns a path as users write it: `C:\a` for `\\?\C:\a`, and `\\server\a` for `\\?\UNC\server\a`. In a verbatim path
/// `/` separates nothing, and messages with one look wrong. Other verbatim paths stay, since they cannot be written otherwise.
pub(crate) fn without_prefix(path: &str) -> Option<String> {
    let rest = path.strip_prefix(r"\\?\")?;
    if let Some(share) = rest.strip_prefix(r"UNC\") {
        return Some(format!(r"\\{share}"));
    }
    let mut letters = rest.chars();
    let is_drive = letters.next().is_some_and(|letter| letter.is_ascii_alphabetic())
        && letters.next() == Some(':')
        && letters.next() == Some('\\');
    // Longer paths need the prefix.
    (is_drive && rest.len() < MAX_PATH_CHARACTERS).then(|| rest.to_owned())
}

/// Maximum length of a path without the prefix (`MAX_PATH` of Windows).
const MAX_PATH_CHARACTERS: usize = 260;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drives_and_shares_lose_the_prefix() {
        let of = without_prefix;
        assert_eq!(of(r"\\?\C:\robots\a.urdf").as_deref(), Some(r"C:\robots\a.urdf"));
        assert_eq!(of(r"\\?\UNC\server\maps").as_deref(), Some(r"\\server\maps"));
        assert_eq!(of(r"\\?\Volume{1}\a"), None);
        assert_eq!(of(r"C:\a"), None);
        assert_eq!(of(&format!(r"\\?\C:\{}", "a".repeat(MAX_PATH_CHARACTERS))), None);
    }

    /// Regression test: files that a robot includes were named `\\?\C:\...` in messages.
    #[cfg(windows)]
    #[test]
    fn canonical_paths_have_no_prefix() {
        let folder = crate::fs::canonicalize(std::env::temp_dir()).unwrap();
        assert!(!folder.display().to_string().starts_with(r"\\?\"), "{folder:?}");
        assert!(folder.is_dir());
    }
}
