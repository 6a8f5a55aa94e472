//! Type descriptions as messages, the response of `~/get_type_description` of a node.
//!
//! Source: the texts of `type_description_interfaces`, and `rosidl_generator_type_description` (order of
//! the referenced types, encodings of the sources).

use std::collections::BTreeMap;

use periplus_rosidl::{Definition, InterfaceKind, Literal, TypeName};

use crate::TypeRegistry;
use crate::type_description_interfaces::{
    Field, FieldType, IndividualTypeDescription, TypeDescription, TypeSource,
};

/// Member of an empty structure, as IDL does not support these.
const EMPTY_MEMBER: &str = "structure_needs_at_least_one_member";

impl TypeRegistry {
    /// Description of a type and of all types that it refers to; `None` if one of them is unknown.
    #[must_use]
    pub fn type_description(&self, type_name: &str) -> Option<TypeDescription> {
        let name = TypeName::read(type_name)?;
        let referenced = self.referenced_by_text(&name);
        let each = referenced.values().map(|name| self.registry().get(name).map(individual));
        Some(TypeDescription {
            type_description: individual(self.registry().get(&name)?),
            referenced_type_descriptions: each.collect::<Option<_>>()?,
        })
    }

    /// Source texts of a type, its own first. Types implied by services and actions have the encoding
    /// `implicit` and no text.
    #[must_use]
    pub fn type_sources(&self, type_name: &str) -> Vec<TypeSource> {
        let Some(name) = TypeName::read(type_name) else { return Vec::new() };
        let referenced = self.referenced_by_text(&name);
        std::iter::once(&name).chain(referenced.values()).map(|name| self.source(name)).collect()
    }

    fn referenced_by_text(&self, name: &TypeName) -> BTreeMap<String, TypeName> {
        let referenced = self.registry().referenced(name).into_iter();
        referenced.map(|name| (name.to_string(), name)).collect()
    }

    fn source(&self, name: &TypeName) -> TypeSource {
        let (encoding, text) = match self.registry().interface(name) {
            Some(interface) => {
                let encoding = match name.kind {
                    InterfaceKind::Message => "msg",
                    InterfaceKind::Service => "srv",
                    InterfaceKind::Action => "action",
                };
                let texts: Vec<&str> =
                    interface.parts.iter().map(|part| part.text.trim_end()).collect();
                (encoding, format!("{}\n", texts.join("\n---\n")))
            }
            None => ("implicit", String::new()),
        };
        TypeSource {
            type_name: name.to_string(),
            encoding: encoding.to_owned(),
            raw_file_contents: text,
        }
    }
}

fn individual(definition: &Definition) -> IndividualTypeDescription {
    let mut fields: Vec<Field> = definition
        .fields
        .iter()
        .map(|field| {
            let numbers = field.r#type.numbers();
            Field {
                name: field.name.clone(),
                r#type: FieldType {
                    type_id: numbers.type_id,
                    capacity: numbers.capacity,
                    string_capacity: numbers.string_capacity,
                    nested_type_name: field.r#type.nested_name(),
                },
                default_value: field.default.as_ref().map(default_value).unwrap_or_default(),
            }
        })
        .collect();
    if fields.is_empty() {
        let r#type = FieldType { type_id: FieldType::FIELD_TYPE_UINT8, ..FieldType::default() };
        fields.push(Field { name: EMPTY_MEMBER.to_owned(), r#type, ..Field::default() });
    }
    IndividualTypeDescription { type_name: definition.name.to_string(), fields }
}

/// Default value as in `rosidl`: as printed by Python, a list as a tuple.
fn default_value(literal: &Literal) -> String {
    match literal {
        Literal::Text(text) => text.clone(),
        Literal::List(items) => {
            let items: Vec<String> = items.iter().map(repr).collect();
            // A tuple of one element keeps its comma.
            let comma = if items.len() == 1 { "," } else { "" };
            format!("({}{comma})", items.join(", "))
        }
        one => repr(one),
    }
}

fn repr(literal: &Literal) -> String {
    match literal {
        Literal::Bool(value) => if *value { "True" } else { "False" }.to_owned(),
        Literal::Int(value) => value.to_string(),
        Literal::Float(value) => float(*value),
        Literal::Text(text) => {
            let text = text.replace('\\', "\\\\");
            if text.contains('\'') && !text.contains('"') {
                format!("\"{text}\"")
            } else {
                format!("'{}'", text.replace('\'', "\\'"))
            }
        }
        Literal::List(_) => default_value(literal),
    }
}

/// Number as printed by Python: exponents have a sign and two digits.
fn float(value: f64) -> String {
    let text = format!("{value:?}").to_lowercase();
    let Some((digits, exponent)) = text.split_once('e') else { return text };
    let (sign, exponent) = exponent.strip_prefix('-').map_or(('+', exponent), |rest| ('-', rest));
    format!("{digits}e{sign}{exponent:0>2}")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;

    #[test]
    fn defaults_are_written_as_python_prints_them() {
        let list = |items: &[Literal]| Literal::List(items.to_vec());
        let text = |text: &str| Literal::Text(text.to_owned());
        for (literal, written) in [
            (Literal::Bool(true), "True"),
            (Literal::Float(1e-7), "1e-07"),
            (Literal::Float(1.0), "1.0"),
            (list(&[Literal::Int(1)]), "(1,)"),
            (list(&[Literal::Bool(false), text("it's")]), "(False, \"it's\")"),
            (text("as it is"), "as it is"),
        ] {
            assert_eq!(default_value(&literal), written);
        }
    }

    #[test]
    fn a_description_names_fields_and_referenced_types() {
        let types = TypeRegistry::builtin();
        let description = types.type_description("std_srvs/srv/Trigger").unwrap();
        let names: Vec<&str> = description
            .referenced_type_descriptions
            .iter()
            .map(|one| one.type_name.as_str())
            .collect();
        assert_eq!(
            names,
            [
                "builtin_interfaces/msg/Time",
                "service_msgs/msg/ServiceEventInfo",
                "std_srvs/srv/Trigger_Event",
                "std_srvs/srv/Trigger_Request",
                "std_srvs/srv/Trigger_Response",
            ]
        );
        let request = &description.referenced_type_descriptions[3];
        assert_eq!(request.fields[0].name, EMPTY_MEMBER);
        let sources = types.type_sources("std_srvs/srv/Trigger");
        assert_eq!((sources.len(), sources[0].encoding.as_str()), (6, "srv"));
        assert!(sources[0].raw_file_contents.contains("---\n"), "{sources:?}");
        assert_eq!(sources[4].encoding, "implicit");
        assert_eq!(types.type_description("no_such/msg/Type"), None);
    }
}
