//! Steps of a Markdown page.

/// Step with its line in the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Step {
    pub(crate) line: usize,
    pub(crate) what: What,
}

/// Something to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum What {
    /// Commands that end.
    Run(String),
    /// Commands that run on in a terminal.
    Open { terminal: String, commands: String },
    /// Expected output of the last block.
    Prints(Vec<String>),
    /// A file that a reader saves.
    Save { path: String, text: String },
    /// A command that succeeds at once.
    Check(String),
    /// A command that succeeds soon.
    Await(String),
    /// Ends the program in a terminal.
    Close(String),
    /// The page is pictured, with a file of RViz if there is one.
    Picture(String),
}

/// The steps of a page; a line and what is wrong there otherwise.
pub(crate) fn steps(text: &str) -> Result<Vec<Step>, String> {
    let mut steps = Vec::new();
    let mut lines = text.lines().enumerate().map(|(at, line)| (at + 1, line));
    while let Some((line, words)) = lines.next() {
        if let Some(info) = words.trim_start().strip_prefix("```") {
            let indent = words.len() - words.trim_start().len();
            let mut body = Vec::new();
            loop {
                match lines.next() {
                    Some((_, end)) if end.trim() == "```" => break,
                    Some((_, inside)) => body.push(inside.get(indent..).unwrap_or_default()),
                    None => return Err(format!("{line}: this block has no end")),
                }
            }
            if let Some(what) = block(info, &body).map_err(|why| format!("{line}: {why}"))? {
                steps.push(Step { line, what });
            }
        } else if let Some(comment) = words.trim().strip_prefix("<!--") {
            let Some(inside) = comment.strip_suffix("-->") else { continue };
            let Some((verb, rest)) = inside.split_once(':') else { continue };
            let rest = rest.trim().to_owned();
            let what = match verb.trim() {
                "check" => What::Check(rest),
                "await" => What::Await(rest),
                "close" => What::Close(rest),
                "picture" => What::Picture(rest),
                _ => continue,
            };
            steps.push(Step { line, what });
        }
    }
    Ok(steps)
}

fn block(info: &str, body: &[&str]) -> Result<Option<What>, String> {
    let mut words = info.split_whitespace();
    let kind = words.next().unwrap_or_default();
    let mut settings = words.map(|word| word.split_once('=').unwrap_or((word, "")));
    let text = || body.iter().map(|line| format!("{line}\n")).collect::<String>();
    Ok(Some(match (kind, settings.next()) {
        (_, Some(("file", path))) => What::Save { path: path.to_owned(), text: text() },
        ("sh", None) => What::Run(text()),
        ("sh", Some(("terminal", name))) => {
            What::Open { terminal: name.to_owned(), commands: text() }
        }
        ("text", None) => What::Prints(body.iter().map(|&line| line.to_owned()).collect()),
        ("sh" | "text" | "", Some((other, _))) => {
            return Err(format!("`{other}` is not a setting of a block: `terminal=` or `file=`"));
        }
        ("", None) => {
            return Err("name the kind of the block: sh, text, or another language".to_owned());
        }
        // Shown only.
        _ => return Ok(None),
    }))
}

/// Checks that a text has lines that match these, in this order.
///
/// # Errors
/// The first missing line.
pub(crate) fn has(text: &str, expected: &[String]) -> Result<(), String> {
    let mut rest = text.lines();
    for line in expected.iter().filter(|line| line.trim() != "..." && !line.trim().is_empty()) {
        if !rest.any(|one| is_like(one.trim(), line.trim())) {
            return Err(line.clone());
        }
    }
    Ok(())
}

/// `...` in a line stands for anything.
fn is_like(line: &str, pattern: &str) -> bool {
    let parts: Vec<&str> = pattern.split("...").collect();
    let [first, middle @ .., last] = parts.as_slice() else { return line == pattern };
    let Some(mut rest) = line.strip_prefix(first) else { return false };
    for part in middle {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page() {
        let text = "# Title\n```sh\nls\n```\n```text\na ... c\n```\n<!-- check: test -f x -->\n\
                    ```sh terminal=sim\nrun\n```\n<!-- close: sim -->\n```xml file=a/b.xml\n<a/>\n```\n";
        let steps = steps(text).unwrap_or_else(|why| panic!("{why}"));
        let whats: Vec<What> = steps.into_iter().map(|step| step.what).collect();
        assert_eq!(
            whats,
            [
                What::Run("ls\n".into()),
                What::Prints(vec!["a ... c".into()]),
                What::Check("test -f x".into()),
                What::Open { terminal: "sim".into(), commands: "run\n".into() },
                What::Close("sim".into()),
                What::Save { path: "a/b.xml".into(), text: "<a/>\n".into() },
            ]
        );
        assert!(super::steps("```sh\nls\n").is_err());
        assert!(super::steps("```\nls\n```\n").is_err());
    }

    #[test]
    fn what_is_printed_has_these_lines() {
        let text = "average rate: 9.998\n\tmin: 0.1s\nheader:\n  stamp: 3\n";
        let expects = |lines: &[&str]| {
            has(text, &lines.iter().map(|&line| line.to_owned()).collect::<Vec<_>>())
        };
        assert_eq!(expects(&["average rate: 9.9...", "...", "stamp: ..."]), Ok(()));
        assert_eq!(expects(&["header:", "average rate: ..."]), Err("average rate: ...".into()));
    }
}
