//! What can be wrong with a message.

use std::fmt;

/// Why bytes or JSON are no message of a type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DecodeError {
    /// What is wrong.
    pub problem: Problem,
    /// Where: names of fields and numbers of elements from the outside, such as `fields[2].name`.
    pub path: String,
    /// How far the reading had come; bytes from the start, 0 for JSON.
    pub offset: usize,
}

/// What is wrong with bytes or JSON.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Problem {
    /// The message ends too early.
    Short {
        /// Bytes that are needed.
        needed: usize,
        /// Bytes that are left.
        left: usize,
    },
    /// There are bytes behind the end of the message.
    Long {
        /// How many.
        left: usize,
    },
    /// The first bytes do not say that this is plain CDR.
    Encapsulation(u8, u8),
    /// More elements than the rest of the message can hold.
    Count(usize),
    /// More elements or characters than the type allows.
    Bound {
        /// How many there are.
        count: usize,
        /// How many there may be.
        limit: usize,
    },
    /// A truth value that is neither 0 nor 1.
    Truth(u8),
    /// A string that is no UTF-8 or UTF-16.
    Text,
    /// JSON of another kind.
    Json {
        /// What belongs there.
        expected: String,
        /// What is there.
        found: String,
    },
    /// A name that the type does not have.
    Unknown {
        /// What is there.
        name: String,
        /// Which are known.
        known: Vec<String>,
    },
}

impl DecodeError {
    pub(crate) fn new(problem: Problem, offset: usize) -> Self {
        Self { problem, path: String::new(), offset }
    }

    /// The same, seen from the structure around the field.
    pub(crate) fn within(mut self, field: &str) -> Self {
        let dot = if self.path.is_empty() || self.path.starts_with('[') { "" } else { "." };
        self.path = format!("{field}{dot}{}", self.path);
        self
    }

    /// The same, seen from the list around the element.
    pub(crate) fn within_element(self, index: usize) -> Self {
        self.within(&format!("[{index}]"))
    }
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.problem {
            Problem::Short { needed, left } => {
                write!(
                    f,
                    "the message ends too early: {needed} bytes are needed, {left} are left"
                )?;
            }
            Problem::Long { left } => {
                write!(f, "{left} bytes follow the end of the message: it is of another type")?;
            }
            Problem::Encapsulation(first, second) => {
                write!(
                    f,
                    "the message begins with {first:02x} {second:02x}, not as plain CDR does"
                )?;
            }
            Problem::Count(count) => {
                write!(f, "{count} elements are announced, more than the message can hold")?;
            }
            Problem::Bound { count, limit } => {
                write!(f, "{count} elements where the type allows {limit}")?;
            }
            Problem::Truth(byte) => write!(f, "a truth value is {byte}, neither 0 nor 1")?,
            Problem::Text => write!(f, "a string is no valid text")?,
            Problem::Json { expected, found } => write!(f, "expected {expected}, found {found}")?,
            Problem::Unknown { name, known } => {
                write!(f, "there is no field `{name}`")?;
                let known = known.iter().map(String::as_str);
                if let Some(near) = periplus_diagnostics::closest(name, known) {
                    write!(f, ", did you mean `{near}`?")?;
                }
            }
        }
        if !self.path.is_empty() {
            write!(f, " (at `{}`)", self.path)?;
        }
        if self.offset > 0 {
            write!(f, " (byte {})", self.offset)?;
        }
        Ok(())
    }
}

impl std::error::Error for DecodeError {}

/// Why a message cannot be sent: it holds more than its type allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EncodeError {
    /// How many elements or characters there are.
    pub count: usize,
    /// How many there may be.
    pub limit: usize,
    /// The field.
    pub field: String,
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, limit, field } = self;
        write!(f, "`{field}` has {count} elements, and its type allows {limit}")
    }
}

impl std::error::Error for EncodeError {}
