//! Conversion of types between ROS 1 and ROS 2.
//!
//! The MD5 sum of ROS 1 is that of `genmsg`: over the constants, then the fields, each in its own line,
//! where the type of a nested message is replaced by its sum.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use md5::{Digest, Md5};

use crate::{
    ArrayShape, Constant, Definition, ElementType, Literal, Registry, SEPARATOR, Scalar, TypeName,
};

/// Definition and MD5 sum of a type for ROS 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ros1Text {
    /// Text of the type and of all types that it needs, as in ROS 1 bags.
    pub text: String,
    /// MD5 sum, as 32 hexadecimal digits.
    pub md5: String,
}

impl Registry {
    /// Type in the form of ROS 1, without bounds and defaults. `None` if the type is unknown or ROS 1 has
    /// no equivalent: wide strings.
    #[must_use]
    pub fn ros1_text(&self, name: &TypeName) -> Option<Ros1Text> {
        let mut sums = BTreeMap::new();
        let md5 = self.sum(name, &mut sums)?;
        let mut order = vec![name];
        let mut text = String::new();
        let mut next = 0;
        while let Some(&name) = order.get(next) {
            let definition = self.get(name)?;
            if next > 0 {
                let _ = write!(text, "{SEPARATOR}\nMSG: {}\n", name.short());
            }
            let parts =
                definition.constants.iter().map(|one| constant(one, &one.name, Scalar::name));
            let fields = fields(definition, |name| Some(name.short()), &mut |name| {
                if !order.contains(&name) {
                    order.push(name);
                }
            });
            for line in parts.chain(fields?) {
                text.push_str(&line);
                text.push('\n');
            }
            next += 1;
        }
        Some(Ros1Text { text, md5 })
    }

    /// MD5 sum of a service: over the lines of its request and those of its response. `None` as for
    /// [`Registry::ros1_text`].
    #[must_use]
    pub fn ros1_service_md5(&self, service: &TypeName) -> Option<String> {
        let (request, response) = (service.implied("Request"), service.implied("Response"));
        let mut sums = BTreeMap::new();
        let mut text = self.summed_lines(&request, &mut sums)?;
        text.push_str(&self.summed_lines(&response, &mut sums)?);
        Some(md5_of(&text))
    }

    fn sum<'a>(
        &'a self,
        name: &'a TypeName,
        sums: &mut BTreeMap<&'a TypeName, String>,
    ) -> Option<String> {
        if let Some(known) = sums.get(name) {
            return Some(known.clone());
        }
        let sum = md5_of(&self.summed_lines(name, sums)?);
        sums.insert(name, sum.clone());
        Some(sum)
    }

    /// Lines over which the sum of a type is computed.
    fn summed_lines<'a>(
        &'a self,
        name: &TypeName,
        sums: &mut BTreeMap<&'a TypeName, String>,
    ) -> Option<String> {
        let definition = self.get(name)?;
        for (_, nested) in definition.nested() {
            if time_word(nested).is_none() {
                self.sum(nested, sums)?;
            }
        }
        let constants =
            definition.constants.iter().map(|one| constant(one, &one.name, Scalar::name));
        let fields = fields(definition, |name| sums.get(name).cloned(), &mut |_| {})?;
        let lines: Vec<String> = constants.chain(fields).collect();
        Some(lines.join("\n"))
    }

    /// Returns the same types with names valid in ROS 2, and matching texts.
    #[must_use]
    pub fn for_ros2(&self) -> Self {
        let mut all = Self::new();
        for interface in self.interfaces() {
            let mut interface = interface.clone();
            for part in &mut interface.parts {
                part.text = ros2_text(part);
                for field in &mut part.fields {
                    field.name = field.name.to_ascii_lowercase();
                }
            }
            all.add(interface);
        }
        all
    }
}

fn md5_of(text: &str) -> String {
    let mut sum = String::new();
    for byte in Md5::digest(text) {
        let _ = write!(sum, "{byte:02x}");
    }
    sum
}

/// Lines of the fields; a sum replaces a nested message with its brackets.
fn fields<'a>(
    definition: &'a Definition,
    nested: impl Fn(&TypeName) -> Option<String>,
    needs: &mut dyn FnMut(&'a TypeName),
) -> Option<Vec<String>> {
    let mut lines = Vec::new();
    let header = TypeName::message("std_msgs", "Header");
    if definition.name == header {
        lines.push("uint32 seq".to_owned());
    }
    for field in &definition.fields {
        let mut is_sum = false;
        let word = match &field.r#type.element {
            ElementType::Scalar(scalar) => scalar.name().to_owned(),
            ElementType::String(_) => "string".to_owned(),
            ElementType::WString(_) => return None,
            ElementType::Nested(name) => match time_word(name) {
                Some(word) => word.to_owned(),
                None => {
                    needs(name);
                    let word = nested(name)?;
                    is_sum = !word.contains('/');
                    word
                }
            },
        };
        let brackets = match field.r#type.shape {
            ArrayShape::One => String::new(),
            _ if is_sum => String::new(),
            ArrayShape::Fixed(size) => format!("[{size}]"),
            ArrayShape::Bounded(_) | ArrayShape::Unbounded => "[]".to_owned(),
        };
        lines.push(format!("{word}{brackets} {}", field.name));
    }
    Some(lines)
}

fn time_word(name: &TypeName) -> Option<&'static str> {
    match (name.package.as_str(), name.name.as_str()) {
        ("builtin_interfaces", "Time") => Some("time"),
        ("builtin_interfaces", "Duration") => Some("duration"),
        _ => None,
    }
}

/// Word in ROS 2; there `byte` has no numeric meaning.
fn ros2_word(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Ros1Byte => Scalar::I8.name(),
        other => other.name(),
    }
}

fn constant(constant: &Constant, name: &str, word_of: fn(Scalar) -> &'static str) -> String {
    let word = match &constant.element {
        ElementType::Scalar(scalar) => word_of(*scalar),
        _ => "string",
    };
    let value = match &constant.value {
        Literal::Bool(true) => "True".to_owned(),
        Literal::Bool(false) => "False".to_owned(),
        Literal::Int(value) => value.to_string(),
        Literal::Float(value) => format!("{value:?}"),
        Literal::Text(text) => text.clone(),
        Literal::List(_) => String::new(),
    };
    format!("{word} {name}={value}")
}

/// Definition in the form of ROS 2.
fn ros2_text(definition: &Definition) -> String {
    let mut text = String::new();
    for one in &definition.constants {
        let name = one.name.to_ascii_uppercase();
        let line = match &one.value {
            Literal::Text(text) => format!("string {name}=\"{}\"", text.replace('"', "\\\"")),
            _ => constant(one, &name, ros2_word),
        };
        text.push_str(&line);
        text.push('\n');
    }
    for field in &definition.fields {
        let word = match &field.r#type.element {
            ElementType::Scalar(scalar) => ros2_word(*scalar).to_owned(),
            ElementType::String(limit) => bounded("string", *limit),
            ElementType::WString(limit) => bounded("wstring", *limit),
            ElementType::Nested(name) => name.short(),
        };
        let brackets = match field.r#type.shape {
            ArrayShape::One => String::new(),
            ArrayShape::Fixed(size) => format!("[{size}]"),
            ArrayShape::Bounded(most) => format!("[<={most}]"),
            ArrayShape::Unbounded => "[]".to_owned(),
        };
        let _ = writeln!(text, "{word}{brackets} {}", field.name.to_ascii_lowercase());
    }
    text
}

fn bounded(word: &str, limit: Option<u64>) -> String {
    limit.map_or_else(|| word.to_owned(), |limit| format!("{word}<={limit}"))
}
