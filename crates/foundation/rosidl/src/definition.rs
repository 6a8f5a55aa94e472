//! What a text says, as plain data.

use periplus_diagnostics::Origin;

use crate::{Literal, TypeName};

/// A number, a truth value, or a byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scalar {
    /// `bool`, one byte that is 0 or 1.
    Bool,
    /// `byte`, eight bits without a meaning as a number.
    Byte,
    /// `char`, which ROS 2 holds as an unsigned number of eight bits.
    Char,
    /// `int8`.
    I8,
    /// `uint8`.
    U8,
    /// `int16`.
    I16,
    /// `uint16`.
    U16,
    /// `int32`.
    I32,
    /// `uint32`.
    U32,
    /// `int64`.
    I64,
    /// `uint64`.
    U64,
    /// `float32`.
    F32,
    /// `float64`.
    F64,
}

impl Scalar {
    /// All of them with their names in texts.
    pub const NAMES: [(Self, &'static str); 13] = [
        (Self::Bool, "bool"),
        (Self::Byte, "byte"),
        (Self::Char, "char"),
        (Self::I8, "int8"),
        (Self::U8, "uint8"),
        (Self::I16, "int16"),
        (Self::U16, "uint16"),
        (Self::I32, "int32"),
        (Self::U32, "uint32"),
        (Self::I64, "int64"),
        (Self::U64, "uint64"),
        (Self::F32, "float32"),
        (Self::F64, "float64"),
    ];

    /// The scalar with such a name in texts.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(scalar, _)| *scalar)
    }

    /// Its name in texts.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(scalar, _)| *scalar == self).map_or("", |(_, name)| name)
    }

    /// The range of an integer; none for `bool` and floating point.
    #[must_use]
    pub fn range(self) -> Option<(i128, i128)> {
        let signed = |bits: u32| (-(1_i128 << (bits - 1)), (1_i128 << (bits - 1)) - 1);
        let unsigned = |bits: u32| (0, (1_i128 << bits) - 1);
        Some(match self {
            Self::Bool | Self::F32 | Self::F64 => return None,
            Self::I8 => signed(8),
            Self::I16 => signed(16),
            Self::I32 => signed(32),
            Self::I64 => signed(64),
            Self::Byte | Self::Char | Self::U8 => unsigned(8),
            Self::U16 => unsigned(16),
            Self::U32 => unsigned(32),
            Self::U64 => unsigned(64),
        })
    }
}

/// What one element of a field is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Element {
    /// A number, a truth value or a byte.
    Scalar(Scalar),
    /// Text of at most so many bytes.
    String(Option<u64>),
    /// Text in UTF-16 of at most so many units.
    WString(Option<u64>),
    /// Another message.
    Nested(TypeName),
}

/// How many elements a field has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One, and no array.
    One,
    /// `[n]`: always so many.
    Fixed(u64),
    /// `[<=n]`: at most so many.
    Bounded(u64),
    /// `[]`: any number.
    Unbounded,
}

/// The type of a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Type {
    /// What one element is.
    pub element: Element,
    /// How many there are.
    pub shape: Shape,
}

/// One field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// Its type.
    pub r#type: Type,
    /// The value that it has when nobody sets it, where the text gives one.
    pub default: Option<Literal>,
    /// What the comments beside and above it say.
    pub doc: String,
    /// Where its type is written.
    pub origin: Origin,
}

/// One named value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// A scalar, or a string without bound.
    pub element: Element,
    /// Its value, already in range.
    pub value: Literal,
    /// What the comments beside and above it say.
    pub doc: String,
}

/// One message, or one part of a service or an action.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// Its full name.
    pub name: TypeName,
    /// Its fields in the order in which they are written and sent.
    pub fields: Vec<Field>,
    /// Its named values.
    pub constants: Vec<Constant>,
    /// What the comments at the top say.
    pub doc: String,
    /// The text that defines it, without what belongs to other parts of a service or an action;
    /// empty for what no text defines.
    pub text: String,
}

impl Definition {
    /// The messages that fields refer to, in order, with repetitions.
    pub fn nested(&self) -> impl Iterator<Item = (&Field, &TypeName)> {
        self.fields.iter().filter_map(|field| match &field.r#type.element {
            Element::Nested(name) => Some((field, name)),
            _ => None,
        })
    }
}
