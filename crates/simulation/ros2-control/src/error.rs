//! Errors of controllers.

use std::fmt;

/// Reason for which a controller refuses what it is asked for. Its text completes a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ControllerError {
    /// A parameter, a command or a topic is not usable.
    Refused(String),
    /// The state of a joint is not a number.
    Unmeasured(String),
}

impl fmt::Display for ControllerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(text) | Self::Unmeasured(text) => f.write_str(text),
        }
    }
}

impl std::error::Error for ControllerError {}

impl From<String> for ControllerError {
    fn from(text: String) -> Self {
        Self::Refused(text)
    }
}

impl From<&str> for ControllerError {
    fn from(text: &str) -> Self {
        Self::Refused(text.to_owned())
    }
}
