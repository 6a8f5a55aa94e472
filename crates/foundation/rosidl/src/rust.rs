//! Rust code for a package: calls of the macros `message!`, `service!` and `action!` of the crate
//! `periplus-msgs`, which implement the common parts of all types.

use std::collections::BTreeMap;
use std::fmt::{self, Write as _};

use crate::{
    ArrayShape, Definition, ElementType, Field, Interface, InterfaceKind, Literal, Registry,
    Scalar, TypeName,
};

/// Error of a type that has no Rust code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CodegenError {
    /// Two types with the same name in Rust.
    NameClash(TypeName, TypeName),
    /// A type that refers to an unknown type.
    UnknownType(TypeName),
    /// An array of bounded strings, which the macros do not support.
    ArrayOfBoundedStrings {
        /// Type with the field.
        owner: TypeName,
        /// Name of the field.
        field: String,
    },
    /// A list of values for a field that is not an array.
    ListForOneValue,
}

impl fmt::Display for CodegenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NameClash(name, other) => {
                write!(f, "`{name}` and `{other}` would have the same name in Rust")
            }
            Self::UnknownType(name) => write!(f, "`{name}` needs a type that is not available"),
            Self::ArrayOfBoundedStrings { owner, field } => {
                write!(f, "`{owner}`: an array of bounded strings: `{field}`")
            }
            Self::ListForOneValue => write!(f, "a list where one value belongs"),
        }
    }
}

impl std::error::Error for CodegenError {}

/// Generates the code of one package. The types that it refers to must be in modules named like their
/// packages, next to this one.
///
/// # Errors
/// If a type cannot be expressed in this form.
pub fn package(registry: &Registry, package: &str) -> Result<String, CodegenError> {
    let types = some(registry, |name| name.package == package)?;
    Ok(head(&format!("interfaces/{package}")) + &types)
}

/// Generates the code of a module that has all types of a package, with the form of `folder` of those that
/// are variants.
///
/// # Errors
/// As [`package`].
pub fn variants(
    registry: &Registry,
    folder: &str,
    is_variant: impl Fn(&TypeName) -> bool,
) -> Result<String, CodegenError> {
    let mut code = head(folder);
    let _ = writeln!(code, "\npub use super::{}::*;", package_of(folder));
    code.push_str(&some(registry, is_variant)?);
    Ok(code)
}

fn package_of(folder: &str) -> &str {
    folder.rsplit('/').next().unwrap_or_default()
}

fn head(folder: &str) -> String {
    format!(
        "//! `{}`. Made by `cargo xtask codegen`; edit the texts in `{folder}`\n\
         //! instead.\n",
        package_of(folder)
    )
}

/// Code of the wanted types.
fn some(
    registry: &Registry,
    is_wanted: impl Fn(&TypeName) -> bool,
) -> Result<String, CodegenError> {
    let mut code = String::new();
    let mut taken = BTreeMap::new();
    for interface in registry.interfaces().filter(|one| is_wanted(&one.name)) {
        for definition in structs(registry, interface) {
            claim(&mut taken, &definition.name)?;
            message(&mut code, registry, definition)?;
        }
        match interface.name.kind {
            InterfaceKind::Message => {}
            InterfaceKind::Service => {
                claim(&mut taken, &interface.name)?;
                service(&mut code, registry, &interface.name, &interface.doc)?;
            }
            InterfaceKind::Action => {
                claim(&mut taken, &interface.name)?;
                for suffix in ["SendGoal", "GetResult"] {
                    service(&mut code, registry, &interface.name.implied(suffix), "")?;
                }
                action(&mut code, registry, interface)?;
            }
        }
    }
    Ok(code)
}

/// Types of an interface that become structs: not the events of services, which only introspection
/// publishes, nor services and actions as a whole, which are never serialized.
pub fn structs<'a>(
    registry: &'a Registry,
    interface: &'a Interface,
) -> impl Iterator<Item = &'a Definition> {
    let suffixes: &[&str] = match interface.name.kind {
        InterfaceKind::Action => &[
            "SendGoal_Request",
            "SendGoal_Response",
            "GetResult_Request",
            "GetResult_Response",
            "FeedbackMessage",
        ],
        _ => &[],
    };
    let implied =
        suffixes.iter().filter_map(|suffix| registry.get(&interface.name.implied(suffix)));
    interface.parts.iter().chain(implied)
}

/// Rust name of a type: `Trigger_Request` is `TriggerRequest`.
#[must_use]
pub fn type_name(name: &TypeName) -> String {
    name.name.replace('_', "")
}

fn claim(taken: &mut BTreeMap<String, TypeName>, name: &TypeName) -> Result<(), CodegenError> {
    match taken.insert(type_name(name), name.clone()) {
        Some(other) => Err(CodegenError::NameClash(name.clone(), other)),
        None => Ok(()),
    }
}

fn hash(registry: &Registry, name: &TypeName) -> Result<String, CodegenError> {
    registry.hash(name).ok_or_else(|| CodegenError::UnknownType(name.clone()))
}

fn message(
    code: &mut String,
    registry: &Registry,
    definition: &Definition,
) -> Result<(), CodegenError> {
    let name = &definition.name;
    let _ = writeln!(code, "\ncrate::message! {{");
    let fallback = format!("`{name}`.");
    doc(code, "    ", if definition.doc.is_empty() { &fallback } else { &definition.doc });
    let _ = writeln!(code, "    \"{name}\" \"{}\"", hash(registry, name)?);
    let _ = writeln!(code, "    {} {{", type_name(name));
    for field in &definition.fields {
        doc(code, "        ", if field.doc.is_empty() { &field.name } else { &field.doc });
        let _ = write!(code, "        {}: {}", ident(&field.name), field_type(field, name)?);
        if let Some(limit) = limit(field) {
            let _ = write!(code, " | {limit}");
        }
        if let Some(default) = &field.default {
            let _ = write!(code, " = {}", value(default, field)?);
        }
        code.push_str(",\n");
    }
    code.push_str("    }\n");
    for constant in &definition.constants {
        doc(code, "    ", if constant.doc.is_empty() { &constant.name } else { &constant.doc });
        let rust = match constant.element {
            ElementType::Scalar(scalar) => scalar_type(scalar),
            _ => "&str",
        };
        let value = scalar_value(&constant.value, &constant.element)?;
        let _ = writeln!(code, "    {}: {rust} = {value};", constant.name);
    }
    code.push_str("}\n");
    Ok(())
}

fn service(
    code: &mut String,
    registry: &Registry,
    name: &TypeName,
    words: &str,
) -> Result<(), CodegenError> {
    let _ = writeln!(code, "\ncrate::service! {{");
    let fallback = format!("`{name}`.");
    doc(code, "    ", if words.is_empty() { &fallback } else { words });
    let rust = type_name(name);
    let hash = hash(registry, name)?;
    let _ = writeln!(code, "    \"{name}\" \"{hash}\"\n    {rust}, {rust}Request, {rust}Response");
    code.push_str("}\n");
    Ok(())
}

fn action(
    code: &mut String,
    registry: &Registry,
    interface: &Interface,
) -> Result<(), CodegenError> {
    let _ = writeln!(code, "\ncrate::action! {{");
    let fallback = format!("`{}`.", interface.name);
    doc(code, "    ", if interface.doc.is_empty() { &fallback } else { &interface.doc });
    let rust = type_name(&interface.name);
    let hash = hash(registry, &interface.name)?;
    let _ = writeln!(code, "    \"{}\" \"{hash}\"", interface.name);
    let _ = writeln!(
        code,
        "    {rust}, {rust}Goal, {rust}Result, {rust}Feedback,\n    {rust}SendGoal, \
         {rust}GetResult, {rust}FeedbackMessage"
    );
    code.push_str("}\n");
    Ok(())
}

fn doc(code: &mut String, indent: &str, text: &str) {
    for line in text.lines() {
        // Text that looks like a link or a tag to rustdoc is escaped.
        let line = line.replace('[', "\\[").replace('<', "\\<");
        let _ = writeln!(code, "{}", format!("{indent}/// {line}").trim_end());
    }
}

fn field_type(field: &Field, owner: &TypeName) -> Result<String, CodegenError> {
    let one = match &field.r#type.element {
        ElementType::Scalar(scalar) => scalar_type(*scalar).to_owned(),
        ElementType::String(_) => "std::string::String".into(),
        ElementType::WString(_) => "crate::WideString".into(),
        ElementType::Nested(name) if name.package == owner.package => type_name(name),
        ElementType::Nested(name) => format!("crate::{}::{}", name.package, type_name(name)),
    };
    let bound_twice = limit_of_text(&field.r#type.element).is_some();
    Ok(match field.r#type.shape {
        ArrayShape::One => one,
        _ if bound_twice => {
            return Err(CodegenError::ArrayOfBoundedStrings {
                owner: owner.clone(),
                field: field.name.clone(),
            });
        }
        ArrayShape::Fixed(size) => format!("[{one}; {size}]"),
        ArrayShape::Bounded(_) | ArrayShape::Unbounded => format!("Vec<{one}>"),
    })
}

fn limit_of_text(element: &ElementType) -> Option<u64> {
    match element {
        ElementType::String(limit) | ElementType::WString(limit) => *limit,
        _ => None,
    }
}

/// Maximum length of a field, if the text gives one.
fn limit(field: &Field) -> Option<u64> {
    match field.r#type.shape {
        ArrayShape::One => limit_of_text(&field.r#type.element),
        ArrayShape::Bounded(limit) => Some(limit),
        _ => None,
    }
}

fn scalar_type(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Bool => "bool",
        Scalar::Byte | Scalar::Char | Scalar::U8 => "u8",
        Scalar::I8 | Scalar::Ros1Byte => "i8",
        Scalar::I16 => "i16",
        Scalar::U16 => "u16",
        Scalar::I32 => "i32",
        Scalar::U32 => "u32",
        Scalar::I64 => "i64",
        Scalar::U64 => "u64",
        Scalar::F32 => "f32",
        Scalar::F64 => "f64",
    }
}

fn value(literal: &Literal, field: &Field) -> Result<String, CodegenError> {
    let one = |literal: &Literal| {
        let value = scalar_value(literal, &field.r#type.element)?;
        let is_text = matches!(literal, Literal::Text(_));
        Ok(if is_text { format!("{value}.into()") } else { value })
    };
    match literal {
        Literal::List(list) => {
            let items: Result<Vec<String>, CodegenError> = list.iter().map(one).collect();
            let opening =
                if matches!(field.r#type.shape, ArrayShape::Fixed(_)) { "[" } else { "vec![" };
            Ok(format!("{opening}{}]", items?.join(", ")))
        }
        literal => one(literal),
    }
}

fn scalar_value(literal: &Literal, element: &ElementType) -> Result<String, CodegenError> {
    Ok(match literal {
        Literal::Bool(value) => value.to_string(),
        Literal::Int(value) => value.to_string(),
        Literal::Float(value) if value.is_finite() => format!("{value:?}"),
        Literal::Float(value) => {
            let rust = if *element == ElementType::Scalar(Scalar::F32) { "f32" } else { "f64" };
            let name = match (value.is_nan(), *value > 0.0) {
                (true, _) => "NAN",
                (false, true) => "INFINITY",
                (false, false) => "NEG_INFINITY",
            };
            format!("{rust}::{name}")
        }
        Literal::Text(text) => format!("{text:?}"),
        Literal::List(_) => return Err(CodegenError::ListForOneValue),
    })
}

/// Rust keywords that may be names of fields.
const KEYWORDS: [&str; 44] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn",
    "else", "enum", "extern", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "static",
    "struct", "trait", "try", "type", "typeof", "unsafe", "use", "virtual", "where", "while",
];

fn ident(name: &str) -> String {
    match name {
        // These cannot be raw identifiers; the macro removes the underscore.
        "self" | "super" | "crate" => format!("{name}_"),
        name if KEYWORDS.contains(&name)
            || ["yield", "unsized", "true", "false", "static"].contains(&name) =>
        {
            format!("r#{name}")
        }
        name => name.into(),
    }
}
