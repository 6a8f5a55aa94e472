//! Files of the tree, each with its package, and what the checks need of Rust source.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::rust::{self, Kind, Token};
use crate::step::Failed;

/// File of the tree.
#[derive(Debug)]
pub(crate) struct File {
    /// Path below the root, with `/`.
    pub(crate) path: String,
    pub(crate) text: String,
    /// Package that the file belongs to; `docs` or `viewer` for what belongs to none.
    pub(crate) package: String,
}

impl File {
    /// True for programs of developers, which are not published.
    pub(crate) fn is_tool(&self) -> bool {
        ["xtask/", "benches/", "fuzz/"].iter().any(|folder| self.path.starts_with(folder))
    }
}

/// Line and column (both from 1, the column in characters) of an offset.
pub(crate) fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = &text[..text.floor_char_boundary(offset)];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// Reads all files below `root` that Git tracks or would track and that a check looks at.
///
/// # Errors
/// Git cannot be run, or a file is not UTF-8.
pub(crate) fn files(root: &Path) -> Result<Vec<File>, Failed> {
    let mut command = Command::new("git");
    command.current_dir(root);
    command.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard", "--deduplicate"]);
    let output = command.output().map_err(|error| {
        Failed(format!("`git ls-files` cannot be started ({error}): install Git"))
    })?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        return Err(Failed(format!("`git ls-files` failed: {why}; run this in a clone")));
    }
    let names = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut texts = BTreeMap::new();
    for path in names.split('\0').filter(|path| is_read(path)) {
        // A file that is deleted but not yet committed is still listed.
        let Ok(bytes) = fs::read(root.join(path)) else { continue };
        let text = String::from_utf8(bytes)
            .map_err(|error| Failed(format!("{path} is not UTF-8 ({error}); save it as UTF-8")))?;
        texts.insert(path.to_owned(), text);
    }
    Ok(with_packages(texts))
}

fn is_read(path: &str) -> bool {
    let extension = path.rsplit('.').next().unwrap_or_default();
    path.rsplit('/').next() == Some("Cargo.toml")
        || matches!(extension, "rs" | "md" | "svelte")
        || (path.starts_with("viewer/src/") && extension == "ts")
}

fn with_packages(texts: BTreeMap<String, String>) -> Vec<File> {
    let packages: BTreeMap<String, String> = texts
        .iter()
        .filter_map(|(path, text)| {
            let folder = path.strip_suffix("/Cargo.toml")?;
            Some((folder.to_owned(), package_name(text)?))
        })
        .collect();
    let package = |path: &str| {
        let folders = path.match_indices('/').map(|(at, _)| &path[..at]).rev();
        let mut names = folders.filter_map(|folder| packages.get(folder));
        match names.next() {
            Some(name) => name.clone(),
            None if path.starts_with("viewer/") => "viewer".to_owned(),
            None => "docs".to_owned(),
        }
    };
    let file = |(path, text): (String, String)| File { package: package(&path), path, text };
    texts.into_iter().map(file).collect()
}

/// Name in the section `[package]` of a manifest.
fn package_name(manifest: &str) -> Option<String> {
    let section = manifest.lines().skip_while(|line| line.trim() != "[package]").skip(1);
    let mut entries = section.take_while(|line| !line.starts_with('['));
    let name =
        entries.find_map(|line| line.strip_prefix("name")?.trim_start().strip_prefix('='))?;
    Some(name.trim().trim_matches('"').to_owned())
}

/// Rust source as tokens, each with what it is part of.
#[derive(Debug)]
pub(crate) struct Rust<'a> {
    pub(crate) file: &'a File,
    pub(crate) tokens: Vec<Token>,
    /// Index of the closing bracket of each opening one.
    pub(crate) closers: Vec<usize>,
    /// True for tokens of items that only tests are built with.
    pub(crate) is_test: Vec<bool>,
    /// True for doc comments that clap prints.
    pub(crate) is_help: Vec<bool>,
}

impl<'a> Rust<'a> {
    pub(crate) fn new(file: &'a File) -> Self {
        let tokens = rust::tokens(&file.text);
        let closers = rust::closers(&tokens);
        let in_tests = is_of_tests(&file.path);
        let mut this = Self {
            file,
            closers,
            is_test: vec![in_tests; tokens.len()],
            is_help: vec![false; tokens.len()],
            tokens,
        };
        this.mark();
        this
    }

    pub(crate) fn text(&self, at: usize) -> &'a str {
        self.tokens.get(at).map_or("", |token| &self.file.text[token.range.clone()])
    }

    pub(crate) fn is_punct(&self, at: usize, punct: u8) -> bool {
        self.tokens.get(at).is_some_and(|token| token.kind == Kind::Punct(punct))
    }

    pub(crate) fn is_ident(&self, at: usize, ident: &str) -> bool {
        self.tokens.get(at).is_some_and(|token| token.kind == Kind::Ident) && self.text(at) == ident
    }

    /// Index after an item that starts at a token: behind its `;` or its block, at the latest where
    /// the block around it ends.
    fn item_end(&self, mut at: usize) -> usize {
        while at < self.tokens.len() {
            match self.tokens[at].kind {
                Kind::Punct(b';' | b',') => return at + 1,
                Kind::Punct(b'{') => return self.closers[at] + 1,
                Kind::Punct(b'}' | b')' | b']') => return at,
                Kind::Punct(b'(' | b'[') => at = self.closers[at] + 1,
                // An attribute's brackets, and generics with commas in them.
                Kind::Punct(b'<') => at = self.generics_end(at),
                _ => at += 1,
            }
        }
        at.min(self.tokens.len())
    }

    /// Index after the `>` that closes a `<`, or after the `<` where there is none near.
    pub(crate) fn generics_end(&self, open: usize) -> usize {
        let mut depth = 0;
        let mut at = open;
        while at < self.tokens.len() {
            match self.tokens[at].kind {
                Kind::Punct(b'<') => depth += 1,
                Kind::Punct(b'>') if at > 0 && self.is_punct(at - 1, b'-') => {}
                Kind::Punct(b'>') => {
                    depth -= 1;
                    if depth == 0 {
                        return at + 1;
                    }
                }
                Kind::Punct(b'(' | b'[') => at = self.closers[at],
                Kind::Punct(b';' | b'{' | b'}' | b')' | b']') => break,
                _ => {}
            }
            at += 1;
        }
        open + 1
    }

    /// Marks what only tests are built with and what clap prints.
    fn mark(&mut self) {
        for at in 0..self.tokens.len() {
            if !self.is_punct(at, b'#') || !self.is_punct(at + 1, b'[') {
                continue;
            }
            let end = self.closers[at + 1].min(self.tokens.len());
            let has = |name: &str| (at + 2..end).any(|at| self.is_ident(at, name));
            let (first, second) = (self.text(at + 2), self.text(at + 4));
            let is_test = first == "test" || (first == "cfg" && has("test") && second != "not");
            let is_derive = first == "derive";
            let is_clap = is_derive
                && ["Parser", "Args", "Subcommand", "ValueEnum"].iter().any(|name| has(name));
            if is_test {
                let end = self.item_end(end + 1);
                self.is_test[at..end].fill(true);
            } else if is_clap {
                let is_named = has("Parser");
                let end = self.item_end(end + 1);
                self.is_help[at..end].fill(true);
                let docs = (0..at).rev().take_while(|&at| self.tokens[at].kind.is_comment());
                let start = docs.last().filter(|_| is_named).unwrap_or(at);
                self.is_help[start..at].fill(true);
            }
        }
    }
}

/// True for files that only tests and benchmarks are built with.
fn is_of_tests(path: &str) -> bool {
    path.split('/').any(|part| matches!(part, "tests" | "tests.rs" | "benches" | "fuzz"))
}

/// File of a made-up package, for the tests of the checks.
#[cfg(test)]
pub(crate) fn made_up(path: &str, text: &str) -> File {
    let package = path.split('/').rev().nth(2).unwrap_or("docs").to_owned();
    File { path: path.to_owned(), text: text.to_owned(), package }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packages_are_those_of_the_nearest_manifest() {
        let manifest =
            |name: &str| format!("[workspace]\n[package]\nname = \"{name}\"\n[x]\nname = 1");
        let texts = [
            ("crates/a/b/Cargo.toml", manifest("p-b")),
            ("crates/a/b/src/x.rs", String::new()),
            ("crates/a/README.md", String::new()),
            ("viewer/src/x.ts", String::new()),
        ];
        let files = with_packages(texts.map(|(path, text)| (path.to_owned(), text)).into());
        let found: Vec<_> = files.iter().map(|file| file.package.as_str()).collect();
        assert_eq!(found, ["docs", "p-b", "p-b", "viewer"]);
    }

    #[test]
    fn lines_and_columns() {
        assert_eq!(line_and_column("é\nüx", 5), (2, 2));
        assert_eq!(line_and_column("", 0), (1, 1));
    }

    /// Texts of the marked identifiers.
    fn marked(text: &str, marks: impl Fn(&Rust) -> Vec<bool>) -> Vec<String> {
        let file = made_up("a/src/lib.rs", text);
        let rust = Rust::new(&file);
        let marks = marks(&rust);
        (0..marks.len())
            .filter(|&at| {
                marks[at] && matches!(rust.tokens[at].kind, Kind::Number | Kind::LineDoc { .. })
            })
            .map(|at| rust.text(at).trim().to_owned())
            .collect()
    }

    #[test]
    fn tests_are_marked() {
        let text = "0 #[cfg(test)] use a::{b, 1}; 2 #[test] fn a() { 3 } 4 #[cfg(test)] mod a { 5 } 6 \
                    #[cfg(not(test))] fn b<A, B>() { 7 } #[cfg(test)] fn b<A, B>(a: A, b: B) { 8 } 9";
        assert_eq!(marked(text, |rust| rust.is_test.clone()), ["1", "3", "5", "8"]);
        let file = made_up("crates/a/tests/a.rs", "fn");
        assert_eq!(Rust::new(&file).is_test, [true]);
    }

    #[test]
    fn help_is_marked() {
        let text = "/// a\nstruct A;\n/// b\n#[derive(Debug, Parser)]\n#[command(x)]\nstruct B {\n/// c\nc: u8 }\n\
                    /// d\n#[derive(Args)]\nstruct D {\n/// e\ne: u8 }\n/// f\nf";
        assert_eq!(marked(text, |rust| rust.is_help.clone()), ["b", "c", "e"]);
    }
}
