//! Writer: tree to text.

use crate::tree::{Document, Element, XmlNode};

/// Writes a document with an XML declaration, two spaces per level.
#[must_use]
pub fn write_document(document: &Document) -> String {
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n");
    for node in &document.before {
        write_node(node, 0, &mut out);
    }
    write_into(&document.root, 0, &mut out);
    for node in &document.after {
        write_node(node, 0, &mut out);
    }
    out
}

/// Writes one element, two spaces per level, with a line break at the end.
#[must_use]
pub fn write_element(element: &Element) -> String {
    let mut out = String::new();
    write_into(element, 0, &mut out);
    out
}

fn write_node(node: &XmlNode, level: usize, out: &mut String) {
    match node {
        XmlNode::Element(element) => write_into(element, level, out),
        XmlNode::Text(text) => {
            let text = text.text.trim();
            if !text.is_empty() {
                indent(level, out);
                escape(text, false, out);
                out.push('\n');
            }
        }
        XmlNode::Comment(comment) => {
            indent(level, out);
            out.push_str("<!--");
            // A tolerated `--` must not be written again.
            out.push_str(&comment.text.replace("--", "- -"));
            out.push_str(if comment.text.ends_with('-') { " -->\n" } else { "-->\n" });
        }
        XmlNode::Instruction(instruction) => {
            indent(level, out);
            out.push_str("<?");
            out.push_str(&instruction.text);
            out.push_str("?>\n");
        }
    }
}

fn write_into(element: &Element, level: usize, out: &mut String) {
    indent(level, out);
    out.push('<');
    out.push_str(&element.name);
    for attribute in &element.attributes {
        out.push(' ');
        out.push_str(&attribute.name);
        out.push_str("=\"");
        escape(&attribute.value, true, out);
        out.push('"');
    }
    let shown =
        |node: &&XmlNode| !matches!(node, XmlNode::Text(text) if text.text.trim().is_empty());
    let mut content = element.children.iter().filter(shown).peekable();
    match content.peek() {
        None => out.push_str("/>\n"),
        Some(XmlNode::Text(text)) if element.children.iter().filter(shown).count() == 1 => {
            out.push('>');
            escape(text.text.trim(), false, out);
            close(element, out);
        }
        Some(_) => {
            out.push_str(">\n");
            for node in content {
                write_node(node, level + 1, out);
            }
            indent(level, out);
            close(element, out);
        }
    }
}

fn close(element: &Element, out: &mut String) {
    out.push_str("</");
    out.push_str(&element.name);
    out.push_str(">\n");
}

fn indent(level: usize, out: &mut String) {
    for _ in 0..level {
        out.push_str("  ");
    }
}

fn escape(text: &str, attribute: bool, out: &mut String) {
    for character in text.chars() {
        match character {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' if attribute => out.push_str("&quot;"),
            '\n' if attribute => out.push_str("&#10;"),
            _ => out.push(character),
        }
    }
}
