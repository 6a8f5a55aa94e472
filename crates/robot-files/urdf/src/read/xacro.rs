//! Unexpanded xacro in a file that should be plain URDF.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_xml::{Element, XmlNode};

use super::fields::{is_xacro, unexpanded};

/// Elements of xacro from versions without a prefix.
const OLD_XACRO: [&str; 7] =
    ["macro", "property", "include", "if", "unless", "insert_block", "arg"];

/// Maximum number of findings. One would do; a few more show the extent.
const MAX_FINDINGS: usize = 20;

/// Reports unexpanded xacro: `xacro:` elements, and expressions in names and texts. Those in numbers are
/// reported by the readers of the numbers.
pub(super) fn check(root: &Element, diagnostics: &mut Diagnostics) {
    for child in root.elements().filter(|child| OLD_XACRO.contains(&&*child.name)) {
        diagnostics.push(
            Diagnostic::warning(
                "unexpanded-xacro",
                format!("`{}` is an element of xacro, and xacro has not run", child.name),
            )
            .at(child.name_origin())
            .label("this is ignored")
            .help(format!(
                "write `xacro:{}`, declare xmlns:xacro=\"http://www.ros.org/wiki/xacro\" in \
                 <robot>, and name the file `.xacro`",
                child.name
            )),
        );
    }
    let mut found = Vec::new();
    walk(root, &mut found);
    for (what, place) in found {
        // Unreadable numbers have been reported at the same location.
        if diagnostics.iter().any(|known| known.span.is_some() && known.span == place.0) {
            continue;
        }
        diagnostics.push(unexpanded(what, place));
    }
}

fn walk(element: &Element, found: &mut Vec<(String, Origin)>) {
    if element.prefix() == Some("xacro") {
        let what = format!("`{}` is an element of xacro, and xacro has not run", element.name);
        found.push((what, element.name_origin()));
        return;
    }
    for attribute in element.attributes.iter().filter(|attribute| is_xacro(&attribute.value)) {
        let what = format!("`{}` holds a xacro expression, and xacro has not run", attribute.name);
        found.push((what, attribute.value_origin));
    }
    for child in &element.children {
        if found.len() >= MAX_FINDINGS {
            return;
        }
        match child {
            XmlNode::Element(child) => walk(child, found),
            XmlNode::Text(text) if is_xacro(&text.text) => {
                let what =
                    format!("`{}` holds a xacro expression, and xacro has not run", element.name);
                found.push((what, element.text_origin()));
            }
            _ => {}
        }
    }
}
