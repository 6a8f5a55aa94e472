//! What goes wrong in an expression, and where.

use std::fmt;
use std::ops::Range;

/// Why an expression could not be parsed or evaluated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExpressionError {
    /// What is wrong, one sentence without a full stop.
    pub message: String,
    /// The faulty part: byte offsets into the expression's text.
    pub range: Range<usize>,
    /// What to do about it, where that is known.
    pub help: Option<String>,
}

/// Stands for "whoever knows the place will fill it in", see [`ExpressionError::at`].
const UNPLACED: Range<usize> = usize::MAX..usize::MAX;

impl ExpressionError {
    /// An error whose place the evaluator fills in.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), range: UNPLACED, help: None }
    }

    /// Adds what to do about it.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Says where, unless a closer place is known already.
    pub(super) fn at(mut self, range: &Range<usize>) -> Self {
        if self.range == UNPLACED {
            self.range = range.clone();
        }
        self
    }

    /// Forgets the place, where it is one of another text.
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

/// Shorthand of this module's functions.
pub(super) type Outcome<T> = Result<T, ExpressionError>;

/// An `Err` of this message, still without a place.
pub(super) fn fail<T>(message: impl Into<String>) -> Outcome<T> {
    Err(ExpressionError::new(message))
}
