//! The site: every page below `docs/` is in its table of contents, and mdbook builds it.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use super::links::resolve;
use super::page::{Page, Target};
use crate::step::{Failed, copy_folder, root, run};

/// The folder with the pages of the site.
pub(crate) const SOURCES: &str = "docs/";
/// The table of contents of the site.
pub(crate) const CONTENTS: &str = "docs/SUMMARY.md";
/// The way to install mdbook.
const INSTALL: &str = "install it with `cargo install --locked mdbook`";

/// Checks that the table of contents lists every page once.
pub(crate) fn check(pages: &[Page]) -> Vec<String> {
    let Some(contents) = pages.iter().find(|page| page.path == CONTENTS) else {
        return vec![format!("{CONTENTS}: it is missing, and the site has no table of contents")];
    };
    let mut listed: BTreeMap<String, usize> = BTreeMap::new();
    for link in &contents.links {
        if let Target::Known(target) = &link.target {
            *listed.entry(resolve(CONTENTS, target).unwrap_or_default()).or_default() += 1;
        }
    }
    let mut findings = Vec::new();
    let in_site = pages.iter().filter(|page| page.path.starts_with(SOURCES));
    for page in in_site.filter(|page| page.path != CONTENTS) {
        match listed.get(&page.path) {
            Some(1) => {}
            Some(count) => {
                findings.push(format!("{CONTENTS}: `{}` is listed {count} times", page.path));
            }
            None => findings.push(format!(
                "{CONTENTS}: `{}` is not listed, so the site does not have it: add a line",
                page.path
            )),
        }
    }
    findings
}

/// Builds the site into `target/site`. Without mdbook it is left out, unless it was asked for.
pub(crate) fn build(is_asked_for: bool) -> Result<(), Failed> {
    let is_installed = Command::new("mdbook").arg("--version").output().is_ok();
    if !is_installed && !is_asked_for {
        eprintln!("NOTE: mdbook is not installed, so the site was not built: {INSTALL}");
        return Ok(());
    }
    run(Command::new("mdbook").current_dir(root()).arg("build"), INSTALL)?;
    add_page()
}

/// Copies the page that runs in a browser tab to where the buttons "Run it here" expect it (`docs/run-here.js`). Without
/// it the site has no such buttons.
fn add_page() -> Result<(), Failed> {
    let (page, place) = (root().join("target/tab/page"), root().join("target/site/run"));
    if !page.join("index.html").exists() {
        eprintln!(
            "NOTE: the site has no page to run in a tab: `cargo xtask wasm --page` builds it"
        );
        return Ok(());
    }
    // Only hosts that choose between both need the compressed twins of files.
    let is_plain = |path: &Path| path.extension().is_none_or(|it| it != "br");
    copy_folder(&page, &place, is_plain)
        .map_err(|error| Failed(format!("target/site/run: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(pages: &[(&str, &str)]) -> Vec<String> {
        let read = |(path, text): &(&str, &str)| Page::read(path, (*text).to_owned());
        check(&pages.iter().map(read).collect::<Vec<_>>())
    }

    #[test]
    fn every_page_is_listed_once() {
        let contents = ("docs/SUMMARY.md", "- [a](a.md)\n- [b](b/c.md)\n- [d](d.md)\n- [d](d.md)");
        let pages = [contents, ("docs/a.md", ""), ("docs/b/c.md", ""), ("README.md", "")];
        assert_eq!(faults(&pages), Vec::<String>::new());
        let more = [contents, ("docs/a.md", ""), ("docs/d.md", ""), ("docs/e.md", "")];
        assert_eq!(
            faults(&more),
            [
                "docs/SUMMARY.md: `docs/d.md` is listed 2 times",
                "docs/SUMMARY.md: `docs/e.md` is not listed, so the site does not have it: add a line",
            ]
        );
        assert_eq!(faults(&[("docs/a.md", "")]).len(), 1);
    }
}
