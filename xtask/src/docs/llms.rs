//! `docs/llms.txt`: all pages of the site with their first sentences, for programs that read documentation.
//! Its form is that of <https://llmstxt.org>.

use std::fmt::Write as _;

use super::book::{CONTENTS, SOURCES};
use super::page::Page;

/// The file.
pub(crate) const FILE: &str = "docs/llms.txt";

/// Longest description of a page \[characters\].
const MAX_DESCRIPTION: usize = 200;

/// Returns the text of the file.
pub(crate) fn text(pages: &[Page], about: &str) -> String {
    let mut text = format!("# Periplus\n\n> {about}\n\n");
    let contents = pages.iter().find(|page| page.path == CONTENTS);
    for line in contents.map_or("", |page| &page.text).lines() {
        let line = line.trim();
        if let Some(section) = line.strip_prefix("# ").filter(|section| *section != "Summary") {
            let _ = write!(text, "\n## {section}\n\n");
        }
        let Some((title, path)) = link(line) else { continue };
        let page = pages.iter().find(|page| page.path == format!("{SOURCES}{path}"));
        let description = page.map(|page| description(&page.text)).unwrap_or_default();
        let address = path.strip_suffix(".md").map_or(path.to_owned(), |path| match path {
            "README" => "index.html".to_owned(),
            path => format!("{path}.html"),
        });
        let _ = write!(text, "- [{title}]({address})");
        let _ =
            if description.is_empty() { writeln!(text) } else { writeln!(text, ": {description}") };
    }
    text
}

/// Checks that the file is that of the pages.
pub(crate) fn check(written: Option<&str>, expected: &str) -> Vec<String> {
    if written == Some(expected) {
        return Vec::new();
    }
    vec![format!("{FILE}: it is not that of the pages; write it with `cargo xtask docs --update`")]
}

/// Title and target of a line of the table of contents.
fn link(line: &str) -> Option<(&str, &str)> {
    let (title, rest) = line.trim_start_matches("- ").strip_prefix('[')?.split_once("](")?;
    Some((title, rest.strip_suffix(')')?))
}

/// First sentence of a page that is prose: no heading, code, table, picture or list.
fn description(text: &str) -> String {
    let mut in_code = false;
    let mut paragraph = String::new();
    for line in text.lines().map(str::trim) {
        if line.starts_with("```") {
            in_code = !in_code;
            continue;
        }
        let is_prose = !in_code && !line.starts_with(['#', '|', '!', '-', '<', '>']);
        if is_prose && !line.is_empty() {
            let _ = write!(paragraph, "{}{line}", if paragraph.is_empty() { "" } else { " " });
        } else if !paragraph.is_empty() {
            break;
        }
    }
    let paragraph = without_links(&paragraph);
    let end = paragraph.find(". ").map_or(paragraph.len(), |at| at + 1);
    let sentence = paragraph[..end].trim_end_matches(':');
    match sentence.char_indices().nth(MAX_DESCRIPTION) {
        Some((at, _)) => format!("{}...", sentence[..at].trim_end()),
        None => sentence.to_owned(),
    }
}

/// `[words](target)` as `words`.
fn without_links(text: &str) -> String {
    let mut rest = text;
    let mut plain = String::new();
    while let Some(open) = rest.find('[') {
        let Some((words, after)) = rest[open + 1..].split_once("](") else { break };
        let Some((_, after)) = after.split_once(')') else { break };
        plain.push_str(&rest[..open]);
        plain.push_str(words);
        rest = after;
    }
    plain.push_str(rest);
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_are_listed_with_their_first_sentence() {
        let read = |(path, text): (&str, &str)| Page::read(path, text.to_owned());
        let contents =
            "# Summary\n\n[P](README.md)\n\n# How-to\n\n- [Map](map.md)\n  - [Bare](a/b.md)";
        let map = "# Map\n\n```\ncode\n```\n\nBuilds a [map](x.md) from\nscans. And more.";
        let pages =
            [("docs/SUMMARY.md", contents), ("docs/map.md", map), ("docs/a/b.md", "# B")].map(read);
        assert_eq!(
            text(&pages, "About it."),
            "# Periplus\n\n> About it.\n\n- [P](index.html)\n\n## How-to\n\n\
             - [Map](map.html): Builds a map from scans.\n- [Bare](a/b.html)\n"
        );
    }

    #[test]
    fn an_old_file_is_told() {
        assert!(check(Some("a"), "a").is_empty());
        assert_eq!(check(None, "a").len(), 1);
    }
}
