//! Interface definitions as plain data.

use periplus_diagnostics::Origin;

use crate::{Literal, TypeName};

/// Number, boolean, or byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scalar {
    /// `bool`, one byte with the value 0 or 1.
    Bool,
    /// `byte`, eight bits without numeric meaning.
    Byte,
    /// `char`, in ROS 2 an unsigned 8-bit integer.
    Char,
    /// `int8`.
    I8,
    /// `byte` of ROS 1, a signed 8-bit integer.
    Ros1Byte,
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
    /// All of ROS 2 with their names in interface texts.
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

    /// Scalar with this name in interface texts.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(scalar, _)| *scalar)
    }

    /// Name in interface texts.
    #[must_use]
    pub fn name(self) -> &'static str {
        if self == Self::Ros1Byte {
            return "byte";
        }
        Self::NAMES.iter().find(|(scalar, _)| *scalar == self).map_or("", |(_, name)| name)
    }

    /// Range of an integer; `None` for `bool` and floating point.
    #[must_use]
    pub fn range(self) -> Option<(i128, i128)> {
        let signed = |bits: u32| (-(1_i128 << (bits - 1)), (1_i128 << (bits - 1)) - 1);
        let unsigned = |bits: u32| (0, (1_i128 << bits) - 1);
        Some(match self {
            Self::Bool | Self::F32 | Self::F64 => return None,
            Self::I8 | Self::Ros1Byte => signed(8),
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

/// Type of one element of a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ElementType {
    /// Number, boolean or byte.
    Scalar(Scalar),
    /// String of at most N bytes.
    String(Option<u64>),
    /// UTF-16 string of at most N code units.
    WString(Option<u64>),
    /// Another message.
    Nested(TypeName),
}

/// Number of elements of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArrayShape {
    /// Single value, no array.
    One,
    /// `[n]`: fixed-size array.
    Fixed(u64),
    /// `[<=n]`: bounded sequence.
    Bounded(u64),
    /// `[]`: unbounded sequence.
    Unbounded,
}

/// Type of a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Type {
    /// Type of one element.
    pub element: ElementType,
    /// Number of elements.
    pub shape: ArrayShape,
}

/// Field of a message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// Its type.
    pub r#type: Type,
    /// Default value, if given.
    pub default: Option<Literal>,
    /// Text of the comments next to and above it.
    pub doc: String,
    /// Source location of the type.
    pub origin: Origin,
}

/// Named constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Scalar, or an unbounded string.
    pub element: ElementType,
    /// Value, already in range.
    pub value: Literal,
    /// Text of the comments next to and above it.
    pub doc: String,
}

/// Message, or one part of a service or an action.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// Its full name.
    pub name: TypeName,
    /// Fields in the order of the text and of the serialization.
    pub fields: Vec<Field>,
    /// Its named values.
    pub constants: Vec<Constant>,
    /// Text of the comments at the top.
    pub doc: String,
    /// Text that defines it, without other parts of a service or an action; empty for implied types.
    pub text: String,
}

impl Definition {
    /// Messages that fields refer to, in order, with repetitions.
    pub fn nested(&self) -> impl Iterator<Item = (&Field, &TypeName)> {
        self.fields.iter().filter_map(|field| match &field.r#type.element {
            ElementType::Nested(name) => Some((field, name)),
            _ => None,
        })
    }
}
