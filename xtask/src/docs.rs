//! `cargo xtask docs`: the documentation of the code, the links of every Markdown page, and the site.

mod anchors;
mod book;
mod dependencies;
mod links;
mod llms;
mod page;
mod paths;
mod rustdoc;

use std::fs;
use std::process::Command;

use clap::ValueEnum;

use crate::step::{Failed, root, timed};
use page::Page;

/// One part of the task.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Part {
    /// Documentation of the code, with every warning as an error
    Code,
    /// Links and anchors of every Markdown page, the table of contents, the list of dependencies
    /// with the tests that it names
    Links,
    /// Site in `target/site`, built by mdbook if it is installed
    Site,
    /// Site in a browser: links, search, pages on a phone, first paint and weight; only if it is named
    Browser,
}

/// Description of Periplus in `docs/llms.txt`.
const ABOUT: &str = "Simulates mobile robots from URDF, SDF and launch files, builds maps, localizes, keeps \
    costmaps and navigates, without ROS, Gazebo or a GPU; ROS 2, Gazebo and Foxglove see an ordinary robot.";

/// Writes `docs/llms.txt`.
///
/// # Errors
/// When it cannot be written.
pub(crate) fn update() -> Result<(), Failed> {
    let text = llms::text(&pages()?, ABOUT);
    fs::write(root().join(llms::FILE), text)
        .map_err(|error| Failed(format!("cannot write {}: {error}", llms::FILE)))
}

/// Runs all parts, or one.
///
/// # Errors
/// When a part has findings; they are printed before.
pub(crate) fn run(only: Option<Part>) -> Result<(), Failed> {
    let is_wanted = |part| only.is_none_or(|only| only == part);
    if is_wanted(Part::Links) {
        timed("docs: links", check)?;
    }
    if is_wanted(Part::Site) {
        timed("docs: site", || book::build(only == Some(Part::Site)))?;
    }
    if only == Some(Part::Browser) {
        timed("docs: site", || book::build(true))?;
        timed("docs: in a browser", crate::viewer::site)?;
    }
    if is_wanted(Part::Code) {
        timed("docs: code", rustdoc::run)?;
    }
    Ok(())
}

/// Checks every page of the tree without the network.
fn check() -> Result<(), Failed> {
    let pages = pages()?;
    let findings = findings(&pages);
    findings.iter().for_each(|finding| eprintln!("{finding}"));
    match findings.len() {
        0 => Ok(()),
        count => Err(Failed(format!("{count} findings in the documents, see above"))),
    }
}

/// All findings about links, named paths, the table of contents and the list of dependencies.
fn findings(pages: &[Page]) -> Vec<String> {
    let exists = |path: &str| root().join(path).exists();
    let mut findings = links::check(pages, &exists);
    findings.extend(paths::check(pages, &exists));
    findings.extend(book::check(pages));
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap_or_default();
    let list = pages.iter().find(|page| page.path == dependencies::PAGE);
    let list = list.map_or("", |page| &page.text);
    findings.extend(dependencies::check(&manifest, list));
    let read = |path: &str| fs::read_to_string(root().join(path)).ok();
    findings.extend(dependencies::check_tests(list, &read));
    findings.extend(llms::check(read(llms::FILE).as_deref(), &llms::text(pages, ABOUT)));
    findings
}

/// Every tracked Markdown page. Templates of `periplus new` are not pages of this project.
fn pages() -> Result<Vec<Page>, Failed> {
    let failed = |why: String| Failed(format!("cannot list the Markdown pages: {why}"));
    let listed = Command::new("git")
        .current_dir(root())
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard", "*.md"])
        .output()
        .map_err(|error| failed(error.to_string()))?;
    if !listed.status.success() {
        return Err(failed(String::from_utf8_lossy(&listed.stderr).into_owned()));
    }
    let names = String::from_utf8_lossy(&listed.stdout).into_owned();
    let mut pages = Vec::new();
    for path in names.split('\0').filter(|path| !path.is_empty() && !path.contains("/templates/")) {
        // A page that was deleted and not committed yet is still listed.
        if let Ok(text) = fs::read_to_string(root().join(path)) {
            pages.push(Page::read(path, text));
        }
    }
    pages.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(pages)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_documents_have_no_findings() {
        let pages = pages().unwrap();
        assert!(pages.len() > 20, "{} pages found", pages.len());
        let findings = findings(&pages);
        assert!(findings.is_empty(), "\n{}\n", findings.join("\n"));
    }
}
