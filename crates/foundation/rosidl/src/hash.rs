//! Type hashes: RIHS01.
//!
//! SHA-256 of the type's description as JSON (ROS Enhancement Proposal 2016; the layout of the JSON is that
//! of `rosidl_generator_type_description`). Names, types and order of the fields matter; comments,
//! constants and defaults do not.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

use crate::{ArrayShape, Definition, ElementType, Field, Registry, Scalar, Type, TypeName};

impl Registry {
    /// `RIHS01_` and 64 hexadecimal digits; `None` if the type or one that it needs is unknown.
    #[must_use]
    pub fn hash(&self, name: &TypeName) -> Option<String> {
        let digest = Sha256::digest(self.description(name)?);
        let mut hash = String::from("RIHS01_");
        for byte in digest {
            let _ = write!(hash, "{byte:02x}");
        }
        Some(hash)
    }

    /// Text that is hashed.
    #[must_use]
    pub fn description(&self, name: &TypeName) -> Option<String> {
        let mut json = String::from("{\"type_description\": ");
        individual(&mut json, self.get(name)?);
        json.push_str(", \"referenced_type_descriptions\": [");
        // Sorted by full name as text.
        let mut referenced: Vec<(String, TypeName)> =
            self.referenced(name).into_iter().map(|name| (name.to_string(), name)).collect();
        referenced.sort();
        for (index, (_, name)) in referenced.iter().enumerate() {
            json.push_str(if index == 0 { "" } else { ", " });
            individual(&mut json, self.get(name)?);
        }
        json.push_str("]}");
        Some(json)
    }
}

fn individual(json: &mut String, definition: &Definition) {
    let _ = write!(json, "{{\"type_name\": \"{}\", \"fields\": [", definition.name);
    for (index, field) in definition.fields.iter().enumerate() {
        json.push_str(if index == 0 { "" } else { ", " });
        one(json, field);
    }
    if definition.fields.is_empty() {
        // IDL has no empty structures.
        json.push_str(
            "{\"name\": \"structure_needs_at_least_one_member\", \"type\": {\"type_id\": 3, \
             \"capacity\": 0, \"string_capacity\": 0, \"nested_type_name\": \"\"}}",
        );
    }
    json.push_str("]}");
}

impl Type {
    /// Numbers of `type_description_interfaces/msg/FieldType` that describe it.
    #[must_use]
    pub fn numbers(&self) -> TypeNumbers {
        let (id, string_capacity) = match &self.element {
            ElementType::Scalar(scalar) => (scalar_id(*scalar), 0),
            ElementType::String(None) => (17, 0),
            ElementType::WString(None) => (18, 0),
            ElementType::String(Some(bound)) => (21, *bound),
            ElementType::WString(Some(bound)) => (22, *bound),
            ElementType::Nested(_) => (1, 0),
        };
        let (added, capacity) = match self.shape {
            ArrayShape::One => (0, 0),
            ArrayShape::Fixed(size) => (48, size),
            ArrayShape::Bounded(bound) => (96, bound),
            ArrayShape::Unbounded => (144, 0),
        };
        TypeNumbers { type_id: id + added, capacity, string_capacity }
    }

    /// Name of the message of its elements; empty for scalars and text.
    #[must_use]
    pub fn nested_name(&self) -> String {
        match &self.element {
            ElementType::Nested(name) => name.to_string(),
            _ => String::new(),
        }
    }
}

/// Type of a field as in `type_description_interfaces/msg/FieldType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TypeNumbers {
    /// Element and array type, in one number.
    pub type_id: u8,
    /// Bound or size of an array; 0 if none.
    pub capacity: u64,
    /// Bound of a string; 0 if none.
    pub string_capacity: u64,
}

fn one(json: &mut String, field: &Field) {
    let nested = field.r#type.nested_name();
    let TypeNumbers { type_id, capacity, string_capacity } = field.r#type.numbers();
    let _ = write!(
        json,
        "{{\"name\": \"{}\", \"type\": {{\"type_id\": {type_id}, \"capacity\": {capacity}, \
         \"string_capacity\": {string_capacity}, \"nested_type_name\": \"{nested}\"}}}}",
        field.name
    );
}

/// Numbers of `type_description_interfaces/msg/FieldType`; a `char` is hashed as `uint8`.
fn scalar_id(scalar: Scalar) -> u8 {
    match scalar {
        Scalar::I8 | Scalar::Ros1Byte => 2,
        Scalar::U8 | Scalar::Char => 3,
        Scalar::I16 => 4,
        Scalar::U16 => 5,
        Scalar::I32 => 6,
        Scalar::U32 => 7,
        Scalar::I64 => 8,
        Scalar::U64 => 9,
        Scalar::F32 => 10,
        Scalar::F64 => 11,
        Scalar::Bool => 15,
        Scalar::Byte => 16,
    }
}
