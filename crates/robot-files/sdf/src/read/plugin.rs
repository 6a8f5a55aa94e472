//! `<plugin>`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::Plugin;
use periplus_xml::{Element, XmlNode};

use crate::fields::Fields;
use crate::verbatim::keep;

/// Reads a `<plugin>`; its children are kept verbatim.
pub fn read_plugin(element: &Element, diagnostics: &mut Diagnostics) -> Plugin {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.attribute("name").map(|it| it.value.to_string());
    let filename = fields.required_attribute("filename").map(|it| it.value.to_string());
    if name.is_none() {
        fields.diagnostics.push(
            Diagnostic::warning("missing-attribute", "`<plugin>` lacks the attribute `name`")
                .at(element.origin),
        );
    }
    Plugin {
        name: name.unwrap_or_default(),
        filename: filename.unwrap_or_default(),
        content: element.children.iter().filter_map(XmlNode::as_element).map(keep).collect(),
        origin: element.origin,
    }
}

/// Reads all `<plugin>` children.
pub(crate) fn plugins(fields: &mut Fields<'_, '_>) -> Vec<Plugin> {
    let elements = fields.children("plugin");
    elements.into_iter().map(|element| read_plugin(element, fields.diagnostics)).collect()
}
