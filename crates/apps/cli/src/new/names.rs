//! Names of robots, worlds and packages.

/// Checks a name by the rules of ROS 2 packages (REP 144); it is then also a valid model, world and
/// file name.
///
/// # Errors
/// The rule, with the nearest valid name.
pub(super) fn name(word: &str) -> Result<String, String> {
    let is_first = |letter: char| letter.is_ascii_lowercase();
    let is_inner = |letter: char| is_first(letter) || letter.is_ascii_digit() || letter == '_';
    let is_name = word.starts_with(is_first) && word.chars().all(is_inner) && !word.contains("__");
    if is_name && word.len() > 1 {
        return Ok(word.to_owned());
    }
    let mut near = String::new();
    for letter in word.chars() {
        let folded = letter.to_ascii_lowercase();
        match is_inner(folded) {
            true if folded != '_' => near.push(folded),
            _ if near.is_empty() || near.ends_with('_') => {}
            _ => near.push('_'),
        }
    }
    let near = near.trim_end_matches('_').trim_start_matches(|letter: char| !is_first(letter));
    let rule = "a name has two or more lower-case letters, digits and single underscores, and begins \
                with a letter";
    Err(if near.len() > 1 { format!("{rule}; try `{near}`") } else { rule.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::name;

    #[test]
    fn names_are_those_of_packages() {
        assert_eq!(name("my_bot2").as_deref(), Ok("my_bot2"));
        let near = |word: &str| name(word).unwrap_err();
        assert!(near("My-Bot").ends_with("try `my_bot`"));
        assert!(near("../etc/passwd").ends_with("try `etc_passwd`"));
        assert!(near("3d robot").ends_with("try `d_robot`"));
        assert!(near("a").ends_with("begins with a letter") && near("").ends_with("a letter"));
        assert!(near("a<b>\"&").ends_with("try `a_b`"));
    }
}
