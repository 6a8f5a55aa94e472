//! Errors of mesh files with location and advice.

use std::fmt;

/// Location in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Line of a text file, counted from 1.
    Line(usize),
    /// Offset in a binary file, in bytes from its start.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, "line {line}"),
            Place::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Error of a mesh file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshError {
    /// Description of the fault.
    pub message: String,
    /// Location, if known.
    pub place: Option<Place>,
    /// Advice.
    pub help: String,
}

impl MeshError {
    pub(crate) fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        MeshError { message: message.into(), place: None, help: help.into() }
    }

    pub(crate) fn at(mut self, place: Place) -> Self {
        self.place = Some(place);
        self
    }
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = self.place {
            write!(f, "{place}: ")?;
        }
        write!(f, "{}; {}", self.message, self.help)
    }
}

impl std::error::Error for MeshError {}
