//! Words of a shell.

/// Returns a word as a POSIX shell reads it: in quotes if it has other characters than those of names and paths.
///
/// ```
/// use periplus_os::shell_word;
///
/// assert_eq!(shell_word("/a/b.json"), "/a/b.json");
/// assert_eq!(shell_word("it's"), r"'it'\''s'");
/// ```
#[must_use]
pub fn shell_word(word: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_./:=@,+~".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}
