//! Paths of this tree that pages name as code: each exists.

use super::page::{Page, Target};

/// Folders of the tree; text between backticks that begins with one is a path.
const FOLDERS: [&str; 9] = [
    "benches/",
    "conformance/",
    "crates/",
    "docs/",
    "fuzz/",
    "robots/",
    "viewer/",
    "worlds/",
    "xtask/",
];
/// Pages about the past: they name files as they were then.
const HISTORIES: [&str; 3] = ["CHANGELOG.md", "EXPERIMENTS.md", "RESULTS.md"];

/// Checks all pages; `exists` tests a path from the root of the tree.
pub(crate) fn check(pages: &[Page], exists: &dyn Fn(&str) -> bool) -> Vec<String> {
    let is_present = |page: &&Page| !HISTORIES.iter().any(|name| page.path.ends_with(name));
    let mut findings = Vec::new();
    for page in pages.iter().filter(is_present) {
        for code in &page.code {
            if let Target::Known(path) = &code.target
                && is_path(path)
                && !exists(path)
            {
                findings.push(format!(
                    "{}:{}:{}: `{path}` is not in this tree: correct the path",
                    page.path, code.line, code.column
                ));
            }
        }
    }
    findings
}

/// True for a path, and not for a pattern or a command.
fn is_path(code: &str) -> bool {
    let plain = |c: char| c.is_alphanumeric() || "/._-".contains(c);
    FOLDERS.iter().any(|folder| code.starts_with(folder)) && code.chars().all(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_paths_exist() {
        let text = "`crates/a/b.rs`, `crates/*/c.rs`, `crates/gone` and `/scan`";
        let pages = ["docs/a.md", "CHANGELOG.md"].map(|path| Page::read(path, text.to_owned()));
        assert_eq!(
            check(&pages, &|path| path == "crates/a/b.rs"),
            ["docs/a.md:1:35: `crates/gone` is not in this tree: correct the path"]
        );
    }
}
