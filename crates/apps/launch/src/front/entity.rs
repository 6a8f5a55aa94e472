//! Common view of XML elements and YAML mappings: a name, attributes and children.

use periplus_diagnostics::{Diagnostic, Span};
use periplus_xml::Element;
use periplus_yaml::YamlNode;

use super::text::text;
use crate::evaluate::Outcome;
use crate::tree::Text;

/// Element of a launch file.
#[derive(Clone, Copy)]
pub(super) enum Entity<'f> {
    Xml(&'f Element),
    Yaml { name: &'f str, node: &'f YamlNode },
}

impl<'f> Entity<'f> {
    pub(super) fn xml(element: &'f Element) -> Self {
        Self::Xml(element)
    }

    pub(super) fn yaml(name: &'f str, node: &'f YamlNode) -> Self {
        Self::Yaml { name, node }
    }

    /// Name, with `_` for `-`, as both are in use.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Xml(element) => element.name.replace('-', "_"),
            Self::Yaml { name, .. } => name.replace('-', "_"),
        }
    }

    pub(super) fn span(&self) -> Option<Span> {
        match self {
            Self::Xml(element) => element.name_origin().0,
            Self::Yaml { node, .. } => Some(node.span),
        }
    }

    /// Attribute as written.
    pub(super) fn written(&self, name: &str) -> Option<(&'f str, Option<Span>)> {
        match self {
            Self::Xml(element) => {
                let attribute = element.attribute(name)?;
                Some((&attribute.value, attribute.value_origin.0))
            }
            Self::Yaml { node, .. } => {
                let value = node.get(name)?;
                Some((value.text()?, Some(value.span)))
            }
        }
    }

    /// Attribute with parsed substitutions.
    pub(super) fn text(&self, name: &str) -> Outcome<Option<Text>> {
        self.written(name).map(|(written, span)| Self::resolved(written, span)).transpose()
    }

    fn resolved(written: &str, span: Option<Span>) -> Outcome<Text> {
        match span {
            Some(span) => text(written, span),
            None => Err(Diagnostic::error("launch-place", "a text without a position").into()),
        }
    }

    /// Required attribute.
    pub(super) fn needed(&self, name: &str) -> Outcome<Text> {
        self.text(name)?.ok_or_else(|| {
            let mut wrong = Diagnostic::error(
                "launch-attribute",
                format!("`{}` needs `{name}`", self.name().replace('_', "-")),
            );
            if let Some(span) = self.span() {
                wrong = wrong.at(span);
            }
            wrong.into()
        })
    }

    /// List of texts in YAML; `None` if it is not a list.
    pub(super) fn list(&self, name: &str) -> Outcome<Option<Vec<Text>>> {
        let Self::Yaml { node, .. } = self else { return Ok(None) };
        let Some(list) = node.get(name).and_then(YamlNode::list) else { return Ok(None) };
        list.iter()
            .map(|item| text(item.text().unwrap_or_default(), item.span))
            .collect::<Outcome<_>>()
            .map(Some)
    }

    /// Children of all kinds but the attributes, in order.
    pub(super) fn children(&self) -> Outcome<Vec<Self>> {
        match self {
            Self::Xml(element) => Ok(element.elements().map(Self::Xml).collect()),
            Self::Yaml { node, .. } => {
                let list = node.list().or_else(|| node.get("children").and_then(YamlNode::list));
                let mut children = Vec::new();
                for item in list.unwrap_or_default() {
                    match item.entries() {
                        Some([(key, value)]) => children
                            .push(Self::Yaml { name: key.text().unwrap_or_default(), node: value }),
                        _ => {
                            return Err(Diagnostic::error(
                                "launch-entry",
                                "each entry of this list must be a mapping with one key, as `- node: {...}`",
                            )
                            .at(item.span)
                            .into());
                        }
                    }
                }
                Ok(children)
            }
        }
    }

    /// Children of a kind: elements in XML, a list under its name in YAML.
    pub(super) fn of_kind(&self, kind: &'f str) -> Vec<Self> {
        match self {
            Self::Xml(element) => element.named(kind).map(Self::Xml).collect(),
            Self::Yaml { node, .. } => {
                let list = node.get(kind).and_then(YamlNode::list).unwrap_or_default();
                list.iter().map(|node| Self::Yaml { name: kind, node }).collect()
            }
        }
    }

    /// Names of attributes and children that are not among these.
    pub(super) fn others(&self, known: &[&str]) -> Vec<(String, Option<Span>)> {
        let is_other = |name: &str| !known.contains(&name);
        match self {
            Self::Xml(element) => element
                .attributes
                .iter()
                .filter(|attribute| is_other(&attribute.name))
                .map(|attribute| (attribute.name.to_string(), attribute.origin.0))
                .collect(),
            Self::Yaml { node, .. } => node
                .entries()
                .unwrap_or_default()
                .iter()
                .filter_map(|(key, _)| Some((key.text()?, key.span)))
                .filter(|(name, _)| is_other(name))
                .map(|(name, span)| (name.to_owned(), Some(span)))
                .collect(),
        }
    }
}
