//! Names that SDF 1.8 and later accept.
//!
//! In these versions `::` separates a model from its content, and libsdformat refuses names that contain
//! it. Gazebo Classic wrote such names when it flattened nested models (`arm::link`).

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_xml::{Document, Element, SmolStr, XmlNode};

/// Separates models in names of SDF 1.8 and later.
const SEPARATOR: &str = "::";

/// Elements that have a name.
const NAMED: [&str; 11] = [
    "world",
    "model",
    "link",
    "joint",
    "frame",
    "collision",
    "visual",
    "sensor",
    "light",
    "actor",
    "gripper",
];

/// Attributes that refer to names.
const REFERRING: [&str; 6] =
    ["relative_to", "attached_to", "expressed_in", "canonical_link", "placement_frame", "joint"];

/// Maximum number of renamed elements listed in a message.
const MAX_LISTED: usize = 3;

/// New names of one model or world.
#[derive(Debug, Default)]
struct Scope {
    renamed: BTreeMap<SmolStr, SmolStr>,
    /// Nested models, by their original names.
    models: BTreeMap<SmolStr, Scope>,
}

/// Replaces each name `a::b` by `a__b`, and all references to it, plugins included. A warning lists the
/// renamed elements.
pub fn use_plain_names(document: &mut Document, diagnostics: &mut Diagnostics) {
    let mut listed = Vec::new();
    let scope = Scope::of(&document.root, &mut listed);
    if listed.is_empty() {
        return;
    }
    scope.apply(&mut document.root);
    let shown: Vec<String> =
        listed.iter().take(MAX_LISTED).map(|(old, new)| format!("`{old}` as `{new}`")).collect();
    let more = match listed.len().saturating_sub(MAX_LISTED) {
        0 => String::new(),
        count => format!(", and {count} more"),
    };
    diagnostics.push(
        Diagnostic::warning(
            "renamed",
            format!("names with `::` are written with `__`: {}{more}", shown.join(", ")),
        )
        .note("since SDF 1.8 `::` separates models, and libsdformat refuses it in names")
        .help("use the new names in launch files, bridges and commands"),
    );
}

impl Scope {
    fn of(element: &Element, listed: &mut Vec<(SmolStr, SmolStr)>) -> Self {
        let mut scope = Self::default();
        let mut taken: BTreeSet<SmolStr> = BTreeSet::new();
        scope.collect_taken(element, &mut taken);
        scope.collect(element, &mut taken, listed);
        scope
    }

    fn collect_taken(&self, element: &Element, taken: &mut BTreeSet<SmolStr>) {
        for child in parts(element) {
            taken.extend(child.value("name").map(SmolStr::new));
            if !opens_scope(child) {
                self.collect_taken(child, taken);
            }
        }
    }

    fn collect(
        &mut self,
        element: &Element,
        taken: &mut BTreeSet<SmolStr>,
        listed: &mut Vec<(SmolStr, SmolStr)>,
    ) {
        for child in parts(element) {
            let name = SmolStr::new(child.value("name").unwrap_or_default());
            let named = NAMED.contains(&&*child.name);
            if named && name.contains(SEPARATOR) && !self.renamed.contains_key(&name) {
                let mut new = name.replace(SEPARATOR, "__");
                while taken.contains(&*new) {
                    new.push('_');
                }
                taken.insert(new.clone().into());
                listed.push((name.clone(), new.clone().into()));
                self.renamed.insert(name.clone(), new.into());
            }
            if opens_scope(child) {
                self.models.insert(name, Self::of(child, listed));
            } else {
                self.collect(child, taken, listed);
            }
        }
    }

    /// New spelling of a name, or of a path into nested models.
    fn path(&self, path: &str) -> Option<SmolStr> {
        if let Some(new) = self.renamed.get(path) {
            return Some(new.clone());
        }
        for (at, _) in path.match_indices(SEPARATOR) {
            let (model, rest) = (&path[..at], &path[at + SEPARATOR.len()..]);
            let Some(inside) = self.models.get(model) else { continue };
            let new_model = self.renamed.get(model).map_or(model, SmolStr::as_str);
            let new_rest = inside.path(rest);
            if new_rest.is_none() && new_model == model {
                return None;
            }
            let rest = new_rest.as_deref().unwrap_or(rest);
            return Some(format!("{new_model}{SEPARATOR}{rest}").into());
        }
        None
    }

    fn apply(&self, element: &mut Element) {
        for node in &mut element.children {
            let XmlNode::Element(child) = node else { continue };
            let own = SmolStr::new(child.value("name").unwrap_or_default());
            for attribute in &mut child.attributes {
                let is_name = attribute.name == "name" && NAMED.contains(&&*child.name);
                let refers = REFERRING.contains(&&*attribute.name);
                if (is_name || refers)
                    && let Some(new) = self.path(&attribute.value)
                {
                    attribute.value = new;
                }
            }
            match self.models.get(&own).filter(|_| opens_scope(child)) {
                Some(inside) => {
                    inside.apply_to_root(child);
                    inside.apply(child);
                }
                None => self.apply(child),
            }
            self.apply_to_text(child);
        }
    }

    /// Attributes of a model's element that refer to names inside it.
    fn apply_to_root(&self, model: &mut Element) {
        for attribute in &mut model.attributes {
            if ["canonical_link", "placement_frame"].contains(&&*attribute.name)
                && let Some(new) = self.path(&attribute.value)
            {
                attribute.value = new;
            }
        }
    }

    /// Texts that are names: ends of joints, links of grippers, and any text in a plugin.
    fn apply_to_text(&self, element: &mut Element) {
        if element.elements().next().is_some() {
            return;
        }
        for node in &mut element.children {
            if let XmlNode::Text(text) = node
                && let Some(new) = self.path(text.text.trim())
            {
                text.text = new;
            }
        }
    }
}

/// Children whose names are in the scope of their parent.
fn parts(element: &Element) -> impl Iterator<Item = &Element> {
    element.elements().filter(|child| child.name != "plugin" && child.prefix().is_none())
}

fn opens_scope(element: &Element) -> bool {
    ["world", "model"].contains(&&*element.name)
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::SourceMap;
    use periplus_xml::{parse, write_document};

    use super::*;

    fn plain(text: &str) -> (String, Vec<String>) {
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add("a.sdf", text);
        let mut document = parse(file, &sources, &mut diagnostics).expect("XML");
        use_plain_names(&mut document, &mut diagnostics);
        let messages = diagnostics.iter().map(|one| one.message.clone()).collect();
        (write_document(&document), messages)
    }

    #[test]
    fn names_and_what_refers_to_them_change_together() {
        let (text, messages) = plain(
            "<sdf version='1.9'><world name='w'><model name='m' canonical_link='a::b'>\
             <link name='a::b'/><link name='c'/><link name='a__c'/><link name='a::c'/>\
             <joint name='j' type='fixed'><parent>a::b</parent><child>a::c</child></joint>\
             <frame name='f' attached_to='a::b'><pose relative_to='in::x::y'/></frame>\
             <model name='in'><link name='x::y'/><link name='plain'/></model>\
             <joint name='k' type='fixed'><parent>in::plain</parent><child>in::x::y</child></joint>\
             <plugin name='p::q' filename='f'><link_name>a::b</link_name><other>z::z</other>\
             </plugin></model></world></sdf>",
        );
        for expected in [
            "canonical_link=\"a__b\"",
            "<link name=\"a__b\"",
            "<link name=\"a__c_\"",
            "<parent>a__b</parent>",
            "<child>a__c_</child>",
            "attached_to=\"a__b\"",
            "relative_to=\"in::x__y\"",
            "<parent>in::plain</parent>",
            "<child>in::x__y</child>",
            "<link_name>a__b</link_name>",
            "<other>z::z</other>",
            "name=\"p::q\"",
        ] {
            assert!(text.contains(expected), "{text} lacks {expected}");
        }
        assert_eq!(
            messages,
            ["names with `::` are written with `__`: `a::b` as `a__b`, `a::c` as `a__c_`, `x::y` \
              as `x__y`"]
        );
    }

    #[test]
    fn a_path_into_a_model_is_no_name() {
        let text = "<sdf version='1.9'><model name='m'><model name='in'><link name='l'/></model>\
                    <frame name='f' attached_to='in::l'/></model></sdf>";
        let (written, messages) = plain(text);
        assert!(written.contains("attached_to=\"in::l\"") && messages.is_empty());
    }
}
