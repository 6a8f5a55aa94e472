//! Splitting of lines into words as a POSIX shell does.

/// Splits a line; quotes and backslashes as in Python's `shlex.split`. `None` if a quote is
/// unclosed.
pub(crate) fn split(line: &str) -> Option<Vec<String>> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut letters = line.chars();
    while let Some(letter) = letters.next() {
        match letter {
            ' ' | '\t' | '\r' | '\n' => words.extend(word.take()),
            '\'' => {
                let word = word.get_or_insert_default();
                loop {
                    match letters.next()? {
                        '\'' => break,
                        other => word.push(other),
                    }
                }
            }
            '"' => {
                let word = word.get_or_insert_default();
                loop {
                    match letters.next()? {
                        '"' => break,
                        '\\' => match letters.next()? {
                            quoted @ ('"' | '\\') => word.push(quoted),
                            other => word.extend(['\\', other]),
                        },
                        other => word.push(other),
                    }
                }
            }
            '\\' => word.get_or_insert_default().push(letters.next()?),
            other => word.get_or_insert_default().push(other),
        }
    }
    words.extend(word);
    Some(words)
}

#[cfg(test)]
mod tests {
    use super::split;

    #[test]
    fn words_are_those_of_a_shell() {
        let words = split(r#"  xacro 'a b' "c \"d\" \e" f\ g '' "#).unwrap();
        assert_eq!(words, ["xacro", "a b", r#"c "d" \e"#, "f g", ""]);
        assert_eq!(split("it's"), None, "an open quote");
        assert_eq!(split(" "), Some(vec![]));
    }
}
