//! A form in which two trees that mean the same are the same text.

use crate::tree::{Element, Node};
use crate::write::escape;

/// One line per element, text or end: attributes sorted by name, comments and instructions left
/// out, runs of text joined and trimmed, empty text dropped.
#[must_use]
pub fn canonical(element: &Element) -> String {
    let mut out = String::new();
    write(element, &mut out);
    out
}

fn write(element: &Element, out: &mut String) {
    out.push('<');
    out.push_str(&element.name);
    let mut attributes: Vec<_> = element.attributes.iter().collect();
    attributes.sort_by(|a, b| a.name.cmp(&b.name));
    for attribute in attributes {
        out.push(' ');
        out.push_str(&attribute.name);
        out.push_str("=\"");
        escape(&attribute.value, true, out);
        out.push('"');
    }
    out.push_str(">\n");
    let mut run = String::new();
    for node in &element.children {
        match node {
            Node::Element(child) => {
                flush(&mut run, out);
                write(child, out);
            }
            Node::Text(text) => run.push_str(&text.text),
            Node::Comment(_) | Node::Instruction(_) => {}
        }
    }
    flush(&mut run, out);
    out.push_str("</");
    out.push_str(&element.name);
    out.push_str(">\n");
}

fn flush(run: &mut String, out: &mut String) {
    let text = run.trim();
    if !text.is_empty() {
        escape(text, false, out);
        out.push('\n');
    }
    run.clear();
}
