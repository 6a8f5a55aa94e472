//! One line: a field or a constant.

use periplus_diagnostics::{Diagnostic, Span};

use super::InterfaceDialect;
use crate::name::{is_constant_name, is_field_name, is_package_name, is_type_name};
use crate::{ArrayShape, Constant, ElementType, Field, Scalar, Type, TypeName, literal};

pub(super) enum Read {
    Field(Field),
    Constant(Constant),
}

impl Read {
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Field(field) => &field.name,
            Self::Constant(constant) => &constant.name,
        }
    }
}

pub(super) struct Context<'a> {
    pub(super) package: &'a str,
    pub(super) dialect: InterfaceDialect,
    pub(super) span: Span,
}

/// Splits off the text after a `#` outside of quotes.
pub(super) fn without_comment(line: &str) -> (&str, Option<&str>) {
    let mut quote = None;
    let mut before = ' ';
    for (at, character) in line.char_indices() {
        match quote {
            Some(open) if character == open && before != '\\' => quote = None,
            Some(_) => {}
            None if character == '#' => {
                let comment = line[at + 1..].trim_end();
                return (&line[..at], Some(comment.strip_prefix(' ').unwrap_or(comment)));
            }
            None if ['"', '\''].contains(&character) && " \t=[,".contains(before) => {
                // A quote without a closing one is a plain character.
                let rest = &line[at + 1..];
                quote = rest.contains(character).then_some(character);
            }
            None => {}
        }
        before = character;
    }
    (line, None)
}

/// Reads a line that is neither empty nor only a comment, and the location of the name.
pub(super) fn read(code: &str, context: &Context) -> Result<(Read, Span), Box<Diagnostic>> {
    let Words { r#type: type_word, name, rest, .. } = words(code);
    let place = |word: &str| place(code, word, context.span);
    if name.is_empty() {
        let wrong = format!("`{type_word}` is followed by no name");
        return Err(Box::new(
            Diagnostic::error("missing-name", wrong)
                .at(place(type_word))
                .help("a line is `type name`, `type name default` or `type NAME=value`"),
        ));
    }
    let r#type =
        read_type(type_word, context).map_err(|wrong| Box::new(wrong(place(type_word))))?;
    if let Some(value) = rest.strip_prefix('=') {
        let constant = constant(code, name, r#type, value, context)?;
        return Ok((Read::Constant(constant), place(name)));
    }
    // ROS 1 allows any case in names.
    let lenient = context.dialect == InterfaceDialect::Ros1;
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !(is_field_name(name) || lenient && name.chars().all(plain)) {
        let wrong = format!("`{name}` cannot be the name of a field");
        return Err(Box::new(
            Diagnostic::error("bad-name", wrong)
                .at(place(name))
                .help("lower case letters, digits and single underscores, a letter first"),
        ));
    }
    let default = match rest {
        "" => None,
        rest if context.dialect == InterfaceDialect::Ros1 => {
            let wrong = format!("`{rest}` follows the field, and ROS 1 has no defaults");
            return Err(Box::new(Diagnostic::error("bad-value", wrong).at(place(rest))));
        }
        rest => Some(value(rest, &r#type, place(rest))?),
    };
    let field = Field {
        name: name.into(),
        r#type,
        default,
        doc: String::new(),
        origin: place(type_word).into(),
    };
    Ok((Read::Field(field), place(name)))
}

fn constant(
    code: &str,
    name: &str,
    r#type: Type,
    written: &str,
    context: &Context,
) -> Result<Constant, Box<Diagnostic>> {
    let place = |word: &str| place(code, word, context.span);
    // ROS 1 allows any case in constants.
    let lenient = context.dialect == InterfaceDialect::Ros1;
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !(is_constant_name(name) || lenient && name.chars().all(plain)) {
        let wrong = format!("`{name}` cannot be the name of a constant");
        return Err(Box::new(
            Diagnostic::error("bad-name", wrong)
                .at(place(name))
                .help("upper case letters, digits and single underscores, a letter first"),
        ));
    }
    let simple = matches!(r#type.element, ElementType::Scalar(_) | ElementType::String(None));
    if !simple || r#type.shape != ArrayShape::One {
        let wrong = format!("the constant `{name}` is neither a number nor a plain string");
        return Err(Box::new(Diagnostic::error("bad-constant", wrong).at(place(name))));
    }
    let written = written.trim();
    if written.is_empty() && r#type.element != ElementType::String(None) {
        let wrong = format!("the constant `{name}` has no value");
        return Err(Box::new(Diagnostic::error("bad-value", wrong).at(place(name))));
    }
    let value = value(written, &r#type, place(written))?;
    Ok(Constant { name: name.into(), element: r#type.element, value, doc: String::new() })
}

fn value(text: &str, r#type: &Type, span: Span) -> Result<literal::Literal, Box<Diagnostic>> {
    literal::read(text, r#type).map_err(|expected| {
        let wrong = format!("`{text}` is not a value of this type");
        let label = format!("expected {expected}");
        Box::new(Diagnostic::error("bad-value", wrong).at(span).label(label))
    })
}

struct Words<'a> {
    r#type: &'a str,
    name: &'a str,
    rest: &'a str,
}

fn words(code: &str) -> Words<'_> {
    let code = code.trim();
    let (r#type, after) = code.split_at(code.find([' ', '\t']).unwrap_or(code.len()));
    let after = after.trim_start();
    let ends = |c: char| c.is_whitespace() || c == '=';
    let (name, rest) = after.split_at(after.find(ends).unwrap_or(after.len()));
    Words { r#type, name, rest: rest.trim() }
}

/// Location of a word of a line; the word must be a slice of `code`.
fn place(code: &str, word: &str, line: Span) -> Span {
    let from = (word.as_ptr() as usize).saturating_sub(code.as_ptr() as usize);
    line.part(from, from + word.len())
}

type Wrong = Box<dyn FnOnce(Span) -> Diagnostic>;

fn wrong(code: &'static str, message: String, help: &'static str) -> Wrong {
    Box::new(move |span| Diagnostic::error(code, message).at(span).help(help))
}

fn read_type(word: &str, context: &Context) -> Result<Type, Wrong> {
    let (element, shape) = match word.find('[') {
        None => (word, ArrayShape::One),
        Some(open) => {
            let bad = || {
                let message = format!("`{}` is not the size of an array", &word[open..]);
                wrong("bad-array", message, "write `[]`, `[3]` or `[<=3]`")
            };
            let size = word[open + 1..].strip_suffix(']').ok_or_else(bad)?;
            let shape = if size.is_empty() {
                ArrayShape::Unbounded
            } else if let Some(bound) = size.strip_prefix("<=") {
                ArrayShape::Bounded(positive(bound).ok_or_else(bad)?)
            } else {
                ArrayShape::Fixed(positive(size).ok_or_else(bad)?)
            };
            (&word[..open], shape)
        }
    };
    Ok(Type { element: read_element(element, context)?, shape })
}

fn read_element(word: &str, context: &Context) -> Result<ElementType, Wrong> {
    let ros1 = context.dialect == InterfaceDialect::Ros1;
    match word {
        "time" if ros1 => return Ok(nested("builtin_interfaces", "Time")),
        "duration" if ros1 => return Ok(nested("builtin_interfaces", "Duration")),
        "Header" => return Ok(nested("std_msgs", "Header")),
        "byte" if ros1 => return Ok(ElementType::Scalar(Scalar::Ros1Byte)),
        _ => {}
    }
    if let Some(scalar) = Scalar::from_name(word) {
        return Ok(ElementType::Scalar(scalar));
    }
    let (stem, bound) = match word.split_once("<=") {
        None => (word, None),
        Some((stem, bound)) => {
            let bad = || {
                let message = format!("`{bound}` is not the longest that a string may be");
                wrong("bad-bound", message, "write a whole number above 0, such as `string<=255`")
            };
            (stem, Some(positive(bound).ok_or_else(bad)?))
        }
    };
    match (stem, bound) {
        ("string", bound) => return Ok(ElementType::String(bound)),
        ("wstring", bound) => return Ok(ElementType::WString(bound)),
        (stem, Some(_)) if Scalar::from_name(stem).is_none() && !stem.contains('/') => {
            return Err(unknown(stem));
        }
        (_, Some(_)) => {
            let message = format!("`{stem}` has no length to be bound");
            return Err(wrong("bad-bound", message, "only `string` and `wstring` have"));
        }
        _ => {}
    }
    let parts: Vec<&str> = word.split('/').collect();
    match parts[..] {
        [name] if is_type_name(name) => Ok(nested(context.package, name)),
        [package, name] | [package, "msg", name]
            if is_package_name(package) && is_type_name(name) =>
        {
            Ok(nested(package, name))
        }
        _ => Err(unknown(word)),
    }
}

fn nested(package: &str, name: &str) -> ElementType {
    ElementType::Nested(TypeName::message(package, name))
}

fn unknown(word: &str) -> Wrong {
    let word = word.to_owned();
    Box::new(move |span| {
        let names = Scalar::NAMES.iter().map(|(_, name)| *name).chain(["string", "wstring"]);
        let other = match word.as_str() {
            "float" => Some("float32"),
            "double" => Some("float64"),
            "int" => Some("int32"),
            "str" => Some("string"),
            _ => None,
        };
        let wrong = Diagnostic::error("unknown-type", format!("`{word}` is not a type")).at(span);
        match other {
            Some(name) => {
                let end = word.len();
                wrong.replace(span.part(0, end), name, format!("did you mean `{name}`?"))
            }
            None => wrong.did_you_mean(span.part(0, word.len()), &word, names),
        }
        .help("messages are named `package/Name`")
    })
}

fn positive(text: &str) -> Option<u64> {
    let digits = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    // Lengths are serialized with 32 bits.
    text.parse().ok().filter(|&size: &u64| digits && size > 0 && size <= u64::from(u32::MAX))
}
