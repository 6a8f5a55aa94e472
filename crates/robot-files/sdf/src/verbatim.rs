//! Elements that are kept verbatim.

use periplus_xml::{Element, Text, XmlNode};

/// Returns the element without the layout white space around its texts, so that a kept element is the same
/// after writing and reading.
pub fn keep(element: &Element) -> Element {
    let mut children: Vec<XmlNode> = Vec::with_capacity(element.children.len());
    for node in &element.children {
        match node {
            XmlNode::Element(child) => children.push(XmlNode::Element(keep(child))),
            XmlNode::Text(text) => match children.last_mut() {
                // Adjacent text and CDATA are one text.
                Some(XmlNode::Text(before)) => {
                    before.text = format!("{}{}", before.text, text.text).into();
                }
                _ => children.push(XmlNode::Text(text.clone())),
            },
            other => children.push(other.clone()),
        }
    }
    children.retain_mut(|node| match node {
        XmlNode::Text(text) => {
            trim(text);
            !text.text.is_empty()
        }
        _ => true,
    });
    Element {
        name: element.name.clone(),
        attributes: element.attributes.clone(),
        children,
        origin: element.origin,
    }
}

fn trim(text: &mut Text) {
    let trimmed = text.text.trim();
    if trimmed.len() != text.text.len() {
        let start = text.text.len() - text.text.trim_start().len();
        // With entities or CDATA the text is shorter than its source.
        if let Some(span) = text.origin.0
            && (span.end - span.start) as usize == text.text.len()
        {
            text.origin = span.part(start, start + trimmed.len()).into();
        }
        text.text = trimmed.into();
    }
}
