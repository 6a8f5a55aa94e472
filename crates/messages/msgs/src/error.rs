//! Errors of messages.

use std::fmt;

/// Error of bytes or JSON that are not a message of a type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DecodeError {
    /// Description of the fault.
    pub problem: Problem,
    /// Path of the field: names of fields and indices of elements, such as `fields[2].name`.
    pub path: String,
    /// Offset of the reader [bytes]; 0 for JSON.
    pub offset: usize,
}

/// Fault in bytes or JSON.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Problem {
    /// The message ends too early.
    Short {
        /// Number of bytes needed.
        needed: usize,
        /// Number of bytes left.
        left: usize,
    },
    /// Bytes follow the end of the message.
    Long {
        /// Number of bytes.
        left: usize,
    },
    /// The first bytes are not the header of plain CDR.
    Encapsulation(u8, u8),
    /// More elements than the rest of the message can contain.
    Count(usize),
    /// More elements or characters than the type allows.
    Bound {
        /// Number of elements or characters.
        count: usize,
        /// Maximum number.
        limit: usize,
    },
    /// A boolean that is neither 0 nor 1.
    Truth(u8),
    /// A string that is not valid UTF-8 or UTF-16.
    Text,
    /// JSON of the wrong type.
    Json {
        /// Expected value.
        expected: String,
        /// Actual value.
        found: String,
    },
    /// JSON of another type where a string is expected.
    NotAString {
        /// Actual value.
        found: String,
    },
    /// Unknown name.
    Unknown {
        /// The name.
        name: String,
        /// Known names.
        known: Vec<String>,
    },
}

impl DecodeError {
    pub(crate) fn new(problem: Problem, offset: usize) -> Self {
        Self { problem, path: String::new(), offset }
    }

    /// Adds the field of the enclosing structure to the path.
    pub(crate) fn within(mut self, field: &str) -> Self {
        let dot = if self.path.is_empty() || self.path.starts_with('[') { "" } else { "." };
        self.path = format!("{field}{dot}{}", self.path);
        self
    }

    /// Adds the index in the enclosing list to the path.
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
                    "the message begins with {first:02x} {second:02x}, which is not a header of plain CDR"
                )?;
            }
            Problem::Count(count) => {
                write!(f, "{count} elements are announced, more than the message can hold")?;
            }
            Problem::Bound { count, limit } => {
                write!(f, "{count} elements where the type allows {limit}")?;
            }
            Problem::Truth(byte) => write!(f, "a truth value is {byte}, neither 0 nor 1")?,
            Problem::Text => write!(f, "a string is not valid UTF-8")?,
            Problem::Json { expected, found } => write!(f, "expected {expected}, found {found}")?,
            Problem::NotAString { found } => write!(f, "expected a string, found {found}")?,
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

/// Error of a message that cannot be serialized: a value is longer than its type allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EncodeError {
    /// Number of elements or characters.
    pub count: usize,
    /// Maximum number.
    pub limit: usize,
    /// Field.
    pub field: String,
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, limit, field } = self;
        write!(f, "`{field}` has {count} elements, and its type allows {limit}")
    }
}

impl std::error::Error for EncodeError {}
