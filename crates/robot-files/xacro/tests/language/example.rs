//! Small robots to expand.

use std::path::PathBuf;

use expect_test::Expect;
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_resources::{MemoryHost, Resolver};
use periplus_xacro::{Expanded, XacroContext, expand};
use periplus_xml::{XmlNode, canonical, decode, parse};

/// A file `/robot/main.xacro` whose root is `r`, with files around it.
pub(crate) struct Example {
    host: MemoryHost,
    arguments: Vec<(String, String)>,
}

/// A file with this content in its root.
pub(crate) fn example(content: &str) -> Example {
    whole(format!("<r xmlns:xacro=\"http://www.ros.org/wiki/xacro\">{content}</r>"))
}

/// A file with this text.
pub(crate) fn whole(text: impl Into<Vec<u8>>) -> Example {
    let host = MemoryHost::new().with_file("/robot/.git/HEAD", "");
    let text = text.into();
    let example = Example { host, arguments: Vec::new() };
    example.file("main.xacro", text)
}

/// The expanded content of the root.
pub(crate) fn check(content: &str, expected: Expect) {
    example(content).check(expected);
}

/// The same for input that the reference refuses or expands wrongly.
pub(crate) fn check_lenient(content: &str, expected: Expect) {
    example(content).check_lenient(expected);
}

/// The messages about it.
pub(crate) fn check_messages(content: &str, expected: Expect) {
    example(content).check_messages(expected);
}

impl Example {
    /// Adds a file in `/robot`.
    pub(crate) fn file(mut self, name: &str, content: impl Into<Vec<u8>>) -> Self {
        let content = content.into();
        self.host = self.host.with_file(PathBuf::from("/robot").join(name), content);
        self
    }

    /// Adds a file anywhere.
    pub(crate) fn secret(&mut self, path: &str, content: &str) {
        self.host = std::mem::take(&mut self.host).with_file(path, content);
    }

    /// Adds a file whose root holds this content.
    pub(crate) fn include(self, name: &str, content: &str) -> Self {
        let head = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">";
        self.file(name, format!("{head}{content}</robot>"))
    }

    pub(crate) fn argument(mut self, name: &str, value: &str) -> Self {
        self.arguments.push((name.into(), value.into()));
        self
    }

    pub(crate) fn variable(mut self, name: &str, value: &str) -> Self {
        self.host = self.host.with_variable(name, value);
        self
    }

    /// The expansion, and all messages as they are shown.
    pub(crate) fn run(&self) -> (Option<Expanded>, Diagnostics, SourceMap) {
        let mut sources = SourceMap::new();
        let mut diagnostics = Diagnostics::new();
        let path = PathBuf::from("/robot/main.xacro");
        let bytes = periplus_resources::Host::read(&self.host, &path).unwrap();
        let text = decode(&bytes).expect("the first file is text");
        let file = sources.add("main.xacro", text);
        let document = parse(file, &sources, &mut diagnostics);
        let resolver = Resolver::new(&self.host, &[]);
        let expanded = document.and_then(|document| {
            let setting = XacroContext {
                path,
                working_folder: PathBuf::from("/robot"),
                arguments: self.arguments.clone(),
                host: &self.host,
                resolver: &resolver,
            };
            expand(&document, setting, &mut sources, &mut diagnostics)
        });
        (expanded, diagnostics, sources)
    }

    /// All messages.
    pub(crate) fn messages(&self) -> String {
        let (_, diagnostics, sources) = self.run();
        diagnostics.iter().map(|found| render(found, &sources, RenderStyle::Plain)).collect()
    }

    pub(crate) fn check(self, expected: Expect) {
        self.expanded(expected);
    }

    pub(crate) fn check_lenient(self, expected: Expect) {
        self.expanded(expected);
    }

    fn expanded(self, expected: Expect) {
        let (expanded, ..) = self.run();
        match expanded {
            Some(expanded) => expected.assert_eq(&inside(&canonical(&expanded.document.root))),
            None => panic!("it does not expand:\n{}", self.messages()),
        }
    }

    pub(crate) fn check_messages(self, expected: Expect) {
        expected.assert_eq(&self.messages());
    }

    /// The content of the root with its comments.
    pub(crate) fn check_with_comments(self, expected: Expect) {
        let (expanded, ..) = self.run();
        let Some(mut expanded) = expanded else {
            panic!("it does not expand:\n{}", self.messages());
        };
        show_comments(&mut expanded.document.root.children);
        expected.assert_eq(&inside(&canonical(&expanded.document.root)));
    }
}

/// Comments as elements, so that they can be seen in the canonical form.
fn show_comments(nodes: &mut [XmlNode]) {
    for node in nodes {
        if let XmlNode::Comment(comment) = node {
            let text = comment.text.clone();
            *node = XmlNode::Element(periplus_xml::Element::new("comment").with_text(text));
        }
        if let XmlNode::Element(element) = node {
            show_comments(&mut element.children);
        }
    }
}

fn inside(root: &str) -> String {
    let content = root.strip_prefix("<r>").and_then(|rest| rest.strip_suffix("</r>"));
    content.unwrap_or(root).to_owned()
}
