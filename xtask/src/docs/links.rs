//! Links of Markdown pages: files and anchors exist, addresses elsewhere are well formed.

use std::collections::BTreeMap;

use super::book;
use super::page::{Link, Page, Target};

/// Anchors that a message lists when one is missing.
const SHOWN_ANCHORS: usize = 8;

/// Checks the links of all pages; `exists` tests a path from the root of the tree.
pub(crate) fn check(pages: &[Page], exists: &dyn Fn(&str) -> bool) -> Vec<String> {
    let tree =
        Tree { pages: pages.iter().map(|page| (page.path.as_str(), page)).collect(), exists };
    let mut findings = Vec::new();
    for page in pages {
        for link in &page.links {
            tree.check_link(page, &page.path, link, &mut findings);
        }
        for include in &page.includes {
            tree.check_include(page, include, &mut findings);
        }
    }
    findings
}

struct Tree<'a> {
    pages: BTreeMap<&'a str, &'a Page>,
    exists: &'a dyn Fn(&str) -> bool,
}

impl Tree<'_> {
    /// Checks a link that is written in `page` and read on the page `shown_on`.
    fn check_link(&self, page: &Page, shown_on: &str, link: &Link, findings: &mut Vec<String>) {
        let mut fault = |why: String| {
            let on =
                if shown_on == page.path { String::new() } else { format!(" (on {shown_on})") };
            findings.push(format!("{}:{}:{}: {why}{on}", page.path, link.line, link.column));
        };
        let target = match &link.target {
            Target::Known(target) => target.as_str(),
            Target::Undefined(label) => {
                return fault(format!(
                    "the reference `{label}` is not defined: add `[{label}]: TARGET`"
                ));
            }
        };
        if let Some(why) = address_fault(target) {
            return fault(format!("link `{target}`: {why}"));
        }
        if is_address(target) {
            return;
        }
        let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
        let Some(path) = resolve(shown_on, path) else {
            return fault(format!("link `{target}` leaves the tree: write a path inside of it"));
        };
        if !(self.exists)(&path) {
            return fault(format!("link `{target}`: there is no `{path}`"));
        }
        let in_site = |path: &str| path.starts_with(book::SOURCES);
        if in_site(shown_on) && !in_site(&path) {
            return fault(format!(
                "link `{target}` leaves `{}`, and the site has no such page: name `{path}` as code \
                 instead",
                book::SOURCES
            ));
        }
        if in_site(shown_on) && shown_on != book::CONTENTS && path.ends_with("/README.md") {
            return fault(format!(
                "link `{target}`: the site has a README.md as index.html, and the link would break: \
                 name the page `index.md`"
            ));
        }
        if !anchor.is_empty()
            && let Some(why) = self.anchor_fault(&path, anchor)
        {
            fault(format!("link `{target}`: {why}"));
        }
    }

    /// Checks that an included file exists, and its links where the site shows them.
    fn check_include(&self, page: &Page, include: &Link, findings: &mut Vec<String>) {
        let Target::Known(target) = &include.target else { return };
        match resolve(&page.path, target).and_then(|path| self.pages.get(path.as_str())) {
            Some(included) => {
                for link in &included.links {
                    self.check_link(included, &page.path, link, findings);
                }
            }
            None => findings.push(format!(
                "{}:{}:{}: `{target}` is included, and there is no such page",
                page.path, include.line, include.column
            )),
        }
    }

    /// The reason why an anchor leads nowhere.
    fn anchor_fault(&self, path: &str, anchor: &str) -> Option<String> {
        let Some(page) = self.pages.get(path) else {
            return Some(format!("`{path}` is not a Markdown page, and has no anchors"));
        };
        let included = page.includes.iter().filter_map(|include| match &include.target {
            Target::Known(target) => self.pages.get(resolve(path, target)?.as_str()),
            Target::Undefined(_) => None,
        });
        let anchors: Vec<&String> =
            page.anchors.iter().chain(included.flat_map(|page| &page.anchors)).collect();
        if anchors.iter().any(|known| *known == anchor) {
            return None;
        }
        let near = |known: &&&String| known.chars().next() == anchor.chars().next();
        let shown: Vec<&str> =
            anchors.iter().filter(near).take(SHOWN_ANCHORS).map(|known| known.as_str()).collect();
        let hint = match shown.len() {
            0 => String::new(),
            _ => format!("; headings there with that letter: {}", shown.join(", ")),
        };
        Some(format!("`{path}` has no heading `{anchor}`{hint}"))
    }
}

/// True for a link with a scheme, such as `https://example.org` or `mailto:a@example.org`.
fn is_address(target: &str) -> bool {
    target.split_once(':').is_some_and(|(scheme, _)| {
        !scheme.is_empty() && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+.-".contains(c))
    })
}

/// The reason why a target is malformed. Nothing is asked of the network.
fn address_fault(target: &str) -> Option<&'static str> {
    if target.is_empty() {
        return Some("it is empty");
    }
    if target.chars().any(char::is_whitespace) {
        return Some("it has white space: write `%20`");
    }
    if target.starts_with('/') {
        return Some("it is absolute: write a path relative to the page");
    }
    if !is_address(target) {
        return None;
    }
    if let Some(rest) = target.strip_prefix("mailto:") {
        return (!rest.contains('@')).then_some("a mail address has an `@`");
    }
    let rest = target.strip_prefix("https://").or_else(|| target.strip_prefix("http://"));
    let Some(rest) = rest else { return Some("only http, https and mailto are used here") };
    let host = rest.split(['/', '?', '#']).next().unwrap_or_default();
    let host = host.rsplit_once(':').map_or(host, |(host, _)| host);
    let is_host = host.split('.').count() > 1 && host.split('.').all(|part| !part.is_empty());
    (!is_host).then_some("it has no host such as `example.org`")
}

/// The path from the root of the tree that a relative path on a page means; none outside of the tree.
pub(crate) fn resolve(page: &str, relative: &str) -> Option<String> {
    if relative.is_empty() {
        return Some(page.to_owned());
    }
    let mut parts: Vec<&str> = page.split('/').collect();
    parts.pop();
    for part in relative.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            _ => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Findings about the first of some pages; files are the pages and `docs/a.png`.
    fn faults(pages: &[(&str, &str)]) -> Vec<String> {
        let pages: Vec<Page> =
            pages.iter().map(|(path, text)| Page::read(path, (*text).to_owned())).collect();
        let exists = |path: &str| path == "docs/a.png" || pages.iter().any(|it| it.path == path);
        check(&pages, &exists)
    }

    #[test]
    fn good_links_have_no_findings() {
        let b = ("docs/b.md", "# One two\n\n[up](../docs/a.md), [here](#one-two)");
        let a = ("docs/a.md", "[b](b.md#one-two) ![p](a.png) <https://example.org/x#y>");
        assert_eq!(faults(&[a, b]), Vec::<String>::new());
    }

    #[test]
    fn missing_files_and_headings_are_found() {
        let b = ("docs/b.md", "# One two");
        assert_eq!(
            faults(&[("docs/a.md", "[x](c.md)\n[y](b.md#one)"), b]),
            [
                "docs/a.md:1:1: link `c.md`: there is no `docs/c.md`",
                "docs/a.md:2:1: link `b.md#one`: `docs/b.md` has no heading `one`; headings there \
                 with that letter: one-two",
            ]
        );
        assert_eq!(
            faults(&[("a.md", "[x](docs/a.png#b)")]),
            [
                "a.md:1:1: link `docs/a.png#b`: `docs/a.png` is not a Markdown page, and has no anchors"
            ]
        );
    }

    #[test]
    fn pages_of_the_site_stay_in_it() {
        let outside = ("README.md", "# R");
        assert_eq!(
            faults(&[("docs/a.md", "[r](../README.md)"), outside]),
            [
                "docs/a.md:1:1: link `../README.md` leaves `docs/`, and the site has no such page: name \
              `README.md` as code instead"
            ]
        );
        assert_eq!(
            faults(&[("a.md", "[r](../b.md)")]),
            ["a.md:1:1: link `../b.md` leaves the tree: write a path inside of it"]
        );
    }

    #[test]
    fn indexes_of_the_site_are_not_linked_as_readme() {
        let index = ("docs/cli/README.md", "# Commands");
        assert_eq!(
            faults(&[("README.md", "[c](docs/cli/README.md)"), index]),
            Vec::<String>::new()
        );
        assert_eq!(
            faults(&[("docs/a.md", "[c](cli/README.md)"), index]),
            [
                "docs/a.md:1:1: link `cli/README.md`: the site has a README.md as index.html, and the link \
              would break: name the page `index.md`"
            ]
        );
    }

    #[test]
    fn included_pages_are_checked_where_they_are_shown() {
        let included = ("A.md", "# Title\n\n[b](docs/b.md)");
        let shown = ("docs/A.md", "{{#include ../A.md}}");
        let linking = ("docs/b.md", "[t](A.md#title)");
        assert_eq!(
            faults(&[shown, included, linking]),
            ["A.md:3:1: link `docs/b.md`: there is no `docs/docs/b.md` (on docs/A.md)"]
        );
        assert_eq!(
            faults(&[("docs/A.md", "{{#include ../B.md}}")]),
            ["docs/A.md:1:1: `../B.md` is included, and there is no such page"]
        );
    }

    #[test]
    fn addresses_are_checked_for_form_only() {
        for good in ["https://example.org/a?b#c", "http://a.b:80", "mailto:a@b.c", "a.md", "#x"] {
            assert_eq!(address_fault(good), None, "{good}");
        }
        for bad in ["", "/etc", "https://", "https://host", "ftp://a.b", "mailto:a", "a b.md"] {
            assert!(address_fault(bad).is_some(), "{bad}");
        }
    }
}
