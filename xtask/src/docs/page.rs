//! One Markdown page: its headings, links, pictures and included files.

use pulldown_cmark::{BrokenLink, CowStr, Event, LinkType, Options, Parser, Tag, TagEnd};

use super::anchors::Anchors;

/// A Markdown page of the tree.
pub(crate) struct Page {
    /// Path from the root of the tree, with `/`.
    pub(crate) path: String,
    /// The page as it is written.
    pub(crate) text: String,
    /// Anchors of its headings, and those set by `<a id="...">`.
    pub(crate) anchors: Vec<String>,
    /// Links and pictures, in their order.
    pub(crate) links: Vec<Link>,
    /// Files that mdbook includes by `{{#include PATH}}`.
    pub(crate) includes: Vec<Link>,
    /// Text between backticks.
    pub(crate) code: Vec<Link>,
}

/// A link or picture of a page.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Link {
    /// Line, from 1.
    pub(crate) line: usize,
    /// Column in bytes, from 1.
    pub(crate) column: usize,
    /// The target as it is written.
    pub(crate) target: Target,
}

/// The target of a link.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// A path, an anchor, or the address of something elsewhere.
    Known(String),
    /// The label of a reference that the page does not define.
    Undefined(String),
}

/// Attributes of HTML whose values are links.
const LINK_ATTRIBUTES: [&str; 2] = ["src", "href"];
/// Attributes of HTML whose values are anchors.
const ANCHOR_ATTRIBUTES: [&str; 2] = ["id", "name"];

impl Page {
    /// Parses a page.
    pub(crate) fn read(path: &str, text: String) -> Self {
        let mut page = Self {
            path: path.to_owned(),
            text: String::new(),
            anchors: Vec::new(),
            links: Vec::new(),
            includes: Vec::new(),
            code: Vec::new(),
        };
        let mut undefined = Vec::new();
        let mut on_broken = |broken: BrokenLink<'_>| -> Option<(CowStr<'_>, CowStr<'_>)> {
            // `[m]` alone is a unit; `[text][label]` is meant as a link.
            if matches!(broken.link_type, LinkType::Reference | LinkType::Collapsed) {
                undefined.push((broken.span.start, broken.reference.to_string()));
            }
            None
        };
        let mut anchors = Anchors::default();
        let mut heading: Option<String> = None;
        let options = Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH;
        let parser = Parser::new_with_broken_link_callback(&text, options, Some(&mut on_broken));
        for (event, range) in parser.into_offset_iter() {
            match event {
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::End(TagEnd::Heading(_)) => {
                    page.anchors.push(anchors.add(&heading.take().unwrap_or_default()));
                }
                Event::Text(words) | Event::Code(words) => {
                    if text[range.start..].starts_with('`') {
                        page.code.push(link(&text, range.start, &words));
                    }
                    if let Some(heading) = &mut heading {
                        heading.push_str(&words);
                    } else {
                        page.includes.extend(included(&text, &words, range.start));
                    }
                }
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    page.links.push(link(&text, range.start, &dest_url));
                }
                Event::Html(html) | Event::InlineHtml(html) => {
                    for (at, name, value) in attributes(&html) {
                        if LINK_ATTRIBUTES.contains(&name) {
                            page.links.push(link(&text, range.start + at, value));
                        } else if ANCHOR_ATTRIBUTES.contains(&name) {
                            page.anchors.push(value.to_owned());
                        }
                    }
                }
                _ => {}
            }
        }
        for (at, label) in undefined {
            let (line, column) = position(&text, at);
            page.links.push(Link { line, column, target: Target::Undefined(label) });
        }
        page.text = text;
        page
    }
}

fn link(text: &str, at: usize, target: &str) -> Link {
    let (line, column) = position(text, at);
    Link { line, column, target: Target::Known(target.to_owned()) }
}

/// The file of `{{#include PATH}}`, if a piece of text has one.
fn included(text: &str, words: &str, at: usize) -> Option<Link> {
    let (_, rest) = words.split_once("{{#include ")?;
    let (path, _) = rest.split_once("}}")?;
    Some(link(text, at, path.trim()))
}

/// Line and column of a byte, both from 1.
fn position(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at.min(text.len())];
    let line = before.matches('\n').count() + 1;
    (line, at - before.rfind('\n').map_or(0, |end| end + 1) + 1)
}

/// Attributes with values in double quotes of a piece of HTML: where the value begins, name, value.
fn attributes(html: &str) -> Vec<(usize, &str, &str)> {
    let mut found = Vec::new();
    let mut from = 0;
    while let Some(at) = html[from..].find("=\"") {
        let value_at = from + at + 2;
        let Some(len) = html[value_at..].find('"') else { break };
        let before = &html[..from + at];
        let name = before.rsplit(|c: char| !c.is_alphanumeric() && c != '-').next();
        found.push((value_at, name.unwrap_or_default(), &html[value_at..value_at + len]));
        from = value_at + len + 1;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Page {
        Page::read("a.md", text.to_owned())
    }

    fn targets(text: &str) -> Vec<String> {
        let shown = |link: &Link| match &link.target {
            Target::Known(target) => format!("{}:{} {target}", link.line, link.column),
            Target::Undefined(label) => format!("{}:{} ? {label}", link.line, link.column),
        };
        read(text).links.iter().map(shown).collect()
    }

    #[test]
    fn links_and_pictures_have_positions() {
        let text = "See [a](b.md#c),\n  ![d](e.png) and <https://example.org>.";
        assert_eq!(targets(text), ["1:5 b.md#c", "2:3 e.png", "2:19 https://example.org"]);
        assert_eq!(targets("<img src=\"p.png\" width=\"3\">"), ["1:11 p.png"]);
        assert_eq!(targets("[a][r]\n\n[r]: x.md"), ["1:1 x.md"]);
    }

    #[test]
    fn code_and_units_are_no_links() {
        assert!(targets("`[a](b)` and a width [m].\n\n```\n[c](d)\n```").is_empty());
    }

    #[test]
    fn undefined_references_are_found() {
        assert_eq!(targets("see [a][nowhere]"), ["1:5 ? nowhere"]);
    }

    #[test]
    fn headings_and_includes_are_found() {
        let page = read("# A `b`\n\n## A b\n\n{{#include ../C.md}}\n\n<a id=\"own\"></a>\n");
        assert_eq!(page.anchors, ["a-b", "a-b-1", "own"]);
        assert_eq!(page.includes, [link(&page.text, 17, "../C.md")]);
    }
}
