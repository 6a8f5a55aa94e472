//! Canonical text form: trees of equal meaning have the same text.

use crate::tree::{Element, XmlNode};

/// White space of XML.
const SPACE: [char; 4] = [' ', '\t', '\r', '\n'];

/// Returns the tree in one line: attributes sorted by name, comments and instructions removed, runs of text
/// joined and trimmed, empty text removed, `<a></a>` for an empty element.
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
        for character in attribute.value.chars() {
            match character {
                '"' => out.push_str("&quot;"),
                '\t' => out.push_str("&#9;"),
                '\n' => out.push_str("&#10;"),
                '\r' => out.push_str("&#13;"),
                other => escape(other, out),
            }
        }
        out.push('"');
    }
    out.push('>');
    let mut run = String::new();
    for node in &element.children {
        match node {
            XmlNode::Element(child) => {
                flush(&mut run, out);
                write(child, out);
            }
            XmlNode::Text(text) => run.push_str(&text.text),
            XmlNode::Comment(_) | XmlNode::Instruction(_) => {}
        }
    }
    flush(&mut run, out);
    out.push_str("</");
    out.push_str(&element.name);
    out.push('>');
}

fn flush(run: &mut String, out: &mut String) {
    run.trim_matches(SPACE).chars().for_each(|character| escape(character, out));
    run.clear();
}

fn escape(character: char, out: &mut String) {
    match character {
        '&' => out.push_str("&amp;"),
        '<' => out.push_str("&lt;"),
        '>' => out.push_str("&gt;"),
        other => out.push(other),
    }
}
