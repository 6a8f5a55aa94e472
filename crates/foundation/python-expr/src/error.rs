//! Errors of expressions with location.

use std::fmt;
use std::ops::Range;

/// Class of an error to which callers react.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExpressionErrorKind {
    /// Any error that is in none of the other classes.
    Invalid,
    /// Nothing defines a name.
    UndefinedName,
    /// The [`Scope`](crate::Scope) has reported the error already.
    Reported,
}

/// Error of an expression that cannot be parsed or evaluated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExpressionError {
    /// Class of the error.
    pub kind: ExpressionErrorKind,
    /// Description of the fault, one sentence without a full stop.
    pub message: String,
    /// Location of the fault: byte range in the expression's text.
    pub range: Range<usize>,
    /// Advice, if known.
    pub help: Option<String>,
}

/// Placeholder for a location that is set later, see [`ExpressionError::at`].
const UNPLACED: Range<usize> = usize::MAX..usize::MAX;

impl ExpressionError {
    /// Error whose location the evaluator sets.
    pub fn new(message: impl Into<String>) -> Self {
        let kind = ExpressionErrorKind::Invalid;
        Self { kind, message: message.into(), range: UNPLACED, help: None }
    }

    /// Sets the class.
    pub const fn with_kind(mut self, kind: ExpressionErrorKind) -> Self {
        self.kind = kind;
        self
    }

    /// Adds advice.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Sets the location, unless a more precise one is known.
    pub(super) fn at(mut self, range: &Range<usize>) -> Self {
        if self.range == UNPLACED {
            self.range = range.clone();
        }
        self
    }

    /// Removes a location in another text.
    pub(super) fn unplaced(mut self) -> Self {
        self.range = UNPLACED;
        self
    }
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match &self.help {
            Some(help) => write!(f, " ({help})"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for ExpressionError {}

/// Result type of this module's functions.
pub(super) type Outcome<T> = Result<T, ExpressionError>;

/// Returns an `Err` with this message and no location.
pub(super) fn fail<T>(message: impl Into<String>) -> Outcome<T> {
    Err(ExpressionError::new(message))
}
