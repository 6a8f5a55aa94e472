//! Errors of mesh files with location and advice.

use std::fmt;

/// Location in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshLocation {
    /// Line of a text file, counted from 1.
    Line(usize),
    /// Offset in a binary file, in bytes from its start.
    Byte(usize),
}

impl fmt::Display for MeshLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MeshLocation::Line(line) => write!(f, "line {line}"),
            MeshLocation::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Error of a mesh file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshError {
    /// Description of the fault.
    pub message: String,
    /// Location, if known.
    pub place: Option<MeshLocation>,
    /// Advice.
    pub help: String,
}

impl MeshError {
    pub(crate) fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        MeshError { message: message.into(), place: None, help: help.into() }
    }

    pub(crate) fn at(mut self, place: MeshLocation) -> Self {
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
